//! Cosines after a linear map: against GGX, and the light of shapes against quadratures in double precision that know only the density.

mod spheres;
mod table;

use crate::lights::stretch;
use core::f64::consts::{PI, TAU};
use etendue::light::Polygon;
use etendue::reflection::Reflection;
use etendue::{LightSampler, Parallelogram, Real, Rectangle, Triangle, Vec2, Vec3, Warp};
use etendue_judge::generators::Random;
use etendue_judge::packets::Coordinates;
use etendue_judge::tolerances::ULP;
use etendue_oracle::direct::microfacets;
use etendue_oracle::tier::cases;
use etendue_oracle::{V3, along, basis, cross, dot, length, narrow, sub, unit, wide};

fn vector<R: Real>(v: V3) -> Vec3<R> {
    Coordinates::gather(&[v])
}

/// A surface at the origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ReflectingSurface {
    pub(crate) alpha: f64,
    pub(crate) normal: V3,
    pub(crate) view: V3,
}

impl ReflectingSurface {
    fn new(random: &mut Random) -> Self {
        Self::on(random.direction(), random)
    }
    /// A surface of random roughness with this normal, seen from a random direction above it.
    pub(crate) fn on(normal: V3, random: &mut Random) -> Self {
        let (s, t) = basis(normal);
        let cos = random.magnitude(1e-3, 1.0);
        let turn = TAU * random.unit_f64();
        let sine = (1.0 - cos * cos).sqrt();
        let flat = along(s.map(|x| x * turn.cos()), t, turn.sin());
        let view = along(normal.map(|x| x * cos), flat, sine);
        Self { alpha: random.magnitude(1e-3, 1.0), normal, view: unit(view) }
    }
    pub(crate) fn reflection<R: Real>(&self) -> Reflection<R> {
        Reflection::new(R::lit(self.alpha), vector(self.normal), vector(self.view))
    }
    /// f cosθ with a Fresnel factor of 1.
    pub(crate) fn reflected(&self, w: V3) -> f64 {
        dot(w, self.normal) * microfacets(self.view, w, self.normal, self.alpha)
    }
}

/// The density integrates to one over the hemisphere, samples have the density that the inverse says, and all is above the horizon.
#[test]
fn samples_have_the_density() {
    let mut random = Random::new(1);
    let mut worst = 0.0_f64;
    for _ in 0..cases(300, 10_000) {
        let place = ReflectingSurface::new(&mut random);
        let (single, double) = (place.reflection::<f32>(), place.reflection::<f64>());
        for _ in 0..20 {
            let u = [random.unit(), random.unit()];
            let w = single.sample(Vec2::new(u[0], u[1]));
            assert!((length(w.at(0)) - 1.0).abs() < 3e-7 && w.dot(vector(place.normal)) > -2e-7, "{place:?}: {w:?}");
            let back = single.invert(w);
            let again = single.sample(back);
            let off = length(sub(again.at(0), w.at(0)));
            // a rounded direction after the map, as the inverse of the map stretches it
            let ends = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
                .map(|v| length(double.from_cosine(vector(v)).at(0)));
            let stretch = ends.into_iter().fold(1.0, f64::max) * length(double.to_cosine(vector(w.at(0))).at(0));
            // near the horizon, a step of u moves the direction farther
            if (back.x - u[0]).abs().max((back.y - u[1]).abs()) <= 8.0 * ULP as f32 {
                continue;
            }
            worst = worst.max(off / stretch.max(1.0));
            assert!(
                off < 2e-6 * stretch.max(1.0),
                "{place:?} {u:?}: {back:?} is off by {off}, stretched {stretch} times"
            );
        }
        let u = [(); 2].map(|()| 0.05 + 0.9 * random.unit_f64());
        let draw = |u: Vec2<f64>| {
            let w = double.sample(u);
            (w.at(0), double.pdf(w), ())
        };
        let stretch = stretch(draw, u).unwrap();
        assert!((stretch - 1.0).abs() < 3e-3, "{place:?}: the map stretches {stretch} times the density at {u:?}");
    }
    println!("inverses are those of directions at most {worst:.1e} away, times the stretch of the map");
}

