//! A program with its inputs and what Rust returns, and how a device differs from it.

use std::error::Error;
use std::fs;
use std::path::Path;

/// A program of the tests of `etendue-shader`.
pub(crate) struct Case {
    pub(crate) name: String,
    pub(crate) wgsl: String,
    pub(crate) spirv: Vec<u32>,
    /// The same with each `fma` written out, so that it rounds once wherever sums and products are exact.
    pub(crate) exact: Vec<u32>,
    /// The operations of its functions.
    pub(crate) operations: usize,
    /// What each output is: the field of a result.
    places: Vec<String>,
    pub(crate) count: usize,
    pub(crate) inputs: Vec<u8>,
    /// The words that functions read; 16 zeros if they read none, as buffers are not empty.
    pub(crate) memory: Vec<u8>,
    pub(crate) right: Vec<f32>,
}

impl Case {
    /// The case whose source in WGSL this is.
    pub(crate) fn read(path: &Path) -> Result<Self, Box<dyn Error>> {
        let wrong = |path: &Path, what: &str| format!("{}: {what}", path.display());
        let text = |path: &Path| fs::read_to_string(path).map_err(|error| wrong(path, &error.to_string()));
        let (wgsl, about) = (text(path)?, path.with_extension("txt"));
        let lines = text(&about)?;
        let (operations, places) = lines.split_once('\n').ok_or_else(|| wrong(&about, "no second line"))?;
        let operations = operations.parse().map_err(|_| wrong(&about, "line 1 is no number of operations"))?;
        let places: Vec<String> = places.lines().map(str::to_owned).collect();
        let words = |path: &Path| {
            let bytes = fs::read(path).map_err(|error| wrong(path, &error.to_string()))?;
            Ok::<Vec<u32>, String>(bytes.as_chunks().0.iter().map(|word| u32::from_le_bytes(*word)).collect())
        };
        let (spirv, exact) = (words(&path.with_extension("spv"))?, words(&path.with_extension("exact.spv"))?);
        let path = path.with_extension("bin");
        let words = words(&path)?;
        let Some((&[count, takes, gives, memory], rest)) = words.split_first_chunk() else {
            return Err(wrong(&path, "too short").into());
        };
        let [count, takes, gives, memory] = [count, takes, gives, memory].map(|k| k as usize);
        if gives != places.len() || count == 0 || rest.len() != memory + count * (takes + gives) {
            return Err(wrong(&path, &format!("{} words, which are not {count} inputs", rest.len())).into());
        }
        let bytes = |words: &[u32]| words.iter().flat_map(|word| word.to_ne_bytes()).collect::<Vec<u8>>();
        let (memory, rest) = rest.split_at(memory);
        let (inputs, right) = rest.split_at(count * takes);
        Ok(Self {
            name: path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
            wgsl,
            spirv,
            exact,
            operations,
            places,
            count,
            inputs: bytes(inputs),
            memory: if memory.is_empty() { vec![0; 16] } else { bytes(memory) },
            right: right.iter().map(|bits| f32::from_bits(*bits)).collect(),
        })
    }
    /// How what a device returns differs.
    pub(crate) fn difference(&self, found: &[f32]) -> Difference {
        let mut of = Difference { numbers: self.right.len(), ..Difference::default() };
        for (k, (&right, &found)) in self.right.iter().zip(found).enumerate() {
            let place = self.places[k % self.places.len()].as_str();
            let is_pdf = place.starts_with("pdf") || place.ends_with("pdf");
            let relative = is_pdf || place.ends_with(".weight") || place.ends_with(".distance");
            of.nan += usize::from(found.is_nan() && !right.is_nan());
            of.pdf_for_none += usize::from(is_pdf && right == 0.0 && found != 0.0);
            if found.to_bits() == right.to_bits() || found.is_nan() && right.is_nan() {
                of.same += 1;
            } else if found.is_finite() && right.is_finite() {
                let difference = (f64::from(found) - f64::from(right)).abs();
                let scale = if relative { f64::from(right).abs().max(f64::from(f32::MIN_POSITIVE)) } else { 1.0 };
                of.errors.push(difference / scale * 16_777_216.0);
            } else {
                of.errors.push(f64::INFINITY);
            }
        }
        of.errors.sort_by(f64::total_cmp);
        of
    }
}

/// How a device differs from Rust.
#[derive(Default)]
pub(crate) struct Difference {
    pub(crate) numbers: usize,
    /// How many numbers have the same bits.
    pub(crate) same: usize,
    /// The others in units of 2^-24, in ascending order: relative those of densities, weights and distances, absolute all others.
    errors: Vec<f64>,
    /// How many are NaN where those of Rust are not.
    pub(crate) nan: usize,
    /// How many densities are not 0 where those of Rust are.
    pub(crate) pdf_for_none: usize,
}

impl Difference {
    /// The error that this fraction of all numbers does not exceed, in units of 2^-24.
    pub(crate) fn quantile(&self, fraction: f64) -> f64 {
        let rank = (fraction * self.numbers as f64).ceil() as usize;
        rank.checked_sub(self.same + 1).map_or(0.0, |k| self.errors[k])
    }
}
