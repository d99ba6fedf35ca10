//! Techniques by projected solid angle, on an unoccluded diffuse surface under constant light: no variance, and the mean is the closed form.

use core::f64::consts::PI;
use etendue::{LightSample, Mask, Real, Sphere, Vec2, Vec3, f32x8};
use etendue_tests::domain::Random;
use etendue_tests::oracle::{V3, along, basis, length, projected_cap_by_rings, unit, wide};

/// Greatest relative variance: that of a rounded quotient is 1e−14.
const VARIANCE: f64 = 1e-10;

/// Mean and relative variance of cosθ/pdf over 4096 samples; the number of samples that are worth nothing.
fn estimate(normal: Vec3<f32x8>, seed: u64, sample: impl Fn(Vec2<f32x8>) -> LightSample<f32x8>) -> (f64, f64, u64) {
    let mut random = Random::new(seed);
    let (mut n, mut mean, mut square, mut lost) = (0.0, 0.0, 0.0, 0);
    for _ in 0..512 {
        let mut axis = || f32x8::from_fn(|_| random.unit());
        let x = axis();
        let light = sample(Vec2::new(x, axis()));
        let cos = light.direction.dot(normal);
        for k in 0..8 {
            let (pdf, cos) = (light.pdf.lane_f64(k), cos.lane_f64(k));
            if pdf <= 0.0 || !light.emits.lane(k) {
                lost += 1;
            }
            // as an integrator has it: nothing from a sample of density 0
            let value = if pdf > 0.0 && light.emits.lane(k) { cos.max(0.0) / pdf } else { 0.0 };
            n += 1.0;
            let off = value - mean;
            mean += off / n;
            square += off * (value - mean);
        }
    }
    (mean, square / (n - 1.0) / (mean * mean).max(1e-300), lost)
}

fn packet(v: [f32; 3]) -> Vec3<f32x8> {
    Vec3::new(f32x8::splat(v[0]), f32x8::splat(v[1]), f32x8::splat(v[2]))
}
fn narrow(v: V3) -> [f32; 3] {
    v.map(|x| x as f32)
}

#[test]
fn spheres() {
    let mut random = Random::new(21);
    let (mut greatest, mut off, mut cases) = (0.0_f64, 0.0_f64, 0);
    for ratio in [1e-3, 0.01, 0.1, 0.3, 0.6, 0.9, 0.99, 1.5] {
        for distance in [1e-3, 1.0, 1e3] {
            for tilt in 0..=16 {
                // up to 0.95 of the way from the axis along the normal to the whole sphere below the horizon
                let sigma = if ratio < 1.0 { f64::asin(ratio) } else { PI / 2.0 };
                let omega = f64::from(tilt) / 16.0 * (PI / 2.0 + 0.95 * sigma);
                let normal = narrow(random.direction());
                let n = unit(wide(normal));
                let (s, _) = basis(n);
                let axis = along(n.map(|x| x * omega.cos()), s, omega.sin());
                let center = narrow(axis.map(|x| x * distance));
                let radius = (ratio * distance) as f32;
                let c = wide(center);
                let cos = etendue_tests::oracle::dot(c, n) / length(c);
                let inside = f64::from(radius) > length(c);
                let sigma = if inside { PI / 2.0 } else { (f64::from(radius) / length(c)).asin() };
                let truth = projected_cap_by_rings(sigma, if inside { 1.0 } else { cos });
                let light = Sphere { center: packet(center), radius: f32x8::splat(radius) };
                let up = packet(normal);
                let origin = packet([0.0; 3]);
                let (mean, variance, lost) = estimate(up, cases, |u| {
                    let mut light = light.by_projected_solid_angle(origin, up, u);
                    light.emits = light.emits | <f32x8 as Real>::Mask::splat(inside);
                    light
                });
                cases += 1;
                // the cosine to the axis is known to a unit; a thin lune is worth so much of it
                let condition = 1.0 + 3.0 * cos.abs() / (sigma.sin() - cos.abs()).abs().max(1e-3 * sigma.sin());
                let relative = (mean / truth - 1.0).abs() / condition;
                greatest = greatest.max(variance);
                off = off.max(relative);
                let name = format!("ratio {ratio} distance {distance} omega {omega}");
                assert!(variance < VARIANCE && lost == 0, "{name}: relative variance {variance:e}, {lost} lost");
                assert!(relative < 1e-6, "{name}: mean {mean} for {truth}");
            }
        }
    }
    println!("{cases} spheres: relative variance ≤ {greatest:.1e}, mean within {off:.1e} of the closed form");
}
