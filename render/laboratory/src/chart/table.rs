//! The CSV file of measurements, from which a later run goes on.

use super::measure::{ChartedScene, Key, Plan, Row, Rows};
use super::reference::Difference;
use etendue_render::{ChoiceBy, RayCount, Sampler, Technique};
use serde::{Deserialize, Serialize};
use std::collections::HashSet;
use std::error::Error;
use std::fs::{File, OpenOptions};
use std::path::Path;

/// A line of the table. All means are over pixels and channels.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Line {
    /// Hash of the circumstances, in hexadecimal digits.
    settings: String,
    scene: String,
    technique: Technique,
    choice: ChoiceBy,
    sampler: Sampler,
    /// Pixels across.
    width: u32,
    /// Pixels down.
    height: u32,
    /// Samples per pixel.
    spp: u32,
    replicate: u32,
    seed: u64,
    /// Wall time of an image.
    seconds: f64,
    /// Time of all threads together for an image, where the system tells.
    cpu_seconds: Option<f64>,
    repeats: u32,
    mse_with_reference_error: f64,
    reference_error: f64,
    mse: f64,
    relative_mse_with_reference_error: f64,
    relative_mse: f64,
    mean_difference: f64,
    camera_rays: u64,
    mirror_rays: u64,
    shadow_rays: u64,
    corner_rays: u64,
}

/// The names of the columns.
const HEADER: [&str; 23] = [
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
    "cpu_seconds",
    "repeats",
    "mse_with_reference_error",
    "reference_error",
    "mse",
    "relative_mse_with_reference_error",
    "relative_mse",
    "mean_difference",
    "camera_rays",
    "mirror_rays",
    "shadow_rays",
    "corner_rays",
];

impl Line {
    fn new(subject: &ChartedScene, key: &Key, row: &Row) -> Self {
        let cost = row.cost(&subject.reference);
        Self {
            settings: format!("{:016x}", subject.settings),
            scene: subject.name.clone(),
            technique: key.technique,
            choice: key.choice,
            sampler: key.sampler,
            width: subject.size[0],
            height: subject.size[1],
            spp: key.spp,
            replicate: row.replicate,
            seed: row.seed,
            seconds: row.seconds,
            cpu_seconds: row.cpu,
            repeats: row.repeats,
            mse_with_reference_error: row.difference.squared,
            reference_error: subject.reference.error,
            mse: cost.mse,
            relative_mse_with_reference_error: row.difference.relative,
            relative_mse: cost.relative,
            mean_difference: row.difference.mean,
            camera_rays: row.rays.camera,
            mirror_rays: row.rays.mirror,
            shadow_rays: row.rays.shadow,
            corner_rays: row.rays.corner,
        }
    }

    fn row(&self) -> Row {
        let [squared, relative] = [self.mse_with_reference_error, self.relative_mse_with_reference_error];
        Row {
            replicate: self.replicate,
            seed: self.seed,
            seconds: self.seconds,
            cpu: self.cpu_seconds,
            repeats: self.repeats,
            difference: Difference { squared, relative, mean: self.mean_difference },
            rays: RayCount {
                camera: self.camera_rays,
                mirror: self.mirror_rays,
                shadow: self.shadow_rays,
                corner: self.corner_rays,
            },
        }
    }

    /// The key of a plan that the line belongs to, if there is one.
    fn key(&self, plan: &Plan) -> Option<Key> {
        let belongs = |s: &ChartedScene| s.name == self.scene && format!("{:016x}", s.settings) == self.settings;
        let scene = plan.scenes.iter().position(belongs)?;
        let Self { technique, choice, sampler, spp, .. } = *self;
        let key = Key { scene, technique, choice, sampler, spp };
        (self.replicate < plan.replicates && plan.keys.contains(&key)).then_some(key)
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

    pub(super) fn append(&mut self, subject: &ChartedScene, key: &Key, row: &Row) -> Result<(), Box<dyn Error>> {
        self.writer.serialize(Line::new(subject, key, row))?;
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
        let line: Line = record.deserialize(None).map_err(|error| match error.kind() {
            csv::ErrorKind::Deserialize { err, .. } => {
                err.field().map_or_else(|| error.to_string(), |n| invalid(n as usize))
            }
            _ => error.to_string(),
        })?;
        let infinite = |value: &str| value.parse::<f64>().is_ok_and(|x| !x.is_finite());
        // names of scenes are no numbers
        if let Some(column) = (2..record.len()).find(|column| infinite(&record[*column])) {
            return Err(invalid(column));
        }
        match line.key(plan) {
            Some(key) if seen.insert((key, line.replicate)) => rows.entry(key).or_default().push(line.row()),
            _ => others += 1,
        }
    }
    for rows in rows.values_mut() {
        rows.sort_by_key(|r| r.replicate);
    }
    Ok((rows, others))
}