/// Estimates of all reflected light by samples of the fit: their mean is the albedo of the table, and their spread is what is published.
#[test]
fn fit_is_that_of_ggx() {
    for (alpha, cos, most) in [
        (0.01, 0.9, 0.04),
        (0.05, 0.7, 0.15),
        (0.1, 0.5, 0.32),
        (0.2, 0.9, 0.2),
        (0.2, 0.5, 0.35),
        (0.4, 0.3, 0.37),
        (0.7, 0.1, 0.25),
        (1.0, 0.9, 0.05),
    ] {
        let view = [(1.0_f64 - cos * cos).sqrt(), 0.0, cos];
        let place = ReflectingSurface { alpha, normal: [0.0, 0.0, 1.0], view };
        let fit = place.reflection::<f64>();
        let (mut sum, mut squares, mut schlick) = (0.0, 0.0, 0.0);
        let side = 400;
        for k in 0..side * side {
            let u = [k / side, k % side].map(|i| (f64::from(i) + 0.5) / f64::from(side));
            let w = fit.sample(Vec2::new(u[0], u[1]));
            let part = place.reflected(w.at(0)) / fit.pdf(w);
            let half = unit(along(view, w.at(0), 1.0));
            sum += part;
            squares += part * part;
            schlick += part * (1.0 - dot(half, view)).powi(5);
        }
        let count = f64::from(side * side);
        let (mean, schlick) = (sum / count, schlick / sum);
        assert!((mean - fit.albedo()).abs() < 5e-3, "α {alpha}, cosθ {cos}: {mean}, not {}", fit.albedo());
        assert!((schlick - fit.schlick()).abs() < 4e-3, "α {alpha}, cosθ {cos}: {schlick}, not {}", fit.schlick());
        let spread = (squares / count - mean * mean).max(0.0).sqrt() / mean;
        assert!(spread < most && spread > 0.2 * most, "α {alpha}, cosθ {cos}: {spread}, not about {most}");
    }
}

/// π times the density, integrated over the directions within an angle of an axis.
fn over_cap(place: &ReflectingSurface, axis: V3, sine: f64, steps: usize) -> f64 {
    let lobe = place.reflection::<f64>();
    let (s, t) = basis(axis);
    let versine = sine * sine / (1.0 + (1.0 - sine * sine).max(0.0).sqrt());
    let mut sum = 0.0;
    for i in 0..steps {
        let k = versine * (i as f64 + 0.5) / steps as f64;
        let (z, r) = (1.0 - k, (k * (2.0 - k)).sqrt());
        for j in 0..2 * steps {
            let turn = TAU * (j as f64 + 0.5) / (2 * steps) as f64;
            let w = along(along(axis.map(|x| x * z), s, r * turn.cos()), t, r * turn.sin());
            sum += lobe.pdf(vector(w));
        }
    }
    PI * sum * TAU * versine / (2 * steps * steps) as f64
}

/// π times the part of evenly spread samples of the lobe that lie inside: for large parts, whose edge may be sharp. Off by at most 4e−3.
fn part_of_samples(place: &ReflectingSurface, inside: impl Fn(V3) -> bool) -> f64 {
    let lobe = place.reflection::<f64>();
    let steps = 500;
    let place = |k: usize| (k as f64 + 0.5) / steps as f64;
    let is_inside = |k: &usize| inside(lobe.sample(Vec2::new(place(k / steps), place(k % steps))).at(0));
    PI * (0..steps * steps).filter(is_inside).count() as f64 / (steps * steps) as f64
}

