//! Adaptive sampling: a few pilot samples for every pixel, and the rest where the variance around a pixel is great.
//!
//! The pilot's samples are part of the image. The number of samples of a pixel depends on the variance at its neighbours, not on its
//! own, so that a pixel that happens to be dark is not left dark. Mean and number of samples are independent, except for the share
//! that a pixel has in the sum over all pixels.

use super::allocation::{APART, Weights};
use super::settings::Settings;
use crate::area::crop;
use crate::film::{Accumulator, Pixel, channels};
use crate::packet::{V8, X8};
use crate::sums::{Adder, Moments, Sum};
use etendue::Real;
use etendue::estimate::Welford;
use etendue::select::Allocated;
use libm::pow;

/// The squared error falls about as N^−1.5 if a pixel's integrand is smooth except for edges. Then Σ cᵢ nᵢ^−1.5 for a given Σ nᵢ is
/// least with nᵢ ∝ cᵢ^0.4.
const POWER: f64 = 0.4;
/// Neighbours are at most this many rows and columns away.
const NEAR: usize = 2;
/// Pixels up to this far away have a small weight, since all near ones may have missed an edge that passes through the pixel. (This
/// helps a pilot of eight samples; with more it makes no difference.)
const FAR: usize = 6;
const WEIGHT_FAR: f64 = 0.003;

/// Numbers of samples per set of a pixel, in packets of eight.
#[derive(Clone, Copy, Debug)]
pub(super) struct Effort {
    /// Packets of the pilot in each set.
    pub(super) pilot: u32,
    /// Mean number of packets per set over the pixels.
    pub(super) packets: f64,
}

impl Effort {
    pub(super) fn new(spp: u32, sets: u32) -> Self {
        let packets = f64::from(spp) / f64::from(8 * sets);
        // the greatest power of two up to a quarter, but 2 packets if there are 4 or more: eight points miss too much
        let pilot = greatest_power(packets / 4.0).max(if packets < 4.0 { 1.0 } else { 2.0 });
        Self { pilot: pilot as u32, packets }
    }
}

/// Statistics of a range of the samples of a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Sum of each set.
    pub sums: [[f64; 3]; 4],
    /// Packets in each set.
    pub packets: u32,
    /// Variance of the means of four samples each, summed over the channels; for allocated samples, of what the camera sees directly. For
    /// samples allocated to more than `APART` lights, the sum of squared differences of successive samples.
    pub variance: f64,
    /// Number of lights to which the samples were allocated; 0 if they were not, or if there are more than `APART`.
    pub lights: usize,
    /// Σ(xᵢ−xᵢ₊₁)² over pairs of successive samples of each light.
    pub spread: [f32; APART],
    /// Number of these pairs per set.
    pub pairs: [u32; APART],
    /// Number of samples of each light per set.
    pub taken: [u32; APART],
}

/// How many samples each pixel of a rectangle receives after the pilot, and what the pilot found.
#[derive(Clone, Debug, PartialEq)]
pub struct Allotment {
    /// The pixels [x0, y0, x1, y1).
    pub area: [u32; 4],
    /// Packets of each pixel in each set, with those of the pilot.
    pub packets: Vec<u32>,
    /// Number of lights among which the samples are shared by weight; 0 if they are not.
    pub lights: usize,
    /// The weight of each light at each pixel.
    pub weights: Vec<f32>,
    /// Samples per set of each light in the pilot.
    pub begun: Vec<[u32; APART]>,
    /// Sum of each set of the pilot.
    pub sums: Vec<[[f64; 3]; 4]>,
}

