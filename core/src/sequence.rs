//! Random numbers and point sets in packets: pure functions of (pixel, sample, dimension, seed), with no state.
//!
//! The table gives the variance of the mean of N samples in a pair of dimensions, and the gain: how many times smaller that
//! variance is than with independent samples. The two integrands are f = exp(x + y) (smooth) and a straight edge at a random
//! place and angle. Times are per pair, for many samples of one pixel, on one thread at x86-64-v3, all lanes counted.
//! (`cargo test -p etendue-tests variance -- --nocapture`,
//! `cargo bench -p etendue-benches --bench summary -- sequence`.)
//!
//! <!-- table: sequences -->
//! AMD EPYC, x86-64-v3, 2026-11-25.
//!
//! | sequence | variance: smooth, edge | gain at 16 | gain at 64 | f32 | f32x4 | f32x8 | when |
//! |---|---|---|---|---|---|---|---|
//! | [`Independent`] | N⁻¹ | 1 | 1 | 2.66 | 0.85 | 0.42 | the baseline; the spread of samples gives the variance |
//! | [`Stratified`] | N⁻², N^(−3/2) | 14, 4.2 | 56, 8.5 | 43.3 | 12.4 | 6.28 | any count |
//! | [`OwenSobol`] | about N^(−2.9), N^(−3/2) | 125, 6.0 | 1630, 12.0 | 4.76 | 2.06 | 1.03 | the choice wherever the count is a power of two |
//! | [`JointSobol`] | pair 0 as [`OwenSobol`] |  |  | 4.86 | 2.06 | 1.05 | integrands that depend on two or more pairs together |
//! | [`ZOrder`] | within a pixel as [`OwenSobol`] |  |  | 27.4 | 5.02 | 3.52 | few samples per pixel, images for human viewers: blue noise |
//! <!-- end of table -->
//!
//! These figures are for pairs of one dimension. Different dimensions are associated at random.
//!
//! A dimension here is a pair of coordinates: dimension 0 might be the pixel, 1 the light, 2 the lens.

#[cfg(feature = "rand")]
mod generator;
mod independent;
mod joint;
mod owen_sobol;
mod stratified;

#[cfg(feature = "rand")]
pub use generator::CounterRng;
pub use independent::Independent;
pub use joint::JointSobol;
pub use owen_sobol::{OwenSobol, ZOrder, ZOrderIndex};
pub use stratified::Stratified;

use crate::real::Real;
use crate::vector::Vec2;

/// A point set with random access, one pair of dimensions at a time.
pub trait Sequence {
    /// The pair `dimension` of sample `sample` of pixel `pixel`, in [0, 1)²; lanes may differ in pixel and sample.
    fn pair<R: Real>(&self, pixel: R::Uint, sample: R::Uint, dimension: u32) -> Vec2<R>;
}
