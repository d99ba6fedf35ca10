//! The warps under test, with what is known about each from elsewhere.

mod flat;
mod projected;
mod round;

pub use flat::{AreaTriangle, Hexagon, Parallelogram, Rectangle, Triangle};
pub use projected::ProjectedCap;
pub use round::{
    Cap, ConcentricDisk, Cone, CosineHemisphere, PolarDisk, UniformHemisphere, UniformSphere, nearest_hit,
};
