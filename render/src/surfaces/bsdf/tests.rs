//! BSDFs against formulas in complex numbers, and against their own integrals.

use super::fresnel::fresnel;
use super::*;
use crate::scene::{Material, Roughness};

fn complex(cos: f64, eta: f64, k: f64) -> f64 {
    // r⊥ = (cosθ − m cosθₜ)/(cosθ + m cosθₜ), r∥ = (m cosθ − cosθₜ)/(m cosθ + cosθₜ), m cosθₜ = √(m² − sin²θ)
    let (re, im) = (eta * eta - k * k - (1.0 - cos * cos), 2.0 * eta * k);
    let modulus = libm::hypot(re, im);
    let (a, b) = (((modulus + re) / 2.0).sqrt(), ((modulus - re) / 2.0).sqrt());
    let ratio = |(p, q): (f64, f64), (r, s): (f64, f64)| (p * p + q * q) / (r * r + s * s);
    let across = ratio((cos - a, -b), (cos + a, b));
    // multiplied by m: m² cosθ ∓ m cosθₜ
    let (x, y) = ((eta * eta - k * k) * cos, 2.0 * eta * k * cos);
    let along = ratio((x - a, y - b), (x + a, y + b));
    0.5 * (across + along)
}

#[test]
fn fresnel_is_that_of_complex_numbers() {
    let mut greatest = 0.0_f64;
    for (eta, k) in [(0.2, 3.9), (1.44, 1.6), (1.0, 2.0), (1.0, 199.98), (1.5, 0.0), (0.04, 4.8), (9.0, 3.0)] {
        for i in 0..=1000 {
            let cos = f64::from(i) / 1000.0;
            let [c, e, x] = [cos, eta, k].map(|x| x as f32);
            let truth = complex(c.into(), e.into(), x.into());
            let value = f64::from(fresnel(X8::splat(c), X8::splat(e), X8::splat(x)).lane(3));
            assert!((value - truth).abs() < 2e-6, "{eta} {k} at {cos}: {value}, expected {truth}");
            greatest = greatest.max((value - truth).abs());
        }
    }
    assert!(greatest > 0.0);
    // at normal incidence with η = 1: k²/(k² + 4)
    assert!((fresnel(X8::lit(1.0), X8::lit(1.0), X8::lit(2.0)).lane(0) - 0.5).abs() < 1e-7);
    // a zero index, and a vacuum
    for (cos, eta, k) in [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.5, 1.0, 0.0)] {
        let f = fresnel(X8::lit(cos), X8::lit(eta), X8::lit(k)).lane(0);
        assert!((0.0..=1.0).contains(&f), "{cos} {eta} {k}: {f}");
    }
}

/// White furnace test: ∫f cosθ dω agrees between BSDF sampling and a grid over the hemisphere, and the pdf integrates to the
/// fraction of samples above the horizon.
#[test]
fn rough_metal_integrates() {
    for (along, across) in [(0.1_f32, 0.1_f32), (0.4, 0.4), (1.0, 1.0), (0.1, 0.5), (0.9, 0.3)] {
        let alpha = format!("{along} and {across}");
        let roughness = Roughness { along, across, turn: 0.0 };
        let metal = Material::Conductor { eta: [0.2, 1.0, 1.1], k: [3.9, 2.4, 2.1], roughness };
        let metal = Metal::new([&record(&metal); 8]).along(V8::from([0.6, 0.8, 5.0]));
        for sin in [0.0_f32, 0.6, 0.95] {
            let cos = (1.0 - sin * sin).sqrt();
            let normal = V8::new(X8::lit(0.0), X8::lit(0.0), X8::lit(1.0));
            let toward = V8::from([-sin, 0.0, -cos]);
            let bsdf = Bsdf::<true>::new([normal; 2], V8::default(), toward, Some(&metal), Vec2::default());
            let n = 1024_u16;
            let (mut sampled, mut weight, mut grid, mut density) = (0.0, 0.0, 0.0, 0.0);
            for i in 0..n {
                for j in (0..n).step_by(8) {
                    let u = Vec2::new(
                        X8::splat((f32::from(i) + 0.5) / f32::from(n)),
                        X8::from_fn(|lane| (f32::from(j) + lane as f32 + 0.5) / f32::from(n)),
                    );
                    let Scattered { color: value, pdf, .. } = bsdf.sample(Technique::Brdf, u);
                    let uniform: V8 = UniformHemisphere.sample(u);
                    let Evaluated { color: at, pdf: d, .. } = bsdf.evaluate(uniform);
                    for lane in 0..8 {
                        if pdf.lane(lane) > 0.0 {
                            sampled += f64::from(value.x.lane(lane));
                            weight += 1.0;
                        }
                        grid += f64::from(at.x.lane(lane)) * std::f64::consts::TAU;
                        density += f64::from(d.lane(lane)) * std::f64::consts::TAU;
                    }
                }
            }
            let count = f64::from(n) * f64::from(n);
            let [sampled, weight, grid, density] = [sampled, weight, grid, density].map(|x| x / count);
            assert!((sampled - grid).abs() < 3e-3, "α {alpha}, sin {sin}: {sampled} sampled, {grid} on a grid");
            assert!((weight - density).abs() < 3e-3, "α {alpha}, sin {sin}: {weight} above, {density} integrated");
            assert!(sampled > 0.2 && sampled < 1.0, "α {alpha}, sin {sin}: {sampled}");
        }
    }
}

