//! Vectors in f64. Incremental builds inline functions of another package only where they are marked so, and `map` of an array never.

/// A vector in f64.
pub type V3 = [f64; 3];

/// Dot product.
#[must_use]
#[inline]
pub fn dot(a: V3, b: V3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
/// Cross product.
#[must_use]
#[inline]
pub fn cross(a: V3, b: V3) -> V3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
/// `a + b`.
#[must_use]
#[inline]
pub fn add(a: V3, b: V3) -> V3 {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}
/// `a·s`.
#[must_use]
#[inline]
pub fn times(a: V3, s: f64) -> V3 {
    [a[0] * s, a[1] * s, a[2] * s]
}
/// `a + b·s`.
#[must_use]
#[inline]
pub fn along(a: V3, b: V3, s: f64) -> V3 {
    [a[0] + b[0] * s, a[1] + b[1] * s, a[2] + b[2] * s]
}
/// `a − b`.
#[must_use]
#[inline]
pub fn sub(a: V3, b: V3) -> V3 {
    along(a, b, -1.0)
}
/// Length, without overflow or underflow: a power of two first takes the greatest coordinate to [1, 2). The standard library's `hypot` is
/// the C library's, and not the same on every platform.
#[must_use]
#[inline]
pub fn length(a: V3) -> f64 {
    let greatest = a[0].abs().max(a[1].abs()).max(a[2].abs());
    let exponent = (greatest.to_bits() >> 52).clamp(1, 2045);
    let scale = f64::from_bits((2046 - exponent) << 52);
    let scaled = [a[0] * scale, a[1] * scale, a[2] * scale];
    dot(scaled, scaled).sqrt() / scale
}
/// Unit vector; the zero vector stays zero.
#[must_use]
#[inline]
pub fn unit(a: V3) -> V3 {
    let l = length(a);
    if l > 0.0 { [a[0] / l, a[1] / l, a[2] / l] } else { a }
}
/// Converts f32 to f64.
#[must_use]
#[inline]
pub fn wide(a: [f32; 3]) -> V3 {
    [f64::from(a[0]), f64::from(a[1]), f64::from(a[2])]
}
/// Rounds to f32.
#[must_use]
#[inline]
pub fn narrow(a: V3) -> [f32; 3] {
    [a[0] as f32, a[1] as f32, a[2] as f32]
}
/// Two unit vectors perpendicular to the unit vector `n`.
#[must_use]
#[inline]
pub fn basis(n: V3) -> (V3, V3) {
    crate::double_double::basis(n)
}
