//! Independent truth for the tests of the core and for the laboratory. Nothing here calls the library under test.
//!
//! - [`double_double`]: 106-bit arithmetic and vectors.
//! - [`flat`]: solid angles of triangles and rectangles, and their maps by definition.
//! - [`curves`]: disks and line segments, and their maps by definition.
//! - [`visible`]: what convex blockers leave of a light.
//! - [`direct`]: images by direct lighting, exhaustive and without offsets of rays.
//! - [`tier`]: how many cases a test runs.
//! - At the root: vectors in f64; closed forms for caps, polygons and disks ([`cap`], [`projected_cap`], [`lambert`], …); quadrature
//!   ([`gauss_legendre`], [`integrate`]); [`Random`] numbers; and [`Greatest`], the measure of a greatest error.

mod cap;
mod closed_forms;
pub mod curves;
pub mod direct;
pub mod double_double;
pub mod flat;
mod greatest;
mod outline;
mod quadrature;
mod random;
pub mod tier;
mod vectors;
pub mod visible;

pub use closed_forms::*;
pub use double_double::{dd, exact_sum};
pub use flat::triangle_solid_angle;
pub use greatest::Greatest;
pub use quadrature::{gauss_legendre, integrate};
pub use random::Random;
pub use vectors::*;