/// Spheres: small, large, grazing, cut by the horizon, behind it, and around the point.
#[test]
fn spheres_have_their_part_of_the_lobe() {
    let mut random = Random::new(3);
    let (mut whole, mut cut, mut worst) = (0, 0, [0.0_f64; 2]);
    for _ in 0..cases(200, 2_000) {
        let place = ReflectingSurface { alpha: random.magnitude(0.03, 1.0), ..ReflectingSurface::new(&mut random) };
        // near the lobe, or anywhere
        let axis = if random.below(2) == 0 {
            let near = place.reflection::<f64>().sample(Vec2::new(random.unit_f64(), random.unit_f64()));
            near.at(0)
        } else {
            random.direction()
        };
        let sine = random.magnitude(1e-3, 0.999);
        let height = dot(axis, place.normal);
        let small = sine < 0.1;
        let cos = (1.0 - sine * sine).sqrt();
        let truth =
            if small { over_cap(&place, axis, sine, 200) } else { part_of_samples(&place, |w| dot(w, axis) > cos) };
        let wide = place.reflection::<f64>().sphere(vector(axis), sine);
        let single = f64::from(place.reflection::<f32>().sphere(vector(axis), sine as f32));
        let off = (wide - truth).abs();
        if height > sine {
            whole += 1;
            let bound = if small { 2e-3 * truth + 1e-9 } else { 4e-3 };
            assert!(off < bound, "{place:?}, {axis:?} within {sine}: {wide}, not {truth}");
        } else if height > -sine {
            cut += 1;
            let bound = if small { 2e-2 * truth + 1e-6 } else { 4e-3 };
            assert!(off < bound, "{place:?}, {axis:?} within {sine}: {wide}, not {truth}");
        } else {
            assert_eq!([wide, single], [0.0; 2], "{place:?}, {axis:?} within {sine}");
        }
        let off = (single - wide).abs();
        let k = usize::from(height < sine);
        worst[k] = worst[k].max(off / (1e-4 + wide));
        assert!(off < 2e-4 * wide + 3e-7 / sine, "{place:?}, {axis:?} within {sine}: {single}, not {wide}");
    }
    assert!(whole > 20 && cut > 20, "{whole} whole, {cut} cut");
    println!(
        "greatest error in single precision {:.1e} and {:.1e} of what spheres cover, whole and cut",
        worst[0], worst[1]
    );
    let place = ReflectingSurface { alpha: 0.3, ..ReflectingSurface::new(&mut random) };
    let lobe = place.reflection::<f32>();
    assert_eq!(lobe.sphere(vector([0.1, 0.0, 0.0]), 1.0), PI as f32);
    for radius in [0.0, -1.0] {
        assert_eq!(lobe.sphere(vector([0.1, 0.0, 0.0]), radius), 0.0);
    }
}

/// π times the density over a parallelogram, or the half of it that is a triangle.
fn over_flat(place: &ReflectingSurface, corner: V3, s: V3, t: V3, half: bool, steps: usize) -> f64 {
    let lobe = place.reflection::<f64>();
    let normal = cross(s, t);
    let mut sum = 0.0;
    for k in 0..steps * steps {
        let [x, y] = [k / steps, k % steps].map(|i| (i as f64 + 0.5) / steps as f64);
        let [x, y, weight] = if half { [x, (1.0 - x) * y, 1.0 - x] } else { [x, y, 1.0] };
        let v = along(along(corner, s, x), t, y);
        let distance = length(v);
        sum += weight * lobe.pdf(vector(unit(v))) * dot(v, normal).abs() / distance.powi(3);
    }
    PI * sum / (steps * steps) as f64
}

struct Flat {
    place: ReflectingSurface,
    corner: V3,
    s: V3,
    t: V3,
}

/// A surface, and a flat light around a direction that it reflects.
fn flat(random: &mut Random) -> Flat {
    let place = ReflectingSurface { alpha: random.magnitude(0.03, 1.0), ..ReflectingSurface::new(random) };
    let w = place.reflection::<f64>().sample(Vec2::new(random.unit_f64(), random.unit_f64())).at(0);
    let distance = random.magnitude(0.5, 20.0);
    let mut edge = || random.direction().map(|x| x * random.magnitude(0.02, 2.0));
    let (s, t) = (edge(), edge());
    let corner = along(along(w.map(|x| x * distance), s, -0.5), t, -0.5);
    let [corner, s, t] = [corner, s, t].map(|v| wide(narrow(v)));
    Flat { place, corner, s, t }
}

