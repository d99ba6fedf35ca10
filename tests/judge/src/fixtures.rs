//! The warps under test, each with independent knowledge about it.

mod disk;
mod flat;
mod normals;
mod round;
mod segment;
mod square;
mod surface;

pub use disk::Disk;
pub use flat::{
    Hexagon, Parallelogram, ProjectedParallelogram, ProjectedPentagon, ProjectedTriangle, Rectangle, Triangle,
};
pub use normals::GgxVisibleNormals;
pub use round::{
    AreaTriangle, Cap, ConcentricDisk, Cone, CosineHemisphere, LowDistortionTriangle, Octahedral, ProjectedCap,
    UniformHemisphere, UniformSphere, nearest_hit,
};
pub use segment::{ProjectedSegment, Segment};
pub use square::Bilinear;
pub use surface::PatchSurface;
