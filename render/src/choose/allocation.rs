//! Allocation of the samples of a set to a few lights.

use crate::packet::X8;
use etendue::select::{Choice, SpatialLights};
use etendue::{Real, Uint, u32x8};

/// The greatest number of lights of an [`Allocation`], and of those that are chosen by what each can contribute to a point.
pub const FEW: usize = SpatialLights::MOST;

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
    pub fn samples(&self, first: u32) -> Allocated<'_> {
        let last = self.lights.saturating_sub(1);
        let begin = self.end[..last].partition_point(|&end| end <= first);
        if begin == last || self.end[begin] >= first.saturating_add(8) {
            // one light in all lanes
            let before = (self.before[begin] + first).wrapping_sub(self.start(begin));
            return Allocated {
                allocation: self,
                light: u32x8::splat(self.light[begin]),
                sample: Uint::from_fn(|lane| before.wrapping_add(lane as u32)),
                share: X8::splat(self.share_of(begin)),
            };
        }
        // each light has a sample, so successive lanes belong to the same light or to successive ones
        let mut places = [begin; 8];
        let mut k = begin;
        for (place, j) in places.iter_mut().zip(first..first.saturating_add(8)) {
            k += usize::from(k < last && j >= self.end[k]);
            *place = k;
        }
        Allocated {
            allocation: self,
            light: places.map(|k| self.light[k]).into(),
            sample: Uint::from_fn(|lane| {
                let k = places[lane];
                (self.before[k] + first).wrapping_add(lane as u32).wrapping_sub(self.start(k))
            }),
            share: places.map(|k| self.share_of(k)).into(),
        }
    }
    fn share_of(&self, k: usize) -> f32 {
        (self.end[k] - self.start(k)) as f32 * self.reciprocal
    }
    /// The fraction of the block's samples that a light receives; 0 for an index past the last light.
    #[must_use]
    pub fn share(&self, light: u32) -> f32 {
        let place = self.light[..self.lights].iter().position(|&one| one == light);
        place.map_or(0.0, |k| self.share_of(k))
    }
}

/// Allocated samples, one per lane: the choice of a light that needs no random number.
#[derive(Clone, Copy, Debug)]
pub struct Allocated<'a> {
    allocation: &'a Allocation,
    /// Indices of the lights.
    pub light: u32x8,
    /// Indices of the samples among all samples of their lights, in this block and those before.
    pub sample: u32x8,
    /// Fractions of the block's samples that the lights receive.
    pub share: X8,
}

impl Allocated<'_> {
    /// The lane's own light, with its share as the pmf; `u` is returned as it is, within [0, 1).
    #[inline]
    #[must_use]
    pub fn choose(&self, u: X8) -> Choice<X8> {
        Choice { index: self.light, pmf: self.share, u: u.clamped(X8::ZERO, X8::ONE_MINUS_EPSILON) }
    }
    /// The probability of a light: its share.
    #[inline]
    #[must_use]
    pub fn pmf(&self, light: u32) -> X8 {
        X8::splat(self.allocation.share(light))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue::Vec2;
    use etendue::sequence::{Independent, Sequence};

    /// The samples of a block belong to the lights in contiguous parts, whose shares sum to 1 exactly, in this block and those after it; a
    /// brighter light never receives fewer. Then the numbers that the documented rule gives.
    #[test]
    fn allocated_shares_sum_to_one() {
        let draw = |k: u32| {
            let u: Vec2<f32> = Independent::new(11).pair(0, k, 0);
            (u.x * 12.0).exp2() * u.y
        };
        for lights in 1..=FEW {
            for size in [32_u32, 64, 1024] {
                let weights: Vec<f32> = (0..lights as u32).map(|k| draw(k * 64 + lights as u32)).collect();
                let mut before = Allocation::NONE;
                for block in 1..4 {
                    let last = before;
                    let allocation = Allocation::new(&weights, size, &mut before);
                    let shares: Vec<f32> = (0..lights as u32).map(|k| allocation.share(k)).collect();
                    // multiples of 1/size: their sum is exact
                    assert_eq!(shares.iter().sum::<f32>(), 1.0, "{weights:?}");
                    assert_eq!([lights as u32, u32::MAX].map(|k| allocation.share(k)), [0.0; 2]);
                    assert_eq!(before.iter().sum::<u32>(), block * size);
                    for (k, &share) in shares.iter().enumerate() {
                        let count = before[k] - last[k];
                        assert!(count > 0 && share * size as f32 == count as f32, "{weights:?}: light {k}");
                        assert!((0..lights).all(|j| weights[j] <= weights[k] || before[j] - last[j] >= count));
                    }
                    // the samples of each light follow each other, from those of the blocks before on
                    let mut found = last;
                    for first in (0..size).step_by(8) {
                        let packet = allocation.samples(first);
                        for lane in 0..8 {
                            let light = packet.light.lane(lane);
                            assert_eq!(
                                packet.sample.lane(lane),
                                found[light as usize],
                                "{weights:?}: {first} + {lane}"
                            );
                            assert_eq!(packet.share.lane(lane), shares[light as usize]);
                            assert_eq!(packet.pmf(light), X8::splat(shares[light as usize]));
                            found[light as usize] += 1;
                        }
                    }
                    assert_eq!(found, before);
                }
            }
        }
        for (weights, size, counts) in [
            (&[1.0, 1.0, 1.0, 1.0][..], 32, &[8, 8, 8, 8][..]),
            (&[8.0, 4.0, 2.0, 2.0], 32, &[16, 8, 4, 4]),
            (&[0.0, 0.0], 8, &[4, 4]),
            (&[0.0, 0.0, 0.0], 8, &[4, 2, 2]),
            (&[1.0, 0.9, 0.8], 64, &[32, 16, 16]),
            // one that dominates receives what the others leave, which have 2 % of the sum
            (&[1.0, 0.0], 64, &[56, 8]),
            (&[1.0, 0.0], 1024, &[896, 128]),
            (&[1e6, 0.0, 0.0], 256, &[192, 32, 32]),
            (&[1.0, 0.0, 0.0, 0.0], 16, &[10, 2, 2, 2]),
            (&[7.0], 32, &[32]),
        ] {
            let mut before = Allocation::NONE;
            let _ = Allocation::new(weights, size, &mut before);
            assert_eq!(&before[..weights.len()], counts, "{weights:?}");
        }
        // without lights there is nothing to share
        let mut before = Allocation::NONE;
        let none = Allocation::new(&[], 8, &mut before);
        assert_eq!(none.samples(0).share, X8::splat(0.0));
    }
}
