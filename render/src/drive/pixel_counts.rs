//! How many samples each pixel takes: a few of a pilot everywhere, and the rest where the variance around a pixel is great.
//!
//! The pilot's samples are part of the image, and yet its mean is that of the light, exactly:
//! 1. A pixel has one of nine colours, (column mod 3, row mod 3). Samples of different pixels are independent.
//! 2. The counts of the pixels of a colour, and their weights of lights, are a function of the pilot of the other eight colours alone: so are
//!    the means around these pixels, and the scale that makes the counts of this colour its share of all samples, which is fixed.
//! 3. Given the pilot of the other colours, the count n of a pixel is thus a constant, and its samples are what they were without a pilot.
//! 4. The mean of the first n samples of a pixel has the light as its expectation, for each constant n.
//! 5. So it has it for the counts that are found, too. (With one scale for all pixels, a bright speck that its own pixel's pilot met would
//!    give the samples to the others, and one that it missed to its own: means were up to half too great.)

use super::light_weights::{APART, LightWeights};
use super::pixel_statistics::{Statistics, fall};
use super::second_sets::{self, Checks};
use super::tile::TileRenderer;
use crate::film::Pixel;
use crate::film::sums::Moments;
use crate::scene::area::{self, Area, crop};
use crate::settings::Settings;
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

/// Pixels whose rows and columns both differ by multiples of this have the same colour. No other number leaves all near neighbours with other
/// colours and is smaller.
const COLOURS: usize = NEAR + 1;
/// The greatest part of all samples that a pixel may take. What a single pixel has found makes up to 168 neighbours want samples: so a speck
/// that one pixel has met takes at most 0.42 of them.
const PART_OF_ALL: f64 = 1.0 / 400.0;
/// In images of so few pixels that this part is less, the greatest number of samples of a pixel relative to the mean.
const TIMES_MEAN: f64 = 4.0;
/// What pixels without any variance want, relative to those that want most: samples that these may not take are not lost.
const WANTED_LAST: f64 = 1e-6;

/// The weight of the neighbours of a pixel where its variance is estimated by the spread of samples. (With 0, `triangle-light` claimed 0.89
/// of its error, since the pixels that miss an edge were hardly ever judged.)
const BESIDE: f64 = 0.3;

/// Numbers of samples per set of a pixel, in packets of eight.
#[derive(Clone, Copy, Debug)]
pub(super) struct SamplePlan {
    /// Sets of a pixel.
    pub(super) sets: u32,
    /// Packets of the pilot in each set.
    pub(super) pilot: u32,
    /// Mean number of packets per set over the pixels.
    packets: f64,
    /// The samples of [checks](super::second_sets) relative to those of the image; 0 if the sets tell the variance.
    pub(super) checks: f64,
}

impl SamplePlan {
    pub(super) fn new(settings: &Settings) -> Self {
        let &Settings { spp, sampler, sets: asked, .. } = settings;
        let sets = sampler.sets(spp, asked);
        let checks = if sampler.checks(asked) { second_sets::share(settings.whole()) } else { 0.0 };
        let packets = f64::from(spp) / (8.0 * f64::from(sets) * (1.0 + checks));
        // the greatest power of two up to a quarter, but 2 packets if there are 4 or more: eight points miss too much
        let pilot = greatest_power(packets / 4.0).max(if packets < 4.0 { 1.0 } else { 2.0 });
        Self { sets, pilot: pilot as u32, packets, checks }
    }
    /// The same with a pilot of so many packets, if that is more, but no more than a third of all: what follows it goes where the variance is.
    pub(super) fn with_pilot(self, packets: u32) -> Self {
        let fits = 3.0 * f64::from(packets) <= self.packets;
        Self { pilot: if fits { packets.max(self.pilot) } else { self.pilot }, ..self }
    }
}

/// How many samples each pixel of a rectangle receives after the pilot, and what the pilot found.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelCounts {
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
    /// The sum of the variances of all pixels of the image, as the pilot tells them, but for a common factor.
    pub expected: f64,
}

