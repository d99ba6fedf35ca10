//! Measures error and time of every scene × technique × choice of a light × sampler × sample count, in interleaved replicates.

use super::clock::Clock;
use super::reference::{Difference, Reference};
use super::stats::Cost;
use crate::cost::median;
use crate::hash::fnv1a;
use crate::processor_time::processor_seconds;
use etendue_render::{ChoiceBy, Sampler, Settings, Technique, World};
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::error::Error;
use std::hash::{Hash, Hasher};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// A scene to measure.
#[derive(Debug)]
pub struct ChartedScene {
    /// Scene name as given by the user.
    pub name: String,
    /// The prepared scene.
    pub world: World,
    /// Pixels across and down.
    pub size: [u32; 2],
    /// The reference image.
    pub reference: Reference,
    /// Hash of everything a measurement depends on, besides the values of a [`Measurement`].
    pub settings: u64,
}

/// One way of rendering one scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key {
    /// Index of the scene.
    pub scene: usize,
    /// How lights are sampled.
    pub technique: Technique,
    /// How one of them is chosen.
    pub choice: ChoiceBy,
    /// How random numbers are generated.
    pub sampler: Sampler,
    /// Samples per pixel.
    pub spp: u32,
}

/// A technique in words, and the choice of a light unless that is `auto`, such as `area by power`.
#[must_use]
pub fn method(technique: Technique, choice: ChoiceBy) -> String {
    match choice {
        ChoiceBy::Auto => technique.name().to_owned(),
        _ => format!("{} by {}", technique.name(), choice.name()),
    }
}

impl Key {
    /// The settings of an image.
    #[must_use]
    pub fn settings(&self, [width, height]: [u32; 2], seed: u64) -> Settings {
        let Self { technique, choice, sampler, spp, .. } = *self;
        let sets = SETS;
        Settings { width, height, spp, technique, choice, depth: Settings::DEPTH, sampler, sets, seed }
    }
}

impl Hash for Key {
    fn hash<H: Hasher>(&self, state: &mut H) {
        (self.scene, self.technique as usize, self.choice, self.sampler as usize, self.spp).hash(state);
    }
}

/// One measurement, which is a line of the table.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measurement {
    /// Index of the replicate.
    pub replicate: u32,
    /// Seed of the image.
    pub seed: u64,
    /// Median time of `repeats` renderings of this image, in seconds.
    pub seconds: f64,
    /// Seconds that all threads together ran for a rendering, on average over all; `None` where the system does not tell.
    pub cpu: Option<f64>,
    /// Number of renderings.
    pub repeats: u32,
    /// Difference from the reference, which has an error of its own.
    pub difference: Difference,
    /// Numbers of rays of a rendering: from the camera, from mirrors, towards lights, and through corners of pixels.
    pub rays: [u64; 4],
}

impl Measurement {
    /// Its time on the wall, and that of the processors.
    #[must_use]
    pub const fn times(&self) -> (f64, Option<f64>) {
        (self.seconds, self.cpu)
    }
    /// Time by a clock, and errors minus those of the reference.
    #[must_use]
    pub fn cost(&self, reference: &Reference, clock: Clock) -> Cost {
        let Difference { squared, relative, .. } = self.difference;
        let seconds = clock.seconds(self.seconds, self.cpu);
        Cost { mse: squared - reference.error, relative: relative - reference.relative_error, seconds }
    }
}

/// All measurements by key, in order of replicates.
pub type Rows = HashMap<Key, Vec<Measurement>>;

/// Images are rendered repeatedly until this many seconds have passed, at most [`REPEATS`] times.
const SECONDS: f64 = 0.02;
const REPEATS: u32 = 15;

/// Seconds to measure an image that renders in this many.
pub(super) fn needs_repeats(seconds: f64) -> f64 {
    if seconds >= SECONDS { seconds } else { (SECONDS + 0.5 * seconds).min(f64::from(REPEATS) * seconds) }
}

/// Sets per pixel: one, which has the least error, since the error comes from replicates of the image.
pub(crate) const SETS: u32 = 1;

/// Why a sampler does not support this many samples; `None` if it does.
pub(crate) fn inapplicable(sampler: Sampler, spp: u32) -> Option<String> {
    sampler.check(spp, SETS).err()
}

/// Keeps a row of a scene.
pub type Keep<'a> = dyn FnMut(&ChartedScene, &Key, &Measurement) -> Result<(), Box<dyn Error>> + Send + 'a;

/// The planned measurements.
#[derive(Debug)]
pub struct Plan {
    /// The scenes.
    pub scenes: Vec<ChartedScene>,
    /// Keys in the order in which each round renders them.
    pub keys: Vec<Key>,
    /// Number of images per key, with different seeds.
    pub replicates: u32,
    /// Seed of the whole measurement.
    pub seed: u64,
    /// Whether series that cannot win are measured no further, see [`HOPELESS`].
    pub is_race: bool,
}

