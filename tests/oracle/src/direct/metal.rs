//! Reflection of metals and coats.

use super::scene::Finish;
use crate::vectors::{V3, dot, sub, unit};
use core::f64::consts::PI;

/// Reflectance of a smooth metal for unpolarised light at a cosine of the angle of incidence.
#[must_use]
pub fn fresnel(cos: f64, eta: f64, k: f64) -> f64 {
    // r⊥ = (cosθ − w)/(cosθ + w), r∥ = (m² cosθ − w)/(m² cosθ + w) with w = √(m² − sin²θ), m = η + ik
    let (re, im) = (eta * eta - k * k - (1.0 - cos * cos), 2.0 * eta * k);
    let modulus = (re * re + im * im).sqrt();
    let (a, b) = ((0.5 * (modulus + re)).max(0.0).sqrt(), (0.5 * (modulus - re)).max(0.0).sqrt());
    let ratio = |x: f64, y: f64| ((x - a).powi(2) + (y - b).powi(2)) / ((x + a).powi(2) + (y + b).powi(2));
    0.5 * (ratio(cos, 0.0) + ratio((eta * eta - k * k) * cos, 2.0 * eta * k * cos))
}

/// The BRDF between unit vectors towards the viewer and the light, on the side of the unit normal `n`; 0 of a mirror.
pub(super) fn brdf(finish: Finish, view: V3, light: V3, n: V3) -> f64 {
    let half = unit(sub(view, light.map(|x| -x)));
    let cos = dot(view, half);
    match finish {
        Finish::Diffuse(albedo) => albedo / PI,
        Finish::Mirror(_) => 0.0,
        Finish::Metal { eta, k, alpha } => fresnel(cos, eta, k) * microfacets(view, light, n, alpha),
        Finish::Coat { albedo, reflectance, alpha } => {
            let part = reflectance + (1.0 - reflectance) * (1.0 - cos).powi(5);
            part * microfacets(view, light, n, alpha) + (1.0 - part) * albedo / PI
        }
    }
}

/// The BRDF of microfacets by GGX that reflect all light, with shadowing and masking that is correlated by height, between unit vectors.
#[must_use]
pub fn microfacets(view: V3, light: V3, n: V3, alpha: f64) -> f64 {
    let half = unit(sub(view, light.map(|x| -x)));
    let (i, o, m) = (dot(view, n), dot(light, n), dot(half, n));
    if i <= 0.0 || o <= 0.0 || m <= 0.0 {
        return 0.0;
    }
    let squared = alpha * alpha;
    let density = squared / (PI * (m * m * (squared - 1.0) + 1.0).powi(2));
    // 4 cosθᵢ cosθₒ/G₂ = 2 (cosθₒ √(α² + (1 − α²) cos²θᵢ) + cosθᵢ √(α² + (1 − α²) cos²θₒ))
    let root = |cos: f64| (squared + (1.0 - squared) * cos * cos).sqrt();
    density / (2.0 * (o * root(i) + i * root(o)))
}
