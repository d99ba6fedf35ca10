//! The warps under test, with what is known about each from elsewhere.

mod flat;
mod round;

pub use flat::{AreaTriangle, Parallelogram, Rectangle, Triangle};
pub use round::{
    Cap, ConcentricDisk, Cone, CosineHemisphere, PolarDisk, UniformHemisphere, UniformSphere, nearest_hit,
};
