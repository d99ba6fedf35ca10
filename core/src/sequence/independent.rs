//! Independent random numbers.

use super::Sequence;
use crate::real::{Real, Uint};
use crate::vector::Vec2;

/// Hashes four words to four words: a bijection of 128 bits whose outputs pass for independent random numbers.
///
/// One linear congruential step, then two rounds of multiply-adds across the words, with a shift between them. Source:
/// Jarzynski and Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020 (pcg4d).
#[inline]
pub(super) fn hash4<U: Uint>(v: [U; 4]) -> [U; 4] {
    let (multiplier, increment) = (U::splat(1_664_525), U::splat(1_013_904_223));
    let [mut x, mut y, mut z, mut w] = v.map(|v| v.wrapping_mul(multiplier).wrapping_add(increment));
    x = x.wrapping_add(y.wrapping_mul(w));
    y = y.wrapping_add(z.wrapping_mul(x));
    z = z.wrapping_add(x.wrapping_mul(y));
    w = w.wrapping_add(y.wrapping_mul(z));
    [x, y, z, w] = [x, y, z, w].map(|v| v ^ v.shr(16));
    x = x.wrapping_add(y.wrapping_mul(w));
    y = y.wrapping_add(z.wrapping_mul(x));
    z = z.wrapping_add(x.wrapping_mul(y));
    w = w.wrapping_add(y.wrapping_mul(z));
    [x, y, z, w]
}

/// Independent uniform numbers by a counter hash, with random access: the baseline for every other sequence.
///
/// Call `Independent::new(seed)`, then [`pair`](Sequence::pair) for any pixel, sample and dimension. There is no degenerate
/// input.
///
/// ```
/// use etendue::{Vec2, sequence::{Independent, Sequence}};
/// let u: Vec2<f32> = Independent::new(7).pair(41, 3, 0);
/// assert_eq!(u, Independent::new(7).pair(41, 3, 0));
/// assert_ne!(u, Independent::new(7).pair(41, 3, 1));
/// ```
///
/// - Formula: a 128-bit hash of (pixel, sample, dimension, seed); each number takes 24 bits of one of its four words.
/// - Domain: any 32-bit counters.
/// - Values: multiples of 2⁻²⁴ in [0, 1 − 2⁻²⁴], the same at every precision and width.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct Independent {
    pub(super) seed: u32,
}

impl Independent {
    /// A stream; those of different seeds are independent. All 64 bits of the seed count.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self { seed: Self::key(seed as u32, (seed >> 32) as u32) }
    }
    /// What is kept of a seed, of which `low` and `high` are the halves.
    #[doc(hidden)]
    #[inline]
    pub fn key<U: Uint>(low: U, high: U) -> U {
        let [x, y, ..] = hash4([low, high, U::splat(0x4574_656e), U::splat(0x6475_6500)]);
        x ^ (y.shl(16) | y.shr(16))
    }
    /// Numbers of two pairs, with a key of its own for each lane.
    #[doc(hidden)]
    #[inline]
    pub fn numbers<R: Real>(pixel: R::Uint, sample: R::Uint, block: R::Uint, key: R::Uint) -> [R; 4] {
        hash4([pixel, sample, block, key]).map(R::unit)
    }
    /// The four hashed words of a counter.
    #[inline]
    pub fn words<U: Uint>(&self, pixel: U, sample: U, dimension: u32) -> [U; 4] {
        hash4([pixel, sample, U::splat(dimension), U::splat(self.seed)])
    }
    /// The pairs `2·block` and `2·block + 1`, for the cost of one.
    #[inline]
    pub fn two_pairs<R: Real>(&self, pixel: R::Uint, sample: R::Uint, block: u32) -> [Vec2<R>; 2] {
        let [x, y, z, w] = Self::numbers(pixel, sample, R::Uint::splat(block), R::Uint::splat(self.seed));
        [Vec2::new(x, y), Vec2::new(z, w)]
    }
}

impl Sequence for Independent {
    #[inline]
    fn pair<R: Real>(&self, pixel: R::Uint, sample: R::Uint, dimension: u32) -> Vec2<R> {
        let [first, second] = self.two_pairs(pixel, sample, dimension / 2);
        if dimension.is_multiple_of(2) { first } else { second }
    }
}
