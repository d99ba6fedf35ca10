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
    /// What the variances predict; `None` if the image has no finite variance.
    pub predicted: Option<Prediction>,
}

/// The difference expected of two images that estimate the same values.
#[derive(Clone, Debug, PartialEq)]
pub struct Prediction {
    /// Expected mean squared difference: the mean variance of the image plus that of the reference.
    pub mse: f64,
    /// Mean difference per channel, in standard deviations.
    pub z: [f64; 3],
    /// `mse − predicted mse` in standard deviations, which come from the spread over pixels. A large value of either sign is a
    /// fault: the variance layer claims too much precision, or too little.
    pub z_mse: f64,
}

impl Comparison {
    /// Compares two pictures of one size. `reference_error` is the mean squared standard error of the reference, used if it has
    /// no variance of its own.
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
        let predicted = image.variance.as_ref().filter(|v| v.iter().flatten().all(|x| x.is_finite())).map(|variance| {
            let own = |i: usize, k: usize| f64::from(variance[i][k]);
            let other =
                |i: usize, k: usize| reference.variance.as_ref().map_or(reference_error, |v| f64::from(v[i][k]));
            let total = |k: usize| (0..variance.len()).map(|i| own(i, k) + other(i, k)).sum::<f64>();
            let totals = [total(0), total(1), total(2)];
            // the channels of a pixel share their samples, so only pixels are independent
            let excess =
                |i: usize| (0..3).map(|k| difference(i, k).powi(2) - own(i, k) - other(i, k)).sum::<f64>() / 3.0;
            let bias = (0..variance.len()).map(excess).sum::<f64>() / count;
            let spread = (0..variance.len()).map(|i| (excess(i) - bias).powi(2)).sum::<f64>() / (count - 1.0).max(1.0);
            Prediction {
                mse: totals.iter().sum::<f64>() / (3.0 * count),
                z: std::array::from_fn(|k| ratio(mean[k], totals[k].sqrt() / count)),
                z_mse: ratio(bias, (spread / count).sqrt()),
            }
        });
        Ok(Self { mse, mean, largest: (largest.0, at, largest.2), predicted })
    }

    /// The comparison as a JSON object.
    pub fn to_json(&self) -> Value {
        let (value, pixel, channel) = self.largest;
        let mut object = json!({
            "mse": self.mse,
            "mean_difference": self.mean,
            "largest": { "difference": value, "pixel": pixel, "channel": (["R", "G", "B"][channel]) },
        });
        if let Some(p) = &self.predicted {
            object["predicted_mse"] = json!(p.mse);
            object["mse_over_predicted"] = json!(self.mse / p.mse);
            object["z_mse"] = json!(p.z_mse);
            object["z"] = json!(p.z);
        }
        object
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
        writeln!(f, "mean difference    {r:+.6e} {g:+.6e} {b:+.6e}")?;
        writeln!(f, "largest difference {value:+.6e} in {} at pixel ({x}, {y})", ["R", "G", "B"][channel])?;
        match &self.predicted {
            Some(p) => {
                let [r, g, b] = p.z;
                writeln!(
                    f,
                    "predicted mse      {:.6e} (measured/predicted {:.4}, z {:+.2})",
                    p.mse,
                    self.mse / p.mse,
                    p.z_mse
                )?;
                write!(f, "z of the mean      {r:+.2} {g:+.2} {b:+.2}")
            }
            None => write!(f, "the image has no variance, so the difference cannot be judged"),
        }
    }
}
