//! Adaptive sampling: a few pilot samples for every pixel, and the rest where the variance around a pixel is great.
//!
//! The pilot's samples are part of the image. The number of samples of a pixel depends on the variance at its neighbours, not on its
//! own, so that a pixel that happens to be dark is not left dark. Mean and number of samples are independent, except for the share
//! that a pixel has in the sum over all pixels.

use super::allocation::{APART, Weights};
use super::second_sets;
use crate::area::{self, Area, crop};
use crate::film::{Accumulator, Pixel, channels};
use crate::packet::{V8, X8};
use crate::settings::Settings;
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

/// The weight of the neighbours of a pixel where its variance is estimated by the spread of samples. (With 0, `triangle-light` claimed 0.89
/// of its error, since the pixels that miss an edge were hardly ever judged.)
const BESIDE: f64 = 0.3;

/// Numbers of samples per set of a pixel, in packets of eight.
#[derive(Clone, Copy, Debug)]
pub(super) struct Effort {
    /// Sets of a pixel.
    pub(super) sets: u32,
    /// Packets of the pilot in each set.
    pub(super) pilot: u32,
    /// Mean number of packets per set over the pixels.
    packets: f64,
    /// The samples of [checks](super::second_sets) relative to those of the image; 0 if the sets tell the variance.
    pub(super) checks: f64,
}

impl Effort {
    pub(super) fn new(settings: &Settings, lens: bool) -> Self {
        let &Settings { spp, sampler, sets: asked, .. } = settings;
        let sets = sampler.sets(spp, asked, lens);
        let checks = if sampler.checks(asked) { second_sets::share(settings.whole()) } else { 0.0 };
        let packets = f64::from(spp) / (8.0 * f64::from(sets) * (1.0 + checks));
        // the greatest power of two up to a quarter, but 2 packets if there are 4 or more: eight points miss too much
        let pilot = greatest_power(packets / 4.0).max(if packets < 4.0 { 1.0 } else { 2.0 });
        Self { sets, pilot: pilot as u32, packets, checks }
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
    /// What the pilot tells of the variance of each pixel: that of a set of n samples is about proportional to this and to n^−1.5.
    pub squares: Vec<f32>,
    /// Samples per set of each light in the pilot.
    pub begun: Vec<[u32; APART]>,
    /// Sum of each set of the pilot.
    pub sums: Vec<[[f64; 3]; 4]>,
}

impl Allotment {
    /// From the pilot of an area, whose pixels share its samples. For the image, that is the whole.
    ///
    /// # Panics
    /// Panics if the pilot is not one of the area's size.
    #[must_use]
    pub fn new(settings: &Settings, lens: bool, area: Area, pilot: &[Statistics]) -> Self {
        assert_eq!(pilot.len(), area::count(area));
        let (packets, weights) = allot(pilot, area[2] - area[0], &Effort::new(settings, lens));
        let (lights, of) = weights.unwrap_or_default();
        Self {
            area,
            packets,
            lights,
            weights: of,
            squares: pilot.iter().map(|pixel| pixel.square() as f32).collect(),
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
    /// The pixels of a tile, from `rest`, the samples after those of the pilot.
    pub(super) fn finish(&self, tile: Area, rest: &[Statistics], sets: u32) -> Vec<Pixel> {
        let of = |(pixel, rest): ([u32; 2], &Statistics)| {
            let index = self.index(pixel);
            let count = 8 * self.packets[index];
            let both = |(a, b): (&[f64; 3], &[f64; 3])| {
                let sum = std::array::from_fn(|k| a[k] + b[k]);
                (count, Moments { sum, ..Moments::default() })
            };
            Pixel::of_sets(self.sums[index].iter().zip(&rest.sums).take(sets as usize).map(both), false)
        };
        area::pixels(tile).zip(rest).map(of).collect()
    }
    /// The variance of one set of each pixel of a tile by the spread of its samples and of those of the pixels beside it, whose edges it may
    /// have missed, but for a common factor. `rest` are the samples after those of the `pilot`, so many packets.
    pub(super) fn by_spread(&self, tile: Area, rest: &[Statistics], pilot: u32) -> Vec<f64> {
        let of = |(pixel, rest): ([u32; 2], &Statistics)| {
            let [before, after] = [pilot, rest.packets].map(f64::from);
            (before * f64::from(self.squares[self.index(pixel)]) + after * rest.square()) / (before + after)
        };
        let squares: Vec<f64> = area::pixels(tile).zip(rest).map(of).collect();
        let around = mean_around(&squares, &vec![1.0; squares.len()], (tile[2] - tile[0]) as usize);
        let both = |((own, around), pixel): ((f64, f64), [u32; 2])| {
            (own + BESIDE * around) * fall(self.packets_at(pixel).into())
        };
        squares.into_iter().zip(around).zip(area::pixels(tile)).map(both).collect()
    }
}

impl Statistics {
    /// The squared difference of two successive samples, or what has the same effect: a set of n samples has a variance that is about
    /// proportional to this and to n^−1.5.
    fn square(&self) -> f64 {
        let samples = f64::from(8 * self.packets);
        let of_light = |k: usize| match (self.pairs[k], self.taken[k]) {
            (0, _) | (_, 0) => 0.0,
            (pairs, taken) => f64::from(self.spread[k]) / f64::from(pairs) * fall(f64::from(taken) / samples),
        };
        // a difference of two samples has 16 times the variance of the mean of four
        16.0 * self.variance + (0..self.lights).map(of_light).sum::<f64>()
    }
}

/// n^−1.5
fn fall(n: f64) -> f64 {
    (n * n.sqrt()).recip()
}

/// Packets per set for each pixel, from the variance of the pilot; and the number of lights and their weights, if samples are allocated to
/// at most `APART` lights.
fn allot(parts: &[Statistics], width: u32, effort: &Effort) -> (Vec<u32>, Option<(usize, Vec<f32>)>) {
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
    if most <= 0.0 || !most.is_finite() {
        // no variance anywhere, or more than numbers can tell: the same number for all pixels
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

    fn begin(&mut self, first: u32) {
        self.adder.begin(first);
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
        let all = self.adder.sets();
        for (sum, (count, Sum(set))) in part.sums.iter_mut().zip(&*all) {
            (*sum, part.packets) = (*set, count / 8);
        }
        let sets = all.len().max(1) as u32;
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
