//! How many samples each pixel takes: a few of a pilot everywhere, and the rest where the variance around a pixel is great.
//!
//! What the camera sees directly, lights and the sky, has a number of its own: where their outlines are most of the variance, further rays look
//! at them without sampling lights. A pixel is the sum of two means, of n samples of what surfaces reflect, and of m ≥ n of what is seen directly.
//!
//! The pilot's samples are part of the image, and yet its mean is that of the light, exactly:
//! 1. A pixel has one of nine colours, (column mod 3, row mod 3). Samples of different pixels are independent.
//! 2. The counts of the pixels of a colour, and their weights of lights, are a function of the pilot of the other eight colours alone: so are
//!    the means around these pixels, and the scale that makes the counts of this colour its share of all samples, which is fixed.
//! 3. Given the pilot of the other colours, the counts n and m of a pixel are thus constants, and its samples are what they were without a pilot.
//! 4. The mean of the first n samples of a pixel has the light as its expectation, for each constant n: each part of it, as well.
//! 5. So it has it for the counts that are found, too. (With one scale for all pixels, a bright speck that its own pixel's pilot met would
//!    give the samples to the others, and one that it missed to its own: means were up to half too great.)

use super::light_weights::{APART, LightWeights};
use super::pixel_statistics::{Statistics, fall};
use super::second_sets::{self, Checks};
use super::tile::TileRenderer;
use crate::film::Pixel;
use crate::film::sums::Moments;
use crate::scene::area::{self, Area};
use crate::settings::{Settings, tiles};
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

/// The least number of packets per set: eight samples are a pilot alone, so an eighth is added, which goes where the variance is. (At 128 × 128,
/// that takes about a tenth more time, and the squared error of 8 samples is less by 1.8 in `terrain` to 73 in `cornell-box`.)
const LEAST: f64 = 9.0 / 8.0;

/// The time of a sample that only looks, relative to that of one that samples lights, too: 0.1 to 0.3 in meshes under many lamps, 0.5 to 1 where
/// closed forms need no shadow rays. (64 samples, efficiency with 0.12, 0.25 and 0.5: dunes 2.32, 2.00, 1.79; `studio` 1.87, 2.34, 2.43;
/// `cornell-box` 0.84, 0.95, 1.08.)
const LOOK: f64 = 0.4;

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
        let packets = (f64::from(spp) / (8.0 * f64::from(sets) * (1.0 + checks))).max(LEAST);
        // the greatest power of two up to a quarter, but 2 packets if there are 4 or more: eight points miss too much
        let pilot = greatest_power(packets / 4.0).max(if packets < 4.0 { 1.0 } else { 2.0 });
        Self { sets, pilot: pilot as u32, packets, checks }
    }
    /// The same with a pilot of so many packets, if that is more, but no more than a third of all: what follows it goes where the variance is.
    pub(super) fn with_pilot(self, packets: u32) -> Self {
        let fits = 3.0 * f64::from(packets) <= self.packets;
        if fits { self.after_pilot(packets.max(self.pilot)) } else { self }
    }
    /// The same after a pilot of so many packets.
    pub(super) fn after_pilot(self, pilot: u32) -> Self {
        Self { pilot, ..self }
    }
}

/// How many samples each pixel of a rectangle receives after the pilot, and what the pilot found.
pub(super) struct PixelCounts<'a> {
    /// The pixels [x0, y0, x1, y1).
    pub(super) area: Area,
    pilot: &'a [Statistics],
    /// What each pixel [wants](wanted).
    wanted: Vec<[f64; 2]>,
    /// Packets of each pixel in each set, with those of the pilot.
    packets: Vec<u32>,
    /// The same with those that only see what the camera sees directly.
    looks: Vec<u32>,
    /// Number of lights among which the samples are shared by weight; 0 if they are not.
    lights: usize,
    /// The weight of each light at each pixel.
    weights: Vec<f32>,
    /// What the pilot tells of the variance of each pixel: that of a set of n samples is about proportional to this and to n^−1.5.
    /// (Of what the camera sees directly that is the second number, which tells of the number of looks.)
    squares: Vec<[f32; 2]>,
    /// Samples per set of each light in the pilot.
    begun: Vec<[u32; APART]>,
    /// The sum of the variances of all pixels of the image, as the pilot tells them, but for a common factor.
    expected: f64,
}

