//! Sequences whose pairs of dimensions are stratified together.

use super::owen_sobol::{pascal, scramble};
use super::{Independent, OwenSobol, Sequence};
use crate::real::{Real, Uint};
use crate::vector::Vec2;

/// Number of pairs that [`JointSobol`] takes from one point.
const PAIRS: u32 = 4;

/// What bit b of the index adds to dimensions 3 and 4, 5 and 6, 7 and 8, with the bits reversed.
const COLUMNS: [[[u32; 2]; 32]; 3] = [
    zip(columns(2, 1, [1, 3, 0, 0, 0]), columns(3, 1, [1, 3, 1, 0, 0])),
    zip(columns(3, 2, [1, 1, 1, 0, 0]), columns(4, 1, [1, 1, 3, 3, 0])),
    zip(columns(4, 4, [1, 3, 5, 13, 0]), columns(5, 2, [1, 1, 5, 5, 17])),
];

/// Sobol's recurrence for the primitive polynomial of the given `degree` whose inner coefficients are the bits of `inner`,
/// starting from the odd numbers `first` = m₁, m₂, …
const fn columns(degree: usize, inner: u32, first: [u32; 5]) -> [u32; 32] {
    let mut v = [0; 32];
    let mut i = 0;
    while i < 32 {
        if i < degree {
            v[i] = first[i] << (31 - i);
        } else {
            v[i] = v[i - degree] ^ (v[i - degree] >> degree);
            let mut k = 1;
            while k < degree {
                v[i] ^= (inner >> (degree - 1 - k) & 1) * v[i - k];
                k += 1;
            }
        }
        i += 1;
    }
    v
}

const fn zip(a: [u32; 32], b: [u32; 32]) -> [[u32; 2]; 32] {
    let mut both = [[0; 2]; 32];
    let mut i = 0;
    while i < 32 {
        both[i] = [a[i].reverse_bits(), b[i].reverse_bits()];
        i += 1;
    }
    both
}

/// Mixes high bits of a word into low ones, and back: the low bits of the hash are not quite independent across dimensions, and
/// as keys they decide the first digits, with no shuffle of the index to hide it.
#[inline]
fn mixed<U: Uint>(word: U) -> U {
    let word = (word ^ word.shr(16)).wrapping_mul(U::splat(0x7feb_352d));
    word ^ word.shr(15)
}

/// Owen-scrambled Sobol points in eight dimensions: pairs 0 to 3 of a sample are one point of one net. Take it for integrands
/// that depend on two or more pairs together (an edge whose place in the pixel moves with the point on the lens); in one pair
/// alone, [`OwenSobol`] is at least as good.
///
/// Call `JointSobol::new(seed)`, then [`pair`](Sequence::pair). There is no degenerate input, but 2ᵐ samples say nothing about
/// boxes smaller than 2ᵗ⁻ᵐ, so take enough of them.
///
/// ```
/// use etendue::{Vec2, sequence::{JointSobol, Sequence}};
/// // 32 samples: in three dimensions t = 1, so each box of volume 2⁻⁴ has two of them
/// let sobol = JointSobol::new(7);
/// let mut boxes = [0; 16];
/// for sample in 0..32 {
///     let [a, b]: [Vec2<f32>; 2] = [0, 1].map(|dimension| sobol.pair(41, sample, dimension));
///     boxes[(a.x * 2.0) as usize * 8 + (a.y * 4.0) as usize * 2 + (b.x * 2.0) as usize] += 1;
/// }
/// assert_eq!(boxes, [2; 16]);
/// ```
///
/// - Formula: Sobol's sequence at the sample's index, with each dimension scrambled by a key of its own.
/// - Property: samples [k·2ᵐ, (k+1)·2ᵐ) of a pixel, in the first s dimensions, are a (t, m, s)-net in base 2: each box of
///   volume 2ᵗ⁻ᵐ has 2ᵗ samples, t = 0, 0, 1, 3, 5, 8, 11, 15 for s = 1 … 8. Pair 0 alone is a (0, 2)-sequence. In any one
///   dimension t = 0.
/// - Domain: any 32-bit counters. For pairs 1 to 3, time grows with the number of bits of the sample's index. Pairs from 4 on
///   are those of [`OwenSobol`].
/// - Values: multiples of 2⁻²⁴ in [0, 1 − 2⁻²⁴]; each point alone is uniform.
/// - Replicates: samples are correlated; pixels and seeds are independent.
/// - Source: Sobol 1967; Joe and Kuo, "Constructing Sobol Sequences with Better Two-Dimensional Projections", SIAM J. Sci.
///   Comput. 30, 2008 (first numbers); for the scrambling see [`OwenSobol`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct JointSobol {
    random: Independent,
}

impl JointSobol {
    /// A sequence; the scrambles of different seeds are independent. All 64 bits of the seed count.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self { random: Independent::new(seed) }
    }
}

impl Sequence for JointSobol {
    #[inline]
    fn pair<R: Real>(&self, pixel: R::Uint, sample: R::Uint, dimension: u32) -> Vec2<R> {
        if dimension >= PAIRS {
            return OwenSobol { random: self.random }.pair(pixel, sample, dimension);
        }
        let words = self.random.words(pixel, R::Uint::splat(0x4a4f_494e), dimension);
        let [first, second, ..] = words.map(mixed);
        let [x, y] = if dimension == 0 {
            [sample, pascal(sample)]
        } else {
            let mut point = [R::Uint::splat(0); 2];
            let mut rest = sample;
            for column in &COLUMNS[dimension as usize - 1] {
                if !rest.any() {
                    break;
                }
                let set = R::Uint::splat(0).wrapping_sub(rest & R::Uint::splat(1));
                point = [0, 1].map(|k| point[k] ^ (set & R::Uint::splat(column[k])));
                rest = rest.shr(1);
            }
            point
        };
        Vec2::new(R::unit(scramble(x, first).reverse_bits()), R::unit(scramble(y, second).reverse_bits()))
    }
}
