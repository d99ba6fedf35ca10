//! Questions and answers as files of numbers (`.npy`), for samplers that are not called from here: shaders, and Python.
//!
//! [`ask`] writes, for S places, float32 each: `light.npy` (S, numbers of the light as in the C header), `point.npy` (S, 3), `normal.npy`
//! (S, 3), `u.npy` (S, M, 2) and `direction.npy` (S, D, 3). The answers are `sample.npy` (S, M, 4), which has directions and their pdf, or
//! zeros where nothing is drawn, and, unless it was asked with `--no-pdf`, `pdf.npy` (S, D); float32 or float64. Besides, `evaluated.npy` (S, E ≤ M) may have the pdf of the first
//! E samples' directions, and `hidden.npy` (S, M) numbers that are not 0 where the light itself hides the sample.

use crate::area_lights::{LightShape, Measure};
use crate::lights::definition::Definition;
use crate::lights::figures::Trial;
use crate::lights::observe::{Answers, Questions};
use crate::lights::sampler::{Lacks, Sample, measure_name, measure_of, shape_name, shape_of};
use crate::lights::scene::{JudgedPlace, places};
use crate::lights::verdict::{self, Case, Judgement};
use std::fs;
use std::path::Path;

/// An array of numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    /// Lengths of the axes.
    pub shape: Vec<usize>,
    /// The numbers, the last axis first.
    pub numbers: Vec<f32>,
}

impl Array {
    /// Writes a version-1 file of little-endian float32.
    ///
    /// # Errors
    /// Fails if it cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), String> {
        let lengths: String = self.shape.iter().map(|n| format!("{n}, ")).collect();
        let mut header = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}), }}", lengths.trim_end());
        // the numbers begin at a multiple of 64
        while (10 + header.len() + 1) % 64 != 0 {
            header.push(' ');
        }
        header.push('\n');
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((header.len() as u16).to_le_bytes());
        bytes.extend(header.as_bytes());
        bytes.extend(self.numbers.iter().flat_map(|x| x.to_le_bytes()));
        fs::write(path, bytes).map_err(|e| format!("{}: {e}", path.display()))
    }
    /// Reads a file of float32 or float64.
    ///
    /// # Errors
    /// Fails if it is none.
    pub fn read(path: &Path) -> Result<Self, String> {
        let bytes = fs::read(path).map_err(|e| format!("{}: {e}", path.display()))?;
        Self::parse(&bytes).map_err(|e| format!("{}: {e}", path.display()))
    }
    /// The array of a file's bytes.
    ///
    /// # Errors
    /// Fails if they are none.
    pub fn parse(bytes: &[u8]) -> Result<Self, String> {
        if bytes.len() < 12 || &bytes[..6] != b"\x93NUMPY" {
            return Err("is no .npy file".into());
        }
        let (start, length) = match bytes[6] {
            1 => (10, usize::from(u16::from_le_bytes([bytes[8], bytes[9]]))),
            2 | 3 => (12, u32::from_le_bytes([bytes[8], bytes[9], bytes[10], bytes[11]]) as usize),
            version => return Err(format!("version {version} of .npy is unknown")),
        };
        let header = bytes.get(start..start + length).ok_or("ends within its header")?;
        let header = core::str::from_utf8(header).map_err(|_| "its header is no text")?;
        let after = |key: &str| header.split_once(key).map(|s| s.1.trim_start_matches([':', ' ']));
        let kind = after("'descr'").unwrap_or_default();
        let size = match kind.get(..5) {
            Some("'<f4'") => 4,
            Some("'<f8'") => 8,
            _ => return Err(format!("has numbers of the type {kind:.12}, not float32 or float64")),
        };
        if !after("'fortran_order'").is_some_and(|order| order.starts_with("False")) {
            return Err("is in Fortran order: write np.ascontiguousarray(…)".into());
        }
        let shape = after("'shape'").and_then(|s| s.strip_prefix('(')?.split_once(')')).ok_or("has no shape")?.0;
        let lengths = shape.split(',').map(str::trim).filter(|n| !n.is_empty()).map(str::parse);
        let shape: Vec<usize> = lengths.collect::<Result<_, _>>().map_err(|_| format!("has the shape ({shape})"))?;
        let numbers = &bytes[start + length..];
        let count = shape.iter().try_fold(size, |all: usize, n| all.checked_mul(*n));
        if count != Some(numbers.len()) {
            return Err(format!("has {} bytes of numbers, not those of the shape {shape:?}", numbers.len()));
        }
        let number = |b: &[u8]| match b.try_into() {
            Ok(four) => f32::from_le_bytes(four),
            Err(_) => f64::from_le_bytes(core::array::from_fn(|i| b[i])) as f32,
        };
        Ok(Self { shape, numbers: numbers.chunks_exact(size).map(number).collect() })
    }
    fn expect(&self, path: &Path, shape: &[usize]) -> Result<(), String> {
        let is_right = self.shape == shape;
        is_right
            .then_some(())
            .ok_or_else(|| format!("{}: the shape is {:?}, not {shape:?}", path.display(), self.shape))
    }
}

