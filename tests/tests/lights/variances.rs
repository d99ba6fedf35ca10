//! Variances of estimators against closed forms: unoccluded lights over a diffuse receiver.
//!
//! Each variance is measured from independent samples, in batches whose spread gives its standard error. It must lie within five standard
//! errors of the truth, and the standard error must be small. An exact technique has no variance beyond rounding.

use core::f64::consts::PI;
use etendue::light::Disk;
use etendue::light::shapes::SphericalCap;
use etendue::sequence::{Independent, Sequence};
use etendue::warp::{UniformHemisphere, Warp};
use etendue::{LightSample, LightSampler, Real, Sphere, Vec2, Vec3, f32x8, u32x8};
use etendue_judge::stats;

const BATCHES: u32 = 64;
const PACKETS: u32 = 2048;

/// Variance of a sample, and the standard error of that, from batches.
fn variance(key: u32, estimate: impl Fn(Vec2<f32x8>) -> f32x8) -> [f64; 2] {
    let sequence = Independent::new(2024);
    let batch = |b: u32| {
        let mut values = Vec::with_capacity(8 * PACKETS as usize);
        for i in 0..PACKETS {
            let samples = u32x8::new(std::array::from_fn(|k| 8 * i + k as u32));
            let x = estimate(sequence.pair(u32x8::splat(b), samples, key));
            values.extend((0..8).map(|k| x.lane_f64(k)));
        }
        stats::mean_variance(&values).1
    };
    let batches: Vec<f64> = (0..BATCHES).map(batch).collect();
    let (mean, spread) = stats::mean_variance(&batches);
    [mean, (spread / f64::from(BATCHES)).sqrt()]
}

/// cosθ/pdf: the irradiance estimated from one sample, for radiance 1.
fn worth(light: &LightSample<f32x8>, normal: Vec3<f32x8>) -> f32x8 {
    let cos = light.direction.dot(normal);
    let counts = light.emits & light.pdf.gt(f32x8::splat(0.0)) & cos.gt(f32x8::splat(0.0));
    let pdf = Real::blend(counts, light.pdf, f32x8::splat(1.0));
    Real::blend(counts, cos / pdf, f32x8::splat(0.0))
}

fn packet(v: [f64; 3]) -> Vec3<f32x8> {
    v.map(|x| x as f32).into()
}

/// Asserts that `what` is `truth` to 5 standard errors and `digit`, half a unit of the truth's last digit, and that it is measured to 2 %.
fn is(what: &str, [value, error]: [f64; 2], truth: f64, digit: f64) {
    println!("{what:40} {value:.5e} ± {error:.1e}, in closed form {truth:.5e}");
    assert!((value - truth).abs() <= 5.0 * error + digit, "{what}: {value} ± {error}, expected {truth}");
    assert!(error <= 0.02 * truth, "{what}: {value} ± {error} is too uncertain");
}

/// A facing disk of radius k at distance 1: the variance by area, by solid angle, and their ratio.
#[test]
fn facing_disk() {
    let up = packet([0.0, 0.0, 1.0]);
    for (i, (k, known)) in [(0.25, 16.01), (1.0, 16.99), (4.0, 40.5), (8.0, 103.8)].into_iter().enumerate() {
        let disk =
            Disk { center: packet([0.0, 0.0, 1.0]), normal: packet([0.0, 0.0, -1.0]), radius: f32x8::splat(k as f32) };
        let origin = packet([0.0; 3]);
        let c = 1.0 / f64::hypot(1.0, k);
        let (mean, omega) = (PI * k * k / (1.0 + k * k), 2.0 * PI * (1.0 - c));
        let by_area = variance(2 * i as u32, |u| worth(&disk.by_area(origin).sample(u), up));
        let moment = PI * PI * k * k / 3.0 * (1.0 - (1.0 + k * k).powi(-3));
        is(&format!("disk by area, k = {k}"), by_area, moment - mean * mean, 0.0);

        // the sphere tangent to the disk's cone covers the same directions
        let sphere = Sphere { center: packet([0.0, 0.0, 1.0]), radius: f32x8::splat((k * c) as f32) };
        let by_solid_angle = variance(2 * i as u32 + 1, |u| worth(&sphere.by_solid_angle(origin).sample(u), up));
        let moment = omega * 2.0 * PI * (1.0 - c.powi(3)) / 3.0;
        is(&format!("disk by solid angle, k = {k}"), by_solid_angle, moment - mean * mean, 0.0);

        let ratio = by_area[0] / by_solid_angle[0];
        let relative = f64::hypot(by_area[1] / by_area[0], by_solid_angle[1] / by_solid_angle[0]);
        let digit = if known < 20.0 { 0.005 } else { 0.05 };
        is(&format!("area : solid angle, k = {k}"), [ratio, ratio * relative], known, digit);

        let [none, _] = variance(0, |u| worth(&sphere.by_projected_solid_angle(origin, up).sample(u), up));
        assert!(none < 1e-11 * mean * mean, "projected, k = {k}: {none:e}");
    }
}

/// A cone of half-angle σ above the horizon, with its axis at ω to the normal: Ω I₂ − I₁².
#[test]
fn cone() {
    for (i, (sigma, omega)) in
        [(0.5_f64, 0.0), (0.5, 0.9), (0.05, 1.2), (1.2, 0.3), (1e-3, 0.7)].into_iter().enumerate()
    {
        let axis = [f64::sin(omega), 0.0, f64::cos(omega)];
        let cap = SphericalCap::new(packet(axis), f32x8::splat(sigma.sin() as f32));
        let up = packet([0.0, 0.0, 1.0]);
        let measured = variance(i as u32, |u| cap.sample(u).dot(up) / cap.uniform_pdf());
        let (c, s) = (sigma.cos(), sigma.sin());
        // 1 − c, and (1 − c³)/3, without cancellation
        let h = s * s / (1.0 + c);
        let third = h * (1.0 + c + c * c) / 3.0;
        let first = PI * s * s * omega.cos();
        let second = 2.0 * PI * (omega.cos().powi(2) * third + 0.5 * omega.sin().powi(2) * (h - third));
        is(&format!("cone σ = {sigma}, ω = {omega}"), measured, 2.0 * PI * h * second - first * first, 0.0);
    }
}

/// The whole hemisphere under a constant sky: π²/3.
#[test]
fn hemisphere() {
    let measured = variance(9, |u| UniformHemisphere.sample(u).z * f32x8::splat(core::f32::consts::TAU));
    is("uniform hemisphere", measured, PI * PI / 3.0, 0.0);
}
