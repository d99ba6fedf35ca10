//! Owen-scrambled Sobol points, in two dimensions at a time.

use super::independent::hash4;
use super::{Independent, Sequence};
use crate::real::{Real, Uint};
use crate::vector::Vec2;

/// Owen's nested uniform scrambling in base 2, on reversed bits: a hash of the bits below bit k decides whether it is flipped,
/// so the bits below k of the result depend only on the bits below k of the argument, one to one.
///
/// Additions, multiplications by odd numbers and `v ^= v·even` carry only from low bits to high bits. Over 2¹⁴ keys the flips
/// of a bit under different prefixes are as uncorrelated as independent ones, at 12 positions from bit 1 to bit 24; a fourth
/// multiplication before the key, as in the source, makes no measurable difference. Source: Laine and Karras, "Stratified
/// Sampling for Stochastic Transparency", EGSR 2011; Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020; form and
/// multipliers of Vegdahl, "Building a Better LK Hash", 2021.
#[inline]
pub(super) fn scramble<U: Uint>(v: U, key: U) -> U {
    let v = v.wrapping_add(key).wrapping_mul(key.shr(16) | U::splat(1));
    let v = v ^ v.wrapping_mul(U::splat(0x0552_6c56));
    v ^ v.wrapping_mul(U::splat(0x53a2_2864))
}

/// [`scramble`] in base 4: any of the 24 permutations of each digit, chosen by the digits below it. A 1 in `low` marks the
/// lower bit of each digit (the one of more weight, since the bits are reversed), at every second bit.
///
/// Nested permutations in base 2 give 8 of the 24. A step that is not nested goes between them: the upper bit of a digit flips
/// the lower one where the digit below is not 0, which has probability q = ¾. Two such steps between uniform ones leave the
/// eight with probability (1−q)² + q²/2 = 0.344 instead of ⅓.
#[inline]
pub(super) fn scramble_base_4<U: Uint>(v: U, keys: [U; 2], low: u32) -> U {
    let fold = |v: U| v ^ (v.shr(1) & (v.shl(1) | v.shl(2)) & U::splat(low));
    let v = fold(scramble(v, keys[0]));
    let v = fold(scramble(v, keys[1]));
    scramble(v, keys[0] ^ keys[1].shl(13) ^ keys[1].shr(19))
}

/// The second dimension of Sobol's sequence, on reversed bits; the first is the index itself.
///
/// Its matrix is Pascal's triangle modulo 2: if the bits of the index are the coefficients of a polynomial p over GF(2), those
/// of the result are the coefficients of p(x + 1). Since (x+1)^(2ᵏ) = x^(2ᵏ) + 1, each step adds the upper half of each block
/// of 2ᵏ⁺¹ bits to the lower half. Source: Ahmed, "An Implementation Algorithm of 2D Sobol Sequence Fast, Elegant, and
/// Compact", EGSR 2024, derives the same five steps.
#[inline]
pub(super) fn pascal<U: Uint>(index: U) -> U {
    let mut second = index;
    for (half, lower) in [(16, 0x0000_ffff), (8, 0x00ff_00ff), (4, 0x0f0f_0f0f), (2, 0x3333_3333), (1, 0x5555_5555)] {
        second = second ^ (second.shr(half) & U::splat(lower));
    }
    second
}

/// The scrambled point of index `index` in the first two dimensions of Sobol's sequence, both on reversed bits, as the
/// scrambling needs them.
#[inline]
pub(super) fn net<R: Real>(index: R::Uint, keys: [R::Uint; 2]) -> Vec2<R> {
    let second = pascal(index);
    Vec2::new(R::unit(scramble(index, keys[0]).reverse_bits()), R::unit(scramble(second, keys[1]).reverse_bits()))
}