/// The covered part of the lobe is that of the quadrature, and samples of f/g have its mean.
#[test]
fn flat_lights_have_their_part_of_the_lobe() {
    let mut random = Random::new(4);
    for _ in 0..cases(40, 400) {
        let Flat { place, corner, s, t } = flat(&mut random);
        let truth = [false, true].map(|half| {
            let part = part_of_samples(&place, |w| {
                let over = dot(w, cross(s, t));
                let [x, y] = [dot(w, cross(corner, t)) / -over, dot(w, cross(corner, s)) / over];
                let reaches = dot(corner, cross(s, t)) / over > 0.0;
                reaches && x >= 0.0 && y >= 0.0 && if half { x + y <= 1.0 } else { x <= 1.0 && y <= 1.0 }
            });
            // where most of the lobe is covered, its edges count
            if part > 0.3 { [part, 6e-3] } else { [over_flat(&place, corner, s, t, half, 300), 0.0] }
        });
        let near = |got: f64, [truth, bound]: [f64; 2]| {
            let bound = bound + if bound > 0.0 { 0.0 } else { 3e-2 * truth + 1e-6 };
            assert!((got - truth).abs() < bound, "{place:?} {corner:?} {s:?} {t:?}: {got}, not {truth}");
        };
        let reflection = place.reflection::<f64>();
        let (c, u, v) = (vector::<f64>(corner), vector::<f64>(s), vector::<f64>(t));
        let triangle = Triangle { v0: c, e1: u, e2: v }.by_reflection(Vec3::default(), &reflection);
        let parallelogram = Parallelogram::new(c, u, v).by_reflection(Vec3::default(), &reflection);
        let polygon = Polygon::new([c, c + u, c + u + v, c + v]).by_reflection(Vec3::default(), &reflection);
        let got = [parallelogram, Rectangle::new(c, u, v).by_reflection(Vec3::default(), &reflection)]
            .map(|sampler| sampler.projected_solid_angle());
        for got in [got[0], got[1], polygon.projected_solid_angle()] {
            near(got, truth[0]);
        }
        near(triangle.projected_solid_angle(), truth[1]);
    }
}

/// Samplers are closed: the pdf of a sample is that of its direction, samples are on the light, and inverses lead back.
fn closed(sampler: &dyn LightSampler<f32>, random: &mut Random, what: &str) -> [u32; 2] {
    let mut count = [0; 2];
    for _ in 0..20 {
        let u = Vec2::new(random.unit(), random.unit());
        let drawn = sampler.sample(u);
        count[0] += 1;
        assert_eq!(drawn.pdf, sampler.pdf(drawn.direction), "{what}");
        assert!(drawn.pdf.is_finite() && drawn.pdf >= 0.0, "{what}: {}", drawn.pdf);
        if drawn.pdf > 0.0 {
            count[1] += 1;
            let hit = sampler.hit(drawn.direction);
            assert_eq!((hit.pdf, hit.distance, hit.emits), (drawn.pdf, drawn.distance, drawn.emits), "{what}");
            let again = sampler.sample(sampler.invert(drawn.direction));
            let off = length(sub(again.direction.at(0), drawn.direction.at(0)));
            // where the density ends at 0, and the map stretches besides, a step of u is as far
            let step = 1.0 / 16_777_216.0;
            let moved = [Vec2::new(u.x - step, u.y), Vec2::new(u.x, u.y - step)].map(|u| {
                let near = sampler.sample(Vec2::new(u.x.max(0.0), u.y.max(0.0)));
                length(sub(near.direction.at(0), drawn.direction.at(0)))
            });
            let steps = moved[0] + moved[1];
            assert!(off < 2e-4 || off < 3.0 * steps, "{what}: {u:?} is off by {off}, a step by {steps}");
        }
    }
    count
}

