//! The difference of two images, and whether their variance accounts for it.

use crate::image::Picture;
use serde_json::{Value, json};

/// The difference image − reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Mean squared difference over pixels and channels.
    pub mse: f64,
    /// Mean difference per channel.
    pub mean: [f64; 3],
    /// The difference of largest magnitude, its pixel (column, row) and its channel (0 to 2).
    pub largest: (f64, [usize; 2], usize),
    /// Mean of the reference over pixels and channels.
    pub reference_mean: f64,
    /// Greatest value of the reference over pixels and channels: the peak of [`Comparison::psnr`].
    pub peak: f64,
    /// What the variances predict; `None` if the image or the reference has no finite variance.
    pub predicted: Option<Prediction>,
    /// Why nothing is predicted; empty if it is.
    pub unknown: &'static str,
}

/// The difference expected of two images that estimate the same values.
#[derive(Clone, Debug, PartialEq)]
pub struct Prediction {
    /// Expected mean squared difference: the mean variance of the image plus that of the reference.
    pub mse: f64,
    /// Mean difference per channel, in standard deviations.
    pub z: [f64; 3],
    /// `mse − predicted mse` in standard deviations, which come from the spread over pixels, and from what the variances of a tile have in
    /// common. A large value of either sign is a fault: the variance layer claims too much precision, or too little.
    pub z_mse: f64,
    /// The same from the spread over pixels alone: right if the variance of each pixel comes from sets of its own.
    pub z_pixels: f64,
}

/// Whether two images estimate the same values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// All values are equal.
    Identical,
    /// The difference is what the variances predict.
    Agree,
    /// The difference is greater than the variances explain.
    Differ,
    /// The images do not tell.
    Unknown,
}

/// Images differ if a |z| is at least this. Two images of the same values do so with a probability of 3e−5: 6.8e−6 for each of the
/// four z.
pub const LIMIT: f64 = 4.5;

/// Images whose values differ by at most this fraction of the peak are equal up to the rounding of f32.
const ROUNDING: f64 = 1e-6;

/// Side of the squares of pixels whose variances are known together, in images of one set per pixel: those that a thread renders at a time.
const TILE: usize = 16;
/// About the relative standard error of the sum of these variances.
const TOGETHER: f64 = 0.5;
/// The part of the predicted squared difference that is too little for images of independent numbers.
const MUCH_LESS: f64 = 0.6;

const CHANNELS: [&str; 3] = ["R", "G", "B"];

