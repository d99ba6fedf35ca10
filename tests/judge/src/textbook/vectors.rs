//! Vectors of single precision.

pub(super) type V = [f32; 3];

pub(super) fn dot(a: V, b: V) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
pub(super) fn cross(a: V, b: V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
pub(super) fn add(a: V, b: V) -> V {
    core::array::from_fn(|i| a[i] + b[i])
}
pub(super) fn sub(a: V, b: V) -> V {
    core::array::from_fn(|i| a[i] - b[i])
}
pub(super) fn times(a: V, s: f32) -> V {
    a.map(|x| x * s)
}
pub(super) fn length(a: V) -> f32 {
    dot(a, a).sqrt()
}
pub(super) fn normalize(a: V) -> V {
    let l = length(a);
    a.map(|x| x / l)
}
