//! Rank-1 lattices.

use super::owen_sobol::scramble;
use super::{Independent, Sequence};
use crate::real::{Real, Uint};
use crate::vector::Vec2;

/// A rank-1 lattice, shifted at random in each pixel and dimension: the cheapest even point set, also for a count that is not
/// known in advance.
///
/// Call `Lattice::r2(seed)` or `Lattice::fibonacci(seed, count)`, then [`pair`](Sequence::pair). There is no degenerate input.
///
/// ```
/// use etendue::{Vec2, sequence::{Lattice, Sequence}};
/// // neighbours differ by the step, even after four billion samples
/// let lattice = Lattice::r2(7);
/// let [a, b]: [Vec2<f32>; 2] = [0xffff_fff0, 0xffff_fff1].map(|sample| lattice.pair(41, sample, 0));
/// let step = b.x - a.x;
/// assert!((step - step.floor() - 0.754_877_7).abs() < 2e-7);
/// ```
///
/// - Formula: u = frac(index·step + shift), in units of 2⁻³², where products and sums wrap as the torus does: exact for every
///   index.
/// - Domain: any 32-bit counters.
/// - Values: multiples of 2⁻²⁴ in [0, 1 − 2⁻²⁴]; each point alone is uniform.
/// - Padding: dimension 0 takes the indices in order, so any number of samples is as even as the lattice is. Further dimensions
///   shuffle aligned blocks of 2ᵐ indices, so they are best with a power of two.
/// - Replicates: the shifts of pixels, dimensions and seeds are independent; samples are correlated.
/// - Source: Cranley and Patterson 1976 (shift); Roberts 2018 (R2); PBR 4th ed., 8.6, for shuffled indices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lattice {
    random: Independent,
    steps: [u32; 2],
}

impl Lattice {
    /// Roberts's R2: steps 1/g and 1/g², g³ = g + 1, for any number of samples, known in advance or not.
    #[must_use]
    pub fn r2(seed: u64) -> Self {
        // 1/g and 1/g² in units of 2⁻³², rounded to odd numbers, so that all 2³² points differ in both coordinates
        Self { random: Independent::new(seed), steps: [0xc13f_a9a9, 0x91e1_0da5] }
    }
    /// A Fibonacci lattice: steps 1/count and the golden ratio − 1. Best at Fibonacci numbers, good at any count; `count` is
    /// clamped to [1, 2²²].
    ///
    /// The first step is rounded to 2⁻³²; over all samples that adds up to less than the grid of `u` where count ≤ 512, and to
    /// at most 2⁻¹¹ everywhere.
    #[must_use]
    pub fn fibonacci(seed: u64, count: u32) -> Self {
        let count = u64::from(count.clamp(1, 1 << 22));
        let first = ((1_u64 << 32) + count / 2) / count;
        Self { random: Independent::new(seed), steps: [first as u32, 0x9e37_79b9] }
    }
    /// A lattice with any steps, in units of 2⁻³².
    #[must_use]
    pub fn with_steps(seed: u64, steps: [u32; 2]) -> Self {
        Self { random: Independent::new(seed), steps }
    }
}

impl Sequence for Lattice {
    #[inline]
    fn pair<R: Real>(&self, pixel: R::Uint, sample: R::Uint, dimension: u32) -> Vec2<R> {
        let [x, y, shuffle, _] = self.random.words(pixel, R::Uint::splat(0x5231_4c54), dimension);
        let index = if dimension == 0 { sample } else { scramble(sample.reverse_bits(), shuffle).reverse_bits() };
        let place = |shift: R::Uint, step: u32| R::unit(index.wrapping_mul(R::Uint::splat(step)).wrapping_add(shift));
        Vec2::new(place(x, self.steps[0]), place(y, self.steps[1]))
    }
}
