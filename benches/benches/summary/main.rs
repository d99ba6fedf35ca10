//! Two tables: the time per sample of every routine in f32, f32x4, f32x8 and f32x16, with the speed-ups of eight lanes over one and of
//! sixteen over eight; and rays per second on one thread.
//!
//! `cargo bench -p etendue-benches --bench summary -- cone` selects routines by name, `-- rays` the second table. `-- --instructions` counts
//! instructions instead (requires Valgrind). `-- --json=FILE` writes all values, `-- --baseline=FILE` compares with those of an earlier run;
//! paths are from this package's folder.
//!
//! `-- --tables` writes the tables of costs and errors in the README and the documentation. `routines/tests/tables.rs` fails where their
//! rows and the routines differ.
//!
//! Figures are medians of repetitions. The widths take turns, so that a change of the processor's clock affects all of them alike.

mod instructions;

use etendue::{f32x4, f32x8, f32x16};
use etendue_benches::report::Report;
use etendue_laboratory::cost::{self, Rounds};
use etendue_render::bvh::Scratch;
use etendue_routines::rays::{How, RayKind, Workload};
use etendue_routines::{SAMPLES, routines, tables};
use instructions::WIDTHS;
use serde_json::{Value, json};
use std::collections::HashMap;
use std::hint::black_box;
use std::process::ExitCode;
use std::time::Instant;

const REPETITIONS: usize = 31;
/// The calls of a round take a few hundred microseconds.
const ROUNDS: Rounds = Rounds { count: REPETITIONS, calls: 64, samples: SAMPLES };
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
            flag @ (instructions::CHILD | "--instructions" | "--tables") => flags.push(flag),
            word if !word.starts_with('-') => filter = word,
            _ => {
                let known = "--instructions, --tables, --json=FILE and --baseline=FILE";
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
    let mut times = HashMap::new();
    let [one, four, eight] = [routines::<f32>(), routines::<f32x4>(), routines::<f32x8>()];
    let widths = one.into_iter().zip(four).zip(eight).zip(routines::<f32x16>());
    for (((one, four), eight), sixteen) in widths.filter(|(((one, ..), _), _)| one.name.contains(filter)) {
        let name = one.name;
        let mut each = [one.run, four.run, eight.run, sixteen.run];
        let times_of = cost::measure(&mut each, ROUNDS, |_| true);
        let [one, four, eight, _] = row(&mut report, "ns per sample", &name, std::array::from_fn(|k| &times_of[k][..]));
        times.insert(name, [one, four, eight]);
    }
    if flags.contains(&"--tables") {
        tables::write(&tables::Measured::new(times)?)?;
    } else if "rays".contains(filter) {
        rays(&mut report);
    }
    report.finish()
}

fn main() -> ExitCode {
    etendue_benches::exit_code(run())
}

/// Prints the fraction of hits too. It is the same for all ways, except that obvhs lets some rays through at edges.
fn rays(report: &mut Report) {
    println!("\n{:32} {:>15} {:>9} {:>9} {:>9}", "million rays/s, median", "obvhs, per ray", "single", "groups", "hit");
    for scene in ["quads", "terrain"] {
        let workload = Workload::new(scene, 512);
        let mut stack = Scratch::default();
        for (kind, name) in RayKind::ALL {
            let (rays, mut hit) = (workload.rays(kind), 0);
            let mut times = How::ALL.map(|_| Vec::new());
            for _ in 0..REPETITIONS {
                for ((how, _), times) in How::ALL.into_iter().zip(&mut times) {
                    let start = Instant::now();
                    hit = black_box(workload.trace(kind, how, &mut stack));
                    times.push(start.elapsed().as_secs_f64() * 1e9 / rays as f64);
                }
            }
            for ((_, how), times) in How::ALL.into_iter().zip(&times) {
                report.add(&format!("rays/{scene}, {name}/{how}"), "ns per ray", times, json!({ "rays": rays }));
            }
            let [obvhs, single, groups] = times.map(|times| 1e3 / cost::median(&times));
            let hit = hit as f64 / rays as f64;
            println!("{:32} {obvhs:15.1} {single:9.1} {groups:9.1} {hit:9.3}", format!("{scene}, {name}"));
        }
    }
}