/// In a race, a series has no more images once its squared error × time is so many times that of the best at as many samples.
pub const HOPELESS: f64 = 8.0;

impl Plan {
    /// Whether the images so far tell that a series cannot win.
    fn is_hopeless(&self, rows: &Rows, key: &Key) -> bool {
        let reference = &self.scenes[key.scene].reference;
        // squared error × time of a series by its images of so many samples
        let of = |key: &Key| {
            let rows = rows.get(key)?;
            let mean = |of: &dyn Fn(&Measurement) -> f64| rows.iter().map(of).sum::<f64>() / rows.len() as f64;
            let mse = mean(&|row| row.difference.squared - reference.error).max(reference.error);
            Some(mse * mean(&|row| row.cpu.unwrap_or(row.seconds)))
        };
        let spps = || self.keys.iter().map(|key| key.spp);
        let last = spps().filter(|spp| *spp <= key.spp && rows.contains_key(&Key { spp: *spp, ..*key })).max();
        let Some((last, own)) = last.and_then(|spp| Some((spp, of(&Key { spp, ..*key })?))) else { return false };
        let others = self.keys.iter().filter(|other| other.scene == key.scene && other.spp <= last);
        others.filter_map(of).any(|other| own > HOPELESS * other)
    }
    /// The seed of an image, different for each, so that all images are independent.
    fn seed(&self, key: &Key, replicate: u32) -> u64 {
        let subject = &self.scenes[key.scene].name;
        let method = method(key.technique, key.choice);
        let text = format!("{subject}/{method}/{}/{}/{replicate}", key.sampler.name(), key.spp);
        self.seed.wrapping_add(fnv1a(text.as_bytes()))
    }
    /// Number of samples in an image.
    fn samples(&self, key: &Key) -> u64 {
        let [width, height] = self.scenes[key.scene].size;
        u64::from(width) * u64::from(height) * u64::from(key.spp)
    }
    /// Number of samples in all images that are not yet measured.
    #[must_use]
    pub fn work(&self, rows: &Rows) -> u64 {
        let left = |key: &Key| u64::from(self.replicates) - rows.get(key).map_or(0, |r| r.len() as u64);
        self.keys.iter().map(|key| left(key) * self.samples(key)).sum()
    }
    /// Measures what is missing, and gives each row to `keep` before it adds it. Calls `progress` with numbers of samples. Returns early if
    /// `stop` is set. Returns how many images a race left out.
    ///
    /// # Errors
    /// Fails if `keep` does.
    pub fn run(
        &self,
        rows: &mut Rows,
        keep: &mut Keep<'_>,
        stop: &AtomicBool,
        progress: &(dyn Fn(u64) + Sync),
    ) -> Result<usize, Box<dyn Error>> {
        let (mut last, mut left_out) = (None, 0);
        for replicate in 0..self.replicates {
            for key in &self.keys {
                if rows.get(key).is_some_and(|rows| rows.iter().any(|r| r.replicate == replicate)) {
                    continue;
                }
                if self.is_race && self.is_hopeless(rows, key) {
                    left_out += 1;
                    progress(self.samples(key));
                    continue;
                }
                if last != Some(key.scene) {
                    // warms the caches for the first image of a scene
                    self.render(&Key { spp: key.spp.min(4), ..*key }, 0, &|_| ());
                    last = Some(key.scene);
                }
                if stop.load(Ordering::Relaxed) {
                    return Ok(left_out);
                }
                let row = self.render(key, replicate, progress);
                keep(&self.scenes[key.scene], key, &row)?;
                rows.entry(*key).or_default().push(row);
            }
        }
        Ok(left_out)
    }
    fn render(&self, key: &Key, replicate: u32, progress: &(dyn Fn(u64) + Sync)) -> Measurement {
        let subject = &self.scenes[key.scene];
        let seed = self.seed(key, replicate);
        let settings = key.settings(subject.size, seed);
        let begin = Instant::now();
        let cpu_before = processor_seconds();
        let mut seconds = Vec::new();
        let (film, rays) = loop {
            let first = seconds.is_empty();
            let start = Instant::now();
            let image = subject.world.render(&settings, &|pixels| {
                if first {
                    progress(pixels * u64::from(key.spp));
                }
            });
            seconds.push(start.elapsed().as_secs_f64());
            if begin.elapsed().as_secs_f64() >= SECONDS || seconds.len() as u32 >= REPEATS {
                break image;
            }
        };
        let cpu = processor_seconds().zip(cpu_before).map(|(after, before)| (after - before) / seconds.len() as f64);
        Measurement {
            replicate,
            seed,
            seconds: median(&seconds),
            cpu,
            repeats: seconds.len() as u32,
            difference: subject.reference.difference(film.pixels.iter().map(|p| p.mean)),
            rays: [rays.camera, rays.mirror, rays.shadow, rays.corner],
        }
    }
}
