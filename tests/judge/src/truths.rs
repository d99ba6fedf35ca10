//! What is known about shapes that several warps sample.

mod polygon;
mod round;

pub use polygon::Polygon;
pub use round::Round;
