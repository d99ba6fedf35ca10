//! Measures error and time of every scene × technique × choice of a light × sampler × sample count, in interleaved replicates.

use super::reference::Reference;
use super::stats::Cost;
use crate::cost::median;
use crate::hash::fnv1a;
use etendue_render::{ChoiceBy, Sampler, Settings, Technique, World};
use std::collections::{HashMap, HashSet};
use std::error::Error;
use std::fs::{File, OpenOptions};
use std::hash::{Hash, Hasher};
use std::path::Path;
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
    /// Hash of everything a measurement depends on, besides the values of a [`Row`].
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

impl Hash for Key {
    fn hash<H: Hasher>(&self, state: &mut H) {
        (self.scene, self.technique as usize, self.choice, self.sampler as usize, self.spp).hash(state);
    }
}

/// One measurement, which is a line of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Index of the replicate.
    pub replicate: u32,
    /// Seed of the image.
    pub seed: u64,
    /// Median time of `repeats` renderings of this image, in seconds.
    pub seconds: f64,
    /// Number of renderings.
    pub repeats: u32,
    /// Mean over pixels and channels of the squared difference from the reference.
    pub squared: f64,
    /// Mean difference from the reference.
    pub difference: f64,
    /// Number of camera rays.
    pub camera: u64,
    /// Number of shadow rays.
    pub shadow: u64,
}

impl Row {
    /// Time, and error minus that of the reference.
    #[must_use]
    pub fn cost(&self, reference: &Reference) -> Cost {
        Cost { mse: self.squared - reference.error, seconds: self.seconds }
    }
}

/// All measurements by key, in order of replicates.
pub type Rows = HashMap<Key, Vec<Row>>;

const HEADER: [&str; 18] = [
    "settings",
    "scene",
    "technique",
    "choice",
    "sampler",
    "width",
    "height",
    "spp",
    "replicate",
    "seed",
    "seconds",
    "repeats",
    "mse_with_reference_error",
    "reference_error",
    "mse",
    "mean_difference",
    "camera_rays",
    "shadow_rays",
];

/// Images are rendered repeatedly until this many seconds have passed, at most [`REPEATS`] times.
const SECONDS: f64 = 0.02;
const REPEATS: u32 = 15;

/// Sets per pixel: one, which has the least error, since the error comes from replicates of the image.
pub(crate) const SETS: u32 = 1;

/// Why a sampler does not support this many samples; `None` if it does.
pub(crate) fn inapplicable(sampler: Sampler, spp: u32) -> Option<String> {
    sampler.check(spp, SETS).err()
}

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
}

impl Plan {
    /// The seed of an image, different for each, so that all images are independent.
    fn seed(&self, key: &Key, replicate: u32) -> u64 {
        let subject = &self.scenes[key.scene].name;
        let method = method(key.technique, key.choice);
        let text = format!("{subject}/{method}/{}/{}/{replicate}", key.sampler.name(), key.spp);
        self.seed.wrapping_add(fnv1a(text.as_bytes()))
    }
    /// Number of samples in all images that are not yet measured.
    #[must_use]
    pub fn work(&self, rows: &Rows) -> u64 {
        let samples = |key: &Key| {
            let [width, height] = self.scenes[key.scene].size;
            u64::from(width) * u64::from(height) * u64::from(key.spp)
        };
        let left = |key: &Key| u64::from(self.replicates) - rows.get(key).map_or(0, |r| r.len() as u64);
        self.keys.iter().map(|key| left(key) * samples(key)).sum()
    }
    /// Measures what is missing and appends it to the table line by line. Calls `progress` with numbers of samples. Returns early if
    /// `stop` is set.
    ///
    /// # Errors
    /// Fails if the table cannot be written.
    pub fn run(
        &self,
        table: &mut Table,
        rows: &mut Rows,
        stop: &AtomicBool,
        progress: &(dyn Fn(u64) + Sync),
    ) -> Result<(), Box<dyn Error>> {
        let mut last = None;
        for replicate in 0..self.replicates {
            for key in &self.keys {
                if rows.get(key).is_some_and(|rows| rows.iter().any(|r| r.replicate == replicate)) {
                    continue;
                }
                if last != Some(key.scene) {
                    // warms the caches for the first image of a scene
                    self.render(&Key { spp: key.spp.min(4), ..*key }, 0, &|_| ());
                    last = Some(key.scene);
                }
                if stop.load(Ordering::Relaxed) {
                    return Ok(());
                }
                let row = self.render(key, replicate, progress);
                table.append(&self.scenes[key.scene], key, &row)?;
                rows.entry(*key).or_default().push(row);
            }
        }
        Ok(())
    }
    fn render(&self, key: &Key, replicate: u32, progress: &(dyn Fn(u64) + Sync)) -> Row {
        let subject = &self.scenes[key.scene];
        let [width, height] = subject.size;
        let seed = self.seed(key, replicate);
        let settings = Settings {
            width,
            height,
            spp: key.spp,
            technique: key.technique,
            choice: key.choice,
            depth: Settings::DEPTH,
            sampler: key.sampler,
            sets: SETS,
            seed,
        };
        let begin = Instant::now();
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
        let (squared, difference) = subject.reference.difference(film.pixels.iter().map(|p| p.mean));
        Row {
            replicate,
            seed,
            seconds: median(&seconds),
            repeats: seconds.len() as u32,
            squared,
            difference,
            camera: rays.camera,
            shadow: rays.shadow,
        }
    }
}