/// Owen-scrambled Sobol pairs: in every dimension a (0, 2)-sequence in base 2, scrambled and shuffled on its own. The choice
/// wherever the count is a power of two.
///
/// Call `OwenSobol::new(seed)`, then [`pair`](Sequence::pair). There is no degenerate input.
///
/// ```
/// use etendue::{Vec2, sequence::{OwenSobol, Sequence}};
/// let sobol = OwenSobol::new(7);
/// // any four samples that start at a multiple of four have one in each quarter
/// let mut quarters = [0; 4];
/// for sample in 100_000..100_004 {
///     let u: Vec2<f32> = sobol.pair(41, sample, 3);
///     quarters[(u.x * 2.0) as usize * 2 + (u.y * 2.0) as usize] += 1;
/// }
/// assert_eq!(quarters, [1; 4]);
/// ```
///
/// - Formula: the bits of the index are shuffled from the top, each by a hash of those above it; the first two dimensions of
///   Sobol's sequence at that index are scrambled in the same way, each with its own key.
/// - Property: samples [k·2ᵐ, (k+1)·2ᵐ) of a pixel and a dimension, for every k and m ≤ 24, have exactly one point in each of
///   the 2ᵐ boxes of size 2⁻ᵃ × 2ᵃ⁻ᵐ, for every a. Counts that are a power of two are best.
/// - Domain: any 32-bit counters, with no limit to samples or dimensions.
/// - Values: multiples of 2⁻²⁴ in [0, 1 − 2⁻²⁴]; each point alone is uniform.
/// - Replicates: samples are correlated, so the variance of an estimate comes from the spread of the means of independent
///   pixels, dimensions or seeds.
/// - Padding: each pair is a net, and a nested shuffle associates the pairs: of four samples, all 24 associations of two pairs
///   occur, 8 of them twice as often as the other 16. A product of functions of two pairs is sampled worse than by independent
///   numbers: 49/31 = 1.58 times the variance where it is linear in a coordinate of each. See
///   [`JointSobol`](super::JointSobol).
/// - Source: Owen 1995, "Randomly Permuted (t,m,s)-Nets"; Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct OwenSobol {
    pub(super) random: Independent,
}

impl OwenSobol {
    /// A sequence; the scrambles of different seeds are independent. All 64 bits of the seed count.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self { random: Independent::new(seed) }
    }
    /// A pair, with a dimension and a key of its own for each lane.
    #[doc(hidden)]
    #[inline]
    pub fn pair_by<R: Real>(pixel: R::Uint, sample: R::Uint, dimension: R::Uint, key: R::Uint) -> Vec2<R> {
        let [shuffle, first, second, _] = hash4([pixel, R::Uint::splat(0x4f57_454e), dimension, key]);
        let index = scramble(sample.reverse_bits(), shuffle).reverse_bits();
        net(index, [first, second])
    }
}

impl Sequence for OwenSobol {
    #[inline]
    fn pair<R: Real>(&self, pixel: R::Uint, sample: R::Uint, dimension: u32) -> Vec2<R> {
        Self::pair_by(pixel, sample, R::Uint::splat(dimension), R::Uint::splat(self.random.seed))
    }
}

/// Owen-scrambled Sobol pairs dealt out along a Z-order curve: neighbouring pixels take neighbouring parts of one net, so that
/// their errors cancel and the remaining noise is blue. Take it for few samples per pixel, in images for human viewers.
///
/// Call `ZOrder::new(seed, samples)`, then [`pair`](ZOrder::pair) with a [`ZOrderIndex`]. There is no degenerate
/// input.
///
/// ```
/// use etendue::{Vec2, sequence::{ZOrder, ZOrderIndex}};
/// // one sample in each of four neighbouring pixels: together they have one in each quarter
/// let z = ZOrder::new(7, 1);
/// let mut quarters = [0; 4];
/// for (x, y) in [(6, 8), (7, 8), (6, 9), (7, 9)] {
///     let u: Vec2<f32> = z.pair(ZOrderIndex::new(x, y), 0, 0);
///     quarters[(u.x * 2.0) as usize * 2 + (u.y * 2.0) as usize] += 1;
/// }
/// assert_eq!(quarters, [1; 4]);
/// ```
///
/// - Formula: the index is pixel·2ᵏ + sample. Its digits are permuted from the top, each by a hash of those above it and of the
///   dimension, in base 4 for the pixel and in base 2 for the sample. Owen-scrambled Sobol at that index follows, with keys
///   that are the same in all pixels.
/// - Property: the samples of one pixel are a net of 2ᵏ points; so are aligned blocks of 2ᵐ of them, and so are those of any
///   aligned square of 2ⁿ × 2ⁿ pixels together.
/// - Spectrum: with 4 samples, below an eighth of the sampling rate, errors have 0.13 of the power of white noise where the
///   integrand is smooth and 0.42 where it has an edge (`cargo test -p etendue-tests sobol::blue -- --nocapture`).
/// - Domain: any 32-bit counters. The pixel is a position along the curve, a [`ZOrderIndex`]. Pixels share one net while
///   pixel·2ᵏ < 2³²; later ones take further, independent nets, and so do samples past 2ᵏ.
/// - Values: multiples of 2⁻²⁴ in [0, 1 − 2⁻²⁴].
/// - Replicates: samples are correlated, and so are pixels, so the spread among neighbours says nothing about the variance. Use
///   different seeds.
/// - Source: Ahmed and Wonka, "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering of
///   Pixels", SIGGRAPH Asia 2020; hash for base 4 after Vegdahl 2022.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ZOrder {
    random: Independent,
    bits: u32,
}

