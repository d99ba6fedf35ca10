//! What prepared lights consist of, for the tests and the benchmarks of this library: hosts prepare a light.

pub use super::direction::DirectionSample;
pub use super::disk::{area::PlacedDisk, solid_angle::SphericalDisk};
pub use super::line::{angle::SphericalSegment, projected::ProjectedSegment};
pub use super::parallelogram::{area::PlacedParallelogram, solid_angle::SphericalParallelogram};
pub use super::patch::PlacedPatch;
pub use super::polygon::projected::{ProjectedParallelogram, ProjectedPolygon};
pub use super::polygon::{area::PlacedPolygon, solid_angle::SphericalPolygon};
pub use super::rectangle::solid_angle::SphericalRectangle;
pub use super::seen::{ProjectedShape, SphericalShape};
pub use super::sphere::{area::PlacedSphere, projected::ProjectedCap, solid_angle::SphericalCap};
pub use super::triangle::{area::PlacedTriangle, projected::ProjectedTriangle, solid_angle::SphericalTriangle};