/// Samplers are closed, their density is that of the map, and directions beside the light have none.
#[test]
fn samplers_are_closed() {
    let (mut random, mut sums, mut smooth) = (Random::new(6), [0; 2], 0);
    let origin = Vec3::default();
    for _ in 0..cases(400, 20_000) {
        let Flat { place, corner, s, t } = flat(&mut random);
        let reflection = place.reflection::<f32>();
        let (c, u, v) = (vector::<f32>(corner), vector::<f32>(s), vector::<f32>(t));
        let samplers: [&dyn LightSampler<f32>; 3] = [
            &Triangle { v0: c, e1: u, e2: v }.by_reflection(origin, &reflection),
            &Parallelogram::new(c, u, v).by_reflection(origin, &reflection),
            &Polygon::new([c, c + u, c + u + v]).by_reflection(origin, &reflection),
        ];
        for sampler in samplers {
            let count = closed(sampler, &mut random, &format!("{place:?} {corner:?} {s:?} {t:?}"));
            sums = [0, 1].map(|k| sums[k] + count[k]);
        }
        let reflection = place.reflection::<f64>();
        let [c, u, v] = [corner, s, t].map(vector::<f64>);
        let samplers: [&dyn LightSampler<f64>; 3] = [
            &Triangle { v0: c, e1: u, e2: v }.by_reflection(Vec3::default(), &reflection),
            &Parallelogram::new(c, u, v).by_reflection(Vec3::default(), &reflection),
            &Polygon::new([c, c + u, c + u + v, c + v]).by_reflection(Vec3::default(), &reflection),
        ];
        let is_facing = dot(unit(cross(s, t)), unit(corner)).abs() > 0.1;
        for sampler in samplers {
            let draw = |u: Vec2<f64>| {
                let s = sampler.sample(u);
                (s.direction.at(0), s.pdf, s.pdf > 0.0)
            };
            let u = [random.unit_f64(), random.unit_f64()];
            if let Some(stretch) = stretch(draw, u).filter(|_| draw(u.into()).2) {
                smooth += 1;
                let off = (stretch - 1.0).abs();
                assert!(
                    off < 5e-3,
                    "{place:?} {corner:?} {s:?} {t:?}: the map stretches {stretch} times the density at {u:?}"
                );
            }
            for [x, y] in [[-0.01, 0.3], [0.3, -0.01], [1.01, 0.3], [0.7, 1.01]] {
                let beside = vector(unit(along(along(corner, s, x), t, y)));
                assert!(!is_facing || sampler.pdf(beside) == 0.0 && sampler.hit(beside).pdf == 0.0, "{beside:?}");
            }
        }
    }
    assert!(smooth > 1000, "{smooth}");
    assert!(f64::from(sums[1]) > 0.99 * f64::from(sums[0]), "{} of {} samples are valid", sums[1], sums[0]);
}

/// A roughness that is no number, a view from below and a light in the plane of the point. The fuzz body `reflection` tries any numbers.
#[test]
fn degenerate_input_gives_nothing() {
    let up = Vec3::new(0.0, 0.0, 1.0_f32);
    let [x, y] = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)];
    for alpha in [f32::NAN, f32::INFINITY, 0.0, 0.3] {
        for view in [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0; 3]].map(Vec3::from) {
            let lobe = Reflection::new(alpha, up, view);
            assert!((0.0..=1.0).contains(&lobe.albedo()) && (view.z > 0.0 || lobe.albedo() == 0.0), "{lobe:?}");
            for w in [up, x, -up, Vec3::new(0.5, 0.7, f32::MAX)] {
                let (pdf, u) = (lobe.pdf(w), lobe.invert(w));
                assert!(pdf.is_finite() && pdf >= 0.0, "{alpha} {view:?} {w:?}: {pdf}");
                assert!((0.0..1.0).contains(&u.x) && (0.0..1.0).contains(&u.y));
            }
            let sampler = Parallelogram::new(x, y, x + y).by_reflection(Vec3::default(), &lobe);
            assert_eq!((sampler.sample(Vec2::new(0.5, 0.5)).pdf, sampler.projected_solid_angle()), (0.0, 0.0));
        }
    }
}