/// The CSV file that receives each measurement as soon as it is made.
#[derive(Debug)]
pub struct Table {
    writer: csv::Writer<File>,
}

impl Table {
    /// Opens or creates the file. Returns the measurements that belong to the plan, and the number of others.
    ///
    /// # Errors
    /// Fails if the file cannot be read or written, or a line is not a measurement.
    pub fn open(path: &Path, plan: &Plan) -> Result<(Self, Rows, usize), Box<dyn Error>> {
        let at = |what: &dyn std::fmt::Display| format!("{}: {what}", path.display());
        let mut text = match std::fs::read_to_string(path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => String::new(),
            Err(error) => return Err(at(&format!("cannot read: {error}")).into()),
        };
        let fresh = text.is_empty();
        let whole = text.rfind('\n').map_or(0, |end| end + 1);
        let cut = whole < text.len();
        text.truncate(whole);
        let (rows, others) = if whole == 0 { Default::default() } else { plan.read(&text).map_err(|e| at(&e))? };
        let opened = OpenOptions::new().create(true).append(true).open(path);
        let file = opened.map_err(|error| at(&format!("cannot write: {error}")))?;
        if cut {
            // drops an incomplete line, written when the program was killed
            file.set_len(whole as u64)?;
        }
        let mut writer = csv::WriterBuilder::new().from_writer(file);
        if fresh || whole == 0 {
            writer.write_record(HEADER)?;
            writer.flush()?;
        }
        Ok((Self { writer }, rows, others))
    }
    fn append(&mut self, subject: &ChartedScene, key: &Key, row: &Row) -> Result<(), Box<dyn Error>> {
        let [width, height] = subject.size;
        self.writer.write_record([
            format!("{:016x}", subject.settings),
            subject.name.clone(),
            key.technique.name().to_owned(),
            key.choice.name().to_owned(),
            key.sampler.name().to_owned(),
            width.to_string(),
            height.to_string(),
            key.spp.to_string(),
            row.replicate.to_string(),
            format!("{:016x}", row.seed),
            format!("{:.9}", row.seconds),
            row.repeats.to_string(),
            format!("{:e}", row.squared),
            format!("{:e}", subject.reference.error),
            format!("{:e}", row.cost(&subject.reference).mse),
            format!("{:e}", row.difference),
            row.camera.to_string(),
            row.shadow.to_string(),
        ])?;
        self.writer.flush()?;
        Ok(())
    }
}

impl Plan {
    /// Reads the lines of a table that belong to this plan, and counts the others.
    fn read(&self, text: &str) -> Result<(Rows, usize), String> {
        let mut rows = Rows::new();
        let mut others = 0;
        let mut reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text.as_bytes());
        let keys: HashMap<[String; 6], Key> = self
            .keys
            .iter()
            .map(|key| {
                let ChartedScene { name: scene, settings, .. } = &self.scenes[key.scene];
                let names = [key.technique.name(), key.choice.name(), key.sampler.name()];
                let [technique, choice, sampler] = names.map(str::to_owned);
                let line = [format!("{settings:016x}"), scene.clone(), technique, choice, sampler, key.spp.to_string()];
                (line, *key)
            })
            .collect();
        let mut seen = HashSet::new();
        for record in reader.records() {
            let record = record.map_err(|error| error.to_string())?;
            let line = record.position().map_or(0, csv::Position::line);
            if line <= 1 {
                if record.iter().ne(HEADER) {
                    return Err(
                        "line 1 is not the header of a table of measurements; choose another folder with -o".to_owned()
                    );
                }
                continue;
            }
            if record.len() != HEADER.len() {
                return Err(format!("line {line} has {} values instead of {}", record.len(), HEADER.len()));
            }
            fn value<T>(
                record: &csv::StringRecord,
                line: u64,
                column: usize,
                parse: impl Fn(&str) -> Option<T>,
            ) -> Result<T, String> {
                parse(&record[column])
                    .ok_or_else(|| format!("line {line}: {:?} is not a valid {}", &record[column], HEADER[column]))
            }
            let real = |column| value(&record, line, column, |s| s.parse().ok().filter(|x: &f64| x.is_finite()));
            let count = |column| value(&record, line, column, |s| s.parse::<u64>().ok());
            let hexadecimal = |column| value(&record, line, column, |s| u64::from_str_radix(s, 16).ok());
            let small = |column| value(&record, line, column, |s| s.parse::<u32>().ok());
            let row = Row {
                replicate: small(8)?,
                seed: hexadecimal(9)?,
                seconds: real(10)?,
                repeats: small(11)?,
                squared: real(12)?,
                difference: real(15)?,
                camera: count(16)?,
                shadow: count(17)?,
            };
            let columns = [0, 1, 2, 3, 4, 7].map(|column| record[column].to_owned());
            match keys.get(&columns) {
                Some(key) if row.replicate < self.replicates && seen.insert((*key, row.replicate)) => {
                    rows.entry(*key).or_default().push(row);
                }
                _ => others += 1,
            }
        }
        for rows in rows.values_mut() {
            rows.sort_by_key(|r| r.replicate);
        }
        Ok((rows, others))
    }
}
