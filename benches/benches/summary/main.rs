//! The time per sample of every routine in f32, f32x4, f32x8 and f32x16, with the speed-ups of eight lanes over one and of sixteen over
//! eight.
//!
//! `cargo bench -p etendue-benches --bench summary -- cone` selects routines by name. `-- --instructions` counts instructions instead
//! (requires Valgrind). `-- --json=FILE` writes all values, `-- --baseline=FILE` compares with those of an earlier run; paths are from this
//! package's folder.
//!
//! `-- --results` writes the times to `benches/RESULTS.md`. `routines/tests/results.rs` fails where that has no row of a light, or one of no
//! routine.
//!
//! Figures are medians of repetitions. The widths take turns, so that a change of the processor's clock affects all of them alike.

mod instructions;

use etendue::{f32x4, f32x8, f32x16};
use etendue_benches::report::Report;
use etendue_laboratory::cost::{self, Rounds};
use etendue_routines::{SAMPLES, routines};
use instructions::WIDTHS;
use serde_json::Value;
use std::fmt::Write;
use std::fs;
use std::process::ExitCode;

const REPETITIONS: usize = 31;
/// The calls of a round take a few hundred microseconds.
const ROUNDS: Rounds = Rounds { count: REPETITIONS, calls: 64, samples: SAMPLES };
const RESULTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/RESULTS.md");
/// Names of the widths.
const NAMES: [&str; WIDTHS] = ["f32", "f32x4", "f32x8", "f32x16"];

/// Prints a row, and adds it to the report; the last columns are the speed-ups of eight lanes over one, and of sixteen over eight.
fn row(report: &mut Report, unit: &str, name: &str, values: [&[f64]; WIDTHS]) -> [f64; WIDTHS] {
    for (width, values) in NAMES.into_iter().zip(values) {
        report.add(&format!("summary/{name}/{width}"), unit, values, Value::Null);
    }
    let medians @ [one, four, eight, sixteen] = values.map(cost::median);
    let (gain, further) = (one / eight, eight / sixteen);
    println!("{name:38} {one:8.2} {four:8.2} {eight:8.2} {sixteen:8.2} {gain:7.1} {further:7.2}");
    medians
}

fn run() -> Result<(), String> {
    let (mut report, arguments) = Report::from_arguments()?;
    let (mut filter, mut flags) = ("", Vec::new());
    for argument in &arguments {
        match argument.as_str() {
            flag @ (instructions::CHILD | "--instructions" | "--results") => flags.push(flag),
            word if !word.starts_with('-') => filter = word,
            _ => {
                let known = "--instructions, --results, --json=FILE and --baseline=FILE";
                return Err(format!("{argument}: not one of {known}"));
            }
        }
    }
    if flags.contains(&instructions::CHILD) {
        instructions::child(filter);
        return Ok(());
    }
    let counted = flags.contains(&"--instructions");
    let what = if counted { "instructions/sample" } else { "ns/sample, median" };
    let [one, four, eight, sixteen] = NAMES;
    println!("{what:38} {one:>8} {four:>8} {eight:>8} {sixteen:>8} {:>7} {:>7}", "x1/x8", "x8/x16");
    if counted {
        for (name, counts) in instructions::count(filter)? {
            row(&mut report, "instructions per sample", &name, counts.each_ref().map(std::slice::from_ref));
        }
        return report.finish();
    }
    let mut results = String::new();
    let [one, four, eight] = [routines::<f32>(), routines::<f32x4>(), routines::<f32x8>()];
    let widths = one.into_iter().zip(four).zip(eight).zip(routines::<f32x16>());
    for (((one, four), eight), sixteen) in widths.filter(|(((one, ..), _), _)| one.name.contains(filter)) {
        let name = one.name;
        let mut each = [one.run, four.run, eight.run, sixteen.run];
        let times_of = cost::measure(&mut each, ROUNDS, |_| true);
        let times = row(&mut report, "ns per sample", &name, std::array::from_fn(|k| &times_of[k][..]));
        let cells = times.map(|time| if time < 10.0 { format!("{time:.2}") } else { format!("{time:.1}") });
        let _ = writeln!(results, "| {name} | {} |", cells.join(" | "));
    }
    if flags.contains(&"--results") {
        write(&results)?;
    }
    report.finish()
}

/// Replaces what [`RESULTS`] has from its line of the processor on.
fn write(rows: &str) -> Result<(), String> {
    let failed = |e: std::io::Error| format!("{RESULTS}: {e}");
    let text = fs::read_to_string(RESULTS).map_err(failed)?;
    let (head, _) = text.split_once("On ").ok_or_else(|| format!("{RESULTS}: no line of the processor"))?;
    let processor = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let processor = processor.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    let processor = processor.map_or("an unnamed processor", |(_, name)| name);
    let flags = if cfg!(target_feature = "fma") { "x86-64-v3" } else { "x86-64 without flags" };
    let header = format!("| routine | {} |\n|---|---|---|---|---|\n", NAMES.join(" | "));
    fs::write(RESULTS, format!("{head}On {processor}, {flags}.\n\n{header}{rows}")).map_err(failed)
}

fn main() -> ExitCode {
    etendue_benches::exit_code(run())
}
