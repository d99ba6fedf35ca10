//! What an image claims about its error.
//!
//! The error of samples falls with their number, and the variances of the pixels tell it. That of closed forms is the same in all samples,
//! so that no variance tells it: [`View::systematic`](crate::View::systematic) bounds it by the scene. The claim is the root of the sum of
//! both squares, since over random numbers the one has a mean of 0.

use crate::film::Film;

/// The estimated RMS error of an image over pixels and channels, relative to its mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Claim {
    /// What more samples make smaller: √(mean variance) / mean.
    pub random: f64,
    /// A bound of what they do not: the error of closed forms. 0 if there are none.
    pub systematic: f64,
    /// In about how many pixels the random error is: (Σv)² / Σv² over their variances v.
    pub pixels: f64,
}

/// In fewer pixels, the variances of few sets of samples tell the random error less well: `etendue selftest --claims` measures it.
const ENOUGH: f64 = 8.0;

impl Claim {
    /// The claim of an image whose closed forms have at most this error (see [`View::systematic`](crate::View::systematic)). `None` if
    /// a variance is not known, or if the image is black.
    #[must_use]
    pub fn new(film: &Film, systematic: f64) -> Option<Self> {
        let count = 3.0 * film.pixels.len() as f64;
        let (mut sum, mut squares) = (0.0, 0.0);
        for variance in film.pixels.iter().map(|p| p.variance.map(f64::from).iter().sum::<f64>()) {
            sum += variance;
            squares += variance * variance;
        }
        let mean = film.mean().iter().sum::<f64>() / 3.0;
        let pixels = if squares > 0.0 { sum * sum / squares } else { film.pixels.len() as f64 };
        let claim = Self { random: (sum / count).sqrt() / mean, systematic: systematic / mean, pixels };
        (sum.is_finite() && mean > 0.0).then_some(claim)
    }
    /// The whole error.
    #[must_use]
    pub fn total(&self) -> f64 {
        (self.random.powi(2) + self.systematic.powi(2)).sqrt()
    }
    /// Whether the random error is in too few pixels to be known from their variances, and more than the systematic one.
    #[must_use]
    pub fn is_vague(&self) -> bool {
        self.pixels < ENOUGH && self.random > self.systematic
    }
    /// Checks that enough samples lower the whole error to `target`.
    ///
    /// # Errors
    /// Fails if the systematic part alone is as much.
    pub fn check(&self, target: f64) -> Result<(), String> {
        if self.systematic < target {
            return Ok(());
        }
        Err(format!(
            "no number of samples reaches an error of {target:e}: closed forms may have one of {:.1e}. Sampled lights have none, as with \
             `--technique solid-angle`",
            self.systematic
        ))
    }
    /// By what factor the squared random error is greater than it may be for a whole error of `target`: infinite if no number of samples
    /// suffices, and at most 1 if the target is reached.
    #[must_use]
    pub fn excess(&self, target: f64) -> f64 {
        let allowed = target.powi(2) - self.systematic.powi(2);
        if allowed > 0.0 { self.random.powi(2) / allowed } else { f64::INFINITY }
    }
}

/// Why the error of an image is not known. `has_sets` says whether each pixel has more than one set of samples.
#[must_use]
pub fn why_unknown(film: &Film, has_sets: bool) -> String {
    let is_finite = |values: &[f32; 3]| values.iter().all(|x| x.is_finite());
    let pixel = |i: usize| format!("pixel ({}, {})", i % film.width as usize, i / film.width as usize);
    if let Some(i) = film.pixels.iter().position(|p| !is_finite(&p.mean)) {
        return format!("{} is not finite: {TOO_BRIGHT}", pixel(i));
    }
    if !has_sets {
        return "a pixel is a single set of samples".to_owned();
    }
    match film.pixels.iter().position(|p| !is_finite(&p.variance)) {
        Some(i) => format!(
            "the variance of {}, whose mean is {:?}, is not finite: {TOO_BRIGHT}",
            pixel(i),
            film.pixels[i].mean
        ),
        None => "the image is black".to_owned(),
    }
}

const TOO_BRIGHT: &str = "a light is too bright or too near for single-precision numbers, which end at 3.4e38";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::Pixel;

    #[test]
    fn the_error_is_that_of_the_variances_and_of_closed_forms() {
        let film = |mean: [f32; 3], variance: [f32; 3]| Film {
            width: 2,
            height: 1,
            pixels: vec![
                Pixel { mean, variance, samples: 4 },
                Pixel { mean: [2.0; 3], variance: [0.0; 3], samples: 4 },
            ],
        };
        let some = film([1.0, 2.0, 3.0], [0.06, 0.12, 0.06]);
        let expected = (0.24_f64 / 6.0).sqrt() / 2.0;
        let claim = Claim::new(&some, 0.0).unwrap();
        assert!((claim.random - expected).abs() < 1e-7 && claim.systematic == 0.0, "{claim:?}");
        assert_eq!(claim.total(), claim.random);
        assert!((claim.pixels - 1.0).abs() < 1e-12 && claim.is_vague(), "{claim:?}");
        let even = Film { pixels: vec![some.pixels[0]; 20], ..some };
        let claim = Claim::new(&even, 0.0).unwrap();
        assert!((claim.pixels - 20.0).abs() < 1e-9 && !claim.is_vague(), "{claim:?}");
        let claim = Claim::new(&some, 0.15).unwrap();
        assert!((claim.systematic - 0.075).abs() < 1e-12, "{claim:?}");
        assert!((claim.total() - expected.hypot(0.075)).abs() < 1e-7, "{claim:?}");
        assert_eq!(Claim::new(&film([1.0; 3], [f32::INFINITY; 3]), 0.0), None);
        assert_eq!(Claim::new(&film([-2.0; 3], [0.0; 3]), 0.0), None);
    }

    #[test]
    fn samples_lower_the_random_part_alone() {
        let claim = Claim { random: 4.0, systematic: 3.0, pixels: 1.0 };
        assert_eq!(claim.total(), 5.0);
        assert!(claim.check(3.001).is_ok());
        assert!(claim.check(3.0).unwrap_err().contains("may have one of 3.0e0"));
        assert_eq!(claim.excess(5.0), 1.0);
        assert_eq!(claim.excess(3.0), f64::INFINITY);
        assert!((claim.excess(f64::sqrt(9.0 + 4.0)) - 4.0).abs() < 1e-12);
    }
}
