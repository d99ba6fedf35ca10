//! Spheres sampled by reflection, against quadratures in double precision that know only where a sphere is and the density of the lobe.

use super::{ReflectingSurface, closed, vector};
use crate::lights::stretch;
use core::f64::consts::TAU;
use etendue::light::SphereByReflection;
use etendue::reflection::Reflection;
use etendue::{LightSampler, Real, Sphere, Vec2, Vec3, Warp};
use etendue_judge::generators::Random;
use etendue_judge::packets::Coordinates;
use etendue_judge::tolerances::{ROUNDING, ULP};
use etendue_oracle::tier::cases;
use etendue_oracle::{V3, along, basis, dot, length, narrow, wide};

/// A surface, and a sphere of an angular radius about what it reflects, anywhere, or on the horizon.
#[derive(Clone, Copy, Debug)]
struct Ball {
    place: ReflectingSurface,
    center: V3,
    radius: f64,
}

impl Ball {
    fn new(random: &mut Random, sine: f64, least_alpha: f64) -> Self {
        let place = ReflectingSurface { alpha: random.magnitude(least_alpha, 1.0), ..ReflectingSurface::new(random) };
        let axis = match random.below(3) {
            0 => place.reflection::<f64>().sample(Vec2::new(random.unit_f64(), random.unit_f64())).at(0),
            1 => random.direction(),
            // cut by the horizon
            _ => {
                let height = (2.0 * random.unit_f64() - 1.0) * sine.min(1.0);
                let (s, t) = basis(place.normal);
                let turn = TAU * random.unit_f64();
                let flat = along(s.map(|x| x * turn.cos()), t, turn.sin());
                along(place.normal.map(|x| x * height), flat, (1.0 - height * height).sqrt())
            }
        };
        let distance = random.magnitude(1e-3, 1e3);
        let center = wide(narrow(axis.map(|x| x * distance)));
        Self { place, center, radius: f64::from((sine * length(center)) as f32) }
    }
    fn sampler<R: Real>(&self) -> SphereByReflection<R> {
        let light = Sphere::new(vector(self.center), R::lit(self.radius));
        light.by_reflection(Vec3::default(), &self.place.reflection())
    }
    /// Sine of the angular radius.
    fn sine(&self) -> f64 {
        self.radius / length(self.center)
    }
    /// Height of the axis over the horizon, as a cosine.
    fn height(&self) -> f64 {
        dot(self.center, self.place.normal) / length(self.center)
    }
    /// The middles of cells of equal solid angle of the sphere as it is seen.
    fn directions(&self, steps: usize) -> (impl Iterator<Item = V3>, f64) {
        let axis = self.center.map(|x| x / length(self.center));
        let (s, t) = basis(axis);
        let sine = self.sine();
        let versine = if sine < 1.0 { sine * sine / (1.0 + (1.0 - sine * sine).sqrt()) } else { 2.0 };
        let each = move |i: usize| {
            let [row, column] = [i / (2 * steps), i % (2 * steps)].map(|i| i as f64 + 0.5);
            let k = versine * row / steps as f64;
            let (turn, r) = (TAU * column / (2 * steps) as f64, (k * (2.0 - k)).sqrt());
            along(along(axis.map(|x| x * (1.0 - k)), s, r * turn.cos()), t, r * turn.sin())
        };
        ((0..2 * steps * steps).map(each), TAU * versine / (2 * steps * steps) as f64)
    }
}

/// Sines of angular radii: tiny, small, wide, nearly touching, touching but for rounding, and around the point.
const SINES: [f64; 8] = [1e-6, 1e-4, 1e-2, 0.2, 0.7, 0.98, 0.999_999_9, 2.0];

