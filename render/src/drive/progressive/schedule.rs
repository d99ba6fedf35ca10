//! How many samples the next pass takes, so that the time or the error is what was asked for.
//!
//! One large pass has less error than several of as many samples together. So each pass is to fill the time that is left: with the sampler
//! `adaptive`, it decides its number of samples after its pilot, after an eighth of the tiles and after half of them, by how fast these were.

use crate::bvh::RayCount;
use crate::drive::view::Begun;
use crate::film::Film;
use crate::film::claim::Claim;
use crate::sampler::{FEWEST, Sampler};
use crate::scene::limits::MOST_SAMPLES;

/// When an image is finished: as soon as one of these is reached.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Goal {
    /// Seconds since the start of the first pass.
    pub seconds: Option<f64>,
    /// The relative RMS error, see [`Claim::total`].
    pub error: Option<f64>,
}

/// A pass that is finished.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pass {
    /// Samples per pixel.
    pub spp: u32,
    /// How its random numbers were generated.
    pub sampler: Sampler,
    /// Seed of its random numbers.
    pub seed: u64,
    /// Seconds that it took.
    pub seconds: f64,
}

/// The mean of the passes so far.
#[derive(Clone, Debug, PartialEq)]
pub struct Progress {
    /// The image.
    pub film: Film,
    /// Its estimated error; `None` if it is not known.
    pub error: Option<Claim>,
    /// Samples per pixel of the image, without those of passes of a part.
    pub spp: u64,
    /// The passes of the image, in order.
    pub passes: Vec<Pass>,
    /// Seconds from the start of the first pass to the end of the last.
    pub seconds: f64,
    /// Rays of all passes, also of those that are no part of the image.
    pub rays: RayCount,
}

/// A pass of nets takes the place of all before it if it has at least so many times their weight: they have a ninth at most.
const LEFT_OUT: f64 = 8.0;

/// Whether what is known, of this weight, is no part of the image any more after a pass of the weight `own`.
pub(super) fn is_left_out(weight: f64, own: f64, power: f64) -> bool {
    power > 1.0 && own >= LEFT_OUT * weight
}

/// Samples per pixel of the first pass, unless the time is given.
const FIRST: u32 = 16;
/// Unless the time is given, a pass has at most this many times the samples of the largest so far, so that its error can be predicted.
const GROWTH: u32 = 8;
/// The time of a sample relative to one of the pilot, at most. (Of ten scenes at 128 × 128, 0.4 in `studio` to 1.4 in `mirror-room`.)
const SLOWER: f64 = 1.4;
/// A pass of fewer samples than this fraction of the largest so far is not worth its time: it has less than 2 % of the weight.
const WORTH: f64 = 1.0 / 16.0;
/// The greatest number of passes after which an error is not known that seems to be reached, and stays unknown.
const PATIENCE: usize = 32;
/// The number of samples per pixel after which an error that is still uncertain is given up, if no time ends the rendering.
pub(super) const MOST_UNCERTAIN: u32 = 1 << 17;
/// A pass keeps its number of samples if it would change by less than this part: finding those of pixels takes time.
const ALIKE: f64 = 1.0 / 16.0;
/// The part of the remaining time that a pass may be predicted to take.
const SPARE: f64 = 0.93;

/// The seconds that a pass of n samples per pixel takes: `fixed` + n · `each`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Timing {
    fixed: f64,
    each: f64,
}

impl Timing {
    /// From a whole pass of `spp` samples; and from the samples of its pilot and their seconds, if it had one.
    pub(super) fn new(spp: u32, seconds: f64, (pilot, took): (u32, f64)) -> Self {
        let each = (seconds - took) / f64::from(spp.saturating_sub(pilot).max(1));
        Self { fixed: (seconds - f64::from(spp) * each).max(0.0), each }
    }
}

/// Decides what the next pass is.
#[derive(Clone, Debug)]
pub(super) struct Schedule {
    pub(super) goal: Goal,
    /// The exponent of the number of samples in the weight of a pass.
    pub(super) power: f64,
    /// The numbers of samples that a pass may have, in increasing order.
    pub(super) counts: Vec<u32>,
    /// The least of them with the sampler of large passes.
    pub(super) full: u32,
    /// That of the last pass with this sampler.
    pub(super) timing: Option<Timing>,
}

/// The greatest of increasing `counts` that is at most `n`; `None` if all are greater.
#[must_use]
pub fn at_most(counts: &[u32], n: f64) -> Option<u32> {
    counts.iter().copied().rfind(|&count| f64::from(count) <= n)
}

fn at_least(counts: &[u32], n: f64) -> Option<u32> {
    counts.iter().copied().find(|&count| f64::from(count) >= n)
}