impl Comparison {
    /// Compares two pictures of one size. `reference_error` is the mean squared standard error of the reference, used if it has
    /// no finite variance of its own. A reference without a variance layer is exact if `reference_error` is 0.
    ///
    /// # Errors
    /// Fails if the sizes differ or a radiance is not finite.
    pub fn new(reference: &Picture, image: &Picture, reference_error: f64) -> Result<Self, String> {
        if (reference.width, reference.height) != (image.width, image.height) {
            return Err(format!(
                "the reference is {}x{} pixels, the image {}x{}",
                reference.width, reference.height, image.width, image.height
            ));
        }
        for (name, picture) in [("reference", reference), ("image", image)] {
            if let Some(i) = picture.radiance.iter().position(|p| p.iter().any(|x| !x.is_finite())) {
                let (x, y, p) = (i % picture.width, i / picture.width, picture.radiance[i]);
                return Err(format!("pixel ({x}, {y}) of the {name} is not finite: {p:?}"));
            }
        }
        let count = image.radiance.len() as f64;
        let difference = |i: usize, k: usize| f64::from(image.radiance[i][k]) - f64::from(reference.radiance[i][k]);
        let mut mean = [0.0; 3];
        let mut squared = 0.0;
        let mut largest = (0.0_f64, 0, 0);
        for i in 0..image.radiance.len() {
            for (k, sum) in mean.iter_mut().enumerate() {
                let d = difference(i, k);
                *sum += d / count;
                squared += d * d;
                if d.abs() > largest.0.abs() {
                    largest = (d, i, k);
                }
            }
        }
        let mse = squared / (3.0 * count);
        let at = [largest.1 % image.width, largest.1 / image.width];
        let values = || reference.radiance.iter().flatten().map(|&x| f64::from(x));
        let finite = |picture: &Picture| {
            picture.variance.clone().filter(|v| v.iter().flatten().all(|x| x.is_finite() && *x >= 0.0))
        };
        let (image_variance, reference_variance) = (finite(image), finite(reference));
        // a reference without a layer of variance is exact, but one that does not know its variance is not
        let is_judged = reference_variance.is_some() || reference.variance.is_none() || reference_error > 0.0;
        let unknown = match (&image_variance, is_judged) {
            (Some(_), true) => "",
            (Some(_), false) => "the reference has no variance",
            (None, _) if reference_variance.is_some() => "the image has no variance",
            (None, _) => "neither image has a variance",
        };
        let predicted = image_variance.filter(|_| is_judged).map(|variance| {
            let own = |i: usize, k: usize| f64::from(variance[i][k]);
            let other =
                |i: usize, k: usize| reference_variance.as_ref().map_or(reference_error, |v| f64::from(v[i][k]));
            let total = |k: usize| (0..variance.len()).map(|i| own(i, k) + other(i, k)).sum::<f64>();
            let totals = [total(0), total(1), total(2)];
            // the channels of a pixel share their samples, and the pixels of a tile what is known of their variance
            let excess =
                |i: usize| (0..3).map(|k| difference(i, k).powi(2) - own(i, k) - other(i, k)).sum::<f64>() / 3.0;
            let bias = (0..variance.len()).map(excess).sum::<f64>() / count;
            let of_pixels = (0..variance.len()).map(|i| (excess(i) - bias).powi(2)).sum::<f64>();
            let mut tiles = vec![0.0; image.width.div_ceil(TILE) * image.height.div_ceil(TILE)];
            for i in 0..variance.len() {
                let [x, y] = [i % image.width / TILE, i / image.width / TILE];
                tiles[y * image.width.div_ceil(TILE) + x] += (0..3).map(|k| own(i, k)).sum::<f64>() / 3.0;
            }
            let of_tiles = tiles.iter().map(|sum| (TOGETHER * sum).powi(2)).sum::<f64>();
            let of_pixels = of_pixels * count / (count - 1.0).max(1.0);
            Prediction {
                mse: totals.iter().sum::<f64>() / (3.0 * count),
                z: std::array::from_fn(|k| ratio(mean[k], totals[k].sqrt() / count)),
                z_mse: ratio(bias, (of_pixels + of_tiles).sqrt() / count),
                z_pixels: ratio(bias, of_pixels.sqrt() / count),
            }
        });
        Ok(Self {
            mse,
            mean,
            largest: (largest.0, at, largest.2),
            reference_mean: values().sum::<f64>() / (3.0 * count),
            peak: values().fold(0.0, f64::max),
            predicted,
            unknown,
        })
    }

    /// The relative RMS error: √mse over the mean of the reference. `None` if the reference is black.
    #[must_use]
    pub fn relative_rms(&self) -> Option<f64> {
        (self.reference_mean > 0.0).then(|| self.mse.sqrt() / self.reference_mean)
    }

    /// The peak signal-to-noise ratio in dB, 10 log₁₀(peak² / mse), where the peak is the greatest value of the reference. `None` if
    /// it is infinite or the reference is black.
    #[must_use]
    pub fn psnr(&self) -> Option<f64> {
        (self.mse > 0.0 && self.peak > 0.0).then(|| 10.0 * (self.peak * self.peak / self.mse).log10())
    }

    /// Whether the pixels differ by so much less than the variances predict that the images seem to share their random numbers, as
    /// images of one seed do. (Otherwise, a variance is too large.)
    #[must_use]
    pub fn shares_noise(&self) -> bool {
        let is_less = |p: &Prediction| p.z_pixels <= -LIMIT && self.mse < MUCH_LESS * p.mse;
        self.largest.0 != 0.0 && self.predicted.as_ref().is_some_and(is_less)
    }

    /// Whether the images agree, and why.
    #[must_use]
    pub fn verdict(&self) -> (Verdict, String) {
        if self.largest.0 == 0.0 {
            return (Verdict::Identical, "all values are equal".into());
        }
        if self.largest.0.abs() <= self.peak * ROUNDING {
            return (Verdict::Agree, "the values are equal up to rounding".into());
        }
        let Some(p) = &self.predicted else {
            return (Verdict::Unknown, self.unknown.into());
        };
        let (k, z) = (0..3).map(|k| (k, p.z[k])).max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())).unwrap_or((0, 0.0));
        if z.abs() >= LIMIT {
            let channel = CHANNELS[k];
            return (Verdict::Differ, format!("the means of {channel} are {:.1} standard deviations apart", z.abs()));
        }
        if p.z_mse >= LIMIT {
            let what = "the pixels differ by more than the variances predict";
            return (Verdict::Differ, format!("{what}, by {:.1} standard deviations", p.z_mse));
        }
        if self.shares_noise() {
            return (Verdict::Unknown, "the images seem to share their random numbers".into());
        }
        (Verdict::Agree, format!("all |z| are less than {LIMIT}"))
    }

    /// The comparison as a JSON object.
    pub fn to_json(&self) -> Value {
        let (value, pixel, channel) = self.largest;
        let (verdict, reason) = self.verdict();
        let p = self.predicted.as_ref();
        json!({
            "mse": self.mse,
            "relative_rms": self.relative_rms(),
            "psnr": self.psnr(),
            "peak": self.peak,
            "mean_difference": self.mean,
            "largest": { "difference": value, "pixel": pixel, "channel": CHANNELS[channel] },
            "predicted_mse": p.map(|p| p.mse),
            "mse_over_predicted": p.and_then(|p| (p.mse > 0.0).then(|| self.mse / p.mse)),
            "z_mse": p.map(|p| p.z_mse),
            "z": p.map(|p| p.z),
            "verdict": verdict.name(),
            "reason": reason,
        })
    }
}

