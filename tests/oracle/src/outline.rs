//! Outlines of polygons as seen from the origin.

use crate::double_double::{Number, add, cross, dot, length, normalized, sub, times};
use crate::vectors::{V3, along};
use core::f64::consts::PI;

/// The part of a polygon with normal · x ≥ `least`.
pub(crate) fn clipped<T: Number>(corners: &[[T; 3]], normal: [T; 3], least: T) -> Vec<[T; 3]> {
    let mut part = Vec::with_capacity(corners.len() + 1);
    for (i, &a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        let [above, next] = [dot(a, normal) - least, dot(b, normal) - least];
        let [ha, hb] = [above, next].map(T::to_f64);
        if ha >= 0.0 {
            part.push(a);
        }
        if (ha < 0.0 && hb > 0.0) || (ha > 0.0 && hb < 0.0) {
            part.push(add(a, times(sub(b, a), above / (above - next))));
        }
    }
    if part.len() < 3 { Vec::new() } else { part }
}

/// The angle between two vectors.
pub(crate) fn angle<T: Number>(a: [T; 3], b: [T; 3]) -> T {
    length(cross(a, sub(b, a))).atan2(dot(a, b))
}

/// The angle around a polygon.
pub(crate) fn perimeter(corners: &[V3]) -> f64 {
    (0..corners.len()).map(|i| angle(corners[i], corners[(i + 1) % corners.len()])).sum()
}

/// ∫ r dω over a polygon, up to its sign: half the sum of the edges' angles along their normals.
pub(crate) fn lambert_vector<T: Number>(corners: &[[T; 3]]) -> [T; 3] {
    let mut sum = [T::default(); 3];
    for (i, &a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        sum = add(sum, times(normalized(cross(a, sub(b, a))), T::from(0.5) * angle(a, b)));
    }
    sum
}

/// Solid angle of a polygon, with the sign of its turn.
pub(crate) fn solid_angle(corners: &[V3]) -> f64 {
    let Some((&a, rest)) = corners.split_first() else { return 0.0 };
    let triangle = |b: V3, c: V3| {
        let [x, y, z] = [a, b, c].map(length);
        2.0 * dot(a, cross(b, c)).atan2(x * y * z + dot(a, b) * z + dot(b, c) * x + dot(c, a) * y)
    };
    rest.windows(2).map(|pair| triangle(pair[0], pair[1])).sum()
}

/// Twice the area of a convex polygon, along its normal.
pub(crate) fn area_vector(corners: &[V3]) -> V3 {
    let of = |i: usize| cross(sub(corners[i], corners[0]), sub(corners[i + 1], corners[0]));
    (1..corners.len().saturating_sub(1)).fold([0.0; 3], |sum, i| along(sum, of(i), 1.0))
}

/// Ω⊥ of a convex polygon above the horizon of `n`.
pub(crate) fn lambert(corners: &[V3], n: V3) -> f64 {
    let area = area_vector(corners);
    let squared = dot(corners[0], corners[0]);
    if dot(area, area).sqrt() < 1e-12 * squared {
        // so small that all of it is in one direction; the sum over edges would cancel
        let middle = corners.iter().fold([0.0; 3], |sum, v| along(sum, *v, 1.0 / corners.len() as f64));
        let squared = dot(middle, middle);
        let extent = corners.iter().map(|v| length(sub(*v, middle))).fold(0.0, f64::max);
        if extent * extent < 1e-9 * squared {
            return 0.5 * dot(area, middle).abs() * dot(n, middle).max(0.0) / (squared * squared);
        }
    }
    dot(lambert_vector(corners), n).abs().min(PI)
}
