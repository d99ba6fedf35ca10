//! The difference of two images, and whether their variance accounts for it.

use super::image::Picture;
use crate::scene::area;
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
    /// Least mean squared difference of images with these variances, whatever random numbers they share: it is that of images whose
    /// noise differs in nothing but its size.
    pub least: f64,
}

/// A number for each pixel, by its index, and channel.
type ByChannel<'a> = dyn Fn(usize, usize) -> f64 + 'a;

impl Prediction {
    /// From the differences of two images of this size, their `mean` per channel, and the variances of both images.
    fn new(
        [width, height]: [usize; 2],
        mean: [f64; 3],
        difference: &ByChannel<'_>,
        own: &ByChannel<'_>,
        other: &ByChannel<'_>,
    ) -> Self {
        let (pixels, count) = (width * height, (width * height) as f64);
        let sum = |of: &ByChannel<'_>| [0, 1, 2].map(|k| (0..pixels).map(|i| of(i, k)).sum());
        let [owns, others]: [[f64; 3]; 2] = [sum(own), sum(other)];
        let totals: [f64; 3] = std::array::from_fn(|k| owns[k] + others[k]);
        let [deviation, other_deviation] = [owns, others].map(|sums| sums.iter().sum::<f64>().sqrt());
        // the channels of a pixel share their samples, and the pixels of a tile what is known of their variance
        let excess = |i: usize| (0..3).map(|k| difference(i, k).powi(2) - own(i, k) - other(i, k)).sum::<f64>() / 3.0;
        let bias = (0..pixels).map(excess).sum::<f64>() / count;
        let of_pixels = (0..pixels).map(|i| (excess(i) - bias).powi(2)).sum::<f64>();
        let mut tiles = vec![0.0; width.div_ceil(TILE) * height.div_ceil(TILE)];
        for i in 0..pixels {
            let [x, y] = [i % width / TILE, i / width / TILE];
            tiles[y * width.div_ceil(TILE) + x] += (0..3).map(|k| own(i, k)).sum::<f64>() / 3.0;
        }
        let of_tiles = tiles.iter().map(|sum| (TOGETHER * sum).powi(2)).sum::<f64>();
        let of_pixels = of_pixels * count / (count - 1.0).max(1.0);
        Self {
            mse: totals.iter().sum::<f64>() / (3.0 * count),
            z: std::array::from_fn(|k| ratio(mean[k], totals[k].sqrt() / count)),
            z_mse: ratio(bias, (of_pixels + of_tiles).sqrt() / count),
            z_pixels: ratio(bias, of_pixels.sqrt() / count),
            least: (deviation - other_deviation).powi(2) / (3.0 * count),
        }
    }
    /// Whether the difference is what the variances predict.
    #[must_use]
    pub fn agrees(&self) -> bool {
        !self.z.iter().chain([&self.z_mse]).any(|z| differs(*z))
    }
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

/// What a z may be: |z| is as great with a probability of 6.8e−6. So two images of the same values, which have four z, differ with a
/// probability of 3e−5, and a thousand numbers by chance with one of 0.7 %; who compares more of them compares again what differs.
pub const LIMIT: f64 = 4.5;

/// Whether a difference in standard deviations is too great for chance, or unknown: the one judge of images, scenes and tests.
#[must_use]
pub fn differs(z: f64) -> bool {
    z.is_nan() || z.abs() >= LIMIT
}

/// Images whose values differ by at most this fraction of the peak are equal up to the rounding of f32.
const ROUNDING: f64 = 1e-6;

/// Side of the squares of pixels whose variances are known together, in images of one set per pixel.
const TILE: usize = area::TILE as usize;
/// About the relative standard error of the sum of these variances.
const TOGETHER: f64 = 0.5;
/// Images of independent numbers differ by more than this part of the predicted squared difference, unless a variance is wrong.
const MUCH_LESS: f64 = 0.6;

/// Checks that two images can be compared.
pub(super) fn check(reference: &Picture, image: &Picture) -> Result<(), String> {
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
    Ok(())
}

/// The variances of an image, if they are known for all pixels.
pub(super) fn known_variance(picture: &Picture) -> Option<&[[f32; 3]]> {
    let is_known = |v: &&[[f32; 3]]| v.iter().flatten().all(|x| x.is_finite() && *x >= 0.0);
    picture.variance.as_deref().filter(is_known)
}

const CHANNELS: [&str; 3] = ["R", "G", "B"];

impl Comparison {
    /// Compares two pictures of one size. `reference_error` is the mean squared standard error of the reference, used if it has
    /// no finite variance of its own. A reference without a variance layer is exact if `reference_error` is 0.
    ///
    /// # Errors
    /// Fails if the sizes differ or a radiance is not finite.
    pub fn new(reference: &Picture, image: &Picture, reference_error: f64) -> Result<Self, String> {
        check(reference, image)?;
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
        let at = [largest.1 % image.width, largest.1 / image.width];
        let values = || reference.radiance.iter().flatten().map(|&x| f64::from(x));
        let (image_variance, reference_variance) = (known_variance(image), known_variance(reference));
        // a reference without a layer of variance is exact, but one that does not know its variance is not
        let is_judged = reference_variance.is_some() || reference.variance.is_none() || reference_error > 0.0;
        let unknown = match (image_variance, is_judged) {
            (Some(_), true) => "",
            (Some(_), false) => "the reference has no variance",
            (None, _) if reference_variance.is_some() => "the image has no variance",
            (None, _) => "neither image has a variance",
        };
        let predicted = image_variance.filter(|_| is_judged).map(|variance| {
            let own = |i: usize, k: usize| f64::from(variance[i][k]);
            let other = |i: usize, k: usize| reference_variance.map_or(reference_error, |v| f64::from(v[i][k]));
            Prediction::new([image.width, image.height], mean, &difference, &own, &other)
        });
        Ok(Self {
            mse: squared / (3.0 * count),
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
    /// images of one seed do: they may, unless even then they would differ by more.
    #[must_use]
    pub fn shares_noise(&self) -> bool {
        let is_less = |p: &Prediction| p.z_pixels <= -LIMIT && (p.least..p.mse).contains(&(self.mse / MUCH_LESS));
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
        if differs(z) {
            let channel = CHANNELS[k];
            return (Verdict::Differ, format!("the means of {channel} are {:.1} standard deviations apart", z.abs()));
        }
        if self.shares_noise() {
            return (
                Verdict::Unknown,
                "the images seem to share their random numbers, or a variance is too large".into(),
            );
        }
        if differs(p.z_mse) {
            let than = if p.z_mse < 0.0 { "less" } else { "more" };
            let what = format!("the pixels differ by {than} than the variances predict");
            return (Verdict::Differ, format!("{what}, by {:.1} standard deviations", p.z_mse.abs()));
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

    /// A black reference that claims a variance, and an image of 64 tiles whose pixels have a variance of 1 and claim that times a factor
    /// of their tile.
    fn compared(error: f64, factor: impl Fn(usize) -> f32) -> (Verdict, Prediction) {
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
        let image = Picture { width: side, height: side, radiance, variance, second: None };
        let reference = Picture { radiance: vec![[0.0; 3]; side * side], variance: None, ..image.clone() };
        let comparison = Comparison::new(&reference, &image, error).unwrap();
        (comparison.verdict().0, comparison.predicted.unwrap())
    }

    /// Tiles may err in common, whether their mean errs little or not; if all of them err alike, the images differ.
    #[test]
    fn variances_of_a_tile_have_an_error_in_common() {
        let (verdict, prediction) = compared(0.0, |tile| if tile % 8 < 5 { 0.6 } else { 1.4 });
        assert!(verdict == Verdict::Agree && prediction.z_pixels > LIMIT, "{prediction:?}");
        assert_eq!(compared(0.0, |_| 1.0).0, Verdict::Agree);
    }

    /// Images that claim too small an error, or too large a one, do not agree: not even if it is less than twice too large, which no
    /// shared random numbers explain. No random numbers are shared with an exact reference.
    #[test]
    fn variances_are_wrong_in_either_direction() {
        for factor in [0.4, 0.65, 1.5, 2.5, 30.0] {
            let (verdict, prediction) = compared(0.0, |_| factor);
            assert_eq!(verdict, Verdict::Differ, "{factor}: {prediction:?}");
            assert!(
                differs(prediction.z_mse) && (prediction.z_mse < 0.0) == (factor > 1.0),
                "{factor}: {prediction:?}"
            );
        }
        let (verdict, prediction) = compared(1.0, |_| 1.5);
        assert!(verdict == Verdict::Unknown && prediction.least < 0.1, "{prediction:?}");
    }
}
