//! Closed forms of solid angles, projected solid angles and form factors.

use crate::double_double::{Dd, Dd3, dd, dot, length};
use crate::outline::{clipped, lambert_vector};
use crate::vectors::V3;
use core::f64::consts::PI;

/// 1 − cosσ and the half-angle σ of a sphere; 2 and π from inside.
#[must_use]
pub fn cap(center: V3, radius: f64) -> (f64, f64) {
    let (c, r) = (dd(center), Dd::from(radius));
    let squared = dot(c, c);
    let power = squared - r * r;
    if power.to_f64() < 0.0 {
        return (2.0, PI);
    }
    if radius == 0.0 {
        return (0.0, 0.0);
    }
    let cos = (power / squared).sqrt();
    ((r * r / squared / (Dd::from(1.0) + cos)).to_f64(), radius.atan2(power.sqrt().to_f64()))
}

/// Projected solid angle of the part of a sphere above the horizon of `normal`, which may have any length; π from inside.
#[must_use]
pub fn projected_cap(center: V3, radius: f64, normal: V3) -> f64 {
    let (c, r, n) = (dd(center), Dd::from(radius), dd(normal));
    let squared = dot(c, c);
    let power = squared - r * r;
    if power.to_f64() < 0.0 {
        return PI;
    }
    let (sin, cos) = (r / squared.sqrt(), (power / squared).sqrt());
    let height = dot(c, n) / (squared * dot(n, n)).sqrt();
    if (height - sin).to_f64() >= 0.0 {
        return PI * (sin * sin * height).to_f64();
    }
    if (height + sin).to_f64() <= 0.0 {
        return 0.0;
    }
    let y = ((sin - height) * (sin + height)).sqrt();
    // for a thin lune, this is a small difference of three terms
    (y.atan2(cos) + sin * sin * height * y.atan2(-(cos * height)) - y * cos).to_f64()
}

/// Clips a convex polygon to the hemisphere of `n`.
#[must_use]
pub fn above_horizon(corners: &[Dd3], n: Dd3) -> Vec<Dd3> {
    clipped(corners, n, Dd::default())
}

/// Lambert's sum over the edges of a polygon above the horizon of `n`, accurate to 1e−13 for sizes down to 1e−8 of the distance.
#[must_use]
pub fn lambert(corners: &[Dd3], n: Dd3) -> f64 {
    (dot(lambert_vector(corners), n) / length(n)).to_f64().abs()
}

/// Projected solid angle of a convex polygon: clipped to the horizon of `n`, then Lambert's sum over the edges.
#[must_use]
pub fn projected_polygon(vertices: &[V3], n: V3) -> f64 {
    let vertices: Vec<Dd3> = vertices.iter().map(|v| dd(*v)).collect();
    lambert(&above_horizon(&vertices, dd(n)), dd(n))
}

/// Form factor from a point to a disk facing it: radius r, height h, offset a of the axis.
#[must_use]
pub fn facing_disk(r: f64, h: f64, a: f64) -> f64 {
    let (s, d) = (h * h + a * a + r * r, h * h + a * a - r * r);
    0.5 * (1.0 - d / (s * s - 4.0 * r * r * a * a).sqrt())
}

/// The same for a receiver whose normal is parallel to the disk's plane and points towards its axis, for r ≤ a.
#[must_use]
pub fn perpendicular_disk(r: f64, h: f64, a: f64) -> f64 {
    let s = h * h + a * a + r * r;
    h / (2.0 * a) * (s / (s * s - 4.0 * r * r * a * a).sqrt() - 1.0)
}
