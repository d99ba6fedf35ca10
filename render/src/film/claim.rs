//! What an image claims about its error.
//!
//! The error of samples falls with their number, and the variances of the pixels tell it. That of closed forms is the same in all samples,
//! so that no variance tells it: [`View::foreseen`](crate::View::foreseen) bounds it by the scene. The claim is the root of the sum of
//! both squares, since over random numbers the one has a mean of 0. Where a few samples of great worth decide, variances do not tell
//! either, as long as no sample has met what is bright: that is foreseen by the scene, too, and said.
//!
//! No claim can be made for images of which no sample has met what is bright, unless that is a light in view: for a lit spot behind a keyhole
//! that all samples miss, or a glint of a rough metal. Where one pixel has most of the error, an image claims its root mean square over
//! many images and calls it uncertain, since the error of that pixel itself scatters.

use super::pixels::Film;

/// What few samples meet, although the camera sees it: lights smaller than a pixel. A sample that meets one is worth its radiance, so the
/// variance that they cause is known in advance, also while no sample has met one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Specks {
    /// Σ a L², over lights of the area a in pixels. L² is the sum over channels of squared radiances.
    squares: f64,
    /// Σ a L⁴.
    fourths: f64,
    /// The number of lights.
    count: f64,
}

impl Specks {
    /// A light of this area in pixels, and the sum over channels of its squared radiances.
    #[must_use]
    pub fn new(area: f64, squared: f64) -> Self {
        Self { squares: area * squared, fourths: area * squared * squared, count: 1.0 }
    }
    /// These and others, each of which stands for `weight` lights.
    #[must_use]
    pub fn and(&self, others: &Self, weight: f64) -> Self {
        Self {
            squares: self.squares + weight * others.squares,
            fourths: self.fourths + weight * others.fourths,
            count: self.count + weight * others.count,
        }
    }
    /// The sum of the variances that they cause in the pixels and channels of an image with so many samples per pixel, unless enough
    /// samples meet them for the pixels' own variances to tell.
    fn missed(&self, spp: f64) -> f64 {
        // the number of samples that would tell their squares as precisely, if all were alike
        let met = spp * self.squares.powi(2) / self.fourths;
        if met < ENOUGH { self.squares / spp } else { 0.0 }
    }
}

/// What a scene tells of the error of its images, whatever their samples.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Foreseen {
    /// A bound of the RMS error that closed forms leave, over pixels and channels.
    pub systematic: f64,
    /// Lights that few samples meet.
    pub specks: Specks,
}

/// The estimated RMS error of an image over pixels and channels, relative to its mean.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Claim {
    /// What more samples make smaller: √(mean variance) / mean.
    pub random: f64,
    /// The same as far as it is due to lights in view that are smaller than a pixel, and which too few samples meet for the pixels to tell.
    pub missed: f64,
    /// The number of these lights; 0 if enough samples meet them.
    pub specks: f64,
    /// A bound of what they do not: the error of closed forms. 0 if there are none.
    pub systematic: f64,
    /// In about how many pixels the random error is: (Σv)² / Σv² over their variances v.
    pub pixels: f64,
    /// How many independent images, of about equal weight, tell these variances: 1, or that of the passes of an image of many.
    pub images: f64,
}

/// In fewer pixels, the variances of few sets of samples tell the random error less well.
const ENOUGH: f64 = 8.0;
/// The error of an image that is in few pixels is often much greater or less than its root mean square over many images. Where passes tell
/// that root, and so are sure of it, the claim grows by this power of the part of [`ENOUGH`] that these pixels are: by 2.3 for one. So 1.5
/// times the claim is 3.4 standard deviations of that pixel.
const FEW: f64 = 0.4;

