//! `etendue render --beside`: the same scene by another technique in the same time, and both images in one picture.

use crate::output::{Output, grouped, percent};
use etendue_render::film::Film;
use etendue_render::film::claim::Claim;
use etendue_render::scene::Input;
use etendue_render::{Technique, film::files, film::image};
use std::fmt;
use std::num::NonZero;
use std::path::PathBuf;
use std::thread::available_parallelism;

/// The line between both images in pixels.
const LINE: u32 = 2;

/// The part of the processors' time that a program has where nothing else runs, at least.
const OWN: f64 = 0.5;

/// What the picture shows beside the image.
pub(crate) struct Beside {
    pub(crate) technique: Technique,
    png: PathBuf,
}

/// What one of the images took.
pub(crate) struct Cost {
    pub(crate) technique: String,
    pub(crate) seconds: f64,
    pub(crate) shadow_rays: u64,
    pub(crate) error: Option<Claim>,
    /// Samples per pixel.
    pub(crate) spp: u64,
}

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { technique, seconds, spp, shadow_rays, error } = self;
        let error = error.map_or_else(|| "not known".to_owned(), |claim| percent(claim.total()));
        let rays = grouped(*shadow_rays);
        write!(f, "{technique}: {seconds:.1} s, {spp} samples per pixel, {rays} shadow rays, error {error}")
    }
}

/// What to add to the times of images if the processors had other work: `processor` seconds of so many threads in so many seconds.
pub(crate) fn other_work(seconds: f64, threads: usize, processor: f64) -> Option<String> {
    let cores = available_parallelism().map_or(1, NonZero::get).min(threads);
    let part = processor / (seconds * cores as f64);
    let what =
        "the processors had other work, so that the seconds, and the left image, are not those of an idle machine";
    (part < OWN).then(|| format!("{what}: this program had {:.0} % of their time", 100.0 * part))
}

impl Beside {
    /// The picture is called after the image and the other technique.
    ///
    /// # Errors
    /// Fails if the file cannot be written, or if the scene has been read from it.
    pub(crate) fn new(technique: Technique, output: &Output, inputs: &[Input]) -> Result<Self, String> {
        let mut name = output.exr.file_stem().unwrap_or_default().to_owned();
        name.push(format!("-beside-{}.png", technique.name()));
        let png = output.exr.with_file_name(name);
        files::check_replaceable(&png).map_err(|error| error.to_string())?;
        if inputs.iter().any(|input| files::is_same(&input.path, &png)) {
            return Err(format!(
                "{}: the scene has been read from this file: choose another name with -o",
                png.display()
            ));
        }
        Ok(Self { technique, png })
    }

    /// Writes the left half of the other image, a white line and the right half of this one, and says so.
    pub(crate) fn write(&self, other: &Film, this: &Film, exposure: f64) -> Result<String, String> {
        let Film { width, height, .. } = *this;
        let [left, right] = [other, this].map(|film| film.scaled(1.0 / exposure).pixels);
        let middle = (width.saturating_sub(LINE) / 2)..(width.saturating_sub(LINE) / 2 + LINE);
        let columns = (0..height).flat_map(|_| 0..width);
        let pixels = left.iter().zip(&right).zip(columns).map(|((left, right), x)| match x {
            _ if middle.contains(&x) => [255; 3],
            _ => image::tone_map(if x < middle.start { left.mean } else { right.mean }),
        });
        let pixels: Vec<[u8; 3]> = pixels.collect();
        let written = image::encode_png([width, height], &pixels).map_err(|error| error.to_string());
        written.and_then(|bytes| files::replace(&self.png, &bytes).map_err(|error| error.to_string()))?;
        Ok(format!("wrote {}", self.png.display()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_work_is_noted() {
        assert_eq!(other_work(10.0, 1, 9.0), None);
        assert!(other_work(10.0, 1, 4.0).unwrap().ends_with(": this program had 40 % of their time"));
    }
}
