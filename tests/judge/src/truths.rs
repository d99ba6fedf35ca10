//! What is known about shapes that samplers draw from.

mod disk;
mod polygon;
mod round;

pub use disk::Disk;
pub use polygon::{Polygon, Way};
pub use round::{Round, Smooth, off_the_diagonals};