impl Claim {
    /// The claim of an image with so many samples per pixel, with what was [foreseen](crate::View::foreseen). `None` if a variance is not
    /// known, or if the image is black.
    #[must_use]
    pub fn new(film: &Film, foreseen: &Foreseen, spp: u64) -> Option<Self> {
        let count = 3.0 * film.pixels.len() as f64;
        let (mut sum, mut squares) = (0.0, 0.0);
        for variance in film.pixels.iter().map(|p| p.variance.map(f64::from).iter().sum::<f64>()) {
            sum += variance;
            squares += variance * variance;
        }
        let mean = film.mean().iter().sum::<f64>() / 3.0;
        let pixels = if squares > 0.0 { sum * sum / squares } else { film.pixels.len() as f64 };
        let missed = foreseen.specks.missed(spp as f64);
        let claim = Self {
            random: (sum / count).sqrt() / mean,
            missed: (missed / count).sqrt() / mean,
            specks: if missed > 0.0 { foreseen.specks.count } else { 0.0 },
            systematic: foreseen.systematic / mean,
            pixels,
            images: 1.0,
        };
        (sum.is_finite() && mean > 0.0).then_some(claim)
    }
    /// The whole error.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.sampled().hypot(self.systematic)
    }
    /// The part of it that more samples make smaller.
    fn sampled(&self) -> f64 {
        let sampled = self.random.max(self.missed);
        if self.images > 1.0 { sampled * (ENOUGH / self.pixels.max(1.0)).powf(FEW).max(1.0) } else { sampled }
    }
    /// The claim if the variances are those of so many images of about equal weight, together.
    #[must_use]
    pub const fn of_images(self, images: f64) -> Self {
        Self { images, ..self }
    }
    /// Why the whole error is uncertain: because most of it is in too few pixels to be known from their variances, or because too few samples
    /// meet small lights in view.
    #[must_use]
    pub fn uncertain(&self) -> Option<String> {
        if self.sampled() <= self.systematic {
            None
        } else if 2.0 * self.missed > self.random {
            Some(format!("too few samples meet {:.0} lights in view that are smaller than a pixel", self.specks.ceil()))
        } else {
            (self.pixels * self.images.max(1.0) < ENOUGH).then(|| format!("it is in about {:.0} pixels", self.pixels))
        }
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
            "no number of samples reaches an error of {target:e}: approximations of `analytic` may cause one of {:.1e}; \
             `--technique solid-angle` has none",
            self.systematic
        ))
    }
    /// By what factor the squared random error is greater than it may be for a whole error of `target`: infinite if no number of samples
    /// suffices, and at most 1 if the target is reached.
    #[must_use]
    pub fn excess(&self, target: f64) -> f64 {
        let allowed = target.powi(2) - self.systematic.powi(2);
        if allowed > 0.0 { self.sampled().powi(2) / allowed } else { f64::INFINITY }
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
                Pixel { mean, variance, samples: 4, ..Pixel::default() },
                Pixel { mean: [2.0; 3], samples: 4, ..Pixel::default() },
            ],
        };
        let some = film([1.0, 2.0, 3.0], [0.06, 0.12, 0.06]);
        let expected = (0.24_f64 / 6.0).sqrt() / 2.0;
        let new =
            |film: &Film, systematic: f64| Claim::new(film, &Foreseen { systematic, specks: Specks::default() }, 4);
        let claim = new(&some, 0.0).unwrap();
        assert!((claim.random - expected).abs() < 1e-7 && claim.systematic == 0.0, "{claim:?}");
        assert_eq!(claim.total(), claim.random);
        assert_eq!(claim.of_images(2.0).total(), 8.0_f64.powf(FEW) * claim.random);
        assert!(claim.of_images(7.0).uncertain().is_some() && claim.of_images(9.0).uncertain().is_none());
        assert!((claim.pixels - 1.0).abs() < 1e-12 && claim.uncertain().is_some(), "{claim:?}");
        let even = Film { pixels: vec![some.pixels[0]; 20], ..some };
        let claim = new(&even, 0.0).unwrap();
        assert!((claim.pixels - 20.0).abs() < 1e-9 && claim.uncertain().is_none(), "{claim:?}");
        let claim = new(&some, 0.15).unwrap();
        assert!((claim.systematic - 0.075).abs() < 1e-12, "{claim:?}");
        assert!((claim.total() - expected.hypot(0.075)).abs() < 1e-7, "{claim:?}");
        assert_eq!(new(&film([1.0; 3], [f32::INFINITY; 3]), 0.0), None);
        assert_eq!(new(&film([-2.0; 3], [0.0; 3]), 0.0), None);
    }

    #[test]
    fn samples_lower_the_random_part_alone() {
        let claim = Claim { random: 4.0, systematic: 3.0, pixels: 8.0, ..Claim::default() };
        assert_eq!(claim.total(), 5.0);
        assert!(claim.check(3.001).is_ok());
        assert!(claim.check(3.0).unwrap_err().contains("may cause one of 3.0e0"));
        assert_eq!(claim.excess(5.0), 1.0);
        assert_eq!(claim.excess(3.0), f64::INFINITY);
        assert!((claim.excess(f64::sqrt(9.0 + 4.0)) - 4.0).abs() < 1e-12);
    }
    /// A light of a thousandth of a pixel is claimed although no sample has met it, until eight samples have.
    #[test]
    fn lights_that_no_sample_has_met_are_claimed() {
        let dim = Pixel { mean: [1.0; 3], variance: [1e-6; 3], samples: 64, ..Pixel::default() };
        let film = Film { width: 10, height: 10, pixels: vec![dim; 100] };
        let specks = Specks::new(0.001, 3.0 * 500.0_f64.powi(2));
        let claim = |spp: u64| Claim::new(&film, &Foreseen { systematic: 0.0, specks }, spp).unwrap();
        let expected = (0.001 * 500.0_f64.powi(2) / 64.0 / 100.0).sqrt();
        let few = claim(64);
        assert!((few.total() - expected).abs() < 1e-9 && few.specks == 1.0, "{few:?}");
        assert!(few.uncertain().unwrap().contains("meet 1 lights in view"));
        assert!(few.excess(0.1) > 1.0);
        let many = claim(8192);
        assert!(many.uncertain().is_none() && (many.total() - 1e-3).abs() < 1e-9, "{many:?}");
    }
}
