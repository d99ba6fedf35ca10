//! The error of an image that any filter has made of a rendered one, as second sets tell it.
//!
//! I is the mean of a pixel, T the light, and G what the filter made of the pixel. [`Second`](super::Second) is a mean S of as many samples
//! again, which neither I nor G depends on. So E[(G − I)(G + I − 2S)] = (G − T)² − (I − T)², whatever G is: a bias counts like noise. With the
//! inverse chances w of the pixels that have second sets as weights, and with the variances v of the image,
//!
//! Σ(G − T)² ≈ Σv + Σw(G − I)(G + I − 2S) + β(Σ(G − I)² − Σw(G − I)²).
//!
//! The first sum tells Σ(I − T)²; for one image, it is that of w(I − S)²/2. The last term has an expectation of 0, for any β. It is the
//! regression estimator of surveys (Cochran 1977, Sampling Techniques, chapter 7): where a bias is all of G − I, β = 1 removes the chance in
//! which pixels are chosen; where G = T, β = −1 is best. β is that of least squares, between these, in each half of
//! the rows from the other half.

use super::compare::{check, known_variance};
use super::image::Picture;
use serde_json::{Value, json};

/// A difference of so many standard errors tells which image is better.
const SURE: f64 = 2.0;

/// An estimate, and its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// What is estimated.
    pub value: f64,
    /// Standard error of that.
    pub deviation: f64,
}

/// What second sets tell of a filtered image. It holds for a whole image, or for thousands of pixels, never for one of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilteredClaim {
    /// Mean squared error of the image over pixels and channels, in the square of the image's unit.
    pub image: Estimate,
    /// The same of the filtered image. Chance can make it negative, where it is much less than that of the image.
    pub filtered: Estimate,
    /// The latter less the former.
    pub difference: Estimate,
    /// Mean of the image over pixels and channels.
    pub mean: f64,
    /// The number of pixels that have second sets.
    pub pixels: usize,
}

/// Sums over the channels of a pixel that has a second set.
struct Judged {
    weight: f64,
    /// Its row is an even or an odd one.
    half: usize,
    /// (G − I)(G + I − 2S).
    gain: f64,
    /// (G − I)².
    change: f64,
    /// (I − S)².
    apart: f64,
    /// The variance of the image.
    variance: f64,
}

