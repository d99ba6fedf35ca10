//! Workloads of the benchmarks: every routine of the core at every width.
//!
//! A routine computes [`SAMPLES`] samples, which fit the first-level cache, packet after packet, and passes every result to `black_box`.
//! This measures throughput: neighbouring packets overlap as they do in a renderer.

pub mod routines;

pub use routines::{Routine, SAMPLES, routines, without_tables};