impl ZOrder {
    /// A sequence for `samples` per pixel, which takes as many points of a net: the next power of two, at most 2³¹.
    #[must_use]
    pub fn new(seed: u64, samples: u32) -> Self {
        let bits = 32 - samples.clamp(1, 1 << 31).saturating_sub(1).leading_zeros();
        Self { random: Independent::new(seed), bits }
    }
    /// Points of one net that a pixel takes: 2ᵏ.
    #[must_use]
    pub const fn samples(&self) -> u32 {
        1 << self.bits
    }
    /// The pair `dimension` of sample `sample` of a pixel, in [0, 1)²; lanes may differ in pixel and sample.
    #[inline]
    pub fn pair<R: Real>(&self, pixel: ZOrderIndex<R::Uint>, sample: R::Uint, dimension: u32) -> Vec2<R> {
        let ZOrderIndex(pixel) = pixel;
        // two shifts, since a shift by all 32 bits is not defined
        let net_of_pixel = pixel.shr(1).shr(31 - self.bits);
        let net_of_sample = sample.shr(self.bits);
        let [shuffle, again, first, second] = hash4([
            net_of_pixel,
            net_of_sample,
            R::Uint::splat(dimension),
            self.random.words(R::Uint::splat(self.bits), R::Uint::splat(0x5a4f_5244), 0)[0],
        ]);
        let within = R::Uint::splat((1 << self.bits) - 1);
        let index = pixel.shl(self.bits) | (sample & within);
        // the pixel's digits start at bit `bits`; reversed, the bit of more weight is the lower. The sample's bits stay in base
        // 2
        let low = (if self.bits.is_multiple_of(2) { 0x5555_5555 } else { 0xaaaa_aaaa }) & u32::MAX >> self.bits;
        let index = scramble_base_4(index.reverse_bits(), [shuffle, again], low).reverse_bits();
        net(index, [first, second])
    }
}

/// The position of a pixel along the Z-order curve, which a [`ZOrder`] takes: a row-major pixel number would not be one.
#[derive(Clone, Copy, Debug)]
pub struct ZOrderIndex<U>(U);

impl<U: Uint> ZOrderIndex<U> {
    /// The position of the pixel in column `x` and row `y`, both below 2¹⁶: their bits alternate, the lowest of x first.
    #[inline]
    #[must_use]
    pub fn new(x: U, y: U) -> Self {
        let spread = |v: U| {
            let mut v = v & U::splat(0xffff);
            for (by, kept) in [(8, 0x00ff_00ff), (4, 0x0f0f_0f0f), (2, 0x3333_3333), (1, 0x5555_5555)] {
                v = (v | v.shl(by)) & U::splat(kept);
            }
            v
        };
        Self(spread(x) | spread(y).shl(1))
    }
    /// A position along the curve that is known already.
    #[inline]
    #[must_use]
    pub fn from_position(position: U) -> Self {
        Self(position)
    }
}
