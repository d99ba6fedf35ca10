//! Lights with a spread: the factor by its formula and its integral, and samplers of what a point sees by the law that nothing is lost.

use core::f64::consts::{PI, TAU};
use etendue::light::Spread;
use etendue::{Disk, LightSampler, Parallelogram, Real, Rectangle, Vec2, Vec3};
use etendue_judge::generators::Random;
use etendue_judge::packets::Coordinates;
use etendue_judge::tolerances::ULP;
use etendue_oracle::tier::cases;
use etendue_oracle::{V3, along, basis, cross, dot, length, narrow, sub, unit, wide};

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

/// Whatever point of the light shines on the point can be drawn, samples are on the light, in its coordinates, and invert.
fn holds(
    sampler: &dyn LightSampler<f32>,
    whole: f64,
    scene: &Scene,
    of: &dyn Fn([f64; 2]) -> Option<V3>,
    random: &mut Random,
) -> [u32; 2] {
    let mut count = [0; 2];
    for _ in 0..60 {
        let uv = [random.unit_f64(), random.unit_f64()];
        let Some(x) = of(uv) else { continue };
        let to = sub(x, scene.p);
        let cos = dot(to, scene.normal).abs() / length(to);
        let tangent = (1.0 / (cos * cos) - 1.0).max(0.0).sqrt();
        let direction = vector::<f32>(unit(to));
        if factor(scene.angle, tangent) > 0.0 {
            count[0] += 1;
            assert!(
                sampler.pdf(direction) > 0.0,
                "{uv:?} is lost: {:?} {:?} {:?} from {:?}",
                scene.corner,
                scene.s,
                scene.t,
                scene.p
            );
        }
        let u = Vec2::new(random.unit(), random.unit());
        let s = sampler.sample(u);
        if s.pdf <= 0.0 {
            continue;
        }
        count[1] += 1;
        assert_eq!(s.pdf, sampler.pdf(s.direction));
        assert!(1.0 / f64::from(s.pdf) <= whole * 1.0001, "{} of {whole}", 1.0 / s.pdf);
        let position = along(scene.p, s.direction.at(0), f64::from(s.distance));
        let uv = [s.uv.x, s.uv.y].map(f64::from);
        let there = of(uv).unwrap_or(position);
        let size = length(scene.s) + length(scene.t) + length(sub(scene.corner, scene.p));
        let slack = 3e-6 * size / f64::from(s.direction.dot(s.normal)).abs();
        assert!(length(sub(position, there)) < slack, "{position:?} is not {there:?}");
        let back = sampler.invert(s.direction);
        let again = sampler.sample(back);
        let off = length(sub(again.direction.at(0), s.direction.at(0)));
        // directions are rounded: across a sliver, that is a part of its width, and so may move the inverse along a part of its length
        let size = 2.0 * (length(scene.s) + length(scene.t)) / f64::from(s.distance);
        let sliver = size.min(scene.angle).powi(2) * f64::from(s.pdf);
        let bound = 2e-5 + 2.0 * ULP * sliver;
        assert!(off < bound, "{u:?} inverts to {back:?}, off by {off}, allowed {bound}");
    }
    count
}

