//! Solid angles and irradiances, and the line by its angles.

use super::vectors::{V, add, cross, dot, length, normalize, sub, times};
use core::f32::consts::{FRAC_PI_2, PI, TAU};

/// The projected solid angle of a cap in closed form, from the angles σ and ω (Snyder 1996).
#[must_use]
pub fn projected_cap(center: V, radius: f32, normal: V) -> f32 {
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
#[must_use]
pub fn lambert(corners: &[V], normal: V) -> f32 {
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
#[must_use]
pub fn disk(center: V, normal: V, radius: f32) -> f32 {
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

/// Equiangular sampling by arc tangents from the foot of the perpendicular (Kulla and Fajardo 2012).
#[derive(Clone, Copy, Debug)]
pub struct Equiangular {
    foot: V,
    along: V,
    height: f32,
    angles: [f32; 2],
}
impl Equiangular {
    /// The segment from `a` to `a + edge`.
    #[must_use]
    pub fn new(a: V, edge: V) -> Self {
        let size = length(edge);
        let along = times(edge, 1.0 / size);
        let near = dot(a, along);
        let foot = sub(a, times(along, near));
        let height = length(foot);
        Self { foot, along, height, angles: [(near / height).atan(), ((near + size) / height).atan()] }
    }
    /// The direction for `u`.
    #[must_use]
    pub fn sample(&self, u: f32) -> V {
        let theta = (1.0 - u) * self.angles[0] + u * self.angles[1];
        normalize(add(self.foot, times(self.along, self.height * theta.tan())))
    }
    /// The distance for `u`.
    #[must_use]
    pub fn distance(&self, u: f32) -> f32 {
        self.height / ((1.0 - u) * self.angles[0] + u * self.angles[1]).cos()
    }
    /// The pdf per radian.
    #[must_use]
    pub fn pdf(&self) -> f32 {
        1.0 / (self.angles[1] - self.angles[0])
    }
    /// The inverse.
    #[must_use]
    pub fn invert(&self, w: V) -> f32 {
        let theta = (dot(w, self.along) / dot(w, times(self.foot, 1.0 / self.height))).atan();
        (theta - self.angles[0]) / (self.angles[1] - self.angles[0])
    }
}

/// ∫ sinγ cosθ over a segment above the horizon, in closed form with angles from the foot of the perpendicular.
#[must_use]
pub fn projected_segment(mut a: V, edge: V, normal: V) -> f32 {
    let mut b = add(a, edge);
    let (low, high) = (dot(a, normal), dot(b, normal));
    let there = add(a, times(edge, low / (low - high)));
    if low < 0.0 && high < 0.0 {
        return 0.0;
    }
    if low < 0.0 {
        a = there;
    } else if high < 0.0 {
        b = there;
    }
    let along = normalize(edge);
    let foot = normalize(sub(a, times(along, dot(a, along))));
    let angle = |p: V| dot(p, along).atan2(dot(p, foot));
    // sinγ = cosφ, cosθ = n·(foot cosφ + along sinφ) at the angle φ from the foot
    let up_to = |phi: f32| {
        let (s, c) = phi.sin_cos();
        0.5 * (dot(normal, foot) * (phi + s * c) + dot(normal, along) * s * s)
    };
    up_to(angle(b)) - up_to(angle(a))
}