impl Allotment {
    /// From the pilot of a whole image.
    ///
    /// # Panics
    /// Panics if the pilot is not one of the image's size.
    #[must_use]
    pub fn new(settings: &Settings, lens: bool, pilot: &[Statistics]) -> Self {
        let &Settings { width, height, spp, .. } = settings;
        assert_eq!(pilot.len(), width as usize * height as usize);
        let sets = settings.sampler.sets(spp, settings.sets, lens);
        let (packets, weights) = allot(pilot, width, sets, &Effort::new(spp, sets));
        let (lights, of) = weights.map_or((0, Vec::new()), |weights| weights);
        Self {
            area: [0, 0, width, height],
            packets,
            lights,
            weights: of,
            begun: pilot.iter().map(|pixel| pixel.taken).collect(),
            sums: pilot.iter().map(|pixel| pixel.sums).collect(),
        }
    }
    /// The same for the pixels of a rectangle within the area.
    #[must_use]
    pub fn crop(&self, area: [u32; 4]) -> Self {
        Self {
            area,
            packets: crop(&self.packets, self.area, area, 1),
            lights: self.lights,
            weights: crop(&self.weights, self.area, area, self.lights),
            begun: crop(&self.begun, self.area, area, 1),
            sums: crop(&self.sums, self.area, area, 1),
        }
    }
    /// The weights of the lights, if samples are shared by weight.
    pub(super) fn weights(&self) -> Option<Weights<'_>> {
        let Self { lights, weights, area, begun, .. } = self;
        (*lights > 0).then(|| Weights { lights: *lights, of: weights.into(), area: *area, begun })
    }
    /// The pixel of this index, with the samples after those of the pilot.
    pub(super) fn finish(&self, index: usize, rest: &Statistics, sets: u32) -> Pixel {
        let count = 8 * self.packets[index];
        let both = |(a, b): (&[f64; 3], &[f64; 3])| {
            let sum = std::array::from_fn(|k| a[k] + b[k]);
            (count, Moments { sum, ..Moments::default() })
        };
        Pixel::of_sets(self.sums[index].iter().zip(&rest.sums).take(sets as usize).map(both), false)
    }
}

