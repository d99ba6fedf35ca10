//! Adaptive sampling: a few pilot samples for every pixel, and the rest where the variance around a pixel is great.
//!
//! The pilot's samples are part of the image. The number of samples of a pixel depends on the variance at its neighbours, not on its
//! own, so that a pixel that happens to be dark is not left dark. Mean and number of samples are independent, except for the share
//! that a pixel has in the sum over all pixels.

use super::allocation::{APART, Weights};
use super::settings::{Settings, tiles};
use crate::area::{self, Area, crop};
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
const OUTERMOST: usize = 6;
const WEIGHT_OUTERMOST: f64 = 0.003;

/// The share of the samples that is spent on second sets, and the number of pixels that should have one in small images.
const CHECKED: f64 = 1.0 / 12.0;
const FEWEST_CHECKED: f64 = 256.0;
/// The least chance of a pixel to have a second set, and how many pixels of a tile should have one at the least.
const LEAST_CHANCE: f64 = 1.0 / 64.0;
const FEWEST_OF_TILE: f64 = 2.0;

/// Numbers of samples per set of a pixel, in packets of eight.
#[derive(Clone, Copy, Debug)]
pub(super) struct Effort {
    /// The most sets of a pixel.
    pub(super) sets: u32,
    /// Packets of the pilot in each set.
    pub(super) pilot: u32,
    /// Mean number of packets per set over the pixels.
    packets: f64,
    /// If pixels have one set, but for some that have a second one: the samples of these relative to those of all others.
    checked: Option<f64>,
}

impl Effort {
    pub(super) fn new(settings: &Settings, lens: bool) -> Self {
        let &Settings { width, height, spp, sampler, sets: asked, .. } = settings;
        let sets = sampler.sets(spp, asked, lens);
        let pixels = f64::from(width) * f64::from(height);
        let checked = sampler.checks(asked).then(|| (FEWEST_CHECKED / pixels).clamp(CHECKED, 1.0));
        let packets = f64::from(spp) / (8.0 * checked.map_or(f64::from(sets), |checked| 1.0 + checked));
        // the greatest power of two up to a quarter, but 2 packets if there are 4 or more: eight points miss too much
        let pilot = greatest_power(packets / 4.0).max(if packets < 4.0 { 1.0 } else { 2.0 });
        Self { sets, pilot: pilot as u32, packets, checked }
    }
    /// Sets that all pixels have.
    pub(super) const fn common(&self) -> u32 {
        if self.checked.is_some() { 1 } else { self.sets }
    }
}

