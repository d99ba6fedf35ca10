//! Random numbers and point sets in packets: pure functions of (pixel, sample, dimension, seed), with no state.
//!
//! The table gives the variance of the mean of N samples in a pair of dimensions, and the gain: how many times smaller that
//! variance is than with independent samples. The two integrands are f = exp(x + y) (smooth) and a straight edge at a random
//! place and angle (`cargo test -p etendue-tests variance -- --nocapture`). Times are in `benches/RESULTS.md`.
//!
//! | sequence | variance: smooth, edge | gain at 16 | gain at 64 | when |
//! |---|---|---|---|---|
//! | [`Independent`] | N⁻¹ | 1 | 1 | the baseline; the spread of samples gives the variance |
//! | [`Stratified`] | N⁻², N^(−3/2) | 14, 4.2 | 56, 8.5 | any count |
//! | [`OwenSobol`] | about N^(−2.9), N^(−3/2) | 125, 6.0 | 1630, 12.0 | the choice wherever the count is a power of two |
//! | [`JointSobol`] | pair 0 as [`OwenSobol`] |  |  | integrands that depend on two or more pairs together |
//! | [`ZOrder`] | within a pixel as [`OwenSobol`] |  |  | few samples per pixel, images for human viewers: blue noise |
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