impl FilteredClaim {
    /// From an image with second sets, and one that was made of its R, G and B by any filter. (Its variances depend on second sets, but a
    /// factor for each tile is all that they know of these.)
    ///
    /// # Errors
    /// Fails if the sizes differ, if a radiance is not finite, or if the image has no variance or no second set.
    pub fn new(image: &Picture, filtered: &Picture) -> Result<Self, String> {
        check(image, filtered)?;
        let none =
            "the rendered image has no second sets; those of `--sampler adaptive` have them, unless `--sets` is given";
        let variance = known_variance(image).ok_or("the rendered image has no variance")?;
        let second = image.second.as_deref().filter(|second| second.iter().any(|s| s.weight > 0.0)).ok_or(none)?;
        if second.iter().any(|s| !s.weight.is_finite() || s.weight < 0.0 || s.mean.iter().any(|x| !x.is_finite())) {
            return Err("a second set of the rendered image is not finite".into());
        }
        let (mut judged, mut variances, mut changes, mut sum) = (Vec::new(), 0.0, [0.0; 2], 0.0);
        for (i, second) in second.iter().enumerate() {
            let half = i / image.width % 2;
            let mut own =
                Judged { half, weight: second.weight.into(), gain: 0.0, change: 0.0, apart: 0.0, variance: 0.0 };
            for k in 0..3 {
                let [i, g, s] = [image.radiance[i][k], filtered.radiance[i][k], second.mean[k]].map(f64::from);
                own.gain += (g - i) * (g + i - 2.0 * s);
                own.change += (g - i).powi(2);
                own.apart += (i - s).powi(2);
                sum += i;
            }
            own.variance = variance[i].map(f64::from).iter().sum();
            variances += own.variance;
            changes[half] += own.change;
            if second.weight > 0.0 {
                judged.push(own);
            }
        }
        let total = |f: &dyn Fn(&Judged) -> f64| judged.iter().map(f).sum::<f64>();
        // each half of the rows takes the slope of the other: from its own samples, it would be biased
        let slopes = [1, 0].map(|half| {
            let sum = |f: &dyn Fn(&Judged) -> f64| {
                judged.iter().filter(|p| p.half == half).map(|p| p.weight.powi(2) * f(p)).sum::<f64>()
            };
            let squares = sum(&|p| p.change * p.change);
            if squares > 0.0 { (sum(&|p| p.gain * p.change) / squares).clamp(-1.0, 1.0) } else { 0.0 }
        });
        let gain = |p: &Judged| p.gain - slopes[p.half] * p.change;
        // a squared difference is this many times the variance of the image: 2, or more if the image is the mean of several
        let times = total(&|p| p.weight * p.apart) / variances;
        let excess = |p: &Judged| if variances > 0.0 && times > 0.0 { p.apart / times - p.variance } else { 0.0 };
        let count = 3.0 * image.radiance.len() as f64;
        let estimate = |value: f64, residual: &dyn Fn(&Judged) -> f64| Estimate {
            value: value / count,
            deviation: total(&|p| (p.weight * residual(p)).powi(2)).sqrt() / count,
        };
        let difference = slopes[0] * changes[0] + slopes[1] * changes[1] + total(&|p| p.weight * gain(p));
        Ok(Self {
            image: estimate(variances, &excess),
            filtered: estimate(variances + difference, &|p| gain(p) + excess(p)),
            difference: estimate(difference, &gain),
            mean: sum / count,
            pixels: judged.len(),
        })
    }
    /// Which image is better, "image" or "filtered"; `None` if their squared errors differ by too few standard errors to tell.
    #[must_use]
    pub fn better(&self) -> Option<&'static str> {
        let Estimate { value, deviation } = self.difference;
        (value.abs() > SURE * deviation).then_some(if value < 0.0 { "filtered" } else { "image" })
    }
    /// The RMS error of these squares, relative to the mean of the image: 0 if the estimate is negative.
    #[must_use]
    pub fn relative_rms(&self, of: Estimate) -> Estimate {
        let value = of.value.max(0.0).sqrt();
        // where the square is not known to be greater than 0, so far can the root be from it
        let deviation = if value * value > of.deviation { of.deviation / (2.0 * value) } else { of.deviation.sqrt() };
        Estimate { value: value / self.mean, deviation: deviation / self.mean }
    }
    /// The claim as a JSON object.
    pub fn to_json(&self) -> Value {
        let of = |squares: Estimate| {
            let rms = self.relative_rms(squares);
            json!({
                "mse": squares.value,
                "mse_deviation": squares.deviation,
                "relative_rms": (self.mean > 0.0).then_some(rms.value),
                "relative_rms_deviation": (self.mean > 0.0).then_some(rms.deviation),
            })
        };
        json!({
            "image": of(self.image),
            "filtered": of(self.filtered),
            "difference": { "mse": self.difference.value, "mse_deviation": self.difference.deviation },
            "pixels": self.pixels,
            "better": self.better(),
        })
    }
}

impl std::fmt::Display for FilteredClaim {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (name, squares) in [("rendered image", self.image), ("filtered image", self.filtered)] {
            write!(f, "{name}     mse {:.4e} ± {:.1e}", squares.value, squares.deviation)?;
            if self.mean > 0.0 {
                let rms = self.relative_rms(squares);
                write!(f, ", relative RMS error {:.4} ± {:.4} %", 100.0 * rms.value, 100.0 * rms.deviation)?;
            }
            writeln!(f)?;
        }
        let Estimate { value, deviation } = self.difference;
        let better = match self.better() {
            Some("filtered") => "the filtered image",
            Some(_) => "the image as it was rendered",
            None => "not known",
        };
        writeln!(f, "better             {better}: the squared errors differ by {value:+.4e} ± {deviation:.1e}")?;
        write!(f, "second sets        of {} pixels", self.pixels)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::Second;
    use crate::sampler::hash64;

    const SIDE: usize = 64;
    /// What makes a filtered image: of the light, the image, and the index of a pixel and channel.
    type Filter<'a> = &'a dyn Fn(&[f64], &Picture, usize, usize) -> f32;

    /// Numbers of variance 1, about normal.
    fn normal(index: usize, seed: u64) -> f64 {
        let bits = hash64(seed << 32 ^ hash64(index as u64));
        (0..4).map(|k| (bits >> (16 * k) & 0xffff) as f64 / 65536.0 - 0.5).sum::<f64>() * 3.0_f64.sqrt()
    }

