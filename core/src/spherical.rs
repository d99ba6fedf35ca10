//! Shapes seen from a point: maps from the unit square to the directions in which the shape lies.
//!
//! Everything here is prepared once for a shape and a point (`new`, with the shape given relative to the point) and then
//! sampled as often as wanted. Prepared in scalars, it is widened by `splat` to draw packets of samples from one point; prepared
//! in packets, it serves as many points as there are lanes. The maps are threshold-free: one formula at every size and
//! distance, and scaling all lengths by a power of two changes no bit.
//!
//! | shape | type | density | degenerate input |
//! |---|---|---|---|
//! | sphere | [`SphericalCap`] | 1/Ω, Ω = 2π(1−cosσ) | radius ≤ 0: pdf 0; inside: all directions |
//! | sphere | [`ProjectedCap`] | cosθ/Ω⊥ | radius ≤ 0, below the horizon: pdf 0; inside: the hemisphere |
//! | triangle | [`SphericalTriangle`] | 1/Ω | point in the plane or on a vertex, zero area: pdf 0 |
//! | parallelogram | [`SphericalParallelogram`] | 1/Ω | as the triangle |
//! | rectangle | [`SphericalRectangle`] | 1/Ω | as the triangle |
//! | convex polygon, 3 to 8 corners | [`SphericalPolygon`] | 1/Ω | as the triangle |
//! | triangle | [`ProjectedTriangle`] | cosθ/Ω⊥ | as the triangle; below the horizon: pdf 0 |
//! | convex polygon, 3 to 8 corners | [`ProjectedPolygon`] | cosθ/Ω⊥ | as the triangle; below the horizon: pdf 0 |
//! | disk | [`SphericalDisk`] | 1/Ω | point in the plane, radius ≤ 0: pdf 0 |
//! | triangle, rectangle | [`CosineWarped`] | about ∝ cosθ | as the shape |
//! | line segment | [`SphericalSegment`] | 1/α per radian | point on its line: pdf 0 |
//! | line segment | [`ProjectedSegment`] | ∝ sinγ cosθ per radian | as that; below the horizon: pdf 0 |
//!
//! Solid angles Ω in steradians; Ω⊥ projected on the surface at the viewpoint, above its horizon, at most π.

mod cap;
mod cosine_warped;
mod disk;
mod double_word;
mod line;
mod parallelogram;
mod polygon;
mod projected_cap;
mod projected_polygon;
mod rectangle;
mod triangle;

pub use cap::SphericalCap;
pub use cosine_warped::CosineWarped;
pub use disk::SphericalDisk;
pub use line::{ProjectedSegment, SphericalSegment};
pub use parallelogram::SphericalParallelogram;
pub use polygon::SphericalPolygon;
pub use projected_cap::ProjectedCap;
pub use projected_polygon::{ProjectedPolygon, ProjectedTriangle};
pub use rectangle::SphericalRectangle;
pub use triangle::SphericalTriangle;

use crate::real::Real;
use crate::vector::Vec3;

/// A point of a shape as it is seen: in which direction, and how far.
#[derive(Clone, Copy, Debug, Default)]
pub struct DirectionSample<R> {
    /// Unit direction from the viewpoint.
    pub direction: Vec3<R>,
    /// Distance from the viewpoint.
    pub distance: R,
}

/// 1/Ω, or 0 where Ω is 0 or so small (1e−37) that its reciprocal would not be finite.
#[inline(always)]
pub(crate) fn reciprocal_or_zero<R: Real>(solid_angle: R) -> R {
    let some = solid_angle.gt(R::lit(1e-37));
    (R::lit(1.0) / R::blend(some, solid_angle, R::lit(1.0))).keep(some)
}

/// In a unit in which no coordinate exceeds 2, and 1 over it; zeros where a sum overflowed: a triangle of no extent.
#[inline(always)]
pub(crate) fn to_unit<R: Real, const N: usize>(vectors: [Vec3<R>; N]) -> ([Vec3<R>; N], R) {
    let reach = vectors.iter().fold(R::lit(0.0), |most, v| most.greater(v.max_abs()));
    let finite = reach.lt(R::lit(f64::INFINITY));
    let scale = reach.pow2_scale();
    let scaled = |v: Vec3<R>| Vec3::new(v.x.keep(finite), v.y.keep(finite), v.z.keep(finite)) * scale;
    (vectors.map(scaled), scale)
}