/// Packets per set for each pixel, from the variance of the pilot; and the number of lights and their weights, if samples are allocated to
/// at most `APART` lights.
fn allot(parts: &[Statistics], width: u32, sets: u32, effort: &Effort) -> (Vec<u32>, Option<(usize, Vec<f32>)>) {
    let (columns, lights) = (width as usize, parts[0].lights);
    let mut weights = None;
    let wanted: Vec<f64> = if lights == 0 {
        let variance: Vec<_> = parts.iter().map(|part| part.variance).collect();
        mean_around(&variance, &vec![1.0; parts.len()], columns).into_iter().map(|v| pow(v, POWER)).collect()
    } else {
        // the error of each light falls with its own samples: the least Σ cᵢ nᵢ^−1.5 over the lights is (Σ cᵢ^0.4)^2.5 n^−1.5
        let mut of = vec![0.0; parts.len() * lights];
        for k in 0..lights {
            let spread: Vec<_> = parts.iter().map(|part| f64::from(part.spread[k])).collect();
            let pairs: Vec<_> = parts.iter().map(|part| f64::from(part.pairs[k])).collect();
            for (of, mean) in of.chunks_mut(lights).zip(mean_around(&spread, &pairs, columns)) {
                of[k] = pow(mean, POWER) as f32;
            }
        }
        // the error of what the camera sees directly falls with all samples
        let seen: Vec<_> = parts.iter().map(|part| 16.0 * f64::from(sets) * part.variance).collect();
        let reflected = of.chunks(lights).map(|each| each.iter().map(|&w| f64::from(w)).sum::<f64>());
        let both = |(w, seen): (f64, f64)| pow(pow(w, 1.0 / POWER) + seen, POWER);
        let sums = reflected.zip(mean_around(&seen, &vec![1.0; parts.len()], columns)).map(both).collect();
        weights = Some((lights, of));
        sums
    };
    let (pilot, total) = (f64::from(effort.pilot), effort.packets * parts.len() as f64);
    let spent = |scale: f64| wanted.iter().map(|w| (w * scale).max(pilot)).sum::<f64>();
    let most = wanted.iter().fold(0.0_f64, |m, &w| m.max(w));
    if most <= 0.0 {
        // no variance anywhere: the same number for all pixels
        return (vec![(effort.packets.round() as u32).max(effort.pilot); parts.len()], weights);
    }
    let (mut low, mut high) = (0.0, total / most);
    while spent(high) < total {
        high *= 2.0;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if spent(middle) < total { low = middle } else { high = middle }
    }
    // Sobol points are best in powers of two: rounds down or up at random, independently of the samples
    let rounded = |i: usize, packets: f64| {
        let below = greatest_power(packets);
        let turn = (i as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 11;
        let up = (turn as f64 / (1_u64 << 53) as f64) < packets / below - 1.0;
        (if up { 2.0 * below } else { below }) as u32
    };
    (wanted.iter().enumerate().map(|(i, w)| rounded(i, (w * low).max(pilot))).collect(), weights)
}

/// The greatest power of two that is no more than a positive normal number.
fn greatest_power(x: f64) -> f64 {
    f64::from_bits(x.to_bits() >> 52 << 52)
}

/// Σ `sums` / Σ `counts` over the neighbours of each pixel, excluding the pixel itself.
fn mean_around(sums: &[f64], counts: &[f64], columns: usize) -> Vec<f64> {
    let weighted = |values: &[f64]| {
        let (near, far) = (sums_around(values, columns, NEAR), sums_around(values, columns, FAR));
        near.into_iter().zip(far).map(|(near, far)| near + WEIGHT_FAR * far)
    };
    weighted(sums).zip(weighted(counts)).map(|(sum, count)| if count > 0.0 { sum / count } else { 0.0 }).collect()
}

/// Sums over the pixels up to `reach` rows and columns away from each pixel, excluding the pixel itself. Its value is never added and
/// subtracted again, so that not even rounding depends on it.
fn sums_around(values: &[f64], columns: usize, reach: usize) -> Vec<f64> {
    let near = |i: usize, most: usize| i.saturating_sub(reach)..(i + reach + 1).min(most);
    let (mut beside, mut across) = (Vec::with_capacity(values.len()), Vec::with_capacity(values.len()));
    for row in values.chunks(columns) {
        for x in 0..columns {
            let range = near(x, columns);
            let others = row[range.start..x].iter().sum::<f64>() + row[x + 1..range.end].iter().sum::<f64>();
            beside.push(others);
            across.push(others + row[x]);
        }
    }
    let rows = values.len() / columns;
    let other_rows = |x: usize, y: usize| near(y, rows).filter(move |&r| r != y).map(move |r| r * columns + x);
    (0..values.len())
        .map(|i| beside[i] + other_rows(i % columns, i / columns).map(|j| across[j]).sum::<f64>())
        .collect()
}

/// Accumulates [`Statistics`].
#[derive(Clone, Default)]
pub(super) struct StatisticsSum {
    /// Number of lights to which the samples are allocated; 0 if they are not.
    lights: usize,
    adder: Adder<Sum>,
    part: Statistics,
    halves: [Welford<f64>; 3],
    /// Sum of squared differences of successive samples of the same light.
    between: f64,
    /// The sum of reflected light for each light, times its squared share.
    spread: [f64; APART],
    /// Number of pairs in these sums, and of samples, of each light.
    pairs: [u32; APART],
    samples: [u32; APART],
}

impl StatisticsSum {
    pub(super) fn new(lights: usize) -> Self {
        Self { lights, ..Self::default() }
    }
}

impl Accumulator for StatisticsSum {
    type Output = Statistics;

    fn begin(&mut self, set: u32, first: u32) {
        self.adder.begin(set, first);
    }
    fn push_packet(&mut self, radiance: V8, seen: V8, allocated: Option<&Allocated<'_, X8>>) {
        self.adder.push_octet(&channels(radiance));
        // the samples of a packet that is shared among lights differ by their lights: only what does not depend on them is compared
        for half in halves(if allocated.is_some() { seen } else { radiance }) {
            for (spread, x) in self.halves.iter_mut().zip(half) {
                spread.push(x);
            }
        }
        let Some(allocated) = allocated else { return };
        let (light, share) = (allocated.light.to_array(), allocated.share.to_array());
        let square = |v: V8, k: usize| {
            let [a, b] = [k, k + 1].map(|k| v.lane(k));
            [a.x - b.x, a.y - b.y, a.z - b.z].into_iter().map(|d| f64::from(d).powi(2)).sum::<f64>()
        };
        let reflected = radiance - seen;
        for k in [0, 2, 4, 6] {
            if light[k] != light[k + 1] {
                continue;
            }
            let square = square(reflected, k);
            self.between += square;
            if let Some(spread) = self.spread.get_mut(light[k] as usize) {
                *spread += square * f64::from(share[k]).powi(2);
                self.pairs[light[k] as usize] += 1;
            }
        }
        for light in light {
            if let Some(samples) = self.samples.get_mut(light as usize) {
                *samples += 1;
            }
        }
    }
    fn push(&mut self, _: [f32; 3]) {
        unreachable!("adaptive sets consist of whole packets")
    }
    fn finish(&mut self) -> Statistics {
        let mut part = self.part;
        let all = self.adder.sums();
        let sets = all.finish();
        for (sum, (block, Sum(set))) in part.sums.iter_mut().zip(sets) {
            (*sum, part.packets) = (*set, block.count / 8);
        }
        let sets = sets.len();
        all.clear();
        part.variance = self.halves.iter().map(|b| b.variance()).sum();
        if self.lights > APART {
            // in the unit of the other sum: a difference of two samples has 16 times the variance of the mean of four
            part.variance = self.between + part.variance * 16.0 * f64::from(4 * part.packets) * sets as f64;
        }
        if (1..=APART).contains(&self.lights) {
            part.lights = self.lights;
            part.spread = self.spread.map(|spread| spread as f32);
            let sets = sets.max(1) as u32;
            part.pairs = self.pairs.map(|pairs| pairs / sets);
            part.taken = self.samples.map(|samples| samples / sets);
        }
        let adder = std::mem::take(&mut self.adder);
        *self = Self { adder, ..Self::new(self.lights) };
        part
    }
}

/// The means of the first and the last four lanes.
fn halves(radiance: V8) -> [[f64; 3]; 2] {
    [0, 4].map(|first| {
        [radiance.x, radiance.y, radiance.z]
            .map(|channel| (first..first + 4).map(|k| f64::from(channel.lane(k))).sum::<f64>() / 4.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue::select::Allocation;

    const WIDTH: usize = 17;
    const HEIGHT: usize = 15;

    /// Small integers, whose sums are exact.
    fn integers(step: usize) -> Vec<f64> {
        (0..WIDTH * HEIGHT).map(|i| (i * step % 31) as f64).collect()
    }
    /// Σ over the pixels within `reach` rows and columns, excluding the pixel itself, by definition.
    fn around(values: &[f64], i: usize, reach: usize) -> f64 {
        let near = |j: usize| (i % WIDTH).abs_diff(j % WIDTH) <= reach && (i / WIDTH).abs_diff(j / WIDTH) <= reach;
        (0..values.len()).filter(|&j| j != i && near(j)).map(|j| values[j]).sum()
    }

    #[test]
    fn neighbours_are_summed() {
        let values = integers(7);
        for reach in [1, NEAR, FAR, 40] {
            for (i, sum) in sums_around(&values, WIDTH, reach).into_iter().enumerate() {
                assert_eq!(sum, around(&values, i, reach), "pixel {i}, reach {reach}");
            }
        }
    }
    #[test]
    fn means_weight_near_and_far_neighbours() {
        let (sums, mut counts) = (integers(7), integers(5));
        counts[..9].fill(0.0);
        for (i, mean) in mean_around(&sums, &counts, WIDTH).into_iter().enumerate() {
            let both = |values: &[f64]| around(values, i, NEAR) + WEIGHT_FAR * around(values, i, FAR);
            let expected = both(&sums) / both(&counts);
            assert!((mean / expected - 1.0).abs() < 1e-14, "pixel {i}: {mean} instead of {expected}");
        }
        assert!(mean_around(&sums, &vec![0.0; sums.len()], WIDTH).iter().all(|&mean| mean == 0.0));
    }
    #[test]
    fn the_pilot_is_a_quarter_in_a_power_of_two() {
        for (spp, sets, pilot, packets) in
            [(8, 1, 1, 1.0), (16, 1, 1, 2.0), (24, 1, 1, 3.0), (32, 1, 2, 4.0), (64, 1, 2, 8.0), (100, 2, 2, 6.25)]
                .into_iter()
                .chain([(256, 4, 2, 8.0), (504, 1, 8, 63.0), (512, 1, 16, 64.0), (520, 1, 16, 65.0)])
        {
            let effort = Effort::new(spp, sets);
            assert_eq!((effort.pilot, effort.packets), (pilot, packets), "{spp} samples in {sets} sets");
        }
    }

    fn pilot(variance: impl Fn(usize) -> f64) -> Vec<Statistics> {
        (0..WIDTH * HEIGHT).map(|i| Statistics { variance: variance(i), ..Statistics::default() }).collect()
    }
    fn average(packets: &[u32]) -> f64 {
        packets.iter().copied().map(f64::from).sum::<f64>() / packets.len() as f64
    }

    #[test]
    fn equal_variance_gets_equal_numbers() {
        let effort = Effort { pilot: 2, packets: 16.0 };
        for variance in [0.0, 3.0] {
            let (packets, weights) = allot(&pilot(|_| variance), WIDTH as u32, 1, &effort);
            assert!(packets.iter().all(|&n| n == 16), "{packets:?}");
            assert!(weights.is_none());
        }
        // without variance, never less than the pilot
        let (packets, _) = allot(&pilot(|_| 0.0), WIDTH as u32, 1, &Effort { pilot: 2, packets: 1.3 });
        assert!(packets.iter().all(|&n| n == 2));
    }
    /// Two halves of a large image, whose variances have a ratio of 32: the numbers have that of 32^0.4 = 4.
    #[test]
    fn numbers_follow_the_variance_around() {
        let side = 64;
        let part =
            |i: usize| Statistics { variance: if i % side < side / 2 { 1.0 } else { 32.0 }, ..Statistics::default() };
        let parts: Vec<_> = (0..side * side).map(part).collect();
        let (packets, _) = allot(&parts, side as u32, 1, &Effort { pilot: 2, packets: 100.0 });
        assert!((average(&packets) / 100.0 - 1.0).abs() < 0.02, "{}", average(&packets));
        // away from the border by more than the far neighbours
        let columns = |from: usize, to: usize| -> Vec<u32> {
            packets.chunks(side).flat_map(|row| row[from..to].iter().copied()).collect()
        };
        let ratio = average(&columns(39, 64)) / average(&columns(0, 25));
        assert!((ratio / 4.0 - 1.0).abs() < 0.03, "{ratio}");
        assert!(packets.iter().all(|&n| n.is_power_of_two()));
        // and the pilot is the least
        let (packets, _) = allot(&parts, side as u32, 1, &Effort { pilot: 64, packets: 100.0 });
        assert!(packets.chunks(side).all(|row| row[..25].iter().all(|&n| n == 64)));
        assert!((average(&packets) / 100.0 - 1.0).abs() < 0.02, "{}", average(&packets));
    }
    /// Weights of lights are the power 0.4 of the mean square of differences around, and numbers that of (Σ weight)^2.5, and what the
    /// camera sees.
    #[test]
    fn lights_are_weighted_by_their_spread() {
        let mut spread = [0.0; APART];
        let mut pairs = [0; APART];
        spread[..3].copy_from_slice(&[64.0, 6.0, 0.0]);
        pairs[..3].copy_from_slice(&[2, 6, 4]);
        // mean squares of 32, 1 and 0: weights of 4, 1 and 0, (4 + 1)^2.5 = 55.9
        let part = |seen: f64| Statistics { lights: 3, spread, pairs, variance: seen, ..Statistics::default() };
        let side = 64;
        let (sets, seen) = (2, (15.0_f64.powf(2.5) - 5.0_f64.powf(2.5)) / 32.0);
        let parts: Vec<_> = (0..side * side).map(|i| part(if i % side < side / 2 { 0.0 } else { seen })).collect();
        let (packets, weights) = allot(&parts, side as u32, sets, &Effort { pilot: 2, packets: 100.0 });
        let (lights, weights) = weights.unwrap();
        assert_eq!(lights, 3);
        for own in weights.chunks(3) {
            assert!((own[0] - 4.0).abs() < 1e-5 && (own[1] - 1.0).abs() < 1e-6 && own[2] == 0.0, "{own:?}");
        }
        let columns = |from: usize, to: usize| -> Vec<u32> {
            packets.chunks(side).flat_map(|row| row[from..to].iter().copied()).collect()
        };
        // the mean of what is seen makes 15 of 5
        let ratio = average(&columns(39, 64)) / average(&columns(0, 25));
        assert!((ratio / 3.0 - 1.0).abs() < 0.03, "{ratio}");
    }

    fn packet(of: impl Fn(usize) -> [f32; 3]) -> V8 {
        let lane = |channel: usize| X8::from_fn(|k| of(k)[channel]);
        V8::new(lane(0), lane(1), lane(2))
    }

    /// Without allocated samples, the variance is that of the means of four samples.
    #[test]
    fn variances_are_of_means_of_four() {
        let mut sum = StatisticsSum::new(0);
        let mut means: [Vec<f64>; 3] = Default::default();
        for set in 0..2 {
            sum.begin(set, 0);
            for n in 0..2 {
                let sample = |k: usize| [k as f32, (k * k) as f32, (set * 2 + n) as f32 * 3.0 + k as f32 % 2.0];
                sum.push_packet(packet(sample), packet(|_| [100.0; 3]), None);
                for first in [0, 4] {
                    for (channel, means) in means.iter_mut().enumerate() {
                        means.push((first..first + 4).map(|k| f64::from(sample(k)[channel])).sum::<f64>() / 4.0);
                    }
                }
            }
        }
        let variance = |x: &Vec<f64>| {
            let mean = x.iter().sum::<f64>() / x.len() as f64;
            x.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (x.len() - 1) as f64
        };
        let expected: f64 = means.iter().map(variance).sum();
        let found = sum.finish();
        assert!((found.variance / expected - 1.0).abs() < 1e-14, "{} {expected}", found.variance);
        assert_eq!((found.packets, found.lights), (2, 0));
        assert_eq!(found.sums[1], [56.0, 280.0, 8.0 * (6.0 + 9.0) + 8.0]);
        // and the next pixel begins anew
        sum.begin(0, 0);
        sum.push_packet(packet(|_| [1.0; 3]), packet(|_| [0.0; 3]), None);
        assert_eq!(sum.finish().variance, 0.0);
    }
    /// Allocated samples are compared in pairs of the same light, times its squared share, without what the camera sees.
    #[test]
    fn spreads_are_of_pairs_of_one_light() {
        // five samples of the first light and three of the second: pairs 0-1, 2-3 and 6-7
        let mut before = Allocation::NONE;
        let allocation = Allocation::new(&[5.0, 3.0], 8, &mut before);
        let counts = [before[0], before[1]];
        let allocated = allocation.samples::<X8>(0);
        let light = allocated.light.to_array();
        let reflected = |k: usize| [(k * k) as f32, 2.0 * k as f32, 1.0];
        let seen = |k: usize| [if k < 4 { 3.0 } else { 5.0 }, 0.0, 0.0];
        let both = |k: usize| std::array::from_fn(|channel| reflected(k)[channel] + seen(k)[channel]);
        let mut expected = [[0.0; 2]; 2];
        for k in [0, 2, 4, 6].into_iter().filter(|&k| light[k] == light[k + 1]) {
            let [a, b] = [reflected(k), reflected(k + 1)];
            let square: f32 = (0..3).map(|channel| (a[channel] - b[channel]).powi(2)).sum();
            let own = &mut expected[light[k] as usize];
            *own = [own[0] + f64::from(square) * (f64::from(counts[light[k] as usize]) / 8.0).powi(2), own[1] + 1.0];
        }
        assert!(expected.iter().any(|own| own[1] > 0.0) && counts.iter().all(|&n| n > 0), "{light:?}");
        let mut sum = StatisticsSum::new(2);
        for set in 0..2 {
            sum.begin(set, 0);
            sum.push_packet(packet(both), packet(seen), Some(&allocated));
        }
        let found = sum.finish();
        assert_eq!(found.lights, 2);
        for k in 0..2 {
            assert_eq!(f64::from(found.spread[k]), 2.0 * expected[k][0], "light {k}");
            assert_eq!([found.pairs[k], found.taken[k]], [expected[k][1] as u32, counts[k]], "light {k}");
        }
        // four means: 3, 5, 3, 5
        assert!((found.variance - 4.0 / 3.0).abs() < 1e-14, "{}", found.variance);
        // among more lights than are kept apart: the squares of all pairs, and the variance in their unit
        let mut sum = StatisticsSum::new(APART + 1);
        for set in 0..2 {
            sum.begin(set, 0);
            sum.push_packet(packet(both), packet(seen), Some(&allocated));
        }
        let squares: f64 = [0, 2, 4, 6]
            .into_iter()
            .filter(|&k| light[k] == light[k + 1])
            .map(|k| ((k + 1) * (k + 1) - k * k).pow(2) as f64 + 4.0)
            .sum();
        let found = sum.finish();
        assert_eq!(found.lights, 0);
        let all = 2.0 * squares + 4.0 / 3.0 * 16.0 * 8.0;
        assert!((found.variance / all - 1.0).abs() < 1e-14, "{} {all}", found.variance);
    }
}
