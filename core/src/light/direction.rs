//! Directions and distances of points, and vectors in units in which they neither over- nor underflow.

use crate::real::Real;
use crate::vector::Vec3;

/// A point of a shape as seen from the viewpoint: its direction and its distance.
#[derive(Clone, Copy, Debug, Default)]
pub struct DirectionSample<R> {
    /// Unit vector from the viewpoint to the point.
    pub direction: Vec3<R>,
    /// Distance from the viewpoint, in the unit of the shape: ≥ 0.
    pub distance: R,
}

/// Raises the unit vector `w` to a cosine of three units of its rounding to the unit vector `normal`, if rounding has taken it lower.
///
/// The sample of a shape above the horizon may be so low that rounding takes its direction below, where the pdf is 0. The pdf is
/// proportional to the cosine, so an estimate of irradiance does not change where the direction does.
#[inline(always)]
pub(in crate::light) fn above_horizon<R: Real>(w: Vec3<R>, normal: Vec3<R>) -> Vec3<R> {
    let least = R::lit(if R::DOUBLE { 3.0 / 9_007_199_254_740_992.0 } else { 3.0 / 16_777_216.0 });
    let cos = w.dot(normal);
    // what a degenerate shape returns may be 0, or far below
    let low = cos.abs().lt(least) & w.max_abs().gt(R::lit(0.5));
    Vec3::blend(low, normal.mul_add(least - cos, w), w)
}

/// Scales the vectors by a power of two so that no coordinate exceeds 2, and returns that scale; all become 0 where a sum has
/// overflowed.
#[inline(always)]
pub(in crate::light) fn to_unit<R: Real, const N: usize>(mut vectors: [Vec3<R>; N]) -> ([Vec3<R>; N], R) {
    let reach = vectors.iter().fold(R::lit(0.0), |most, v| most.greater(v.max_abs()));
    let finite = reach.lt(R::lit(f64::INFINITY));
    let scale = reach.pow2_scale();
    // of an array's own map, compilers keep a copy in memory
    for v in &mut vectors {
        *v = v.keep(finite) * scale;
    }
    (vectors, scale)
}