impl PixelCounts {
    /// From the pilot of an area, whose pixels share its samples. For the image, that is the whole.
    ///
    /// # Panics
    /// Panics if the pilot is not one of the area's size.
    #[must_use]
    pub fn new(settings: &Settings, area: Area, pilot: &[Statistics]) -> Self {
        assert_eq!(pilot.len(), area::count(area));
        let plan = SamplePlan::new(settings).with_pilot(pilot[0].packets);
        let (packets, weights) = count_packets(pilot, area[2] - area[0], &plan);
        let (lights, of) = weights.unwrap_or_default();
        let squares: Vec<f32> = pilot.iter().map(|pixel| pixel.square() as f32).collect();
        let of_pixel = |(square, packets): (&f32, &u32)| f64::from(*square) * fall((*packets).into());
        let expected = (1.0 + BESIDE) * squares.iter().zip(&packets).map(of_pixel).sum::<f64>();
        Self {
            area,
            expected,
            packets,
            lights,
            weights: of,
            squares,
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
            expected: self.expected,
        }
    }
    /// The weights of the lights, if samples are shared by weight.
    pub(super) fn weights(&self) -> Option<LightWeights<'_>> {
        let Self { lights, weights, area, begun, .. } = self;
        (*lights > 0).then(|| LightWeights { lights: *lights, of: weights.into(), area: *area, begun })
    }
    fn index(&self, [x, y]: [u32; 2]) -> usize {
        let [left, top, right, _] = self.area;
        ((y - top) * (right - left) + (x - left)) as usize
    }
    /// Packets of a pixel in each set, with those of the pilot.
    fn packets_at(&self, pixel: [u32; 2]) -> u32 {
        self.packets[self.index(pixel)]
    }
    /// Renders the samples of a tile that follow the pilot, and some pixels a second time where the differences estimate the variance. Returns
    /// the finished pixels.
    pub(super) fn rest(
        &self,
        renderer: &mut TileRenderer<'_>,
        tile: Area,
        weights: Option<&LightWeights<'_>>,
        &SamplePlan { sets, pilot, checks, .. }: &SamplePlan,
    ) -> Vec<Pixel> {
        renderer.begin(tile);
        let rest = renderer.parts(tile, pilot, 0..sets, weights, |pixel| [pilot, self.packets_at(pixel)]);
        let mut pixels = self.finish(tile, &rest, sets);
        if checks > 0.0 {
            let mut squares = self.squares(tile, &rest, pilot);
            let by_spread = self.by_spread(tile, &squares);
            let packets: Vec<u32> = area::pixels(tile).map(|pixel| self.packets_at(pixel)).collect();
            let checks = Checks::new(tile, &by_spread, &packets, checks, renderer.settings.seed);
            // their first samples are allocated by the pilot, too, which makes little difference
            let weights = weights.map(LightWeights::anew);
            let range = |pixel| [0, if checks.contains(pixel) { self.packets_at(pixel) } else { 0 }];
            let second = renderer.parts(tile, pilot, sets..sets + 1, weights.as_ref(), range);
            // where a set has missed what the other has met, both tell
            for (square, of) in squares.iter_mut().zip(&second).filter(|(_, of)| of.packets > 0) {
                *square = 0.5 * (*square + of.square());
            }
            let by_spread = self.by_spread(tile, &squares);
            let mean = |(of, n): (&Statistics, &u32)| of.sums[0].map(|sum| sum / f64::from(8 * n));
            let second: Vec<_> = second.iter().zip(&packets).map(mean).collect();
            checks.judge(&mut pixels, &by_spread, &second, self.expected);
        }
        pixels
    }
    /// The pixels of a tile, from `rest`, the samples after those of the pilot.
    fn finish(&self, tile: Area, rest: &[Statistics], sets: u32) -> Vec<Pixel> {
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
    /// What each pixel of a tile tells of its variance, as [`Statistics::square`]. `rest` are the samples after those of the `pilot`, so many
    /// packets.
    fn squares(&self, tile: Area, rest: &[Statistics], pilot: u32) -> Vec<f64> {
        let of = |(pixel, rest): ([u32; 2], &Statistics)| {
            let [before, after] = [pilot, rest.packets].map(f64::from);
            (before * f64::from(self.squares[self.index(pixel)]) + after * rest.square()) / (before + after)
        };
        area::pixels(tile).zip(rest).map(of).collect()
    }
    /// The variance of one set of each pixel of a tile by the spread of its samples and of those of the pixels beside it, whose edges it may
    /// have missed, but for a common factor.
    fn by_spread(&self, tile: Area, squares: &[f64]) -> Vec<f64> {
        let around = mean_around(squares, &vec![1.0; squares.len()], (tile[2] - tile[0]) as usize);
        let both = |((own, around), pixel): ((f64, f64), [u32; 2])| {
            (own + BESIDE * around) * fall(self.packets_at(pixel).into())
        };
        squares.iter().copied().zip(around).zip(area::pixels(tile)).map(both).collect()
    }
}

/// Packets per set for each pixel, from the variance of the pilot; and the number of lights and their weights, if samples are allocated to
/// at most `APART` lights.
fn count_packets(parts: &[Statistics], width: u32, plan: &SamplePlan) -> (Vec<u32>, Option<(usize, Vec<f32>)>) {
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
    (share_out(&wanted, columns, plan), weights)
}

