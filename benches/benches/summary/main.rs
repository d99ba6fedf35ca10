//! Two tables: the time per sample of every routine in f32, f32x4, f32x8 and f32x16, with the speed-ups of eight lanes over one and of
//! sixteen over eight; and rays per second on one thread.
//!
//! `cargo bench -p etendue-benches --bench summary -- cone` selects routines by name, `-- --markdown` prints the format of the README, `--
//! --instructions` counts instructions instead (requires Valgrind), `-- rays --json=FILE` also writes the rays to FILE (an absolute path).
//!
//! `-- --tables` writes the tables of costs and errors in the README and the documentation. `routines/tests/tables.rs` fails where their
//! rows and the routines differ.
//!
//! Figures are medians of repetitions. The widths take turns, so that a change of the processor's clock affects all of them alike.

mod instructions;

use etendue::{f32x4, f32x8, f32x16};
use etendue_laboratory::cost::{self, Rounds};
use etendue_render::bvh::Scratch;
use etendue_routines::rays::{How, RayKind, Workload};
use etendue_routines::{SAMPLES, routines, tables};
use instructions::WIDTHS;
use std::hint::black_box;
use std::time::Instant;

const REPETITIONS: usize = 31;
/// The calls of a round take a few hundred microseconds.
const ROUNDS: Rounds = Rounds { count: REPETITIONS, calls: 64, samples: SAMPLES };

/// Prints a row; the last columns are the speed-ups of eight lanes over one, and of sixteen over eight.
fn row(markdown: bool, name: &str, [one, four, eight, sixteen]: [f64; WIDTHS]) {
    let (gain, further) = (one / eight, eight / sixteen);
    if markdown {
        println!("| {name} | {one:.2} | {four:.2} | {eight:.2} | {sixteen:.2} | {gain:.1} | {further:.2} |");
    } else {
        println!("{name:38} {one:8.2} {four:8.2} {eight:8.2} {sixteen:8.2} {gain:7.1} {further:7.2}");
    }
}

fn main() {
    // cargo passes --bench too
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let filter = arguments.iter().find(|a| !a.starts_with('-')).cloned().unwrap_or_default();
    let given = |flag: &str| arguments.iter().any(|a| a == flag);
    if given(instructions::CHILD) {
        return instructions::child(&filter);
    }
    let (markdown, counted) = (given("--markdown"), given("--instructions"));
    let what = if counted { "instructions/sample" } else { "ns/sample, median" };
    let json = arguments.iter().find_map(|a| a.strip_prefix("--json="));
    if markdown {
        println!("| {what} | f32 | x4 | x8 | x16 | x1/x8 | x8/x16 |\n|---|---|---|---|---|---|---|");
    } else {
        println!("{what:38} {:>8} {:>8} {:>8} {:>8} {:>7} {:>7}", "f32", "f32x4", "f32x8", "f32x16", "x1/x8", "x8/x16");
    }
    if counted {
        match instructions::count(&filter) {
            Ok(rows) => rows.iter().for_each(|(name, counts)| row(markdown, name, *counts)),
            Err(error) => {
                eprintln!("{error}");
                std::process::exit(2);
            }
        }
        return;
    }
    let mut times = std::collections::HashMap::new();
    let [one, four, eight] = [routines::<f32>(), routines::<f32x4>(), routines::<f32x8>()];
    let widths = one.into_iter().zip(four).zip(eight).zip(routines::<f32x16>());
    for (((one, four), eight), sixteen) in widths.filter(|(((one, ..), _), _)| one.name.contains(&filter)) {
        let name = one.name;
        let mut each = [one.run, four.run, eight.run, sixteen.run];
        let times_of = cost::measure(&mut each, ROUNDS, |_| true);
        let medians: [f64; WIDTHS] = std::array::from_fn(|k| cost::median(&times_of[k]));
        row(markdown, &name, medians);
        let [one, four, eight, _] = medians;
        times.insert(name, [one, four, eight]);
    }
    if given("--tables") {
        return finish(tables::Measured::new(times).and_then(|measured| tables::write(&measured)));
    }
    if "rays".contains(&filter) {
        rays(json);
    }
}

fn finish(result: Result<(), String>) {
    if let Err(error) = result {
        eprintln!("error: {error}");
        std::process::exit(2);
    }
}

/// Prints the fraction of hits too. It is the same for all ways, except that obvhs lets some rays through at edges.
fn rays(json: Option<&str>) {
    println!("\n{:32} {:>15} {:>9} {:>9} {:>9}", "million rays/s, median", "obvhs, per ray", "single", "groups", "hit");
    let mut rows = Vec::new();
    for scene in ["quads", "terrain"] {
        let workload = Workload::new(scene, 512);
        let mut stack = Scratch::default();
        for (kind, name) in RayKind::ALL {
            let rays = workload.rays(kind);
            let rounds: Vec<_> = (0..REPETITIONS)
                .map(|_| {
                    How::ALL.map(|(how, _)| {
                        let start = Instant::now();
                        let hits = black_box(workload.trace(kind, how, &mut stack));
                        (rays as f64 / start.elapsed().as_secs_f64() / 1e6, hits)
                    })
                })
                .collect();
            let [obvhs, single, groups] =
                [0, 1, 2].map(|k| cost::median(&rounds.iter().map(|r| r[k].0).collect::<Vec<_>>()));
            let [obvhs_hits, _, hits] = rounds[0].map(|(_, hits)| hits);
            let hit = hits as f64 / rays as f64;
            println!("{:32} {obvhs:15.1} {single:9.1} {groups:9.1} {hit:9.3}", format!("{scene}, {name}"));
            rows.push(serde_json::json!({
                "scene": scene, "kind": name, "rays": rays, "hits": hits, "hits_obvhs": obvhs_hits,
                "million_rays_per_second": { "obvhs": obvhs, "single": single, "groups": groups },
            }));
        }
    }
    if let Some(path) = json
        && let Err(error) = std::fs::write(path, format!("{:#}\n", serde_json::Value::from(rows)))
    {
        eprintln!("error: {path}: {error}");
        std::process::exit(2);
    }
}