/// Sampling a coat agrees with a grid over the hemisphere, its pdf integrates to the fraction of samples above both horizons, and it
/// reflects no more light than it receives.
#[test]
fn coats_integrate() {
    for (alpha, f0, f90, albedo) in [
        (0.1_f32, 0.04_f32, 1.0_f32, 0.5_f32),
        (0.4, 0.04, 1.0, 1.0),
        (0.4, 0.004, 0.1, 1.0),
        (1.0, 0.3, 1.0, 0.2),
        (0.3, 0.9, 1.0, 0.0),
    ] {
        let (specular, grazing) = ([f0; 3], [f90; 3]);
        let coat =
            Material::Glossy { diffuse: [albedo; 3], specular, grazing, roughness: alpha.into(), greatest: false };
        let metal = Metal::new([&record(&coat); 8]);
        for (sin, tilt) in [(0.0_f32, 0.0_f32), (0.6, 0.0), (0.6, 0.5), (0.95, 0.3)] {
            let normal = V8::new(X8::lit(0.0), X8::lit(0.0), X8::lit(1.0));
            let flat = V8::from([0.0, -tilt, (1.0 - tilt * tilt).sqrt()]);
            let toward = V8::from([-sin, 0.0, -(1.0 - sin * sin).sqrt()]);
            let bsdf = Bsdf::<true>::new([normal, flat], V8::from([albedo; 3]), toward, Some(&metal), Vec2::default());
            let n = 1024_u16;
            let (mut sampled, mut above, mut grid, mut density) = (0.0, 0.0, 0.0, 0.0);
            for (i, j) in (0..n).flat_map(|i| (0..n).step_by(8).map(move |j| (i, j))) {
                let u = Vec2::new(
                    X8::splat((f32::from(i) + 0.5) / f32::from(n)),
                    X8::from_fn(|lane| (f32::from(j) + lane as f32 + 0.5) / f32::from(n)),
                );
                let Scattered { color, pdf, direction, .. } = bsdf.sample(Technique::Brdf, u);
                let uniform: V8 = UniformHemisphere.sample(u);
                let at = bsdf.evaluate(uniform);
                for lane in 0..8 {
                    if pdf.lane(lane) > 0.0 {
                        assert!(direction.dot(flat).lane(lane) > 0.0);
                        sampled += f64::from(color.x.lane(lane));
                        above += 1.0;
                    }
                    grid += f64::from(at.color.x.lane(lane)) * std::f64::consts::TAU;
                    density += f64::from(at.pdf.lane(lane)) * std::f64::consts::TAU;
                }
            }
            let count = f64::from(n) * f64::from(n);
            let [sampled, above, grid, density] = [sampled, above, grid, density].map(|x| x / count);
            let which = format!("α {alpha}, F₀ {f0}, F₉₀ {f90}, albedo {albedo}, sin {sin}, tilt {tilt}");
            assert!((sampled - grid).abs() < 5e-3, "{which}: {sampled} sampled, {grid} on a grid");
            assert!((above - density).abs() < 5e-3, "{which}: {above} above, {density} integrated");
            assert!(sampled > 0.05 && sampled < 1.005, "{which}: {sampled}");
        }
    }
}

/// Sampling a coated metal finds directions with the pdf that evaluation has: it integrates to the fraction of samples above the horizon,
/// and both give the same light, by which a metal that absorbs nothing reflects no more than it receives.
#[test]
fn coated_metals_integrate() {
    for (above, below, coat) in [(0.1_f32, 0.3_f32, 1.5_f32), (0.3, 0.0, 1.5), (0.2, 0.4, 2.0), (1.0, 1.0, 1.1)] {
        let metal = Material::CoatedConductor {
            eta: [0.0; 3],
            k: [30.0; 3],
            roughness: below.into(),
            coat,
            interface: above.into(),
        };
        let metal = Metal::new([&record(&metal); 8]);
        for sin in [0.1_f32, 0.6, 0.95] {
            let normal = V8::new(X8::lit(0.0), X8::lit(0.0), X8::lit(1.0));
            let toward = V8::from([-sin, 0.0, -(1.0 - sin * sin).sqrt()]);
            let n = 512_u16;
            let (mut sampled, mut above_horizon, mut grid, mut density) = (0.0, 0.0, 0.0, 0.0);
            for (i, j) in (0..n).flat_map(|i| (0..n).step_by(8).map(move |j| (i, j))) {
                let u = Vec2::new(
                    X8::splat((f32::from(i) + 0.5) / f32::from(n)),
                    X8::from_fn(|lane| (f32::from(j) + lane as f32 + 0.5) / f32::from(n)),
                );
                let bsdf = Bsdf::<true>::new([normal; 2], V8::from([1.0; 3]), toward, Some(&metal), u);
                let Scattered { color, pdf, .. } = bsdf.sample(Technique::Brdf, u);
                let uniform: V8 = UniformHemisphere.sample(u);
                let at = bsdf.evaluate(uniform);
                for lane in 0..8 {
                    if pdf.lane(lane) > 0.0 {
                        sampled += f64::from(color.x.lane(lane));
                        above_horizon += 1.0;
                    }
                    grid += f64::from(at.color.x.lane(lane)) * std::f64::consts::TAU;
                    density += f64::from(at.pdf.lane(lane)) * std::f64::consts::TAU;
                }
            }
            let count = f64::from(n) * f64::from(n);
            let [sampled, above_horizon, grid, density] = [sampled, above_horizon, grid, density].map(|x| x / count);
            let which = format!("coat {coat} of roughness {above} over {below}, sin {sin}");
            assert!((sampled - grid).abs() < 0.02, "{which}: {sampled} sampled, {grid} on a grid");
            assert!((above_horizon - density).abs() < 5e-3, "{which}: {above_horizon} above, {density} integrated");
            assert!(sampled > 0.15 && sampled < 1.01, "{which}: {sampled}");
        }
    }
}