/// Packets per set for each pixel in proportion to what it `wants`, with the same mean for the pixels of each colour.
fn share_out(wanted: &[f64], columns: usize, plan: &SamplePlan) -> Vec<u32> {
    let most = (PART_OF_ALL * plan.packets * wanted.len() as f64).max(TIMES_MEAN * plan.packets);
    let mut packets = vec![0; wanted.len()];
    for colour in 0..COLOURS * COLOURS {
        let is_own = |i: &usize| i % columns % COLOURS + i / columns % COLOURS * COLOURS == colour;
        let own: Vec<usize> = (0..wanted.len()).filter(is_own).collect();
        let scaled = scaled(&own.iter().map(|&i| wanted[i]).collect::<Vec<_>>(), most, plan);
        for (n, i) in own.into_iter().enumerate() {
            packets[i] = match &scaled {
                Some(scaled) => rounded(i, scaled[n]),
                None => (plan.packets.round() as u32).max(plan.pilot),
            };
        }
    }
    packets
}

/// Packets of the pixels of a colour in proportion to what they want, at least those of the pilot and at `most` so many, so that their mean is
/// that of the plan. `None` where no pixel has variance, or more than numbers can tell.
fn scaled(wanted: &[f64], most: f64, plan: &SamplePlan) -> Option<Vec<f64>> {
    let (pilot, total) = (f64::from(plan.pilot), plan.packets * wanted.len() as f64);
    let greatest = wanted.iter().fold(0.0_f64, |m, &w| m.max(w));
    if greatest <= 0.0 || !greatest.is_finite() {
        return None;
    }
    let least = WANTED_LAST * greatest;
    let packets = |wanted: f64, scale: f64| (wanted.max(least) * scale).min(most).max(pilot);
    let spent = |scale: f64| wanted.iter().map(|&w| packets(w, scale)).sum::<f64>();
    let (mut low, mut high) = (0.0, total / greatest);
    while spent(high) < total {
        high *= 2.0;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if spent(middle) < total { low = middle } else { high = middle }
    }
    Some(wanted.iter().map(|&w| packets(w, low)).collect())
}

/// The samples of places of the same size relative to their mean, if they share samples as pixels do, by the variance that each would have if
/// they did not. `None` where no place has variance.
pub(super) fn shares(variances: &[f64], plan: &SamplePlan) -> Option<Vec<f64>> {
    let wanted: Vec<f64> = variances.iter().map(|&v| pow(v, POWER)).collect();
    let packets = scaled(&wanted, f64::INFINITY, plan)?;
    Some(packets.into_iter().map(|n| n / plan.packets).collect())
}

/// Rounds to a power of two, with which Sobol points are best: down or up at random, independently of the samples.
fn rounded(pixel: usize, packets: f64) -> u32 {
    let below = greatest_power(packets);
    let turn = (pixel as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 11;
    let up = (turn as f64 / (1_u64 << 53) as f64) < packets / below - 1.0;
    (if up { 2.0 * below } else { below }) as u32
}

/// The greatest power of two that is no more than a positive normal number.
fn greatest_power(x: f64) -> f64 {
    f64::from_bits(x.to_bits() >> 52 << 52)
}

/// Σ `sums` / Σ `counts` over the neighbours of each pixel that have other colours.
fn mean_around(sums: &[f64], counts: &[f64], columns: usize) -> Vec<f64> {
    let weighted = |values: &[f64]| {
        let (near, far) = (sums_around(values, columns, NEAR), sums_around(values, columns, OUTERMOST));
        near.into_iter().zip(far).map(|(near, far)| near + WEIGHT_OUTERMOST * far)
    };
    weighted(sums).zip(weighted(counts)).map(|(sum, count)| if count > 0.0 { sum / count } else { 0.0 }).collect()
}

/// Sums over the pixels up to `reach` rows and columns away from each pixel that have other colours. The value of a pixel of its colour is
/// never added and subtracted again, so that not even rounding depends on it.
fn sums_around(values: &[f64], columns: usize, reach: usize) -> Vec<f64> {
    let near = |i: usize, most: usize| i.saturating_sub(reach)..(i + reach + 1).min(most);
    let has_own = |i: usize, j: usize| i.abs_diff(j).is_multiple_of(COLOURS);
    // in each row, the sum of all values, and of those in columns of other colours
    let (mut all, mut others) = (Vec::with_capacity(values.len()), Vec::with_capacity(values.len()));
    for row in values.chunks(columns) {
        for x in 0..columns {
            let range = near(x, columns);
            all.push(row[range.clone()].iter().sum::<f64>());
            others.push(range.filter(|&other| !has_own(x, other)).map(|other| row[other]).sum::<f64>());
        }
    }
    let rows = values.len() / columns;
    let of_row = |x: usize, y: usize, row: usize| if has_own(y, row) { &others } else { &all }[row * columns + x];
    (0..values.len())
        .map(|i| near(i / columns, rows).map(|row| of_row(i % columns, i / columns, row)).sum::<f64>())
        .collect()
}

#[cfg(test)]
mod tests;
