//! Lights that are mostly below the horizon, by projected solid angle: no sample is lost below it.

use etendue::{Lanewise, LightSampler, Line, Parallelogram, Polygon, Real, Sphere, Triangle, Vec3, f32x8};
use etendue_judge::generators::Random;
use etendue_judge::packets::squares_of;
use etendue_oracle::{along, basis, narrow};

/// Of 3 million samples, as many as 1,300 were below the horizon by rounding, and had pdf 0.
#[test]
fn every_sample_is_above_the_horizon() {
    let mut random = Random::new(1);
    let (mut samples, mut low) = ([0_u32; 5], 0_u32);
    for round in 0..6000 {
        // which part of its height is below
        let depth = [0.5, 0.99, 0.9999, 0.999_99, 0.999_999][round % 5];
        let normal = random.direction();
        let (s, t) = basis(normal);
        let (sin, cos) = random.range(0.0, core::f64::consts::TAU).sin_cos();
        let forth = along(s.map(|x| x * cos), t, sin);
        let side = along(t.map(|x| x * cos), s, -sin);
        let (distance, size) = (random.range(1.0, 3.0), random.range(0.2, 1.5));
        let (tilt, turn) = (random.range(-0.5, 0.5), random.range(0.0, core::f64::consts::TAU));
        let shift = size * (1.0 - 2.0 * depth);
        let corners: [Vec3<f32>; 5] = core::array::from_fn(|i| {
            let (y, x) = (turn + i as f64 * 0.4 * core::f64::consts::PI).sin_cos();
            // one corner is the highest, at the size
            let top = (0..5).map(|k| (turn + f64::from(k) * 0.4 * core::f64::consts::PI).sin()).fold(-1.0, f64::max);
            let height = size * y / top + shift;
            let away = along([0.0; 3], forth, distance + tilt * height);
            narrow(along(along(away, side, size * x), normal, height)).into()
        });
        let center = narrow(along(along([0.0; 3], forth, distance + 2.0), normal, shift)).into();
        let (p, n) = (Vec3::<f32>::default(), Vec3::<f32>::from(narrow(normal)));
        let [a, b, c, ..] = corners;
        let ball = Sphere::new(center, size as f32).by_projected_solid_angle(p, n);
        let triangle = Triangle { v0: a, e1: b - a, e2: c - a }.by_projected_solid_angle(p, n);
        let parallelogram = Parallelogram::new(a, b - a, c - a).by_projected_solid_angle(p, n);
        let polygon = Polygon::new(corners).by_projected_solid_angle(p, n);
        let line = Line::new(a, b - a).by_projected_solid_angle(p, n);
        let (wide, half) = (Vec3::<f32x8>::splat(n), [[0.5, 0.5]]);
        let mut check = |kind: usize, sampler: &dyn LightSampler<f32x8>, some: bool| {
            for _ in 0..if some { 16 } else { 0 } {
                let us: [[f32; 2]; 8] = core::array::from_fn(|_| [random.unit(), random.unit()]);
                let sample = sampler.sample(squares_of(&us));
                let (cos, pdf) = (sample.direction.dot(wide), sampler.pdf(sample.direction));
                for (i, number) in us.iter().enumerate() {
                    let at = || format!("{kind} {corners:?} {center:?} over {n:?} at {number:?}: {sample:?}");
                    assert!(sample.pdf.lane(i) > 0.0 && cos.lane(i) > 0.0, "{}", at());
                    assert!(kind == 4 || pdf.lane(i) == sample.pdf.lane(i), "{}", at());
                    samples[kind] += 1;
                    low += u32::from(cos.lane(i) < 3e-7);
                }
            }
        };
        check(0, &ball.splat::<f32x8>(), ball.projected_solid_angle() > 0.0);
        check(1, &triangle.splat::<f32x8>(), triangle.projected_solid_angle() > 0.0);
        check(2, &parallelogram.splat::<f32x8>(), parallelogram.projected_solid_angle() > 0.0);
        check(3, &polygon.splat::<f32x8>(), polygon.projected_solid_angle() > 0.0);
        check(4, &line.splat::<f32x8>(), line.sample(squares_of(&half)).pdf > 0.0);
    }
    println!("{samples:?}, {low} of them on the horizon");
    assert!(samples.iter().all(|&n| n > 200_000) && low > 1000, "{samples:?}, {low}");
}
