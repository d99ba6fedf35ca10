//! The warps under test, each with independent knowledge about it.

mod cosine;
mod disk;
mod flat;
mod line;
mod normals;
mod projected;
mod projected_flat;
mod round;
mod segment;
mod surface;

pub use cosine::{CosineRectangle, CosineTriangle};
pub use disk::Disk;
pub use flat::{AreaTriangle, Hexagon, LowDistortionTriangle, Parallelogram, Rectangle, Triangle};
pub use line::{Bilinear, Linear, Tent};
pub use normals::GgxVisibleNormals;
pub use projected::ProjectedCap;
pub use projected_flat::{ProjectedParallelogram, ProjectedPentagon, ProjectedTriangle};
pub use round::{
    Cap, ConcentricDisk, Cone, CosineHemisphere, Octahedral, PolarDisk, UniformHemisphere, UniformSphere, nearest_hit,
};
pub use segment::{ProjectedSegment, Segment};
pub use surface::PatchSurface;
