//! Solid angles and irradiances.

use super::vectors::{V, add, cross, dot, length, normalize, sub, times};
use core::f32::consts::{FRAC_PI_2, PI, TAU};

/// The projected solid angle of a cap in closed form, from the angles σ and ω (Snyder 1996).
pub(super) fn projected_cap(center: V, radius: f32, normal: V) -> f32 {
    let distance = length(center);
    let sigma = (radius / distance).asin();
    let omega = (dot(center, normal) / distance).clamp(-1.0, 1.0).acos();
    let (s, c, cos) = (sigma.sin(), sigma.cos(), omega.cos());
    if omega + sigma <= FRAC_PI_2 {
        PI * s * s * cos
    } else if omega - sigma >= FRAC_PI_2 {
        0.0
    } else {
        let y = (s * s - cos * cos).max(0.0).sqrt();
        y.atan2(c) + s * s * cos * y.atan2(-c * cos) - y * c
    }
}

/// The projected solid angle of a polygon, clipped to the horizon, by Lambert's sum with arc cosines of the vertices' unit vectors.
pub(super) fn lambert(corners: &[V], normal: V) -> f32 {
    let mut above = Vec::new();
    for (i, &a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        let (ha, hb) = (dot(a, normal), dot(b, normal));
        if ha >= 0.0 {
            above.push(normalize(a));
        }
        if (ha < 0.0) != (hb < 0.0) {
            above.push(normalize(add(a, times(sub(b, a), ha / (ha - hb)))));
        }
    }
    let edge = |i: usize| {
        let (a, b) = (above[i], above[(i + 1) % above.len()]);
        dot(a, b).clamp(-1.0, 1.0).acos() * dot(normalize(cross(a, b)), normal)
    };
    0.5 * (0..above.len()).map(edge).sum::<f32>().abs()
}

/// The solid angle of a disk by 32 midpoints of 2π − 4∫√(q/(q+a²b²)), with a and b the tangents of the half-angles of its cone, from arc
/// cosines.
pub(super) fn disk(center: V, normal: V, radius: f32) -> f32 {
    let n = normalize(normal);
    let z = dot(center, n).abs();
    let squared = dot(center, center);
    // to the nearest and the farthest point of the rim
    let off = (squared - z * z).max(0.0).sqrt();
    let (near, far) = ((z * z + (off - radius).powi(2)).sqrt(), (z * z + (off + radius).powi(2)).sqrt());
    let alpha = 0.5 * ((squared - radius * radius) / (near * far)).clamp(-1.0, 1.0).acos();
    let a = alpha.tan();
    // tan of the major half-angle, R/√(dist² along the axis of the cone)
    let b = radius / ((near * far).sqrt() * alpha.cos());
    const N: u32 = 32;
    let sum: f32 = (0..N)
        .map(|i| {
            let (s, c) = ((i as f32 + 0.5) * FRAC_PI_2 / N as f32).sin_cos();
            let q = b * b * c * c + a * a * s * s;
            (q / (q + a * a * b * b)).sqrt()
        })
        .sum();
    TAU - 4.0 * sum * FRAC_PI_2 / N as f32
}
