//! The variance of pixels of one set of samples.
//!
//! The samples of a set are not independent, so their spread does not tell the variance of their mean, and several sets have a greater error
//! than one with as many samples. So each pixel has one set, and some have a second one with as many samples, which is no part of the image.
//! The squared differences of both tell by what factor the variances differ from what the spread of the samples lets expect, in each tile.
//!
//! Pixels are chosen by their spread, with a known chance, and count by the inverse of that: the ratio estimator of surveys (Cochran 1977,
//! Sampling Techniques, chapters 6 and 9A). So the sum of the variances is right in the mean, whatever the spread.

use crate::area::{self, Area};
use crate::film::Pixel;
use crate::sampler::mixed;

/// The samples of second sets relative to all others.
const SHARE: f64 = 1.0 / 12.0;
/// About so many pixels have a second set in small images.
const FEWEST: f64 = 1024.0;
/// The least chance of a pixel, and how many pixels of a tile are chosen at the least.
const LEAST: f64 = 1.0 / 64.0;
const FEWEST_OF_TILE: f64 = 2.0;

/// The samples of second sets relative to those of an image of this size.
pub(super) fn share(whole: Area) -> f64 {
    (FEWEST / area::count(whole) as f64).clamp(SHARE, 1.0)
}

/// The pixels of a tile that have a second set.
pub(super) struct Checks {
    /// The chance with which a pixel was chosen; 0 for those that were not.
    chances: Vec<f64>,
    area: Area,
}

impl Checks {
    /// Chooses pixels by the variances `by_spread` of their sets and their numbers of samples, `packets`, so that second sets have this `share`
    /// of all samples.
    pub(super) fn new(area: Area, by_spread: &[f64], packets: &[u32], share: f64, seed: u64) -> Self {
        let pairs = || by_spread.iter().zip(packets);
        // the sum of all variances is known best if chances are proportional to the variance over the root of the cost
        let wanted: Vec<f64> = pairs().map(|(variance, n)| variance / f64::from(*n).sqrt()).collect();
        let least = LEAST.max(FEWEST_OF_TILE / by_spread.len() as f64).min(1.0);
        let chance = |wanted: f64, scale: f64| (wanted * scale).clamp(least, 1.0);
        let spent =
            |scale: f64| wanted.iter().zip(packets).map(|(w, n)| chance(*w, scale) * f64::from(*n)).sum::<f64>();
        let allowed = share * packets.iter().copied().map(f64::from).sum::<f64>();
        let most = wanted.iter().fold(0.0_f64, |most, &x| most.max(x));
        let mut chances = vec![share.max(least); wanted.len()];
        if most > 0.0 && most.is_finite() {
            let (mut low, mut high) = (0.0, most.recip());
            while spent(high) < allowed && high < 1e30 / most {
                high *= 2.0;
            }
            for _ in 0..40 {
                let middle = 0.5 * (low + high);
                if spent(middle) < allowed { low = middle } else { high = middle }
            }
            chances = wanted.iter().map(|&wanted| chance(wanted, low)).collect();
        }
        // systematic sampling: a pixel at each step of 1 in the sum of chances
        let [x, y, ..] = area;
        let bits = mixed(seed ^ mixed(u64::from(y) << 32 | u64::from(x)));
        let mut next = (bits >> 11) as f64 / (1_u64 << 53) as f64;
        let mut sum = 0.0;
        for chance in &mut chances {
            sum += *chance;
            if sum > next {
                next += 1.0;
            } else {
                *chance = 0.0;
            }
        }
        Self { chances, area }
    }
    /// Whether a pixel has a second set.
    pub(super) fn contains(&self, [x, y]: [u32; 2]) -> bool {
        let [x0, y0, x1, _] = self.area;
        self.chances[((y - y0) * (x1 - x0) + (x - x0)) as usize] > 0.0
    }
    /// Sets the variances of the pixels of the tile from what `by_spread` lets expect, and from the means of second sets.
    pub(super) fn judge(&self, pixels: &mut [Pixel], by_spread: &[f64], second: &[[f64; 3]]) {
        let (mut count, mut expected, mut found) = (0.0, 0.0, [0.0; 3]);
        for (i, chance) in self.chances.iter().enumerate().filter(|(_, chance)| **chance > 0.0) {
            count += chance.recip();
            expected += by_spread[i] / chance;
            for (k, found) in found.iter_mut().enumerate() {
                // a difference has twice the variance of each
                *found += (f64::from(pixels[i].mean[k]) - second[i][k]).powi(2) / (2.0 * chance);
            }
        }
        for (pixel, by_spread) in pixels.iter_mut().zip(by_spread) {
            // where nothing is expected, the variance is taken to be the same everywhere
            let of_set = if expected > 0.0 { by_spread / expected } else { f64::recip(count) };
            pixel.variance = found.map(|found| (found * of_set) as f32);
        }
    }
}
