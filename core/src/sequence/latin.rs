//! Latin hypercube samples.

use super::independent::hash4;
use super::stratified::{permute, replicate};
use super::{Independent, Sequence};
use crate::real::{Real, Uint, unit_interval};
use crate::vector::Vec2;

/// Latin hypercube: each coordinate has as many strata as there are samples, and the coordinates are associated at random. Take
/// it for nearly additive integrands, at any count.
///
/// Call `LatinHypercube::new(seed, count)`, then [`pair`](Sequence::pair). The count is clamped to its domain.
///
/// - Formula: u = (stratum + jitter)/count, where the stratum is a permutation of the sample's index, keyed by (pixel,
///   dimension, axis, seed).
/// - Property: the `count` samples of a replicate have exactly one point in each column and each row of width 1/count.
/// - Domain: any count from 1 to 2²²; any sample. Indices beyond the count start over with fresh permutations; from 2³¹ on, the
///   permutations of the first 2³¹ repeat, at fresh places in the strata.
/// - Replicates: indices [k·count, (k+1)·count) are independent copies; see [`Stratified`](super::Stratified).
/// - Source: McKay, Beckman and Conover 1979; Stein 1987 for the variance: the part of an integrand that is a sum of functions
///   of one coordinate converges fast, the rest as with independent samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LatinHypercube {
    random: Independent,
    count: u32,
}

impl LatinHypercube {
    /// A set with `count` samples per replicate, clamped to [1, 2²²].
    #[must_use]
    pub fn new(seed: u64, count: u32) -> Self {
        Self { random: Independent::new(seed), count: count.clamp(1, 1 << 22) }
    }
    /// Samples in each replicate.
    #[must_use]
    pub const fn count(&self) -> u32 {
        self.count
    }
}

impl Sequence for LatinHypercube {
    #[inline]
    fn pair<R: Real>(&self, pixel: R::Uint, sample: R::Uint, dimension: u32) -> Vec2<R> {
        let scale = R::lit(1.0 / f64::from(self.count));
        let (replicate, index) = replicate::<R>(sample, self.count);
        let keys = hash4([
            pixel,
            replicate,
            R::Uint::splat(dimension ^ 0x4c41_5449),
            self.random.words(pixel, replicate, !dimension)[1],
        ]);
        let jitter: Vec2<R> = self.random.pair(pixel, sample, dimension);
        let place = |keys, jitter: R| {
            let stratum = permute(index, self.count, keys);
            unit_interval((R::from_uint(stratum) + jitter) * scale)
        };
        Vec2::new(place(keys, jitter.x), place(hash4(keys), jitter.y))
    }
}