    /// The light, and the mean of some images of it, with second sets, a part of which are certain.
    fn judged(seed: u64, passes: u64) -> (Vec<f64>, Picture) {
        let pixels = SIDE * SIDE;
        let light: Vec<f64> = (0..pixels).map(|i| 2.0 + 0.2 * ((i % SIDE) as f64 / 8.0 % 1.0)).collect();
        let deviation = |i: usize| if i % SIDE < 16 { 0.4 } else { 0.05 };
        let chance = |i: usize| if i % SIDE < 8 { 1.0 } else { 0.125 };
        let (mut radiance, mut second) = (vec![[0.0; 3]; pixels], vec![Second::default(); pixels]);
        for (i, pass) in (0..pixels).flat_map(|i| (0..passes).map(move |pass| (i, pass))) {
            let draw = |what: u64| normal(i, (seed * 8 + pass) * 8 + what);
            let mean = |what: u64| [0, 1, 2].map(|k| (light[i] + deviation(i) * draw(what + k)) as f32);
            let share = f64::recip(pass as f64 + 1.0);
            let is_chosen = uniform(i, seed * 8 + pass) <= chance(i);
            let weight = if is_chosen { chance(i).recip() as f32 } else { 0.0 };
            second[i].add(&Second { mean: mean(3), weight }, share);
            for (all, own) in radiance[i].iter_mut().zip(mean(0)) {
                *all += share as f32 * (own - *all);
            }
        }
        let variance = Some((0..pixels).map(|i| [(deviation(i).powi(2) / passes as f64) as f32; 3]).collect());
        (light, Picture { width: SIDE, height: SIDE, radiance, variance, second: Some(second) })
    }
    fn uniform(index: usize, seed: u64) -> f64 {
        (hash64(!seed << 32 | index as u64) >> 11) as f64 / (1_u64 << 53) as f64
    }
    fn squared(x: &Picture, light: &[f64]) -> f64 {
        let each = x.radiance.iter().zip(light).flat_map(|(x, t)| x.map(|x| (f64::from(x) - t).powi(2)));
        each.sum::<f64>() / (3 * SIDE * SIDE) as f64
    }

    /// Claims are right in the mean over images, and as far off as they say: for the image itself, a box, a bias, and the light itself.
    #[test]
    fn any_filter_is_judged() {
        let filters: [(&str, Filter<'_>); 4] = [
            ("the image", &|_, image, i, k| image.radiance[i][k]),
            ("a box", &|_, image, i, k| {
                let row = i / SIDE * SIDE;
                (0..5).map(|j| image.radiance[row + (i - row + j).clamp(2, SIDE + 1) - 2][k]).sum::<f32>() / 5.0
            }),
            ("a bias", &|_, image, i, k| image.radiance[i][k] + 0.5),
            ("the light", &|light, _, i, _| light[i] as f32),
        ];
        let seeds = 120;
        for (passes, which) in [1, 4].into_iter().flat_map(|passes| (0..4).map(move |which| (passes, which))) {
            let (name, filter) = filters[which];
            let (mut claimed, mut truth, mut noise, mut apart) = (0.0, 0.0, 0.0, 0.0);
            for seed in 0..seeds {
                let (light, image) = judged(seed, passes);
                let radiance = (0..SIDE * SIDE).map(|i| [0, 1, 2].map(|k| filter(&light, &image, i, k))).collect();
                let filtered = Picture { radiance, variance: None, second: None, ..image.clone() };
                let claim = FilteredClaim::new(&image, &filtered).unwrap();
                let [own, of_image] = [&filtered, &image].map(|x| squared(x, &light) / seeds as f64);
                claimed += claim.filtered.value / seeds as f64;
                truth += own;
                noise += of_image;
                let off = claim.difference.value - (own - of_image) * seeds as f64;
                apart += (off / claim.difference.deviation.max(1e-30)).powi(2) / seeds as f64;
                let better = [None, Some("filtered"), Some("image"), Some("filtered")][which];
                assert!(claim.better() == better || which == 1 && passes == 4, "{passes} {name}: {claim}");
            }
            let apart = apart.sqrt();
            println!("{passes} passes, {name}: claimed {claimed:.6} of {truth:.6}, off by {apart:.2} of what it says");
            assert!((claimed - truth).abs() < 0.03 * truth.max(0.3 * noise), "{passes} {name}: {claimed} {truth}");
            assert!(which == 0 || (0.6..1.25).contains(&apart), "{passes} {name}: {apart}");
        }
    }

    /// What cannot be judged is refused, and says why.
    #[test]
    fn images_without_second_sets_are_not_judged() {
        let (_, image) = judged(1, 1);
        let refused = |image: &Picture, filtered: &Picture| FilteredClaim::new(image, filtered).unwrap_err();
        assert!(refused(&Picture { second: None, ..image.clone() }, &image).contains("no second sets"));
        assert!(refused(&Picture { variance: None, ..image.clone() }, &image).contains("no variance"));
        let mut broken = image.clone();
        broken.second.as_mut().unwrap()[7].mean[1] = f32::NAN;
        assert!(refused(&broken, &image).contains("second set"));
        let narrow = Picture { width: 32, height: 128, ..image.clone() };
        assert!(refused(&image, &narrow).contains("32x128"));
    }
}
