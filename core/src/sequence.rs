//! Random numbers and point sets in packets: pure functions of (pixel, sample, dimension, seed), with no state.
//!
//! Variance of the mean of N samples in a pair of dimensions, and how many times less it is than that of independent samples:
//! f = exp(x + y), and a straight edge at a random place and angle. Time for a pair, of many samples of one pixel, on one thread of
//! a Xeon at x86-64-v3, all lanes counted. (`cargo test -p etendue-tests --test sobol -- --nocapture variance`,
//! `cargo bench -p etendue-benches --bench summary -- sequence`.)
//!
//! | sequence | variance: smooth, edge | gain at 16 | gain at 64 | ns: f32, f32x4, f32x8 | when |
//! |---|---|---|---|---|---|
//! | [`Independent`] | N⁻¹ | 1 | 1 | 2.9, 1.6, 0.8 | the yardstick; the spread of samples tells the variance |
//! | [`LatinHypercube`] | N⁻¹, less what is a function of x or of y alone | 22, 3.5 | 25, 3.7 | 52.3, 26.5, 13.4 | any count, nearly additive integrands |
//! | [`Stratified`] | N⁻², N^(−3/2) | 14, 4.2 | 56, 8.5 | 45.7, 20.7, 10.5 | any count |
//! | [`Lattice::r2`] | about N^(−1.8), N^(−1.6) | 2.5, 3.1 | 7.4, 7.1 | 3.9, 1.0, 0.5 | a count not known beforehand, and cheap |
//! | [`Lattice::fibonacci`] | about N^(−1.7), N^(−1.6) | 9.6, 5.6 | 27, 12.6 | 3.9, 1.0, 0.5 | a Fibonacci count; edges |
//! | [`OwenSobol`] | about N^(−2.9), N^(−3/2) | 125, 6.0 | 1630, 12.0 | 9.3, 3.0, 1.4 | the choice wherever the count is a power of two |
//! | [`JointSobol`] | pair 0 as [`OwenSobol`] | | | 7.0, 3.0, 1.5 | what depends on two pairs or more together |
//! | [`JointStratified`] | as many strata as the square root of N in a pair | | | 40.0, 16.9, 8.6 | the same, at n⁴ samples |
//! | [`ZOrder`] | in a pixel as [`OwenSobol`] | | | 26.7, 8.6, 6.3 | few samples a pixel, an image for the eye: blue noise |
//!
//! Pairs of samples in one dimension are what these figures are of. Pairs of different dimensions are associated at random.
//!
//! A dimension is a pair: dimension 0 might be the pixel, 1 the light, 2 the lens.

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
pub use owen_sobol::{OwenSobol, ZOrder};
pub use stratified::Stratified;

use crate::real::Real;
use crate::vector::Vec2;

/// A point set with random access, one pair of dimensions at a time.
pub trait Sequence {
    /// The pair `dimension` of sample `sample` of pixel `pixel`, each in [0, 1)²; lanes may differ in pixel and sample.
    fn pair<R: Real>(&self, pixel: R::Uint, sample: R::Uint, dimension: u32) -> Vec2<R>;
}