/// What is asked.
#[derive(Clone, Debug)]
pub struct Asked {
    /// What the sampler declares that it does not have.
    pub lacks: Lacks,
    name: String,
    shape: LightShape,
    by: Measure,
    quick: bool,
    seed: u64,
}
/// Directions outside of the light for each place; fewer if there are no more, and then the first ones again.
const OUTSIDE: usize = 24;

impl Asked {
    /// From names.
    ///
    /// # Errors
    /// Fails if there is no such shape or measure.
    pub fn new(name: &str, shape: &str, measure: &str, quick: bool, seed: u64) -> Result<Self, String> {
        let (shape, by) = (shape_of(shape)?, measure_of(measure)?);
        Ok(Self { lacks: Lacks::default(), name: name.into(), shape, by, quick, seed })
    }
    /// All places, what the light looks like from them, and what is asked there.
    #[must_use]
    pub fn places(&self) -> Vec<(JudgedPlace, Definition, Questions)> {
        let of = |place: JudgedPlace| {
            let seen = Definition::new(&place.light)?;
            let questions = Questions::new(&seen, self.by, self.quick, self.seed);
            Some((place, seen, questions))
        };
        places(self.shape, self.by, self.quick, self.seed).into_iter().filter_map(of).collect()
    }
    fn text(&self) -> String {
        let Self { name, quick, seed, .. } = self;
        let (shape, measure) = (shape_name(self.shape), measure_name(self.by));
        let Lacks { map, pdf } = self.lacks;
        serde_json::json!({
            "abi": 2, "name": name, "shape": shape, "measure": measure, "quick": quick, "seed": seed, "generator": map, "no pdf": pdf
        })
        .to_string()
    }
    fn read(path: &Path) -> Result<Self, String> {
        let said = |e: &dyn core::fmt::Display| format!("{}: {e}", path.display());
        let text = fs::read_to_string(path).map_err(|e| said(&e))?;
        let all: serde_json::Value = serde_json::from_str(&text).map_err(|e| said(&e))?;
        if all["abi"] != 2 {
            return Err(said(&"other versions asked this: ask again"));
        }
        let text = |key: &str| all[key].as_str().unwrap_or_default().to_owned();
        let seed = all["seed"].as_u64().ok_or_else(|| said(&"has no seed"))?;
        let asked = Self::new(&text("name"), &text("shape"), &text("measure"), all["quick"] == true, seed);
        let lacks = Lacks { map: all["generator"] == true, pdf: all["no pdf"] == true };
        asked.map(|asked| Self { lacks, ..asked }).map_err(|e| said(&e))
    }
}

