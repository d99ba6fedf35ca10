//! Outlines of polygons as seen from the origin.

use crate::vectors::{V3, along, cross, dot, length, sub, unit};

/// The part of a polygon with normal · x ≥ `least`.
pub(crate) fn clipped(corners: &[V3], normal: V3, least: f64) -> Vec<V3> {
    let mut part = Vec::with_capacity(corners.len() + 1);
    for (i, &a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        let (ha, hb) = (dot(a, normal) - least, dot(b, normal) - least);
        if ha >= 0.0 {
            part.push(a);
        }
        if (ha < 0.0 && hb > 0.0) || (ha > 0.0 && hb < 0.0) {
            part.push(along(a, sub(b, a), ha / (ha - hb)));
        }
    }
    if part.len() < 3 { Vec::new() } else { part }
}

/// The angle between two vectors.
pub(crate) fn angle(a: V3, b: V3) -> f64 {
    length(cross(a, sub(b, a))).atan2(dot(a, b))
}

/// The angle around a polygon.
pub(crate) fn perimeter(corners: &[V3]) -> f64 {
    (0..corners.len()).map(|i| angle(corners[i], corners[(i + 1) % corners.len()])).sum()
}

/// ∫ r dω over a polygon, up to its sign: half the sum of the edges' angles along their normals.
pub(crate) fn lambert_vector(corners: &[V3]) -> V3 {
    let mut sum = [0.0; 3];
    for (i, &a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        sum = along(sum, unit(cross(a, sub(b, a))), 0.5 * angle(a, b));
    }
    sum
}
