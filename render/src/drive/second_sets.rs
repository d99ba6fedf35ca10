//! The variance of pixels of one set of samples.
//!
//! The samples of a set are not independent, so their spread does not tell the variance of their mean, and several sets have a greater error
//! than one with as many samples. So each pixel has one set, and some have a second one with as many samples, which is no part of the image.
//! The squared differences of both tell by what factor the variances differ from what the spread of the samples lets expect, in each tile.
//!
//! Pixels are chosen by their spread, with a known chance, and count by the inverse of that: the ratio estimator of surveys (Cochran 1977,
//! Sampling Techniques, chapters 6 and 9A). So the sum of the variances is right in the mean, but for a bias that falls with the number of
//! pixels that are chosen in a tile.

use crate::film::{Pixel, Second};
use crate::sampler::hash64;
use crate::scene::area::{self, Area};

/// The least and the greatest samples of second sets relative to all others.
const SHARES: [f64; 2] = [1.0 / 48.0, 1.0 / 4.0];
/// About so many pixels have a second set, between these: their differences tell the error of the image to a 23rd if they matter alike.
const ENOUGH: f64 = 512.0;
/// The least chance of a pixel, relative to the share of second sets: what is met in spite of it counts many times. And how many pixels of a
/// tile are chosen at the least.
const LEAST: f64 = 1.0 / 2.0;
const FEWEST_OF_TILE: f64 = 2.0;
/// What the variance of a pixel with most of the variance of the image is at the least, relative to what its spread lets expect: half of
/// what it is where the outline of something bright in the pixel causes it. With a share s of the variance, it is s² times this.
const FLOOR: f64 = 0.1;

