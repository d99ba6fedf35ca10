//! The warps under test, with what is known about each from elsewhere.

mod flat;
mod line;
mod normals;
mod projected;
mod projected_flat;
mod round;

pub use flat::{AreaTriangle, Hexagon, LowDistortionTriangle, Parallelogram, Rectangle, Triangle};
pub use line::{Bilinear, Exponential, Linear, Normal, Tent};
pub use normals::GgxVisibleNormals;
pub use projected::ProjectedCap;
pub use projected_flat::{ProjectedParallelogram, ProjectedPentagon, ProjectedTriangle};
pub use round::{
    Cap, ConcentricDisk, Cone, CosineHemisphere, Octahedral, PolarDisk, UniformHemisphere, UniformSphere, nearest_hit,
};
