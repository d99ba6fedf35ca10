//! Uniform solid angle sampling by the formulas of textbooks, in single numbers: vectors are arrays, as small renderers have them.
//!
//! Triangles are after Arvo (1995), "Stratified Sampling of Spherical Triangles"; rectangles after Ureña, Fajardo and King (2013), "An
//! Area-Preserving Parametrization for Spherical Rectangles"; spheres after Pharr, Jakob and Humphreys (2023), "Physically Based Rendering",
//! section 6.2.4.

use std::f32::consts::{PI, TAU};

pub type Vector = [f32; 3];

fn dot(a: Vector, b: Vector) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}
fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
fn mul(a: Vector, s: f32) -> Vector {
    [a[0] * s, a[1] * s, a[2] * s]
}
fn unit(a: Vector) -> Vector {
    mul(a, 1.0 / dot(a, a).sqrt())
}
/// The part of `a` that is perpendicular to the unit vector `b`, as a unit vector.
fn perpendicular(a: Vector, b: Vector) -> Vector {
    unit(sub(a, mul(b, dot(a, b))))
}
/// The angle between unit vectors in radians, by the length of their difference, as in PBR.
fn angle(a: Vector, b: Vector) -> f32 {
    let half_sine = |v: Vector| (0.5 * dot(v, v).sqrt()).min(1.0);
    if dot(a, b) < 0.0 { PI - 2.0 * half_sine(add(a, b)).asin() } else { 2.0 * half_sine(sub(b, a)).asin() }
}

/// A direction from `p` to a triangle, and its pdf per steradian.
pub fn triangle(corners: &[Vector; 3], p: Vector, u: [f32; 2]) -> (Vector, f32) {
    let (a, b, c) = (unit(sub(corners[0], p)), unit(sub(corners[1], p)), unit(sub(corners[2], p)));
    let (ab, bc, ca) = (unit(cross(a, b)), unit(cross(b, c)), unit(cross(c, a)));
    let alpha = angle(ab, mul(ca, -1.0));
    let beta = angle(bc, mul(ab, -1.0));
    let gamma = angle(ca, mul(bc, -1.0));
    let area = alpha + beta + gamma - PI;
    // the vertex that cuts off a part of the area
    let (sin_alpha, cos_alpha) = alpha.sin_cos();
    let (sin, cos) = (PI + u[0] * area).sin_cos();
    let (s, t) = (sin * cos_alpha - cos * sin_alpha, cos * cos_alpha + sin * sin_alpha);
    let (k1, k2) = (t + cos_alpha, s - sin_alpha * dot(a, b));
    let q = ((k2 + (k2 * t - k1 * s) * cos_alpha) / ((k2 * s + k1 * t) * sin_alpha)).clamp(-1.0, 1.0);
    let moved = add(mul(a, q), mul(perpendicular(c, a), (1.0 - q * q).max(0.0).sqrt()));
    // along the arc to it
    let z = 1.0 - u[1] * (1.0 - dot(moved, b));
    let direction = add(mul(b, z), mul(perpendicular(moved, b), (1.0 - z * z).max(0.0).sqrt()));
    (direction, 1.0 / area)
}

/// A direction from `p` to a rectangle of a corner and two perpendicular edges, and its pdf per steradian.
pub fn rectangle(corner: Vector, edges: [Vector; 2], p: Vector, u: [f32; 2]) -> (Vector, f32) {
    let (width, height) = (dot(edges[0], edges[0]).sqrt(), dot(edges[1], edges[1]).sqrt());
    let (x, y) = (mul(edges[0], 1.0 / width), mul(edges[1], 1.0 / height));
    let mut z = cross(x, y);
    let from = sub(corner, p);
    let mut z0 = dot(from, z);
    if z0 > 0.0 {
        z = mul(z, -1.0);
        z0 = -z0;
    }
    let (x0, y0) = (dot(from, x), dot(from, y));
    let (x1, y1) = (x0 + width, y0 + height);
    let (v00, v01, v10, v11) = ([x0, y0, z0], [x0, y1, z0], [x1, y0, z0], [x1, y1, z0]);
    let n = [unit(cross(v00, v10)), unit(cross(v10, v11)), unit(cross(v11, v01)), unit(cross(v01, v00))];
    let between = |i: usize, j: usize| angle(mul(n[i], -1.0), n[j]);
    let (g0, g1, g2, g3) = (between(0, 1), between(1, 2), between(2, 3), between(3, 0));
    let (b0, b1, k) = (n[0][2], n[2][2], TAU - g2 - g3);
    let area = g0 + g1 - k;
    // x from the first number
    let (sin, cos) = (u[0] * area + k).sin_cos();
    let f = (cos * b0 - b1) / sin;
    let c = (1_f32.copysign(f) / (f * f + b0 * b0).sqrt()).clamp(-0.999_999_9, 0.999_999_9);
    let at_x = (-(c * z0) / (1.0 - c * c).max(0.0).sqrt()).clamp(x0, x1);
    // y from the second
    let d = (at_x * at_x + z0 * z0).sqrt();
    let (h0, h1) = (y0 / (d * d + y0 * y0).sqrt(), y1 / (d * d + y1 * y1).sqrt());
    let h = h0 + u[1] * (h1 - h0);
    let at_y = if h * h < 1.0 - 1e-6 { h * d / (1.0 - h * h).sqrt() } else { y1 };
    (unit(add(mul(x, at_x), add(mul(y, at_y), mul(z, z0)))), 1.0 / area)
}

/// A direction from a point `p` outside of a sphere to it, and its pdf per steradian.
pub fn sphere(center: Vector, radius: f32, p: Vector, u: [f32; 2]) -> (Vector, f32) {
    let to_center = sub(center, p);
    let sin2_max = radius * radius / dot(to_center, to_center);
    let mut one_minus_cos_max = 1.0 - (1.0 - sin2_max).max(0.0).sqrt();
    let mut cos = 1.0 - one_minus_cos_max * u[0];
    let mut sin2 = 1.0 - cos * cos;
    // 1.5°
    if sin2_max < 0.000_685_23 {
        sin2 = sin2_max * u[0];
        cos = (1.0 - sin2).sqrt();
        one_minus_cos_max = sin2_max / 2.0;
    }
    // the point of the sphere
    let cos_alpha = sin2 / sin2_max.sqrt() + cos * (1.0 - sin2 / sin2_max).max(0.0).sqrt();
    let sin_alpha = (1.0 - cos_alpha * cos_alpha).max(0.0).sqrt();
    let w = unit(to_center);
    // Duff and others (2017), "Building an Orthonormal Basis, Revisited"
    let sign = 1_f32.copysign(w[2]);
    let a = -1.0 / (sign + w[2]);
    let b = w[0] * w[1] * a;
    let (s, t) = ([1.0 + sign * w[0] * w[0] * a, sign * b, -sign * w[0]], [b, sign + w[1] * w[1] * a, -w[1]]);
    let (sin_phi, cos_phi) = (TAU * u[1]).sin_cos();
    let outwards = add(add(mul(s, sin_alpha * cos_phi), mul(t, sin_alpha * sin_phi)), mul(w, cos_alpha));
    (unit(sub(to_center, mul(outwards, radius))), 1.0 / (TAU * one_minus_cos_max))
}