#[test]
fn nothing_that_shines_is_lost() {
    let mut random = Random::new(2);
    let mut count = [0; 2];
    let mut smaller = 0;
    for i in 0..cases(3000, 300_000) {
        let scene = scene(&mut random, i % 2 == 0);
        let Scene { corner, s, t, p, angle, normal } = scene;
        let spread = Spread::<f32>::new(angle);
        let light = Parallelogram::<f32>::new(vector(corner), vector(s), vector(t));
        let whole = 1.0 / f64::from(light.by_solid_angle(vector(p)).sample(Vec2::new(0.5, 0.5)).pdf);
        let of = |uv: [f64; 2]| Some(along(along(corner, s, uv[0]), t, uv[1]));
        let mut add = |[a, b]: [u32; 2]| count = [count[0] + a, count[1] + b];
        add(holds(&light.by_spread(vector(p), &spread), whole, &scene, &of, &mut random));
        let part = light.visible_part(vector(p), &spread);
        add(holds(&part.by_solid_angle(vector(p)), whole, &scene, &|uv| of(uv).filter(|_| false), &mut random));
        if i % 2 == 0 {
            let light = Rectangle::<f32>::new(vector(corner), vector(s), vector(t));
            let sampler = light.by_spread(vector(p), &spread);
            add(holds(&sampler, whole, &scene, &of, &mut random));
            smaller += u32::from(f64::from(sampler.solid_angle()) < 0.9 * whole);
        }
        let radius = length(s);
        let disk = Disk::<f32>::new(vector(corner), vector(normal), radius as f32);
        let frame = etendue::Frame::new(vector::<f64>(normal));
        let of = |[x, y]: [f64; 2]| {
            let q = [2.0 * x - 1.0, 2.0 * y - 1.0];
            let [s, t] = [frame.s, frame.t].map(|v| [v.x, v.y, v.z]);
            (q[0].hypot(q[1]) < 1.0).then(|| along(along(corner, s, radius * q[0]), t, radius * q[1]))
        };
        let whole = 1.0 / f64::from(disk.by_solid_angle(vector(p)).sample(Vec2::new(0.5, 0.5)).pdf);
        add(holds(&disk.by_spread(vector(p), &spread), whole, &scene, &of, &mut random));
    }
    println!("{count:?} directions and samples, {smaller} rectangles of which less is sampled");
    assert!(count.iter().all(|&n| n > cases(10_000, 1_000_000)) && smaller > cases(300, 30_000), "{count:?} {smaller}");
}

/// Irradiance by samples of the visible part is that of a sum over the light.
#[test]
fn irradiance_is_that_of_the_whole_light() {
    let mut random = Random::new(4);
    let mut lit = 0;
    for _ in 0..cases(40, 400) {
        let scene = scene(&mut random, true);
        let Scene { corner, s, t, p, angle, normal } = scene;
        let spread = Spread::<f64>::new(angle);
        // the receiver faces the light
        let height = dot(sub(corner, p), normal);
        let facing = normal.map(|x| x * height.signum());
        let light = Rectangle::<f64>::new(vector(corner), vector(s), vector(t));
        let sampler = light.by_spread(vector(p), &spread);
        let n = 200;
        let (mut sum, mut truth) = (0.0, 0.0);
        for i in 0..n * n {
            let uv = [i % n, i / n].map(|k| (k as f64 + 0.5) / n as f64);
            let sample = sampler.sample(Vec2::new(uv[0], uv[1]));
            if sample.pdf > 0.0 {
                let value = spread.attenuation(sample.direction, sample.normal);
                sum += value * sample.direction.dot(vector(facing)).max(0.0) / sample.pdf;
            }
            // over the light, or over the disk that the point sees, in polar coordinates: whichever is smaller, so that the sum is fine
            let reach = height.abs() * (0.5 * angle).tan();
            let (x, area) = if length(s) * length(t) < PI * reach * reach {
                (along(along(corner, s, uv[0]), t, uv[1]), length(s) * length(t))
            } else {
                let (r, turn) = (uv[0] * reach, TAU * uv[1]);
                let (a, b) = (unit(s), unit(cross(normal, s)));
                let x = along(along(along(p, normal, height), a, r * turn.cos()), b, r * turn.sin());
                (x, reach * TAU * r)
            };
            let from = sub(x, corner);
            let inside = [s, t].iter().all(|edge| (0.0..1.0).contains(&(dot(from, *edge) / dot(*edge, *edge))));
            if inside {
                let squared = dot(sub(x, p), sub(x, p));
                let tangent = (squared / (height * height) - 1.0).max(0.0).sqrt();
                truth += factor(angle, tangent) * height * height / (squared * squared) * area / (n * n) as f64;
            }
        }
        sum /= (n * n) as f64;
        if truth > 1e-3 {
            lit += 1;
            assert!((sum / truth - 1.0).abs() < 0.03, "{sum}, not {truth}");
        }
    }
    assert!(lit > cases(8, 80), "{lit}");
}