impl Schedule {
    /// The numbers of samples that a pass after one of so many may have.
    pub(super) fn following(&self, spp: u32) -> &[u32] {
        let full = self.counts.partition_point(|&n| n < self.full);
        if spp < self.full { &self.counts } else { &self.counts[full..] }
    }

    /// The greatest number of samples of a pass, if the largest so far had so many and no time is given.
    pub(super) fn most_after(&self, largest: u32) -> f64 {
        f64::from(largest.saturating_mul(GROWTH).max(self.full))
    }

    /// The number of samples of the first pass. If the time is given, it only measures that, with as few as there can be.
    pub(super) fn first(&self) -> u32 {
        let most = if self.goal.seconds.is_some() { 0 } else { FIRST };
        at_most(&self.counts, most.into()).filter(|&n| n >= self.full).unwrap_or(self.counts[0])
    }

    /// The number of samples of the next pass, and the greatest to which it may grow in view of the error; `None` if the goal is reached, or cannot
    /// be approached in time. `weight` is that of the image.
    pub(super) fn next(&self, mean: &Progress, weight: f64, seconds: f64) -> Option<(u32, f64)> {
        let (largest, last) = (mean.passes.iter().map(|p| p.spp).max()?, mean.passes.last()?);
        let counts = self.following(last.spp);
        let wanted = self.wanted(mean, weight, largest)?;
        let Some(time) = self.goal.seconds else { return at_most(counts, wanted).map(|spp| (spp, wanted)) };
        let left = (time - seconds) * SPARE;
        let fits = match self.timing {
            Some(Timing { fixed, each }) => (left - fixed) / each,
            // a preview is up to three times slower, and up to twice faster: its pilot is a quarter of this
            None => left * f64::from(last.spp) / last.seconds,
        };
        let next = fits.min(wanted);
        if next < f64::from(largest) * WORTH {
            return None;
        }
        at_most(counts, next).map(|spp| (spp, wanted))
    }

    /// The samples per pixel in view of the error: infinite if none is asked for, `None` if it is reached.
    fn wanted(&self, mean: &Progress, weight: f64, largest: u32) -> Option<f64> {
        let Some(target) = self.goal.error else { return Some(f64::INFINITY) };
        let (claim, last) = (mean.error?, mean.passes.last()?);
        let excess = claim.excess(target);
        let is_uncertain = claim.uncertain().is_some();
        if excess <= 1.0 && (!is_uncertain || mean.passes.len() >= PATIENCE) {
            return None;
        }
        let mut most = self.most_after(largest);
        if is_uncertain && self.goal.seconds.is_none() {
            if mean.spp >= MOST_UNCERTAIN.into() {
                return None;
            }
            most = most.min(MOST_UNCERTAIN.into());
        }
        // the squared random error is c / Σ n^power; where it is uncertain, passes like the largest tell it
        let missing = weight * (excess - 1.0).max(0.0);
        // what is known is left out beside it
        let missing = if is_left_out(weight, missing, self.power) { weight * excess } else { missing };
        let least = if is_uncertain { largest } else { last.spp };
        let needed = at_least(self.following(last.spp), missing.powf(self.power.recip()).max(f64::from(least)));
        Some(needed.map_or(most, |needed| most.min(needed.into())))
    }

    /// How many samples a pass that was to have `spp` has in the end, at most `most`, if it has begun so. The pilot ended `pilot` seconds after
    /// the start of the pass, and it is `seconds` after that of the first.
    pub(super) fn grown(&self, (spp, most): (u32, f64), begun: Begun, [pilot, now, seconds]: [f64; 3]) -> u32 {
        let Some(time) = self.goal.seconds else { return spp };
        let Begun { pilot: samples, spp: of_tiles, part, samples: more, seconds: took } = begun;
        let left = (time - seconds) * SPARE;
        let fits = if more > 0.0 {
            // finding their numbers again takes less than half as long
            (left - 0.4 * (now - pilot - took)) / (1.0 - part).max(1e-3) * more / took
        } else if of_tiles > 0 {
            f64::from(of_tiles) - f64::from(samples)
        } else {
            let each = self.timing.map_or(SLOWER * pilot / f64::from(samples), |timing| timing.each);
            left / each
        };
        let fits = f64::from(samples) + fits.max(0.0);
        let is_first = self.timing.is_none() && (of_tiles == 0 || of_tiles == spp);
        // the least pilot would tell too little of many samples
        let stays = is_first && spp == self.full;
        let next = if stays { spp.into() } else { fits.min(most) };
        if of_tiles > 0 && (next / f64::from(of_tiles) - 1.0).abs() < ALIKE {
            return of_tiles;
        }
        // a whole number in each set
        let sets = self.full / FEWEST;
        (next.min(MOST_SAMPLES.into()) as u32 / sets * sets).max(self.full)
    }
}
