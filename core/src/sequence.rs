//! Random numbers and point sets in packets: pure functions of (pixel, sample, dimension, seed), with no state.
//!
//! The table gives the variance of the mean of N samples in a pair of dimensions, and the gain: how many times smaller that
//! variance is than with independent samples. The two integrands are f = exp(x + y) (smooth) and a straight edge at a random
//! place and angle. Times are per pair, for many samples of one pixel, on one thread of a Xeon at x86-64-v3, all lanes counted.
//! (`cargo test -p etendue-tests --test sobol -- --nocapture variance`,
//! `cargo bench -p etendue-benches --bench summary -- sequence`.)
//!
//! <!-- table: sequences -->
//! <!-- end of table -->
//!
//! These figures are for pairs of one dimension. Different dimensions are associated at random.
//!
//! A dimension here is a pair of coordinates: dimension 0 might be the pixel, 1 the light, 2 the lens.

mod independent;
mod joint;
mod latin;
mod lattice;
mod owen_sobol;
mod stratified;

pub use independent::{CounterRng, Independent};
pub use joint::{JointSobol, JointStratified};
pub use latin::LatinHypercube;
pub use lattice::Lattice;
pub use owen_sobol::{OwenSobol, ZOrder, ZOrderIndex};
pub use stratified::Stratified;

use crate::real::Real;
use crate::vector::Vec2;

/// A point set with random access, one pair of dimensions at a time.
pub trait Sequence {
    /// The pair `dimension` of sample `sample` of pixel `pixel`, in [0, 1)²; lanes may differ in pixel and sample.
    fn pair<R: Real>(&self, pixel: R::Uint, sample: R::Uint, dimension: u32) -> Vec2<R>;
}
