//! What is measured: each routine of the core at each width, and rays through the scenes.
//!
//! A routine works on [`SAMPLES`] samples that fit the first-level cache, one packet after the other, and hands every result
//! to `black_box`: what is measured is throughput, with neighbouring packets overlapping as they do in a renderer.

pub mod baseline;
pub mod rays;
pub mod routines;

pub use routines::{Routine, SAMPLES, routines};
