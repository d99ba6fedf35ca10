//! Independent random numbers.

use super::Sequence;
use crate::real::{Real, Uint};
use crate::vector::Vec2;
use core::convert::Infallible;
use rand_core::{SeedableRng, TryRng};

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

/// The counter hash as a random generator: `rand_core`'s `Rng`, seedable, with a period of 2⁶⁴ words.
///
/// Call `CounterRng::seed_from_u64(seed)`, then `next_u32`. It never fails.
///
/// ```
/// use etendue::{Real, sequence::CounterRng};
/// use rand_core::{Rng, SeedableRng};
/// let mut rng = CounterRng::seed_from_u64(1);
/// let u: f32 = Real::unit(rng.next_u32());
/// assert!(u >= 0.0 && u < 1.0);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CounterRng {
    key: [u32; 2],
    counter: u64,
    words: [u32; 4],
}

impl SeedableRng for CounterRng {
    type Seed = [u8; 8];
    fn from_seed(seed: Self::Seed) -> Self {
        let seed = u64::from_le_bytes(seed);
        Self { key: [seed as u32, (seed >> 32) as u32], counter: 0, words: [0; 4] }
    }
}

impl TryRng for CounterRng {
    type Error = Infallible;
    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        let index = (self.counter % 4) as usize;
        if index == 0 {
            let block = self.counter / 4;
            self.words = hash4([block as u32, (block >> 32) as u32, self.key[0], self.key[1]]);
        }
        self.counter = self.counter.wrapping_add(1);
        Ok(self.words[index])
    }
    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        let low = u64::from(self.try_next_u32()?);
        Ok(low | u64::from(self.try_next_u32()?) << 32)
    }
    fn try_fill_bytes(&mut self, dst: &mut [u8]) -> Result<(), Infallible> {
        rand_core::utils::fill_bytes_via_next_word(dst, || self.try_next_u32())
    }
}
