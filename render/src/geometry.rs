//! The forms of shapes, each in a file with all that is special about it, and affine maps.
//!
//! A new form is a file that implements `form::Form`, and a line of the table in `table`.

mod affine;
mod bounds;
mod disk;
mod ends;
mod flat;
mod form;
mod parallelogram;
mod points;
mod sphere;
pub mod spread;
mod table;
mod triangle;

pub use affine::{Affine, Instance};
pub use bounds::bounds_of;
pub use disk::Disk;
pub(crate) use ends::{End, Segment};
pub use form::Chart;
pub(crate) use form::{Approach, Extent, Hittable, Meeting, NEAR, NEAR_LIMIT};
pub use parallelogram::Parallelogram;
#[cfg(feature = "analytic")]
pub(crate) use points::{LEAST, LIFT};
pub(crate) use points::{Points, on_triangle, on_triangles, on_vast_triangles};
pub use sphere::Sphere;
pub(crate) use sphere::across;
pub use table::Geometry;
pub(crate) use table::{AnyHittable, KINDS, Kind, extent, normals, sample};
