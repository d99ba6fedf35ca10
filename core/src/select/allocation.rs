//! Allocation of the samples of a set to a few lights.

use super::{Choice, FEW, LightChoice};
use crate::real::{MOST_LANES, Real, Uint, unit_interval};

/// What is added to each weight, as a fraction of the sum: a pixel may differ from the points that the weights belong to.
const LEAST: f32 = 0.02;

/// Allocates a block of samples to a few lights in advance, instead of choosing a light at random for each sample.
///
/// Each light receives some successive samples, at least one, which are well distributed on their own if they are points of a net: a
/// power of two, except for a light that dominates, which also receives what is left. No light is sampled more or less often than it
/// should be, which is most of the noise of a random choice among lights of different colours. The shares depend only on the weights, so
/// the estimate is unbiased as long as the weights do not depend on the samples.
///
/// - Formula: beginning with one sample each, the light of the greatest weight per sample doubles its number. If too few samples are
///   left for that, the greatest light that can double does so if it has a tenth as much weight per sample, and otherwise the light of
///   the greatest weight receives the rest. All weights are raised by 2 % of the sum.
/// - Domain: 1 to [`FEW`] lights, and a block of at least as many samples, which must be a power of two.
/// - Degenerate: without any weight, the samples are shared evenly.
///
/// ```
/// use etendue::select::{Allocation, LightChoice};
/// let mut before = Allocation::NONE;
/// let block = Allocation::new(&[3.0, 1.0], 8, &mut before);
/// assert_eq!(before[..2], [4, 4]);
/// let samples = block.samples::<etendue::f32x8>(0);
/// assert_eq!(samples.choose(etendue::f32x8::splat(0.5)).pmf.to_array(), [0.5; 8]);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Allocation {
    lights: usize,
    /// The lights in decreasing order of their numbers of samples.
    light: [u32; FEW],
    /// End of each light's samples in the block, and the number of its samples before the block.
    end: [u32; FEW],
    before: [u32; FEW],
    reciprocal: f32,
}

impl Allocation {
    /// The numbers of samples before the first block.
    pub const NONE: [u32; FEW] = [0; FEW];

