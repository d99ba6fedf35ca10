//! Shapes as seen from a point: maps from the unit square to the directions in which the shape lies.
//!
//! `new` prepares a type once for a shape and a point (the shape is given relative to the point); it can then be sampled any
//! number of times. A type prepared in scalars is widened by `splat`, to draw packets of samples from one point; a type
//! prepared in packets serves as many points as there are lanes. The maps have no thresholds: one formula holds at every size
//! and distance, and scaling all lengths by a power of two changes no bit.
//!
//! | shape | type | pdf | degenerate input |
//! |---|---|---|---|
//! | sphere | [`SphericalCap`] | 1/Ω, Ω = 2π(1−cosσ) | radius ≤ 0: pdf 0; point inside: all directions |
//! | sphere | [`ProjectedCap`] | cosθ/Ω⊥ | radius ≤ 0, below the horizon: pdf 0; point inside: the hemisphere |
//! | triangle | [`SphericalTriangle`] | 1/Ω | point in the plane or on a vertex, zero area: pdf 0 |
//! | parallelogram | [`SphericalParallelogram`] | 1/Ω | as for the triangle |
//! | rectangle | [`SphericalRectangle`] | 1/Ω | as for the triangle |
//! | convex polygon, 3 to 8 corners | [`SphericalPolygon`] | 1/Ω | as for the triangle |
//! | triangle | [`ProjectedTriangle`] | cosθ/Ω⊥ | as for the triangle; below the horizon: pdf 0 |
//! | convex polygon, 3 to 8 corners | [`ProjectedPolygon`] | cosθ/Ω⊥ | as for the triangle; below the horizon: pdf 0 |
//! | disk | [`SphericalDisk`] | 1/Ω | point in the plane, radius ≤ 0: pdf 0 |
//! | triangle, rectangle | [`CosineWarped`] | roughly ∝ cosθ | as for the shape |
//! | line segment | [`SphericalSegment`] | 1/α per radian | point on the line: pdf 0 |
//! | line segment | [`ProjectedSegment`] | ∝ sinγ cosθ per radian | point on the line, below the horizon: pdf 0 |
//!
//! Solid angles Ω are in steradians. Ω⊥ is the projected solid angle on the surface at the viewpoint, above its horizon: at
//! most π. Where the table does not say otherwise, the pdf is per steradian.

mod cap;
mod cosine_warped;
mod disk;
mod double_word;
mod line;
mod parallelogram;
mod polygon;
mod projected_cap;
mod projected_polygon;
mod projected_triangle;
mod rectangle;
mod shape;
mod triangle;

pub use cap::SphericalCap;
pub use cosine_warped::CosineWarped;
pub use disk::SphericalDisk;
pub(crate) use double_word::{compensated_dot, compensated_height, cross_dw, height_dw, sum_dw};
pub use line::{ProjectedSegment, SphericalSegment};
pub use parallelogram::SphericalParallelogram;
pub use polygon::SphericalPolygon;
pub use projected_cap::ProjectedCap;
pub use projected_polygon::ProjectedPolygon;
pub use projected_triangle::ProjectedTriangle;
pub use rectangle::SphericalRectangle;
pub use shape::{ProjectedShape, SphericalShape};
pub use triangle::SphericalTriangle;

use crate::math::double;
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

/// 1/Ω, or 0 where Ω is so small (≤ 1e−37) that its reciprocal would not be finite.
#[inline(always)]
pub(crate) fn reciprocal_or_zero<R: Real>(solid_angle: R) -> R {
    let some = solid_angle.gt(R::lit(1e-37));
    (R::lit(1.0) / R::blend(some, solid_angle, R::lit(1.0))).keep(some)
}

/// Raises the unit vector `w` to a cosine of three units of its rounding to the unit vector `normal`, if rounding has taken it lower.
///
/// The sample of a shape above the horizon may be so low that rounding takes its direction below, where the pdf is 0. The pdf is
/// proportional to the cosine, so an estimate of irradiance does not change where the direction does.
#[inline(always)]
pub(crate) fn above_horizon<R: Real>(w: Vec3<R>, normal: Vec3<R>) -> Vec3<R> {
    let least = R::lit(if double::<R>() { 3.0 / 9_007_199_254_740_992.0 } else { 3.0 / 16_777_216.0 });
    let cos = w.dot(normal);
    // what a degenerate shape returns may be 0, or far below
    let low = cos.abs().lt(least) & w.max_abs().gt(R::lit(0.5));
    Vec3::blend(low, normal.mul_add(least - cos, w), w)
}

/// Scales the vectors by a power of two so that no coordinate exceeds 2, and returns that scale; all become 0 where a sum has
/// overflowed.
#[inline(always)]
pub(crate) fn to_unit<R: Real, const N: usize>(vectors: [Vec3<R>; N]) -> ([Vec3<R>; N], R) {
    let reach = vectors.iter().fold(R::lit(0.0), |most, v| most.greater(v.max_abs()));
    let finite = reach.lt(R::lit(f64::INFINITY));
    let scale = reach.pow2_scale();
    let scaled = |v: Vec3<R>| Vec3::new(v.x.keep(finite), v.y.keep(finite), v.z.keep(finite)) * scale;
    (vectors.map(scaled), scale)
}
