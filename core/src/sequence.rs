//! Random numbers and point sets in packets: pure functions of (pixel, sample, dimension, seed), with no state.
//!
//! | sequence | variance | notes |
//! |---|---|---|
//! | [`Independent`] | N⁻¹ | the yardstick |
//! | [`Stratified`] | N⁻² smooth, N^(−3/2) with edges, in each pair of dimensions | any count; pairs are associated at random |
//!
//! A dimension is a pair: dimension 0 might be the pixel, 1 the light, 2 the lens. Pairs of different dimensions are independent.

mod independent;
mod latin;
mod lattice;
mod owen_sobol;
mod stratified;

pub use independent::{CounterRng, Independent};
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