/// The pdf integrates to one over the sphere above the horizon, it is the density of the samples, which all hit the sphere there, and their
/// weights have the mean of the lobe over the sphere.
#[test]
fn samples_have_the_density() {
    let mut random = Random::new(21);
    let (mut cut, mut below) = ([0; SINES.len()], 0);
    for (k, sine) in SINES.into_iter().enumerate() {
        let mut worst = 0.0_f64;
        for _ in 0..cases(60, 1_000) {
            let ball = Ball::new(&mut random, sine, 0.3);
            // a grazing lobe needs a finer quadrature than this
            if dot(ball.place.view, ball.place.normal) < 0.3 {
                continue;
            }
            let (sampler, lobe) = (ball.sampler::<f64>(), ball.place.reflection::<f64>());
            let (directions, each) = ball.directions(if sine > 0.5 { 220 } else { 110 });
            let (mut whole, mut part) = (0.0, 0.0);
            for w in directions {
                whole += each * sampler.pdf(vector(w));
                part += each * lobe.pdf(vector(w));
            }
            let above = ball.height() + sine;
            if above < 0.0 {
                below += 1;
                assert_eq!(whole, 0.0, "{ball:?}");
                assert_eq!(sampler.sample(Vec2::new(0.3, 0.6)).pdf, 0.0, "{ball:?}");
                continue;
            }
            // the quadrature resolves no sliver
            let sliver = above < 0.2 * sine;
            if !sliver {
                cut[k] += usize::from(ball.height() < sine);
                assert!((whole - 1.0).abs() < 1e-2, "{ball:?}: the pdf integrates to {whole}");
            }
            let side = 64_u16;
            let (mut sums, mut lost) = ([0.0; 2], 0);
            let (single, count) = (ball.sampler::<f32>(), f64::from(side * side));
            for k in 0..side * side {
                let u = [k / side, k % side].map(|i| (f64::from(i) + 0.5) / f64::from(side));
                let s = sampler.sample(Vec2::new(u[0], u[1]));
                assert!(s.pdf > 0.0 && s.emits == (sine <= 1.0), "{ball:?} at {u:?}: {s:?}");
                sums[0] += lobe.pdf(s.direction) / s.pdf / count;
                let s = single.sample(Vec2::new(u[0] as f32, u[1] as f32));
                lost += i32::from(s.pdf <= 0.0);
                if s.pdf > 0.0 {
                    sums[1] += lobe.pdf(vector(s.direction.at(0))) / f64::from(s.pdf) / count;
                }
            }
            if !sliver {
                assert!((sums[0] / part - 1.0).abs() < 1e-2, "{ball:?}: the lobe has {}, not {part}", sums[0]);
            }
            // single precision resolves a direction to some 1e-7
            let off = (sums[1] / sums[0] - 1.0).abs();
            worst = worst.max(off);
            assert!(
                off < 1e-5 + (4e-9 / sine + 2e-7 / above) * (ROUNDING / ULP),
                "{ball:?}: {} in single precision, not {}",
                sums[1],
                sums[0]
            );
            assert!(f64::from(lost) < 2.0 + 1e-6 * count / above, "{ball:?}: {lost} samples miss");
            let u = [(); 2].map(|()| 0.05 + 0.9 * random.unit_f64());
            let draw = |u: Vec2<f64>| {
                let s = sampler.sample(u);
                (s.direction.at(0), s.pdf, ())
            };
            let stretch = stretch(draw, u).unwrap();
            // corners of the density have no derivative
            assert!((stretch - 1.0).abs() < 1e-2, "{ball:?}: the map stretches {stretch} times the density at {u:?}");
        }
        println!("sine {sine}: the mean of weights in single precision is off by up to {worst:.1e}");
    }
    assert!(cut.iter().all(|&n| n > 1) && below > 5, "{cut:?} are cut, {below} below the horizon");
}

/// The standard deviation of π times the pdf of the lobe over that of the samples is as small as documented.
#[test]
fn samples_vary_little() {
    let mut random = Random::new(22);
    for (sine, most) in [(1e-4, 0.05), (0.05, 0.06), (0.3, 0.08), (0.9, 0.12), (2.0, 0.21)] {
        let (mut mean, mut greatest, mut count) = (0.0, 0.0_f64, 0.0);
        for _ in 0..cases(100, 1_000) {
            let ball = Ball::new(&mut random, sine, 0.1);
            let (sampler, lobe) = (ball.sampler::<f64>(), ball.place.reflection::<f64>());
            if ball.height() < -0.8 * sine || dot(ball.place.view, ball.place.normal) < 0.1 {
                continue;
            }
            let (side, mut sum, mut squares) = (64, 0.0, 0.0);
            for k in 0..side * side {
                let u = [k / side, k % side].map(|i| (f64::from(i) + 0.5) / f64::from(side));
                let s = sampler.sample(Vec2::new(u[0], u[1]));
                let part = lobe.pdf(s.direction) / s.pdf;
                sum += part;
                squares += part * part;
            }
            let deviation = (squares * f64::from(side * side) / (sum * sum) - 1.0).max(0.0).sqrt();
            mean += deviation;
            greatest = greatest.max(deviation);
            count += 1.0;
        }
        mean /= count;
        println!("sine {sine}: standard deviations of {mean:.3} on average, up to {greatest:.3}");
        assert!(mean < most && mean > 0.1 * most, "sine {sine}: {mean}, not about {most}");
    }
}