/// Statistics of a range of the samples of a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Sum of each set.
    pub sums: [[f64; 3]; 4],
    /// Packets in each set.
    pub packets: u32,
    /// Variance of the means of four samples each, summed over the channels; for samples that are allocated to at most `APART` lights, of
    /// what the camera sees directly.
    pub variance: f64,
    /// Number of lights to which the samples were allocated; 0 if they were not, or if there are more than `APART`.
    pub lights: usize,
    /// Σ(xᵢ−xᵢ₊₁)² over pairs of successive samples of each light, per set.
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
    pub area: Area,
    /// Packets of each pixel in each set, with those of the pilot.
    pub packets: Vec<u32>,
    /// Number of lights among which the samples are shared by weight; 0 if they are not.
    pub lights: usize,
    /// The weight of each light at each pixel.
    pub weights: Vec<f32>,
    /// [`Statistics::square`] of the pilot.
    pub squares: Vec<f32>,
    /// The chance with which a pixel was chosen to have one set more than others; 0 if it was not.
    pub chances: Vec<f32>,
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
        let &Settings { width, height, .. } = settings;
        assert_eq!(pilot.len(), width as usize * height as usize);
        let effort = Effort::new(settings, lens);
        let Shares { packets, expected, weights } = allot(pilot, width, &effort);
        let (lights, of) = weights.unwrap_or_default();
        let chances = effort
            .checked
            .map_or_else(|| vec![0.0; pilot.len()], |checked| choose(settings, &packets, &expected, checked));
        Self {
            area: [0, 0, width, height],
            packets,
            lights,
            weights: of,
            squares: pilot.iter().map(|pixel| pixel.square() as f32).collect(),
            chances,
            begun: pilot.iter().map(|pixel| pixel.taken).collect(),
            sums: pilot.iter().map(|pixel| pixel.sums).collect(),
        }
    }
    /// The same for the pixels of a rectangle within the area.
    #[must_use]
    pub fn crop(&self, area: Area) -> Self {
        Self {
            area,
            packets: crop(&self.packets, self.area, area, 1),
            lights: self.lights,
            weights: crop(&self.weights, self.area, area, self.lights),
            squares: crop(&self.squares, self.area, area, 1),
            chances: crop(&self.chances, self.area, area, 1),
            begun: crop(&self.begun, self.area, area, 1),
            sums: crop(&self.sums, self.area, area, 1),
        }
    }
    /// The weights of the lights, if samples are shared by weight.
    pub(super) fn weights(&self) -> Option<Weights<'_>> {
        let Self { lights, weights, area, begun, .. } = self;
        (*lights > 0).then(|| Weights { lights: *lights, of: weights.into(), area: *area, begun })
    }
    fn index(&self, [x, y]: [u32; 2]) -> usize {
        let [left, top, right, _] = self.area;
        ((y - top) * (right - left) + (x - left)) as usize
    }
    /// Packets of a pixel in each set, with those of the pilot.
    pub(super) fn packets_at(&self, pixel: [u32; 2]) -> u32 {
        self.packets[self.index(pixel)]
    }
    /// Whether a pixel has one set more than others.
    pub(super) fn is_checked(&self, pixel: [u32; 2]) -> bool {
        self.chances[self.index(pixel)] > 0.0
    }
    /// The pixels of a tile, from `rest`, the samples after those of the pilot.
    ///
    /// Where pixels have one set, their variances are estimated by the spread of their samples, as c n^−1.5, but for a factor. Those of the
    /// tile's pixels that have a second set tell the factor, each with a weight of 1/chance, as in the ratio estimator of surveys (Cochran
    /// 1977, Sampling Techniques, chapters 6 and 9A): so its mean is right whatever the spread.
    pub(super) fn finish(&self, tile: Area, rest: &[Statistics], effort: &Effort) -> Vec<Pixel> {
        let [x0, y0, x1, y1] = tile;
        let places = || (y0..y1).flat_map(|y| (x0..x1).map(move |x| [x, y])).map(|place| self.index(place));
        let sets = |index: usize| effort.common() + u32::from(self.chances[index] > 0.0);
        let pixel = |(index, rest): (usize, &Statistics)| {
            let count = 8 * self.packets[index];
            let both = |(a, b): (&[f64; 3], &[f64; 3])| {
                let sum = std::array::from_fn(|k| a[k] + b[k]);
                (count, Moments { sum, ..Moments::default() })
            };
            Pixel::of_sets(self.sums[index].iter().zip(&rest.sums).take(sets(index) as usize).map(both), false)
        };
        let mut pixels: Vec<Pixel> = places().zip(rest).map(pixel).collect();
        if effort.checked.is_none() {
            return pixels;
        }
        let by_spread = |(index, rest): (usize, &Statistics)| {
            let [before, after] = [effort.pilot, rest.packets].map(f64::from);
            let pilot = f64::from(self.squares[index]);
            (before * pilot + after * rest.square()) / (before + after) * pow(before + after, -1.5)
        };
        let by_spread: Vec<f64> = places().zip(rest).map(by_spread).collect();
        let (mut count, mut expected, mut found) = (0.0, 0.0, [0.0; 3]);
        for ((index, pixel), by_spread) in places().zip(&pixels).zip(&by_spread) {
            let chance = f64::from(self.chances[index]);
            if chance > 0.0 {
                count += chance.recip();
                expected += by_spread / chance;
                // that of the mean of two sets is half as much
                found.iter_mut().zip(pixel.variance).for_each(|(sum, of)| *sum += 2.0 * f64::from(of) / chance);
            }
        }
        for ((index, pixel), by_spread) in places().zip(&mut pixels).zip(by_spread) {
            // where nothing is expected, variance is taken to be the same everywhere
            let of_set = if expected > 0.0 { by_spread / expected } else { 1.0 / count };
            pixel.variance = found.map(|found| (found * of_set / f64::from(sets(index))) as f32);
        }
        pixels
    }
}