/// Writes the questions.
///
/// # Errors
/// Fails if a file cannot be written.
pub fn ask(folder: &Path, asked: &Asked) -> Result<(), String> {
    fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let all = asked.places();
    let write = |name: &str, shape: &[usize], numbers: Vec<f32>| {
        Array { shape: [&[all.len()], shape].concat(), numbers }.write(&folder.join(name))
    };
    let lights: Vec<f32> = all.iter().flat_map(|a| verdict::numbers(&a.0.light)).collect();
    write("light.npy", &[lights.len() / all.len()], lights)?;
    write("point.npy", &[3], all.iter().flat_map(|a| a.0.light.p).collect())?;
    write("normal.npy", &[3], all.iter().flat_map(|a| a.0.light.n).collect())?;
    let first = &all[0].2;
    let us = all.iter().flat_map(|a| a.2.us.iter().flatten().copied()).collect();
    write("u.npy", &[first.us.len(), 2], us)?;
    let padded = |q: &Questions| -> Vec<[f32; 3]> {
        let outside = (0..OUTSIDE).map(|i| *q.outside.get(i).unwrap_or(&q.directions[i]));
        q.directions.iter().copied().chain(outside).collect()
    };
    let directions: Vec<f32> = all.iter().flat_map(|a| padded(&a.2).into_iter().flatten()).collect();
    write("direction.npy", &[first.directions.len() + OUTSIDE, 3], directions)?;
    fs::write(folder.join("asked.json"), asked.text()).map_err(|e| format!("{}: {e}", folder.display()))
}

/// Judges the answers.
///
/// # Errors
/// Fails if a file is missing or has another shape.
pub fn judge(folder: &Path) -> Result<Judgement, String> {
    let start = std::time::Instant::now();
    let asked = Asked::read(&folder.join("asked.json"))?;
    let all = asked.places();
    let (m, d) = (all[0].2.us.len(), all[0].2.directions.len() + OUTSIDE);
    let read = |name: &str, shape: &[usize]| {
        let path = folder.join(name);
        let array = Array::read(&path)?;
        array.expect(&path, shape).map(|()| array.numbers)
    };
    let samples = read("sample.npy", &[all.len(), m, 4])?;
    let has = |name: &str| folder.join(name).exists();
    let pdfs = if asked.lacks.pdf { None } else { Some(read("pdf.npy", &[all.len(), d])?) };
    let hidden = if has("hidden.npy") { read("hidden.npy", &[all.len(), m])? } else { vec![0.0; all.len() * m] };
    let evaluated = if has("evaluated.npy") && !asked.lacks.pdf {
        let path = folder.join("evaluated.npy");
        let array = Array::read(&path)?;
        let e = array.shape.get(1).copied().unwrap_or(0).min(m);
        array.expect(&path, &[all.len(), e])?;
        (e, array.numbers)
    } else {
        (0, Vec::new())
    };
    let mut cases = Vec::new();
    for (i, (place, seen, questions)) in all.iter().enumerate() {
        let sample = |k: usize| {
            let at = 4 * (i * m + k);
            let [x, y, z, pdf] = core::array::from_fn(|c| samples[at + c]);
            (pdf != 0.0).then_some(Sample { direction: [x, y, z], pdf, is_hidden: hidden[i * m + k] != 0.0 })
        };
        let (n, outside) = (questions.directions.len(), questions.outside.len().min(OUTSIDE));
        let of_place = pdfs.as_ref().map_or(&[][..], |pdfs| &pdfs[i * d..(i + 1) * d]);
        let answers = Answers {
            samples: (0..m).map(sample).collect(),
            evaluated: evaluated.1[i * evaluated.0..(i + 1) * evaluated.0].to_vec(),
            pdfs: of_place[..n.min(of_place.len())].to_vec(),
            outside: of_place.get(n..n + outside).unwrap_or_default().to_vec(),
            ..Answers::default()
        };
        let figures = Trial { seen, by: asked.by, lacks: asked.lacks, questions, answers: &answers }.figures();
        cases.push(Case { axis: place.axis, value: place.value, figures });
    }
    let input = |figure, at: usize| {
        let light = verdict::text(&all[at].0.light);
        let measured = cases[at].figures.iter().find(|f| f.figure == figure);
        format!("{light}\nplace {at}: {}", measured.map_or("", |f| &f.at))
    };
    let (shape, measure) = (shape_name(asked.shape), measure_name(asked.by));
    let findings = verdict::findings(&cases, input);
    let seconds = start.elapsed().as_secs_f64();
    Ok(Judgement { seconds, ..Judgement::new(&asked.name, shape, measure, cases, findings) })
}
