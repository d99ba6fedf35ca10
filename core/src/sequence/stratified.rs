//! Jittered strata.

use super::independent::hash4;
use super::{Independent, Sequence};
use crate::real::{Real, Uint, unit_interval};
use crate::vector::Vec2;

/// Jittered strata: the samples of a pixel are dealt to the cells of a grid, each pair of dimensions in its own random order
/// (padding), and placed uniformly within their cells. Take it for a count that is not a power of two.
///
/// Call `Stratified::new(seed, count)`, then [`pair`](Sequence::pair). The count is clamped to its domain.
///
/// - Formula: the cell is a permutation of the sample's index, keyed by (pixel, dimension, seed); u = (cell + jitter)/(columns,
///   rows).
/// - Domain: any count from 1 to 2²²; any sample. Indices beyond the count start over with fresh strata; from 2³¹ on, the
///   strata of the first 2³¹ repeat, at fresh places.
/// - Grid: columns × rows = count where a factorisation no longer than 2 : 1 exists, else the smallest nearly square grid that
///   holds the count, of which a random selection of cells is used, so that every point is still uniform.
/// - Replicates: indices [k·count, (k+1)·count) are independent copies. The variance of an estimate comes from the spread of
///   the replicates' means, not from the spread of samples, which are negatively correlated.
/// - Source: Cook, Porter and Carpenter 1984 (jitter); Kensler 2013 and PBR 4th ed., 8.5, for padding by permutation.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Stratified {
    random: Independent,
    count: u32,
    columns: u32,
    rows: u32,
}

impl Stratified {
    /// A set with `count` strata per replicate, clamped to [1, 2²²].
    #[must_use]
    pub fn new(seed: u64, count: u32) -> Self {
        let count = count.clamp(1, 1 << 22);
        let (columns, rows) = grid(count);
        Self { random: Independent::new(seed), count, columns, rows }
    }
    /// Strata in each replicate.
    #[must_use]
    pub const fn count(&self) -> u32 {
        self.count
    }
    /// Columns and rows of the grid.
    #[must_use]
    pub const fn grid(&self) -> [u32; 2] {
        [self.columns, self.rows]
    }
}

/// Columns and rows of the grid, with columns ≤ rows.
fn grid(count: u32) -> (u32, u32) {
    let root = count.isqrt();
    let mut columns = root;
    while columns > 1 && !count.is_multiple_of(columns) {
        columns -= 1;
    }
    if count / columns <= 2 * columns {
        return (columns, count / columns);
    }
    let rows = if root * root < count { root + 1 } else { root };
    (count.div_ceil(rows), rows)
}

/// A permutation of [0, 2^bits): each step is a bijection of that many bits.
#[inline]
fn scramble<U: Uint>(mut i: U, mask: U, half: u32, keys: [U; 4]) -> U {
    let one = U::splat(1);
    for key in keys {
        for key in [key, key.shr(15)] {
            // each step takes different bits of the key: a few index bits need all of them to reach every permutation
            i = (i ^ key) & mask;
            i = i ^ i.shr(half);
            i = i.wrapping_mul(key.shr(4) ^ (key.shr(4) & one) ^ one).wrapping_add(key.shr(10)) & mask;
        }
    }
    i
}

/// A permutation of [0, count) keyed by four words: that of the next power of two, iterated until the result is in range.
#[inline]
pub(super) fn permute<U: Uint>(i: U, count: u32, keys: [U; 4]) -> U {
    if count < 2 {
        return i & U::splat(0);
    }
    let bits = 32 - (count - 1).leading_zeros();
    let mask = U::splat(if bits == 32 { u32::MAX } else { (1 << bits) - 1 });
    let half = bits.div_ceil(2).min(31);
    let limit = U::splat(count - 1);
    let mut i = scramble(i, mask, half, keys);
    loop {
        let outside = limit.lt(i);
        if !outside.any() {
            return i;
        }
        // lanes that are done keep their value
        i = i ^ ((i ^ scramble(i, mask, half, keys)) & outside);
    }
}

impl Sequence for Stratified {
    #[inline]
    fn pair<R: Real>(&self, pixel: R::Uint, sample: R::Uint, dimension: u32) -> Vec2<R> {
        let (replicate, index) = replicate::<R>(sample, self.count);
        let keys = hash4([
            pixel,
            replicate,
            R::Uint::splat(dimension | 0x8000_0000),
            self.random.words(pixel, replicate, !dimension)[0],
        ]);
        let cells = self.columns * self.rows;
        let cell = permute(index, cells, keys);
        let row = divide::<R>(cell, self.columns);
        let column = cell.wrapping_sub(row.wrapping_mul(R::Uint::splat(self.columns)));
        let jitter: Vec2<R> = self.random.pair(pixel, sample, dimension);
        let place = |cell: R::Uint, jitter: R, n: u32| {
            unit_interval((R::from_uint(cell) + jitter) * R::lit(1.0 / f64::from(n)))
        };
        Vec2::new(place(column, jitter.x, self.columns), place(row, jitter.y, self.rows))
    }
}

/// The copy of the set to which a sample belongs, and its index there, below `count`: `permute` would never bring a larger one
/// into range.
#[inline]
pub(super) fn replicate<R: Real>(sample: R::Uint, count: u32) -> (R::Uint, R::Uint) {
    let sample = sample & R::Uint::splat(0x7fff_ffff);
    let replicate = divide::<R>(sample, count);
    (replicate, sample.wrapping_sub(replicate.wrapping_mul(R::Uint::splat(count))))
}

/// ⌊numerator/denominator⌋ for numerators below 2³¹: a rounded quotient, the rounded quotient of what is left, and a correction
/// by at most one.
#[inline]
pub(super) fn divide<R: Real>(numerator: R::Uint, denominator: u32) -> R::Uint {
    let inverse = R::lit(1.0 / f64::from(denominator));
    let denominator = R::Uint::splat(denominator);
    let guess = (R::from_uint(numerator) * inverse).to_uint();
    let rest = numerator.wrapping_sub(guess.wrapping_mul(denominator));
    let guess = guess.wrapping_add((R::from_uint(rest) * inverse).to_uint());
    let product = guess.wrapping_mul(denominator);
    // where the guess is too large: all ones are −1
    let guess = guess.wrapping_add(numerator.lt(product));
    let rest = numerator.wrapping_sub(guess.wrapping_mul(denominator));
    let short = denominator.wrapping_sub(R::Uint::splat(1)).lt(rest);
    guess.wrapping_sub(short)
}
