//! Lights with a spread: the factor by its formula and its integral, and the part that a point sees by the law that nothing is lost. What they
//! give in images is in `panels.rs`.

use core::f64::consts::{PI, TAU};
use etendue::{LightSampler, Parallelogram, Real, Vec2, Vec3};
use etendue_judge::generators::Random;
use etendue_judge::packets::Coordinates;
use etendue_oracle::tier::cases;
use etendue_oracle::{V3, along, basis, cross, dot, length, narrow, sub, unit, wide};
use etendue_render::geometry::spread::Spread;

fn vector<R: Real>(v: V3) -> Vec3<R> {
    Coordinates::gather(&[v])
}

/// The factor at the angle to the normal whose tangent is given.
fn factor(angle: f64, tangent: f64) -> f64 {
    let half = 0.5 * angle;
    (half.tan() - tangent).max(0.0) / (half.tan() - half)
}

/// The factor is that of the formula, on both sides, and the power does not depend on the spread.
#[test]
fn attenuation_keeps_the_power() {
    let mut random = Random::new(1);
    for degrees in [0.1_f64, 1.0, 5.0, 5.7, 5.8, 20.0, 90.0, 150.0, 179.0, 179.99] {
        let angle = degrees.to_radians();
        let (narrow, wide) = (Spread::<f32>::new(angle), Spread::<f64>::new(angle));
        let steps = 20_000;
        let sum: f64 = (0..steps)
            .map(|i| {
                let theta = 0.5 * angle * (f64::from(i) + 0.5) / f64::from(steps);
                let w = Vec3::new(theta.sin(), 0.0, theta.cos());
                TAU * theta.sin() * theta.cos() * wide.attenuation(w, Vec3::new(0.0, 0.0, 1.0)) * 0.5 * angle
                    / f64::from(steps)
            })
            .sum();
        assert!((sum / PI - 1.0).abs() < 1e-6, "{degrees}: {sum}");
        let peak = factor(angle, 0.0);
        for _ in 0..cases(200, 20_000) {
            let n = random.direction();
            let (s, t) = basis(n);
            let theta = random.unit_f64() * 0.6 * angle.min(2.5);
            let turn = TAU * random.unit_f64();
            let off = along(s.map(|x| x * turn.cos()), t, turn.sin());
            let w = along(n.map(|x| x * theta.cos()), off, theta.sin());
            let truth = factor(angle, theta.tan());
            let off = (wide.attenuation(vector(w), vector(n)) - truth).abs();
            assert!(off < 1e-9 * peak, "{degrees} at {theta}: off by {off} of {peak}");
            let (w, n) = (vector::<f32>(w), vector::<f32>(n));
            let got = narrow.attenuation(w, n);
            // as for directions that are rounded
            let rounding = (3e-7 / (0.5 * angle).tan() + 1e-6) * peak / (theta.cos() * theta.cos());
            assert!((f64::from(got) - truth).abs() < rounding, "{degrees} at {theta}: {got}, not {truth}");
            assert_eq!(got, narrow.attenuation(w, -n));
        }
    }
}

/// A light, a point that it may shine on, and a spread.
struct Scene {
    corner: V3,
    s: V3,
    t: V3,
    normal: V3,
    p: V3,
    angle: f64,
}

fn scene(random: &mut Random, is_rectangle: bool) -> Scene {
    let normal = random.direction();
    let (a, b) = basis(normal);
    let (long, wide) = (random.magnitude(0.01, 10.0), random.magnitude(0.01, 10.0));
    let s = a.map(|x| x * long);
    let skew = if is_rectangle { 0.0 } else { random.range(-1.0, 1.0) };
    let t = along(b.map(|x| x * wide), a, skew * wide);
    let corner: V3 = core::array::from_fn(|_| random.range(-1.0, 1.0));
    // over the light, or beside it
    let over = along(along(corner, s, random.range(-0.5, 1.5)), t, random.range(-0.5, 1.5));
    let side = if random.below(4) == 0 { -1.0 } else { 1.0 };
    let p = along(over, normal, side * random.magnitude(1e-3, 10.0));
    let angle = random.magnitude(0.5, 170.0).to_radians();
    let [corner, s, t, p] = [corner, s, t, p].map(super_narrow);
    Scene { corner, s, t, normal: unit(cross(s, t)), p, angle }
}

/// What single precision makes of it.
fn super_narrow(v: V3) -> V3 {
    wide(narrow(v))
}

/// How far a ray from the point passes by the light, in roundings of the coordinates and of the distance.
fn past(&Scene { corner, s, t, normal, p, .. }: &Scene, w: V3) -> f64 {
    let distance = dot(sub(corner, p), normal) / dot(w, normal);
    let on = sub(along(p, w, distance), corner);
    // how far it is outside of each pair of edges
    let outside = |edge: V3, other: V3| {
        let upright = unit(cross(other, normal));
        let [at, end] = [on, edge].map(|v| dot(v, upright) * dot(edge, upright).signum());
        (-at).max(at - end)
    };
    let reach = corner.into_iter().chain(p).fold(distance, |most, x| most.max(x.abs()));
    outside(s, t).max(outside(t, s)) * dot(w, normal).abs() / (reach / 16_777_216.0)
}

/// Whatever point of the light shines on the point is in the visible part, which is no larger than the light.
#[test]
fn nothing_that_shines_is_lost() {
    let mut random = Random::new(2);
    let (mut shining, mut smaller, mut worst) = (0, 0, 0.0_f64);
    for i in 0..cases(3000, 300_000) {
        let scene = scene(&mut random, i % 2 == 0);
        let Scene { corner, s, t, p, angle, normal } = scene;
        let light = Parallelogram::<f32>::new(vector(corner), vector(s), vector(t));
        let part = Spread::<f32>::new(angle).visible_part(&light, vector(p));
        let [of_part, of_whole] = [part, light].map(|light| light.by_solid_angle(vector(p)));
        let whole = f64::from(of_whole.solid_angle());
        assert!(f64::from(of_part.solid_angle()) <= whole * 1.0001, "{} of {whole}", of_part.solid_angle());
        smaller += u32::from(f64::from(of_part.solid_angle()) < 0.9 * whole);
        for _ in 0..60 {
            let uv = [random.unit_f64(), random.unit_f64()];
            let to = sub(along(along(corner, s, uv[0]), t, uv[1]), p);
            let cos = dot(to, normal).abs() / length(to);
            let tangent = (1.0 / (cos * cos) - 1.0).max(0.0).sqrt();
            if factor(angle, tangent) > 0.0 {
                shining += 1;
                let pdf = of_part.pdf(vector(unit(to)));
                assert!(pdf > 0.0, "{uv:?} is lost: {corner:?} {s:?} {t:?} from {p:?}, {angle}");
            }
            let drawn = of_part.sample(Vec2::new(random.unit(), random.unit()));
            if drawn.pdf > 0.0 {
                worst = worst.max(past(&scene, wide(drawn.direction.to_array())));
            }
        }
    }
    println!("{shining} directions, {smaller} lights of which less is sampled, {worst:.2} roundings past the edges");
    assert!(worst < 2.0, "{worst}");
    assert!(shining > cases(10_000, 1_000_000) && smaller > cases(600, 60_000), "{shining} {smaller}");
}
