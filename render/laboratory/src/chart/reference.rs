//! Reference images and their own error.

use etendue_render::film::image::{self, Picture};
use etendue_render::{Sampler, Settings, Technique, World};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// An image that serves as the truth, with a known error.
#[derive(Clone, Debug)]
pub struct Reference {
    /// The image.
    pub picture: Picture,
    /// Mean squared standard error of the image.
    pub error: f64,
    /// The same of relative errors, see [`Difference::relative`].
    pub relative_error: f64,
    /// How well the error is known, as a part of it.
    pub known_to: f64,
    /// What is added to the square of a radiance before a squared error is divided by it.
    floor: f64,
    /// Origin of the image.
    pub about: String,
}

/// Images of built-in scenes by an independent renderer, 256×256 with 32,768 samples per pixel, and their mean squared standard
/// errors.
const BUILTIN: [(&str, f64, &[u8]); 3] = [
    ("sphere-light", 4.8e-9, include_bytes!("../../../tests/references/sphere-light.exr")),
    ("triangle-light", 2.6e-8, include_bytes!("../../../tests/references/triangle-light.exr")),
    ("quads", 1.9e-8, include_bytes!("../../../tests/references/quads.exr")),
];

/// Radiance as a part of the mean below which relative errors count less: its square is the 0.01 that is usual in relMSE, for a mean of 1.
const FLOOR: f64 = 0.1;

/// Relative uncertainty of a reference's error: of strata, and of the sampler adaptive, whose claims are within 0.85 and 1.1 of the error
/// (`claims_of_built_in_scenes` in `render/tests`).
const KNOWN_TO: f64 = 0.05;
const ADAPTIVE_KNOWN_TO: f64 = 0.3;

impl Reference {
    /// The reference that comes with the program for a built-in scene, if there is one.
    ///
    /// # Panics
    /// Panics if the embedded file is damaged.
    #[must_use]
    pub fn builtin(scene: &str) -> Option<Self> {
        let (name, error, bytes) = BUILTIN.iter().find(|(name, ..)| *name == scene)?;
        let picture = image::decode_exr(bytes, Path::new(name)).expect("the embedded reference is valid");
        let about = "by an independent renderer, 32,768 samples per pixel".to_owned();
        Some(Self::new(picture, *error, about))
    }

    /// The settings with which a reference is rendered: multiple importance sampling and stratified samples, or what has a small error soon.
    #[must_use]
    pub fn settings([width, height]: [u32; 2], spp: u32, is_quick: bool) -> Settings {
        let way =
            if is_quick { (Technique::Auto, Sampler::Adaptive) } else { (Technique::MisPower, Sampler::Stratified) };
        // a seed that no measurement uses
        let ((technique, sampler), seed) = (way, 0x5eed_0f7e_fe7e_ce00);
        let spp = spp.next_multiple_of(4).max(32);
        Settings { width, height, spp, technique, sampler, seed, ..Settings::DEFAULT }
    }

    /// Renders a reference.
    pub fn render(world: &World, settings: &Settings, progress: &(dyn Fn(u64) + Sync)) -> Self {
        let picture = Picture::from(&world.render(settings, progress).0);
        let error = picture.variance.as_ref().map_or(f64::INFINITY, |v| mean(v));
        let [technique, sampler] = [settings.technique.name(), settings.sampler.name()];
        let about = format!("rendered by this program, {technique}, {sampler}, {} samples per pixel", settings.spp);
        let known_to = if settings.sampler == Sampler::Adaptive { ADAPTIVE_KNOWN_TO } else { KNOWN_TO };
        Self { known_to, ..Self::new(picture, error, about) }
    }

    fn new(picture: Picture, error: f64, about: String) -> Self {
        let floor = (FLOOR * mean(&picture.radiance)).powi(2);
        let mut one = Self { picture, error, relative_error: 0.0, known_to: KNOWN_TO, floor, about };
        let squared = |i: usize, k: usize| match &one.picture.variance {
            Some(variance) => f64::from(variance[i][k]),
            None => error,
        };
        let n = one.picture.radiance.len();
        let sum: f64 =
            (0..n).flat_map(|i| (0..3).map(move |k| (i, k))).map(|(i, k)| squared(i, k) / one.scale(i, k)).sum();
        one.relative_error = sum / (3.0 * n as f64);
        one
    }

    /// What relates a squared error to a channel of a pixel: the square of the reference, and a little more where that is dark.
    fn scale(&self, pixel: usize, channel: usize) -> f64 {
        f64::from(self.picture.radiance[pixel][channel]).powi(2) + self.floor
    }

