//! The warps under test, each with independent knowledge about it.

mod disk;
mod flat;
mod line;
mod normals;
mod round;
mod segment;
mod surface;

pub use disk::Disk;
pub use flat::{
    Hexagon, Parallelogram, ProjectedParallelogram, ProjectedPentagon, ProjectedTriangle, Rectangle, Triangle,
};
pub use line::{Bilinear, Linear, Tent};
pub use normals::GgxVisibleNormals;
pub use round::{
    AreaTriangle, Cap, ConcentricDisk, Cone, CosineHemisphere, LowDistortionTriangle, Octahedral, PolarDisk,
    ProjectedCap, UniformHemisphere, UniformSphere, nearest_hit,
};
pub use segment::{ProjectedSegment, Segment};
pub use surface::PatchSurface;
