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
mod corners;
mod cosine_warped;
mod direction;
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
pub(crate) use corners::PlacedCorners;
pub use cosine_warped::CosineWarped;
pub use direction::DirectionSample;
pub(crate) use direction::{above_horizon, to_unit};
pub use disk::SphericalDisk;
pub(crate) use double_word::{compensated_dot, height_dw, height_over, sum_dw};
pub use line::{ProjectedSegment, SphericalSegment};
pub use parallelogram::SphericalParallelogram;
pub use polygon::SphericalPolygon;
pub use projected_cap::ProjectedCap;
pub use projected_polygon::{ProjectedParallelogram, ProjectedPolygon};
pub use projected_triangle::ProjectedTriangle;
pub use rectangle::SphericalRectangle;
pub use shape::{ProjectedShape, SphericalShape};
pub use triangle::SphericalTriangle;