    /// Shrinks the reference: each pixel becomes the mean of a square of pixels. `None` if its sides are not the same integer multiple of the new
    /// ones.
    #[must_use]
    pub fn shrunk(self, [width, height]: [u32; 2]) -> Option<Self> {
        let (w, h) = (width as usize, height as usize);
        let Picture { width: from_w, height: from_h, .. } = self.picture;
        let factor = from_w / w.max(1);
        if factor == 0 || w * factor != from_w || h * factor != from_h {
            return None;
        }
        if factor == 1 {
            return Some(self);
        }
        let count = (factor * factor) as f64;
        let radiance = (0..w * h)
            .map(|i| {
                let at = |k: usize| (i / w * factor + k / factor) * from_w + i % w * factor + k % factor;
                std::array::from_fn(|c| {
                    let sum: f64 = (0..factor * factor).map(|k| f64::from(self.picture.radiance[at(k)][c])).sum();
                    (sum / count) as f32
                })
            })
            .collect();
        let picture = Picture { width: w, height: h, radiance, variance: None, second: None };
        let about = format!("{}, averaged over {factor}×{factor} pixels", self.about);
        Some(Self { known_to: self.known_to, ..Self::new(picture, self.error / count, about) })
    }

    /// How an image differs from the reference.
    #[must_use]
    pub fn difference(&self, radiance: impl ExactSizeIterator<Item = [f32; 3]>) -> Difference {
        let count = 3.0 * radiance.len() as f64;
        let mut sum = Difference::default();
        for (i, (a, b)) in radiance.zip(&self.picture.radiance).enumerate() {
            for k in 0..3 {
                let d = f64::from(a[k]) - f64::from(b[k]);
                sum.squared += d * d / count;
                sum.relative += d * d / (self.scale(i, k) * count);
                sum.mean += d / count;
            }
        }
        sum
    }

    /// Mean of the reference over pixels and channels.
    #[must_use]
    pub fn mean(&self) -> f64 {
        mean(&self.picture.radiance)
    }
}

/// Means over pixels and channels of the difference image − reference.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Difference {
    /// Of its square.
    pub squared: f64,
    /// Of its square over that of the reference plus (a tenth of the reference's mean)².
    pub relative: f64,
    /// Of itself.
    pub mean: f64,
}

fn mean(values: &[[f32; 3]]) -> f64 {
    values.iter().flatten().map(|&x| f64::from(x)).sum::<f64>() / (3.0 * values.len() as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_references_are_those_of_the_tests() {
        for (name, mean) in [("sphere-light", 0.230_541), ("triangle-light", 0.297_986), ("quads", 0.123_276)] {
            let reference = Reference::builtin(name).unwrap();
            assert!((super::mean(&reference.picture.radiance) - mean).abs() < 1e-6, "{name}");
            let error = reference.error;
            let small = reference.shrunk([64, 64]).unwrap();
            assert!((super::mean(&small.picture.radiance) - mean).abs() < 1e-6, "{name}");
            assert_eq!((small.picture.radiance.len(), small.error), (64 * 64, error / 16.0));
        }
        assert!(Reference::builtin("terrain").is_none());
        for size in [[100, 100], [256, 128], [512, 512], [64, 32]] {
            assert!(Reference::builtin("quads").unwrap().shrunk(size).is_none(), "{size:?}");
        }
    }

    /// A small rendered image agrees, within its noise, with a larger image that is shrunk.
    #[test]
    fn a_pixel_is_the_mean_of_its_parts() {
        let world = World::new(&etendue_scene::load("quads").unwrap()).unwrap();
        let reference = Reference::builtin("quads").unwrap().shrunk([32, 32]).unwrap();
        let rendered = Reference::render(&world, &Reference::settings([32, 32], 4096, false), &|_| ());
        let Difference { squared, relative, mean } = reference.difference(rendered.picture.radiance.iter().copied());
        let expected = reference.error + rendered.error;
        // with 1024 pixels of different variances, the mean square is accurate to some per cent
        assert!((squared / expected - 1.0).abs() < 0.5, "{squared:e} {expected:e}");
        let expected_relative = reference.relative_error + rendered.relative_error;
        assert!((relative / expected_relative - 1.0).abs() < 0.5, "{relative:e} {expected_relative:e}");
        assert!(mean.abs() < 5.0 * (expected / 1024.0).sqrt(), "{mean:e} {expected:e}");
    }
}