/// Chooses the pixels that have a second set, and returns their chances, or 0 for those that are not chosen. The chance is about
/// proportional to the variance that is expected over the root of the number of samples, so that the sum of all variances is known best.
fn choose(settings: &Settings, packets: &[u32], expected: &[f64], checked: f64) -> Vec<f32> {
    let whole = settings.whole();
    let wanted: Vec<f64> = expected.iter().zip(packets).map(|(variance, n)| variance / f64::from(*n).sqrt()).collect();
    let least = |area: Area| LEAST_CHANCE.max(FEWEST_OF_TILE / area::count(area) as f64).min(1.0);
    let mut chances = vec![0.0; packets.len()];
    let mut set = |scale: f64| {
        let mut spent = 0.0;
        for area in tiles(whole) {
            for index in indices(area, settings.width) {
                chances[index] = (wanted[index] * scale).clamp(least(area), 1.0);
                spent += chances[index] * f64::from(packets[index]);
            }
        }
        spent
    };
    let all = checked * packets.iter().copied().map(f64::from).sum::<f64>();
    let most = wanted.iter().fold(0.0_f64, |most, &x| most.max(x));
    if most > 0.0 {
        let (mut low, mut high) = (0.0, most.recip());
        while set(high) < all && high.is_finite() {
            high *= 2.0;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if set(middle) < all { low = middle } else { high = middle }
        }
        set(low);
    } else {
        chances.fill(checked);
    }
    let mut chosen = vec![0.0; packets.len()];
    for area in tiles(whole) {
        // systematic sampling: one pixel at each step of 1 in the sum of chances
        let mut next = share(settings.seed, area);
        let mut sum = 0.0;
        for index in indices(area, settings.width) {
            sum += chances[index];
            if sum > next {
                next += 1.0;
                chosen[index] = chances[index] as f32;
            }
        }
    }
    chosen
}

/// The indices of the pixels of an area, in an image of this width.
fn indices([x0, y0, x1, y1]: Area, width: u32) -> impl Iterator<Item = usize> {
    (y0..y1).flat_map(move |y| (x0..x1).map(move |x| y as usize * width as usize + x as usize))
}

