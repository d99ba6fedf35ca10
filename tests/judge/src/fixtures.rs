//! The samplers under test that are no lights of the core's list: warps, lines by angle, polygons of any corners.

mod corners;
mod normals;
mod round;
mod segment;
mod square;
mod surface;

pub use corners::Corners;
pub use normals::GgxVisibleNormals;
pub use round::*;
pub use segment::Segment;
pub use square::Bilinear;
pub use surface::PatchSurface;
