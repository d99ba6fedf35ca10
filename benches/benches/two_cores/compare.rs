//! Compares times with those of an earlier run.

use serde_json::Value;
use std::collections::HashMap;
use std::fs;
use std::path::Path;

/// The times of an earlier run.
pub(crate) struct Baseline {
    seconds: HashMap<String, Vec<f64>>,
}

impl Baseline {
    /// Reads what `--json=FILE` wrote.
    pub(crate) fn read(path: &Path) -> Result<Self, String> {
        let fault = |what: &dyn std::fmt::Display| format!("{}: {what}", path.display());
        let text = fs::read_to_string(path).map_err(|error| fault(&error))?;
        let rows: Value = serde_json::from_str(&text).map_err(|error| fault(&error))?;
        let row = |row: &Value| {
            let seconds: Option<Vec<f64>> = row["seconds"].as_array()?.iter().map(Value::as_f64).collect();
            Some((row["id"].as_str()?.to_owned(), seconds.filter(|all| !all.is_empty())?))
        };
        let seconds = rows.as_array().and_then(|rows| rows.iter().map(row).collect());
        Ok(Self { seconds: seconds.ok_or_else(|| fault(&"not what --json=FILE writes"))? })
    }
    /// A row of the table: the ratio and its interval, in bold where the interval leaves out 1.
    pub(crate) fn row(&self, id: &str, seconds: &[f64]) -> String {
        let Some(before) = self.seconds.get(id) else { return format!("| {id} | not in the baseline | |") };
        let [least, ratio, most] = ratio(seconds, before);
        let bold = if least > 1.0 || most < 1.0 { "**" } else { "" };
        format!("| {id} | {bold}{ratio:.3}{bold} | {least:.3} to {most:.3} |")
    }
}

/// The ratio of two samples of times, between the ends of an interval of 95 %: the median of the ratios of all pairs, after Hodges and
/// Lehmann, and those as far from it as the rank sum of Mann and Whitney strays. It supposes no distribution.
fn ratio(after: &[f64], before: &[f64]) -> [f64; 3] {
    let mut ratios: Vec<f64> = after.iter().flat_map(|a| before.iter().map(move |b| a / b)).collect();
    ratios.sort_by(f64::total_cmp);
    let (n, m) = (after.len() as f64, before.len() as f64);
    let strays = 1.96 * (n * m * (n + m + 1.0) / 12.0).sqrt();
    let outside = ((0.5 * n * m - strays).max(0.0) as usize).min((ratios.len() - 1) / 2);
    [outside, ratios.len() / 2, ratios.len() - 1 - outside].map(|rank| ratios[rank])
}