impl<'a> PixelCounts<'a> {
    /// From the pilot of an area, whose pixels share its samples. For the image, that is the whole.
    ///
    /// # Panics
    /// Panics if the pilot is not one of the area's size.
    pub(super) fn new(settings: &Settings, area: Area, pilot: &'a [Statistics]) -> Self {
        assert_eq!(pilot.len(), area::count(area));
        let (wanted, weights) = all_wanted(pilot, area[2] - area[0]);
        let (lights, of) = weights.unwrap_or_default();
        let counts = Self {
            area,
            expected: 0.0,
            wanted,
            packets: Vec::new(),
            looks: Vec::new(),
            lights,
            weights: of,
            squares: pilot.iter().map(|p| [p.square() as f32, p.outline.square() as f32]).collect(),
            begun: pilot.iter().map(|pixel| pixel.taken).collect(),
            pilot,
        };
        counts.shared(settings)
    }
    /// From the same pilot, for other settings.
    pub(super) fn shared(self, settings: &Settings) -> Self {
        let plan = SamplePlan::new(settings).after_pilot(self.pilot[0].packets.max(1));
        let [packets, looks] = share_out(&self.wanted, (self.area[2] - self.area[0]) as usize, &plan);
        let counts = packets.iter().zip(&looks).map(|(packets, looks)| [*packets, *looks]);
        let of_pixel = |(squares, counts): (&[f32; 2], [u32; 2])| expected(squares.map(f64::from), counts);
        let expected = (1.0 + BESIDE) * self.squares.iter().zip(counts).map(of_pixel).sum::<f64>();
        Self { expected, packets, looks, ..self }
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
    /// The time that a tile takes after the pilot, in that of a packet in each set: half a packet in each pixel, besides what its counts say.
    pub(super) fn time(&self, tile: Area) -> f64 {
        let of_pixel = |pixel| {
            let [samples, looks] = self.counts_at(pixel).map(f64::from);
            0.5 + samples - f64::from(self.pilot[0].packets) + LOOK * (looks - samples)
        };
        area::pixels(tile).map(of_pixel).sum()
    }
    /// The part of that time that some tiles take.
    pub(super) fn part(&self, is_some: &dyn Fn(Area) -> bool) -> f64 {
        let sum = |is: &dyn Fn(Area) -> bool| tiles(self.area).filter(|&t| is(t)).map(|t| self.time(t)).sum::<f64>();
        sum(is_some) / sum(&|_| true)
    }
    /// Packets of a pixel in each set, with those of the pilot; and with those that only look.
    fn counts_at(&self, pixel: [u32; 2]) -> [u32; 2] {
        let index = self.index(pixel);
        [self.packets[index], self.looks[index]]
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
        let rest = renderer.parts(tile, pilot, 0..sets, weights, |pixel| [pilot, self.counts_at(pixel)[0]]);
        let looks = renderer.looks(tile, 0..sets, |pixel| self.counts_at(pixel));
        let mut pixels = self.finish(tile, [&rest, &looks], sets);
        if checks > 0.0 {
            let mut squares = self.squares(tile, [&rest, &looks], pilot);
            let by_spread = self.by_spread(tile, &squares);
            let packets: Vec<u32> = area::pixels(tile).map(|pixel| self.counts_at(pixel)[0]).collect();
            let checks = Checks::new(tile, &by_spread, &packets, checks, renderer.settings.seed);
            // their first samples are allocated by the pilot, too, which makes little difference
            let weights = weights.map(LightWeights::anew);
            let of = |pixel, counts: [u32; 2]| if checks.contains(pixel) { counts } else { [0; 2] };
            let range = |pixel| of(pixel, [0, self.counts_at(pixel)[0]]);
            let second = renderer.parts(tile, pilot, sets..sets + 1, weights.as_ref(), range);
            let looks = renderer.looks(tile, sets..sets + 1, |pixel| of(pixel, self.counts_at(pixel)));
            // where a set has missed what the other has met, both tell
            for ((squares, of), looks) in
                squares.iter_mut().zip(&second).zip(&looks).filter(|((_, of), _)| of.packets > 0)
            {
                *squares = [0.5 * (squares[0] + of.square()), 0.5 * (squares[1] + both_outlines(&[of, looks]))];
            }
            let by_spread = self.by_spread(tile, &squares);
            let none = [[0.0; 3]; 4];
            let mean = |((pixel, of), looks): (([u32; 2], &Statistics), &Statistics)| {
                set_sum([&none, &none], [of, looks], self.counts_at(pixel), 0)
                    .map(|sum| sum / f64::from(8 * self.counts_at(pixel)[0]))
            };
            let second: Vec<_> = area::pixels(tile).zip(&second).zip(&looks).map(mean).collect();
            checks.judge(&mut pixels, &by_spread, &second, self.expected);
        }
        pixels
    }
    /// The pixels of a tile, from the samples after those of the pilot, and those that only look.
    fn finish(&self, tile: Area, [rest, looks]: [&[Statistics]; 2], sets: u32) -> Vec<Pixel> {
        let of = |((pixel, rest), looks): (([u32; 2], &Statistics), &Statistics)| {
            let index = self.index(pixel);
            let (counts, pilot) = (self.counts_at(pixel), [&self.pilot[index].sums, &self.pilot[index].seen]);
            let set = |set: usize| {
                let sum = set_sum(pilot, [rest, looks], counts, set);
                (8 * counts[0], Moments { sum, ..Moments::default() })
            };
            Pixel::of_sets((0..sets as usize).map(set), false)
        };
        area::pixels(tile).zip(rest).zip(looks).map(of).collect()
    }
    /// What each pixel of a tile tells of its variance, as [`Statistics::square`], and what its outlines do. `rest` are the samples after
    /// those of the `pilot`, so many packets, and `looks` those that only look.
    fn squares(&self, tile: Area, [rest, looks]: [&[Statistics]; 2], pilot: u32) -> Vec<[f64; 2]> {
        let of = |((pixel, rest), looks): (([u32; 2], &Statistics), &Statistics)| {
            let [before, after, last] = [pilot, rest.packets, looks.packets].map(f64::from);
            let [own, outline] = self.squares[self.index(pixel)].map(f64::from);
            let (own, all) = (before * own + after * rest.square(), before + after);
            let outline = before * outline + after * rest.outline.square() + last * looks.outline.square();
            [own / all, outline / (all + last)]
        };
        area::pixels(tile).zip(rest).zip(looks).map(of).collect()
    }
    /// The variance of one set of each pixel of a tile by the spread of its samples and of those of the pixels beside it, whose edges it may
    /// have missed, but for a common factor.
    fn by_spread(&self, tile: Area, squares: &[[f64; 2]]) -> Vec<f64> {
        let width = (tile[2] - tile[0]) as usize;
        let around = [0, 1].map(|k| {
            let squares: Vec<f64> = squares.iter().map(|squares| squares[k]).collect();
            mean_around(&squares, None, width)
        });
        let both = |(i, pixel): (usize, [u32; 2])| {
            let squares = [0, 1].map(|k| squares[i][k] + BESIDE * around[k][i]);
            expected(squares, self.counts_at(pixel))
        };
        area::pixels(tile).enumerate().map(both).collect()
    }
}

/// The variance that the [squares](Statistics::square) of a pixel let expect of a set, but for a common factor: of its samples, and of what the
/// camera sees directly.
fn expected(squares: [f64; 2], counts: [u32; 2]) -> f64 {
    squares[0] * fall(counts[0].into()) + squares[1] * fall(counts[1].into())
}

/// The [square](Outline::square) of outlines by several ranges of samples.
fn both_outlines(of: &[&Statistics]) -> f64 {
    let packets: u32 = of.iter().map(|of| of.packets).sum();
    of.iter().map(|of| f64::from(of.packets) * of.outline.square()).sum::<f64>() / f64::from(packets)
}

/// The sum of a set of a pixel: of the pilot and what the camera sees in it directly, the samples after it, and those that only look, by which
/// the mean of the latter is replaced.
fn set_sum(pilot: [&[[f64; 3]; 4]; 2], [rest, looks]: [&Statistics; 2], counts: [u32; 2], set: usize) -> [f64; 3] {
    let share = f64::from(counts[0]) / f64::from(counts[1]);
    std::array::from_fn(|k| {
        let sum = pilot[0][set][k] + rest.sums[set][k];
        if looks.packets == 0 {
            return sum;
        }
        let seen = pilot[1][set][k] + rest.seen[set][k];
        sum - seen + (seen + looks.seen[set][k]) * share
    })
}

/// The number of lights to which samples are allocated, and the weight of each at each pixel.
type Shared = (usize, Vec<f32>);

/// What each pixel [wants](wanted) by the variance of the pilot; and the number of lights and their weights, if samples are allocated to at most
/// `APART` lights.
fn all_wanted(parts: &[Statistics], width: u32) -> (Vec<[f64; 2]>, Option<Shared>) {
    let (columns, lights) = (width as usize, parts[0].lights);
    let around = |of: &dyn Fn(&Statistics) -> f64| {
        let values: Vec<_> = parts.iter().map(of).collect();
        // most images have no outlines
        if values.iter().all(|&v| v == 0.0) { values } else { mean_around(&values, None, columns) }
    };
    let mut weights = None;
    let own: Vec<f64> = if lights == 0 {
        around(&|part| part.variance)
    } else {
        // the error of each light falls with its own samples: the least Σ cᵢ nᵢ^−1.5 over the lights is (Σ cᵢ^0.4)^2.5 n^−1.5
        let mut of = vec![0.0; parts.len() * lights];
        // where all light is known, no light has pairs
        for k in (0..lights).filter(|&k| parts.iter().any(|part| part.pairs[k] != 0)) {
            let spread: Vec<_> = parts.iter().map(|part| f64::from(part.spread[k])).collect();
            let pairs: Vec<_> = parts.iter().map(|part| f64::from(part.pairs[k])).collect();
            for (of, mean) in of.chunks_mut(lights).zip(mean_around(&spread, Some(&pairs), columns)) {
                of[k] = pow(mean, POWER) as f32;
            }
        }
        // the error of what is known falls with all samples
        let reflected = of.chunks(lights).map(|each| each.iter().map(|&w| f64::from(w)).sum::<f64>());
        let both = |(w, known): (f64, f64)| pow(w, 1.0 / POWER) + known;
        let sums = reflected.zip(around(&|part| 16.0 * part.variance)).map(both).collect();
        weights = Some((lights, of));
        sums
    };
    let scale = if lights == 0 { 1.0 } else { 16.0 };
    let outlines = around(&|part| scale * part.outline.variance);
    (own.into_iter().zip(outlines).map(|(own, outlines)| wanted(own, outlines)).collect(), weights)
}

/// The numbers of samples, and of these and those that only look, in proportion, for which the squared error is least for a given time: `own`
/// falls with the former, and `outlines` with the latter.
fn wanted(own: f64, outlines: f64) -> [f64; 2] {
    // Σ c n^−1.5 is least for a given Σ t n with n ∝ (c/t)^0.4: a sample that does more than look takes the rest of the time
    let apart = [own / (1.0 - LOOK), outlines / LOOK];
    if apart[0] < apart[1] { apart.map(|c| pow(c, POWER)) } else { [pow(own + outlines, POWER); 2] }
}

/// Packets per set for each pixel in proportion to what it `wants`, with the same time for the pixels of each colour.
fn share_out(wanted: &[[f64; 2]], columns: usize, plan: &SamplePlan) -> [Vec<u32>; 2] {
    let most = (PART_OF_ALL * plan.packets * wanted.len() as f64).max(TIMES_MEAN * plan.packets);
    let mut packets = [0; 2].map(|_: u32| vec![0; wanted.len()]);
    for colour in 0..COLOURS * COLOURS {
        let is_own = |i: &usize| i % columns % COLOURS + i / columns % COLOURS * COLOURS == colour;
        let own: Vec<usize> = (0..wanted.len()).filter(is_own).collect();
        let scaled = scaled(&own.iter().map(|&i| wanted[i]).collect::<Vec<_>>(), most, plan);
        for (n, i) in own.into_iter().enumerate() {
            let [samples, looks] = match &scaled {
                Some(scaled) => {
                    let [samples, looks] = scaled[n];
                    // drawn apart
                    [rounded(i, samples), rounded(if looks > samples { i + wanted.len() } else { i }, looks)]
                }
                None => [(plan.packets.round() as u32).max(plan.pilot); 2],
            };
            (packets[0][i], packets[1][i]) = (samples, looks.max(samples));
        }
    }
    packets
}

/// Packets of the pixels of a colour in proportion to what they want, at least those of the pilot and at `most` so many, so that the mean of
/// their time is that of the plan. `None` where no pixel has variance, or more than numbers can tell.
fn scaled(wanted: &[[f64; 2]], most: f64, plan: &SamplePlan) -> Option<Vec<[f64; 2]>> {
    let (pilot, total) = (f64::from(plan.pilot), plan.packets * wanted.len() as f64);
    let greatest = wanted.iter().fold(0.0_f64, |m, [a, b]| m.max(*a).max(*b));
    if greatest <= 0.0 || !greatest.is_finite() {
        return None;
    }
    let least = WANTED_LAST * greatest;
    let packets = |wanted: [f64; 2], scale: f64| wanted.map(|wanted| (wanted.max(least) * scale).min(most).max(pilot));
    // a look takes its part of the time of a sample
    let time = |[samples, looks]: [f64; 2]| samples + (looks - samples) * LOOK;
    let spent = |scale: f64| wanted.iter().map(|&w| time(packets(w, scale))).sum::<f64>();
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
    let wanted: Vec<[f64; 2]> = variances.iter().map(|&v| [pow(v, POWER); 2]).collect();
    let packets = scaled(&wanted, f64::INFINITY, plan)?;
    Some(packets.into_iter().map(|[samples, _]| samples / plan.packets).collect())
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

/// Σ `sums` / Σ `counts` over the neighbours of each pixel that have other colours; without counts, each counts 1.
fn mean_around(sums: &[f64], counts: Option<&[f64]>, columns: usize) -> Vec<f64> {
    let weighted = |around: &dyn Fn(usize) -> Vec<f64>| {
        around(NEAR).into_iter().zip(around(OUTERMOST)).map(|(near, far)| near + WEIGHT_OUTERMOST * far).collect()
    };
    let (sums, counts): (Vec<f64>, Vec<f64>) = (
        weighted(&|reach| sums_around(sums, columns, reach)),
        weighted(&|reach| match counts {
            Some(counts) => sums_around(counts, columns, reach),
            None => numbers_around(sums.len(), columns, reach),
        }),
    );
    sums.into_iter().zip(counts).map(|(sum, count)| if count > 0.0 { sum / count } else { 0.0 }).collect()
}

/// The pixels up to `reach` away from one of so many, in one dimension.
fn near(i: usize, reach: usize, most: usize) -> std::ops::Range<usize> {
    i.saturating_sub(reach)..(i + reach + 1).min(most)
}

fn has_own(i: usize, j: usize) -> bool {
    i.abs_diff(j).is_multiple_of(COLOURS)
}

/// How many pixels up to `reach` rows and columns away from each of `count` pixels have other colours: [`sums_around`] of ones.
fn numbers_around(count: usize, columns: usize, reach: usize) -> Vec<f64> {
    // all and those of its own, in one dimension
    let line = |most: usize| -> Vec<[usize; 2]> {
        let of = |i| [near(i, reach, most).len(), near(i, reach, most).filter(|&j| has_own(i, j)).count()];
        (0..most).map(of).collect()
    };
    let [across, down] = [columns, count / columns].map(line);
    let of = |i: usize| [across[i % columns], down[i / columns]];
    (0..count).map(of).map(|[[x, own], [y, of_own]]| (x * y - own * of_own) as f64).collect()
}

/// Sums over the pixels up to `reach` rows and columns away from each pixel that have other colours. The value of a pixel of its colour is
/// never added and subtracted again, so that not even rounding depends on it.
fn sums_around(values: &[f64], columns: usize, reach: usize) -> Vec<f64> {
    // in each row, the sum of all values, and of those in columns of other colours
    let (mut all, mut others) = (Vec::with_capacity(values.len()), Vec::with_capacity(values.len()));
    for row in values.chunks(columns) {
        for x in 0..columns {
            let range = near(x, reach, columns);
            all.push(row[range.clone()].iter().sum::<f64>());
            others.push(range.filter(|&other| !has_own(x, other)).map(|other| row[other]).sum::<f64>());
        }
    }
    let rows = values.len() / columns;
    let of_row = |x: usize, y: usize, row: usize| if has_own(y, row) { &others } else { &all }[row * columns + x];
    (0..values.len())
        .map(|i| near(i / columns, reach, rows).map(|row| of_row(i % columns, i / columns, row)).sum::<f64>())
        .collect()
}

#[cfg(test)]
mod tests;