    /// Allocates a block of `size` samples by these weights, and adds the samples of each light to `before`, their numbers before the
    /// block. Weights past the first [`FEW`] are ignored.
    #[must_use]
    pub fn new(weights: &[f32], size: u32, before: &mut [u32; FEW]) -> Self {
        let lights = weights.len().min(FEW);
        let weights = &weights[..lights];
        let mut left = size.saturating_sub(lights as u32);
        let mut each = [1; FEW];
        let mut worth = [0.0; FEW];
        let least = LEAST * weights.iter().sum::<f32>().greater(f32::MIN_POSITIVE);
        for (worth, weight) in worth.iter_mut().zip(weights) {
            *worth = weight + least;
        }
        // doubles the number of the light with the greatest weight per sample, as long as samples are left
        while left > 0 && lights > 0 {
            // the greatest of all, and of those that can double
            let (mut best, mut able) = (0, None);
            for k in 0..lights {
                if worth[k] > worth[best] {
                    best = k;
                }
                if each[k] <= left && able.is_none_or(|able: usize| worth[k] > worth[able]) {
                    able = Some(k);
                }
            }
            // too few may be left to double the greatest, but if it dominates, they are still worth most there
            let (chosen, more) = match able {
                Some(k) if worth[k] >= 0.1 * worth[best] => (k, each[k]),
                _ => (best, left),
            };
            left -= more;
            // halving is exact
            worth[chosen] *= each[chosen] as f32 / (each[chosen] + more) as f32;
            each[chosen] += more;
        }
        let mut light: [u32; FEW] = core::array::from_fn(|k| k as u32);
        // by decreasing number, then by index: insertion, as sorting needs memory
        for i in 1..lights {
            let mut k = i;
            while k > 0 && each[light[k - 1] as usize] < each[light[k] as usize] {
                light.swap(k - 1, k);
                k -= 1;
            }
        }
        let mut allocation = Self { lights, light, end: [0; FEW], before: [0; FEW], reciprocal: 1.0 / size as f32 };
        let mut sum = 0;
        for (k, one) in light.iter().enumerate().take(lights) {
            let one = *one as usize;
            sum += each[one];
            (allocation.end[k], allocation.before[k]) = (sum, before[one]);
            before[one] += each[one];
        }
        allocation
    }
    /// The range of samples of the k-th light, in decreasing order of numbers.
    const fn start(&self, k: usize) -> u32 {
        if k == 0 { 0 } else { self.end[k - 1] }
    }
    /// Samples of the block from `first` on, one per lane. Samples past the end of the block belong to the last light.
    #[inline]
    #[must_use]
    pub fn samples<R: Real>(&self, first: u32) -> Allocated<'_, R> {
        let last = self.lights.saturating_sub(1);
        let begin = self.end[..last].partition_point(|&end| end <= first);
        let lanes = R::Uint::LANES as u32;
        if begin == last || self.end[begin] >= first.saturating_add(lanes) {
            // one light in all lanes
            let before = (self.before[begin] + first).wrapping_sub(self.start(begin));
            let share = (self.end[begin] - self.start(begin)) as f32 * self.reciprocal;
            return Allocated {
                allocation: self,
                light: R::Uint::splat(self.light[begin]),
                sample: R::Uint::from_fn(|lane| before.wrapping_add(lane as u32)),
                share: R::lit(f64::from(share)),
            };
        }
        // each light has a sample, so successive lanes belong to the same light or to successive ones
        const { assert!(R::LANES <= MOST_LANES) };
        let mut places = [begin; MOST_LANES];
        let mut k = begin;
        for (place, j) in places.iter_mut().zip(first..first.saturating_add(lanes)) {
            k += usize::from(k < last && j >= self.end[k]);
            *place = k;
        }
        Allocated {
            allocation: self,
            light: R::Uint::from_fn(|lane| self.light[places[lane]]),
            sample: R::Uint::from_fn(|lane| {
                let k = places[lane];
                (self.before[k] + first).wrapping_add(lane as u32).wrapping_sub(self.start(k))
            }),
            share: R::from_fn(|lane| {
                let k = places[lane];
                R::Scalar::lit(f64::from((self.end[k] - self.start(k)) as f32 * self.reciprocal))
            }),
        }
    }
    /// The fraction of the block's samples that a light receives; 0 for an index past the last light.
    #[must_use]
    pub fn share(&self, light: u32) -> f32 {
        let place = self.light[..self.lights].iter().position(|&one| one == light);
        place.map_or(0.0, |k| (self.end[k] - self.start(k)) as f32 * self.reciprocal)
    }
}

/// Allocated samples, one per lane: the choice of a light that needs no random number.
#[derive(Clone, Copy, Debug)]
pub struct Allocated<'a, R: Real> {
    allocation: &'a Allocation,
    /// Indices of the lights.
    pub light: R::Uint,
    /// Indices of the samples among all samples of their lights, in this block and those before.
    pub sample: R::Uint,
    /// Fractions of the block's samples that the lights receive.
    pub share: R,
}

impl<R: Real> LightChoice<R> for Allocated<'_, R> {
    /// The lane's own light, with its share as the pmf; `u` is returned as it is.
    #[inline]
    fn choose(&self, u: R) -> Choice<R> {
        Choice { index: self.light, pmf: self.share, u: unit_interval(u) }
    }
    #[inline]
    fn pmf(&self, index: R::Uint) -> R {
        R::from_fn(|lane| R::Scalar::lit(f64::from(self.allocation.share(index.lane(lane)))))
    }
    #[inline]
    fn pmf_of(&self, light: u32) -> R {
        R::lit(f64::from(self.allocation.share(light)))
    }
}
