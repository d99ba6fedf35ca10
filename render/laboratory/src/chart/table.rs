//! The CSV file of measurements, from which a later run goes on.

use super::clock::Clock;
use super::measure::{ChartedScene, Key, Measurement, Plan, Rows};
use etendue_render::{ChoiceBy, Sampler, Technique};
use serde::{Deserialize, Serialize};
use std::collections::HashSet;
use std::error::Error;
use std::fs::{File, OpenOptions};
use std::path::Path;

/// What a measurement is of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Subject {
    /// Hash of the circumstances, in hexadecimal digits.
    settings: String,
    scene: String,
    technique: Technique,
    choice: ChoiceBy,
    sampler: Sampler,
    /// Samples per pixel.
    spp: u32,
}

/// What is for readers only: pixels across and down, the reference's error, and errors without it.
type Derived = (u32, u32, f64, f64, f64);

/// The names of the columns of a [`Subject`], a [`Measurement`] and what is [`Derived`].
const HEADER: [&str; 23] = [
    "settings",
    "scene",
    "technique",
    "choice",
    "sampler",
    "spp",
    "replicate",
    "seed",
    "seconds",
    "cpu_seconds",
    "repeats",
    "mse_with_reference_error",
    "relative_mse_with_reference_error",
    "mean_difference",
    "camera_rays",
    "mirror_rays",
    "shadow_rays",
    "corner_rays",
    "width",
    "height",
    "reference_error",
    "mse",
    "relative_mse",
];

impl Subject {
    fn new(scene: &ChartedScene, key: &Key) -> Self {
        let settings = format!("{:016x}", scene.settings);
        let Key { technique, choice, sampler, spp, .. } = *key;
        Self { settings, scene: scene.name.clone(), technique, choice, sampler, spp }
    }
    /// The key of a plan that it belongs to, if there is one.
    fn key(&self, plan: &Plan) -> Option<Key> {
        plan.keys.iter().copied().find(|key| *self == Self::new(&plan.scenes[key.scene], key))
    }
}

/// The CSV file that receives each measurement as soon as it is made.
#[derive(Debug)]
pub struct MeasurementFile {
    writer: csv::Writer<File>,
}

impl MeasurementFile {
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
        // an incomplete line was written when the program was killed
        let whole = text.rfind('\n').map_or(0, |end| end + 1);
        let cut = whole < text.len();
        text.truncate(whole);
        let (rows, others) = if whole == 0 { Default::default() } else { read(&text, plan).map_err(|e| at(&e))? };
        let opened = OpenOptions::new().create(true).append(true).open(path);
        let file = opened.map_err(|error| at(&format!("cannot write: {error}")))?;
        if cut {
            file.set_len(whole as u64)?;
        }
        let mut writer = csv::WriterBuilder::new().has_headers(false).from_writer(file);
        if whole == 0 {
            writer.write_record(HEADER)?;
            writer.flush()?;
        }
        Ok((Self { writer }, rows, others))
    }

    pub(super) fn append(&mut self, scene: &ChartedScene, key: &Key, row: &Measurement) -> Result<(), Box<dyn Error>> {
        let (cost, [width, height]) = (row.cost(&scene.reference, Clock::Wall), scene.size);
        let derived: Derived = (width, height, scene.reference.error, cost.mse, cost.relative);
        self.writer.serialize((Subject::new(scene, key), row, derived))?;
        self.writer.flush()?;
        Ok(())
    }
}

/// Reads the lines of a table that belong to a plan, and counts the others.
fn read(text: &str, plan: &Plan) -> Result<(Rows, usize), String> {
    let mut reader = csv::ReaderBuilder::new().flexible(true).from_reader(text.as_bytes());
    if reader.headers().map_err(|error| error.to_string())?.iter().ne(HEADER) {
        return Err("line 1 is not the header of a table of measurements; choose another folder with -o".to_owned());
    }
    let (mut rows, mut others, mut seen) = (Rows::new(), 0, HashSet::new());
    for record in reader.records() {
        let record = record.map_err(|error| error.to_string())?;
        let number = record.position().map_or(0, csv::Position::line);
        if record.len() != HEADER.len() {
            return Err(format!("line {number} has {} values instead of {}", record.len(), HEADER.len()));
        }
        let invalid = |column: usize| format!("line {number}: {:?} is not a valid {}", &record[column], HEADER[column]);
        let (subject, row, _): (Subject, Measurement, Derived) = record.deserialize(None).map_err(|error| {
            let field = match error.kind() {
                csv::ErrorKind::Deserialize { err, .. } => err.field(),
                _ => None,
            };
            field.map_or_else(|| error.to_string(), |field| invalid(field as usize))
        })?;
        let is_infinite = |column: &usize| record[*column].parse::<f64>().is_ok_and(|x| !x.is_finite());
        // a scene may have such a name
        if let Some(column) = (2..record.len()).find(is_infinite) {
            return Err(invalid(column));
        }
        match subject.key(plan) {
            Some(key) if row.replicate < plan.replicates && seen.insert((key, row.replicate)) => {
                rows.entry(key).or_default().push(row);
            }
            _ => others += 1,
        }
    }
    for rows in rows.values_mut() {
        rows.sort_by_key(|r| r.replicate);
    }
    Ok((rows, others))
}