/// Samples lead back, and hits have the pdf of samples, in single precision.
#[test]
fn samplers_are_closed() {
    let mut random = Random::new(23);
    for sine in SINES {
        for _ in 0..cases(40, 4_000) {
            let ball = Ball::new(&mut random, sine, 0.03);
            let [found, valid] = closed(&ball.sampler::<f32>(), &mut random, &format!("{ball:?}"));
            let above = ball.height() + sine.min(1.0);
            if above > (0.1 * sine.min(1.0)).max(1e-5) && dot(ball.place.view, ball.place.normal) > 0.1 {
                assert!(valid + 1 >= found, "{ball:?}: {valid} of {found} samples are valid");
            }
            // beside the sphere, and below the horizon, there is nothing
            let axis = ball.center.map(|x| x / length(ball.center));
            let (s, _) = basis(axis);
            let sampler = ball.sampler::<f32>();
            if sine < 0.9 {
                let beside =
                    vector(along(axis.map(|x| x * (1.0 - 4.0 * sine * sine).max(0.0).sqrt()), s, 2.0 * sine.min(0.5)));
                let clear = 2.0 * sine.min(0.5) > 1.1 * sine;
                if sine > 1e-5 && clear {
                    assert_eq!((sampler.pdf(beside), sampler.hit(beside).pdf), (0.0, 0.0), "{ball:?}");
                }
            }
            let under = vector(ball.place.normal.map(|x| -x));
            assert_eq!(sampler.pdf(under), 0.0, "{ball:?}");
        }
    }
}

/// A sphere whose angular radius underflows, on the horizon of a normal with a subnormal component: the map had no axes, and directions were NaN.
#[test]
fn spheres_without_an_angular_radius_have_directions() {
    let normal = Vec3::new(0.6952027, 1.085_744_3e-38, -0.7188137_f32);
    let sphere = Sphere::new(Vec3::new(4.471_487e-39, 2.598_459e20, 4.471_487e-39), 4.471_487e-39);
    let sampler = sphere.by_reflection(Vec3::new(0.0, 0.0, -1.4039216), &Reflection::new(0.3, normal, normal));
    let s = sampler.sample(Vec2::new(1e-20, 0.944_271_8));
    assert!(s.pdf == 0.0 && (s.direction.length() - 1.0).abs() < 1e-6 && s.normal.max_abs().is_finite(), "{s:?}");
}

/// Whatever the sphere, results are finite; without a radius, or below the horizon, there is no sample.
#[test]
fn degenerate_spheres_give_nothing() {
    let up = Vec3::new(0.0, 0.0, 1.0_f32);
    let numbers = [0.0, -1.0, 1e-40, 1e-30, 1e-19, 1e-10, 1.0, 1e10, 1e19, 1e30, f32::MAX, f32::INFINITY];
    for alpha in [0.0, 0.01, 1.0] {
        for view in [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.6, 0.0, 0.8]] {
            let lobe = Reflection::new(alpha, up, Vec3::from(view));
            for center in [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.6, 0.8, 1e-7], [0.0; 3]] {
                for (size, radius) in numbers.into_iter().flat_map(|a| numbers.map(|b| (a, b))) {
                    let light = Sphere::new(Vec3::from(center.map(|x| x * size)), radius);
                    let sampler = light.by_reflection(Vec3::default(), &lobe);
                    let what = format!("{alpha} {view:?} {light:?}");
                    for u in [[0.0; 2], [0.5, 0.25], [0.999_999_94; 2]] {
                        let s = sampler.sample(Vec2::new(u[0], u[1]));
                        assert!(s.pdf.is_finite() && s.pdf >= 0.0 && s.distance >= 0.0, "{what}: {s:?}");
                        assert!(s.direction.max_abs().is_finite() && s.distance.is_finite(), "{what}: {s:?}");
                        assert!(s.pdf == 0.0 || (s.direction.length() - 1.0).abs() < 1e-6, "{what}: {s:?}");
                        let none = radius <= 0.0 || center[2] < 0.0 && radius < size;
                        assert!(!none || s.pdf == 0.0, "{what}: {s:?}");
                        let back = sampler.invert(s.direction);
                        assert!((0.0..1.0).contains(&back.x) && (0.0..1.0).contains(&back.y), "{what}: {back:?}");
                        let hit = sampler.hit(up);
                        assert!(hit.pdf.is_finite() && hit.pdf >= 0.0 && hit.distance >= 0.0, "{what}: {hit:?}");
                    }
                    let part = sampler.projected_solid_angle();
                    assert!((0.0..=3.2).contains(&part), "{what}: {part}");
                }
            }
        }
    }
}