/// The samples of second sets relative to those of an image of this size.
pub(super) fn share(whole: Area) -> f64 {
    (ENOUGH / area::count(whole) as f64).clamp(SHARES[0], SHARES[1])
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
        let least = (LEAST * share).max(FEWEST_OF_TILE / by_spread.len() as f64).min(1.0);
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
        let bits = hash64(seed ^ hash64(u64::from(y) << 32 | u64::from(x)));
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
    /// Sets the variances of the pixels of the tile from what `by_spread` lets expect, and from the means of second sets, which it stores. Of the whole image,
    /// the sum `of_all` of the former is known.
    pub(super) fn judge(&self, pixels: &mut [Pixel], by_spread: &[f64], second: &[[f64; 3]], of_all: f64) {
        let (mut count, mut expected, mut found, mut cubes) = (0.0, 0.0, [0.0; 3], 0.0);
        for (i, chance) in self.chances.iter().enumerate().filter(|(_, chance)| **chance > 0.0) {
            count += chance.recip();
            let own = by_spread[i] / chance;
            expected += own;
            cubes += own.powi(3);
            for (k, found) in found.iter_mut().enumerate() {
                // a difference has twice the variance of each
                *found += (f64::from(pixels[i].mean[k]) - second[i][k]).powi(2) / (2.0 * chance);
            }
        }
        // a single difference is often much less than its mean: the spread tells the least variance where few pixels have most of it
        let all: f64 = found.iter().sum();
        let floor = if expected > 0.0 { FLOOR * cubes / of_all.max(expected).powi(2) } else { 0.0 };
        if all < floor {
            found = found.map(|found| if all > 0.0 { found * (floor / all) } else { floor / 3.0 });
        }
        for ((pixel, chance), second) in
            pixels.iter_mut().zip(&self.chances).zip(second).filter(|((_, c), _)| **c > 0.0)
        {
            pixel.second = Second { mean: second.map(|x| x as f32), weight: chance.recip() as f32 };
        }
        for (pixel, by_spread) in pixels.iter_mut().zip(by_spread) {
            // where nothing is expected, the variance is taken to be the same everywhere
            let of_set = if expected > 0.0 { by_spread / expected } else { f64::recip(count) };
            pixel.variance = found.map(|found| (found * of_set) as f32);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TILE: Area = [16, 32, 32, 48];

    /// Numbers in [0, 1) by index.
    fn random(index: u64) -> f64 {
        (hash64(index.wrapping_mul(0x9e37_79b9_7f4a_7c15)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Second sets have their share of the samples, in any tile, and pixels of greater variance are chosen more often.
    #[test]
    fn pixels_are_chosen_by_their_spread() {
        let packets: Vec<u32> = (0..256).map(|i| 1 << (i % 4)).collect();
        let by_spread: Vec<f64> = (0..256).map(|i| if i < 64 { 1.0 } else { 0.02 }).collect();
        let (mut spent, mut chosen) = (0.0, [0.0; 2]);
        for seed in 0..400 {
            let checks = Checks::new(TILE, &by_spread, &packets, 0.125, seed);
            for (i, pixel) in area::pixels(TILE).enumerate().filter(|(_, pixel)| checks.contains(*pixel)) {
                assert!(pixel[0] >= 16 && pixel[1] >= 32);
                spent += f64::from(packets[i]);
                chosen[usize::from(i >= 64)] += 1.0;
            }
        }
        let all = packets.iter().copied().map(f64::from).sum::<f64>() * 400.0;
        assert!((spent / all - 0.125).abs() < 0.004, "{}", spent / all);
        assert!(chosen[0] / 64.0 > 5.0 * chosen[1] / 192.0, "{chosen:?}");
        // nothing is known: a share of them; a narrow tile: two at the least
        let even = |area: Area, share| {
            let count = area::count(area);
            let checks = Checks::new(area, &vec![0.0; count], &vec![4; count], share, 3);
            area::pixels(area).filter(|pixel| checks.contains(*pixel)).count()
        };
        assert!((31..=33).contains(&even(TILE, 0.125)), "{}", even(TILE, 0.125));
        assert!((1..=3).contains(&even([0, 0, 1, 16], 0.01)));
        assert_eq!([even([0, 0, 1, 1], 0.1), even(TILE, 1.0)], [1, 256]);
    }

    /// Where a pixel has most of the variance of the image, and its two sets agree by chance, its spread still tells a variance; with a part
    /// of the variance of the image, it tells nothing.
    #[test]
    fn claims_do_not_collapse() {
        let by_spread: Vec<f64> = (0..256).map(|i| if i == 70 { 5.0 } else { 1e-6 }).collect();
        let pixel = Pixel { mean: [1.0, 2.0, 3.0], samples: 8, ..Pixel::default() };
        for (difference, of_all, least) in
            [(0.0, 5.0, FLOOR * 5.0), (1e-3, 5.0, FLOOR * 5.0), (0.0, 50.0, FLOOR * 0.05)]
        {
            let mut pixels = vec![pixel; 256];
            let second: Vec<_> = pixels.iter().map(|p| p.mean.map(|x| f64::from(x) + difference)).collect();
            let checks = Checks::new(TILE, &by_spread, &[2; 256], 0.1, 7);
            checks.judge(&mut pixels, &by_spread, &second, of_all);
            let found: f64 = pixels.iter().flat_map(|pixel| pixel.variance).map(f64::from).sum();
            assert!(found >= 0.99 * least && found < 1.1 * least, "{difference}: {found}");
            assert!(pixels[70].variance[1] > 1e3 * pixels[0].variance[1], "{difference}");
        }
    }

    /// The sum of the variances is right in the mean, whether the spread knows them or not, and all of them where it does.
    #[test]
    fn variances_are_right_in_the_mean() {
        let truth: Vec<f64> = (0..256).map(|i| if i % 16 == 3 { 9.0 } else { 0.25 + random(i) }).collect();
        let unrelated: Vec<f64> = (0..256).map(|i| 0.2 + random(1000 + i)).collect();
        let known: Vec<f64> = truth.iter().map(|x| 7.0 * x).collect();
        for by_spread in [&known, &unrelated, &vec![0.0; 256]] {
            let (seeds, mut sums) = (4000, vec![0.0; 256]);
            for seed in 0..seeds {
                // of two values ±σ, differences are 0 or 2σ, each half of the time
                let value = |i: usize, set: u64| {
                    let sign = if random(seed << 20 | set << 10 | i as u64) < 0.5 { 1.0 } else { -1.0 };
                    (sign * truth[i].sqrt()) as f32
                };
                let pixel = |i| Pixel { mean: [value(i, 1), 0.0, 2.0 * value(i, 1)], samples: 8, ..Pixel::default() };
                let mut pixels: Vec<Pixel> = (0..256).map(pixel).collect();
                let second: Vec<[f64; 3]> =
                    (0..256).map(|i| [value(i, 2), 0.0, 2.0 * value(i, 2)].map(f64::from)).collect();
                Checks::new(TILE, by_spread, &[2; 256], 0.25, seed).judge(
                    &mut pixels,
                    by_spread,
                    &second,
                    f64::INFINITY,
                );
                for (sum, pixel) in sums.iter_mut().zip(&pixels) {
                    assert!(pixel.variance[1] == 0.0 && (pixel.variance[2] - 4.0 * pixel.variance[0]).abs() < 1e-4);
                    *sum += f64::from(pixel.variance[0]) / seeds as f64;
                }
            }
            let ratio = sums.iter().sum::<f64>() / truth.iter().sum::<f64>();
            assert!((ratio - 1.0).abs() < 0.02, "{ratio}");
            if std::ptr::eq(by_spread, &known) {
                let worst = sums.iter().zip(&truth).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max);
                assert!(worst < 0.02, "{worst}");
            }
        }
    }
}