/// A number in [0, 1) for each tile: the output function of SplitMix64 (Steele, Lea and Flood 2014).
fn share(seed: u64, [x, y, ..]: Area) -> f64 {
    let mut bits = seed ^ (u64::from(y) << 32 | u64::from(x)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ bits >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ bits >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((bits ^ bits >> 31) >> 11) as f64 / (1_u64 << 53) as f64
}

/// What [`allot`] finds.
struct Shares {
    /// Packets per set of each pixel.
    packets: Vec<u32>,
    /// The variance of a set of each pixel by the pilot's samples around it, but for a common factor.
    expected: Vec<f64>,
    /// The number of lights and their weights, if samples are allocated to at most `APART` lights.
    weights: Option<(usize, Vec<f32>)>,
}

impl Statistics {
    /// Adds the sums of a set of which `other` is.
    pub(super) fn add_set(&mut self, set: u32, other: &Self) {
        self.sums[set as usize].iter_mut().zip(other.sums[0]).for_each(|(sum, of)| *sum += of);
    }
    /// The squared difference of two successive samples, or what has the same effect: a set of n samples has a variance that is about
    /// proportional to this and to n^−1.5. It has the same mean for any number of sets.
    fn square(&self) -> f64 {
        let samples = f64::from(8 * self.packets);
        let of_light = |k: usize| match (self.pairs[k], self.taken[k]) {
            (0, _) | (_, 0) => 0.0,
            (pairs, taken) => f64::from(self.spread[k]) / f64::from(pairs) * pow(f64::from(taken) / samples, -1.5),
        };
        // a difference of two samples has 16 times the variance of the mean of four
        16.0 * self.variance + (0..self.lights).map(of_light).sum::<f64>()
    }
}

/// Shares the samples among the pixels by the variance of the pilot.
fn allot(parts: &[Statistics], width: u32, effort: &Effort) -> Shares {
    let (columns, lights) = (width as usize, parts[0].lights);
    let mut weights = None;
    let wanted: Vec<f64> = if lights == 0 {
        let variance: Vec<_> = parts.iter().map(|part| part.variance).collect();
        mean_around(&variance, &vec![1.0; parts.len()], columns).into_iter().map(|v| pow(v, POWER)).collect()
    } else {
        // the error of each light falls with its own samples: the least Σ cᵢ nᵢ^−1.5 over the lights is (Σ cᵢ^0.4)^2.5 n^−1.5
        let mut of = vec![0.0; parts.len() * lights];
        // where all light is known, no light has pairs
        for k in (0..lights).filter(|&k| parts.iter().any(|part| part.pairs[k] != 0)) {
            let spread: Vec<_> = parts.iter().map(|part| f64::from(part.spread[k])).collect();
            let pairs: Vec<_> = parts.iter().map(|part| f64::from(part.pairs[k])).collect();
            for (of, mean) in of.chunks_mut(lights).zip(mean_around(&spread, &pairs, columns)) {
                of[k] = pow(mean, POWER) as f32;
            }
        }
        // the error of what the camera sees directly falls with all samples
        let seen: Vec<_> = parts.iter().map(|part| 16.0 * part.variance).collect();
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
        let packets = vec![(effort.packets.round() as u32).max(effort.pilot); parts.len()];
        return Shares { packets, expected: vec![0.0; parts.len()], weights };
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
    let packets: Vec<u32> = wanted.iter().enumerate().map(|(i, w)| rounded(i, (w * low).max(pilot))).collect();
    // c n^−1.5, with c in relation to the greatest
    let variance = |(w, n): (&f64, &u32)| pow(w / most, 1.0 / POWER) * pow(f64::from(*n), -1.5);
    Shares { expected: wanted.iter().zip(&packets).map(variance).collect(), packets, weights }
}

/// The greatest power of two that is no more than a positive normal number.
fn greatest_power(x: f64) -> f64 {
    f64::from_bits(x.to_bits() >> 52 << 52)
}

/// Σ `sums` / Σ `counts` over the neighbours of each pixel, excluding the pixel itself.
fn mean_around(sums: &[f64], counts: &[f64], columns: usize) -> Vec<f64> {
    let weighted = |values: &[f64]| {
        let (near, far) = (sums_around(values, columns, NEAR), sums_around(values, columns, OUTERMOST));
        near.into_iter().zip(far).map(|(near, far)| near + WEIGHT_OUTERMOST * far)
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
        let sets = sets.len().max(1) as u32;
        all.clear();
        part.variance = self.halves.iter().map(|b| b.variance()).sum();
        if self.lights > APART && part.packets > 0 {
            // a difference of two samples has 16 times the variance of the mean of four
            part.variance += self.between / f64::from(16 * 4 * part.packets * sets);
        }
        if (1..=APART).contains(&self.lights) {
            part.lights = self.lights;
            part.spread = self.spread.map(|spread| (spread / f64::from(sets)) as f32);
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
mod tests;
