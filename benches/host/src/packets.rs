//! The formulas of `textbook` over packets, with the elementary functions of the core. Angles are arc cosines, as in Arvo's and Ureña's papers.

use etendue::{Real, Vec2, Vec3};
use std::f64::consts::{PI, TAU};

fn lit<R: Real>(x: f64) -> R {
    R::lit(x)
}
fn unit<R: Real>(a: Vec3<R>) -> Vec3<R> {
    a * (lit::<R>(1.0) / a.dot(a).sqrt())
}
fn cross<R: Real>(a: Vec3<R>, b: Vec3<R>) -> Vec3<R> {
    Vec3::new(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)
}
fn perpendicular<R: Real>(a: Vec3<R>, b: Vec3<R>) -> Vec3<R> {
    unit(a - b * a.dot(b))
}
fn angle<R: Real>(a: Vec3<R>, b: Vec3<R>) -> R {
    a.dot(b).acos()
}
fn sin_cos<R: Real>(x: R) -> (R, R) {
    (x * lit(1.0 / TAU)).sin_cos_turns()
}
/// √(1 − x²), of a number that rounding may leave beyond 1.
fn other<R: Real>(x: R) -> R {
    (lit::<R>(1.0) - x * x).greater(lit(0.0)).sqrt()
}

/// Directions from points `p` to a triangle, and their pdfs per steradian.
pub fn triangle<R: Real>(corners: [Vec3<R>; 3], p: Vec3<R>, u: Vec2<R>) -> (Vec3<R>, R) {
    let one = lit::<R>(1.0);
    let (a, b, c) = (unit(corners[0] - p), unit(corners[1] - p), unit(corners[2] - p));
    let (ab, bc, ca) = (unit(cross(a, b)), unit(cross(b, c)), unit(cross(c, a)));
    let alpha = angle(ab, -ca);
    let area = alpha + angle(bc, -ab) + angle(ca, -bc) - lit(PI);
    let ((sin_alpha, cos_alpha), (sin, cos)) = (sin_cos(alpha), sin_cos(lit::<R>(PI) + u.x * area));
    let (s, t) = (sin * cos_alpha - cos * sin_alpha, cos * cos_alpha + sin * sin_alpha);
    let (k1, k2) = (t + cos_alpha, s - sin_alpha * a.dot(b));
    let q = ((k2 + (k2 * t - k1 * s) * cos_alpha) / ((k2 * s + k1 * t) * sin_alpha)).clamped(-one, one);
    let moved = a * q + perpendicular(c, a) * other(q);
    let z = one - u.y * (one - moved.dot(b));
    (b * z + perpendicular(moved, b) * other(z), one / area)
}

/// Directions from points `p` to a rectangle, and their pdfs per steradian.
pub fn rectangle<R: Real>(corner: Vec3<R>, edges: [Vec3<R>; 2], p: Vec3<R>, u: Vec2<R>) -> (Vec3<R>, R) {
    let (zero, one) = (lit::<R>(0.0), lit::<R>(1.0));
    let (width, height) = (edges[0].dot(edges[0]).sqrt(), edges[1].dot(edges[1]).sqrt());
    let (x, y) = (edges[0] * (one / width), edges[1] * (one / height));
    let z = cross(x, y);
    let from = corner - p;
    let z0 = from.dot(z);
    let (z, z0) = (Vec3::blend(z0.gt(zero), -z, z), -z0.abs());
    let (x0, y0) = (from.dot(x), from.dot(y));
    let (x1, y1) = (x0 + width, y0 + height);
    let zz = z0 * z0;
    let [n0, n1, n2, n3] = [-y0, x1, y1, -x0].map(|e| e / (e * e + zz).sqrt());
    let k = lit::<R>(TAU) - (-(n2 * n3)).acos() - (-(n3 * n0)).acos();
    let area = (-(n0 * n1)).acos() + (-(n1 * n2)).acos() - k;
    let (sin, cos) = sin_cos(u.x * area + k);
    let f = (cos * n0 - n2) / sin;
    let c = one.copysign(f) / (f * f + n0 * n0).sqrt();
    let at_x = (-(c * z0) / other(c)).clamped(x0, x1);
    let d2 = at_x * at_x + zz;
    let (h0, h1) = (y0 / (d2 + y0 * y0).sqrt(), y1 / (d2 + y1 * y1).sqrt());
    let h = h0 + u.y * (h1 - h0);
    let at_y = h * (d2 / (one - h * h)).sqrt();
    (unit(x * at_x + y * at_y + z * z0), one / area)
}

/// Directions from points `p` outside of a sphere to it, and their pdfs per steradian.
pub fn sphere<R: Real>(center: Vec3<R>, radius: R, p: Vec3<R>, u: Vec2<R>) -> (Vec3<R>, R) {
    let one = lit::<R>(1.0);
    let to_center = center - p;
    let squared = to_center.dot(to_center);
    let one_minus_cos_max = one - (one - radius * radius / squared).greater(lit(0.0)).sqrt();
    let cos = one - one_minus_cos_max * u.x;
    let sin = other(cos);
    let w = to_center * (one / squared.sqrt());
    let sign = one.copysign(w.z);
    let a = -one / (sign + w.z);
    let b = w.x * w.y * a;
    let s = Vec3::new(one + sign * w.x * w.x * a, sign * b, -(sign * w.x));
    let t = Vec3::new(b, sign + w.y * w.y * a, -w.y);
    let (sin_phi, cos_phi) = u.y.sin_cos_turns();
    (s * (sin * cos_phi) + t * (sin * sin_phi) + w * cos, one / (lit::<R>(TAU) * one_minus_cos_max))
}
