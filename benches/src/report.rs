//! What a benchmark measured, as JSON, and its comparison with an earlier run.

use serde_json::{Value, json};
use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Measured values by id, which is in the manner of Criterion: the benchmark, its function and its parameter.
pub struct Report {
    json: Option<PathBuf>,
    baseline: Option<Baseline>,
    rows: Vec<Value>,
}

/// The values of an earlier run, by their id and unit.
struct Baseline(HashMap<[String; 2], Vec<f64>>);

impl Report {
    /// Takes `--json=FILE` and `--baseline=FILE` out of the program's arguments, and cargo's `--bench`; returns the other arguments.
    ///
    /// # Errors
    /// If the baseline is not what `--json=FILE` writes.
    pub fn from_arguments() -> Result<(Self, Vec<String>), String> {
        let (mut report, mut rest) = (Self { json: None, baseline: None, rows: Vec::new() }, Vec::new());
        for argument in std::env::args().skip(1).filter(|argument| argument != "--bench") {
            match argument.split_once('=') {
                Some(("--json", path)) => report.json = Some(path.into()),
                Some(("--baseline", path)) => report.baseline = Some(Baseline::read(Path::new(path))?),
                _ => rest.push(argument),
            }
        }
        Ok((report, rest))
    }
    /// Adds the values of repetitions in a unit, and whatever else is known as fields of `more`.
    pub fn add(&mut self, id: &str, unit: &str, values: &[f64], more: Value) {
        let mut row = json!({ "id": id, "unit": unit, "values": values });
        if let (Value::Object(row), Value::Object(more)) = (&mut row, more) {
            row.extend(more);
        }
        self.rows.push(row);
    }
    /// Writes the file, and prints what differs from the baseline.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn finish(self) -> Result<(), String> {
        if let Some(baseline) = &self.baseline {
            baseline.compare(&values(&self.rows).unwrap_or_default());
        }
        let Some(path) = self.json else { return Ok(()) };
        // a row is a line
        let rows: Vec<String> = self.rows.iter().map(Value::to_string).collect();
        fs::write(&path, format!("[\n{}\n]\n", rows.join(",\n")))
            .map_err(|error| format!("{}: {error}", path.display()))
    }
}

/// Ids with units and values of rows, in their order; `None` if a row lacks one of them.
fn values(rows: &[Value]) -> Option<Vec<([String; 2], Vec<f64>)>> {
    let row = |row: &Value| {
        let values: Option<Vec<f64>> = row["values"].as_array()?.iter().map(Value::as_f64).collect();
        let key = [row["id"].as_str()?.to_owned(), row["unit"].as_str()?.to_owned()];
        Some((key, values.filter(|all| !all.is_empty())?))
    };
    rows.iter().map(row).collect()
}

impl Baseline {
    fn read(path: &Path) -> Result<Self, String> {
        let fault = |what: &dyn std::fmt::Display| format!("{}: {what}", path.display());
        let text = fs::read_to_string(path).map_err(|error| fault(&error))?;
        let rows: Vec<Value> = serde_json::from_str(&text).map_err(|error| fault(&error))?;
        let rows = values(&rows).ok_or_else(|| fault(&"not what --json=FILE writes"))?;
        Ok(Self(rows.into_iter().collect()))
    }
    /// Prints the ratios whose interval leaves out 1.
    fn compare(&self, rows: &[([String; 2], Vec<f64>)]) {
        let (mut same, mut missing) = (0, 0);
        println!("\n| | over the baseline | 95 % |\n|---|---|---|");
        for (key, values) in rows {
            let Some(before) = self.0.get(key) else {
                missing += 1;
                continue;
            };
            let [least, ratio, most] = ratio(values, before);
            if least > 1.0 || most < 1.0 {
                println!("| {} | {ratio:.4} | {least:.4} to {most:.4} |", key[0]);
            } else {
                same += 1;
            }
        }
        println!("\n{same} others do not differ; {missing} are not in the baseline.");
    }
}

/// The ratio of two samples of values, between the ends of an interval of 95 %: the median of the ratios of all pairs, after Hodges and
/// Lehmann, and those as far from it as the rank sum of Mann and Whitney strays. It supposes no distribution.
fn ratio(after: &[f64], before: &[f64]) -> [f64; 3] {
    let mut ratios: Vec<f64> = after.iter().flat_map(|a| before.iter().map(move |b| a / b)).collect();
    ratios.sort_by(f64::total_cmp);
    let (n, m) = (after.len() as f64, before.len() as f64);
    let strays = 1.96 * (n * m * (n + m + 1.0) / 12.0).sqrt();
    let outside = ((0.5 * n * m - strays).max(0.0) as usize).min((ratios.len() - 1) / 2);
    [outside, ratios.len() / 2, ratios.len() - 1 - outside].map(|rank| ratios[rank])
}