impl Verdict {
    /// The verdict in words.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Identical => "identical",
            Self::Agree => "agree",
            Self::Differ => "differ",
            Self::Unknown => "not known",
        }
    }
}

/// The quotient, or 0 if the difference is 0: equal images without variance agree.
fn ratio(difference: f64, deviation: f64) -> f64 {
    if difference == 0.0 { 0.0 } else { difference / deviation }
}

impl std::fmt::Display for Comparison {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (value, [x, y], channel) = self.largest;
        let [r, g, b] = self.mean;
        writeln!(f, "mse                {:.6e}", self.mse)?;
        match self.relative_rms() {
            Some(error) => writeln!(f, "relative RMS error {:.4} % of the reference's mean", 100.0 * error)?,
            None => {
                writeln!(f, "relative RMS error not known, because the mean of the reference is not greater than 0")?
            }
        }
        match self.psnr() {
            Some(psnr) => writeln!(f, "PSNR               {psnr:.2} dB at a peak of {:.6}", self.peak)?,
            None if self.mse == 0.0 => writeln!(f, "PSNR               infinite")?,
            None => writeln!(f, "PSNR               not known, because no value of the reference is greater than 0")?,
        }
        writeln!(f, "mean difference    {r:+.6e} {g:+.6e} {b:+.6e}")?;
        writeln!(f, "largest difference {value:+.6e} in {} at pixel ({x}, {y})", CHANNELS[channel])?;
        match &self.predicted {
            Some(p) => {
                let [r, g, b] = p.z;
                writeln!(
                    f,
                    "predicted mse      {:.6e} (measured/predicted {:.4}, z {:+.2})",
                    p.mse,
                    if p.mse > 0.0 { self.mse / p.mse } else { f64::NAN },
                    p.z_mse
                )?;
                writeln!(f, "z of the mean      {r:+.2} {g:+.2} {b:+.2}")?;
            }
            None => writeln!(
                f,
                "z                  not known, because {}; an image has one if its pixels consist of two or more sets, and \
                 --reference-error gives that of the reference",
                self.unknown
            )?,
        }
        let (verdict, reason) = self.verdict();
        write!(f, "verdict            {}: {reason}", verdict.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A black reference, and an image of 64 tiles whose pixels have a variance of 1 and claim that times a factor of their tile.
    fn compared(factor: impl Fn(usize) -> f32) -> (Verdict, Prediction) {
        let side = 8 * TILE;
        let mut state = 1_u32;
        let mut sign = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            if state >> 31 == 0 { 1.0 } else { -1.0 }
        };
        // squares of 0 or 2
        let radiance = (0..side * side).map(|_| [(1.0 + sign()) * 0.5_f32.sqrt() * sign(); 3]).collect();
        let tile = |i: usize| i / side / TILE * 8 + i % side / TILE;
        let variance = Some((0..side * side).map(|i| [factor(tile(i)); 3]).collect());
        let image = Picture { width: side, height: side, radiance, variance };
        let reference = Picture { radiance: vec![[0.0; 3]; side * side], variance: None, ..image.clone() };
        let comparison = Comparison::new(&reference, &image, 0.0).unwrap();
        (comparison.verdict().0, comparison.predicted.unwrap())
    }

    /// Tiles may err in common, whether their mean errs little or not; if all of them err alike, the images differ.
    #[test]
    fn variances_of_a_tile_have_an_error_in_common() {
        let (verdict, prediction) = compared(|tile| if tile % 8 < 5 { 0.6 } else { 1.4 });
        assert!(verdict == Verdict::Agree && prediction.z_pixels > LIMIT, "{prediction:?}");
        assert_eq!(compared(|_| 1.0).0, Verdict::Agree);
        assert_eq!(compared(|_| 0.5).0, Verdict::Differ);
        assert!(compared(|_| 2.5).1.z_mse < -LIMIT);
    }
}
