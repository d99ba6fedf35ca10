//! Measures the error and time of techniques and samplers, and writes a report with charts.

pub mod answer;
mod budget;
pub mod charts;
pub mod clock;
pub mod machine;
pub mod measure;
pub mod options;
pub mod outcome;
pub mod plot;
mod prepare;
pub mod reference;
pub mod report;
pub mod stats;
pub mod summary;
pub mod table;

use crate::interrupt::interrupt;
use crate::options::{out, say};
use crate::progress::{bar, duration};
use budget::{Extent, Trial};
use clock::Clock;
use etendue_render::Sampler;
use etendue_render::film::files;
use measure::{ChartedScene, Key, Measurement, Plan, inapplicable};
pub use options::Options;
pub use outcome::Outcome;
use prepare::Loaded;
use std::error::Error;
use std::io::Write;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use summary::{ERRORS, Summary, Way};
use table::MeasurementFile;

/// Sets `stop` at this time.
fn alarm(stop: &Arc<AtomicBool>, time: Option<Instant>) {
    if let Some(time) = time {
        let stop = Arc::clone(stop);
        std::thread::spawn(move || {
            std::thread::sleep(time.saturating_duration_since(Instant::now()));
            stop.store(true, Ordering::Relaxed);
        });
    }
}

/// Loads the scenes, each once.
fn load(options: &Options) -> Result<Vec<Loaded>, Box<dyn Error>> {
    let mut scenes = Vec::new();
    for (i, scene) in options.scenes.iter().enumerate() {
        if !options.scenes[..i].contains(scene) {
            scenes.push(Loaded::new(options, scene)?);
        }
    }
    Ok(scenes)
}

/// Says what is measured, and how long that takes.
fn announce(scenes: &[Loaded], extent: &Extent, seconds: f64, trial: f64, limit: Option<u64>) {
    let names: Vec<&str> = scenes.iter().map(|s| &*s.name).collect();
    let sizes: Vec<String> = extent.sizes.iter().map(|[width, height]| format!("{width}x{height}")).collect();
    let spps: Vec<String> = extent.spps.iter().map(ToString::to_string).collect();
    let most = limit.map_or_else(String::new, |limit| format!(", and at most {}", duration(limit as f64)));
    say(format_args!(
        "{} ({}), {} samples per pixel, {} replicates: about {}{most}, by a trial of {}",
        names.join(", "),
        sizes.join(", "),
        spps.join(", "),
        extent.replicates,
        duration(seconds),
        duration(trial),
    ));
}

/// The keys of a plan, and notes on those that do not apply.
fn keys(scenes: &[Loaded], spps: &[u32], samplers: &[Sampler]) -> (Vec<Key>, Vec<String>) {
    let (mut keys, mut notes) = (Vec::new(), Vec::new());
    for (scene, loaded) in scenes.iter().enumerate() {
        for (spp, sampler) in spps.iter().flat_map(|spp| samplers.iter().map(move |sampler| (*spp, *sampler))) {
            match inapplicable(sampler, spp) {
                Some(reason) if !notes.contains(&reason) => notes.push(reason),
                Some(_) => (),
                None => keys.extend(loaded.methods.iter().map(|&(technique, choice)| Key {
                    scene,
                    technique,
                    choice,
                    sampler,
                    spp,
                })),
            }
        }
    }
    (keys, notes)
}

/// Runs and summarises the measurements.
///
/// # Errors
/// Fails if a scene or reference cannot be read, or the table cannot be written.
pub fn measure(options: &Options, stop: &Arc<AtomicBool>) -> Result<Outcome, Box<dyn Error>> {
    let start = Instant::now();
    let pool = crate::options::pool(options.threads)?;
    let facts = machine::facts(pool.current_num_threads());
    let mut scenes = pool.install(|| load(options).map_err(|e| e.to_string()))?;
    let mut notes: Vec<String> = scenes.iter_mut().flat_map(|s| std::mem::take(&mut s.notes)).collect();

    // a short trial tells what fits into the time
    let samplers = options.samplers();
    let begin = Instant::now();
    let trial = pool.install(|| Trial::new(&scenes, &samplers, options.quick));
    let took = begin.elapsed().as_secs_f64();
    let mut extent = Extent {
        spps: options.spps(),
        replicates: options.replicates.unwrap_or(5),
        sizes: scenes.iter().map(|s| s.size).collect(),
        reference_spp: options.reference_spp.unwrap_or(if options.quick { 256 } else { 4096 }),
        is_race: options.quick,
    };
    let limit = options.limit();
    if let Some(limit) = limit {
        trial.fit(&mut extent, options, limit as f64 - start.elapsed().as_secs_f64());
    }
    let (keys, inapplicable) = keys(&scenes, &extent.spps, &samplers);
    notes.extend(inapplicable);
    notes.extend(scenes.iter().zip(&extent.sizes).filter_map(|(scene, size)| scene.note_on_size(*size)));
    if keys.is_empty() {
        return Err(format!("nothing to measure: {}", notes.join("; ")).into());
    }
    // fails before the measurements, not after them
    files::make_folder(&options.output)?;
    announce(&scenes, &extent, trial.estimate(&extent), took, limit);
    let end = limit.and_then(|limit| start.checked_add(Duration::from_secs(limit)));
    alarm(stop, end);

    // measurements of another build do not count; a new commit does not matter as long as the program stays the same
    let kept: Vec<_> = facts.iter().filter(|(name, _)| *name != "commit").collect();
    let circumstances = format!("{kept:?}{}", crate::hash::build());
    let finished = scenes.into_iter().zip(&extent.sizes);
    let scenes = pool.install(|| {
        finished
            .map(|(scene, size)| scene.finish(options, *size, extent.reference_spp, &circumstances))
            .collect::<Result<Vec<_>, _>>()
            .map_err(|e| e.to_string())
    })?;
    let plan = Plan { scenes, keys, replicates: extent.replicates, seed: options.seed, is_race: extent.is_race };
    let rows = render(&plan, options, &pool, stop, &mut notes)?;
    let clock = Clock::of(rows.values().flatten().map(Measurement::times), pool.current_num_threads());
    let baseline = Way { technique: options.baseline, choice: options.choices[0], sampler: Sampler::Independent };
    let summaries = (0..plan.scenes.len())
        .map(|scene| Summary::new(&plan, &rows, scene, baseline, clock))
        .filter(|s| !s.series.is_empty())
        .collect();
    Ok(Outcome { plan, rows, clock, summaries, facts, notes })
}

/// Renders what the table of the output folder lacks, and notes how much that is.
fn render(
    plan: &Plan,
    options: &Options,
    pool: &rayon::ThreadPool,
    stop: &AtomicBool,
    notes: &mut Vec<String>,
) -> Result<measure::Rows, Box<dyn Error>> {
    let file = options.output.join("measurements.csv");
    let (mut table, mut rows, others) = MeasurementFile::open(&file, plan)?;
    if others > 0 {
        notes.push(format!("{}: {others} measurements with other settings are kept but not shown", file.display()));
    }
    let found: usize = rows.values().map(Vec::len).sum();
    if found > 0 {
        notes.push(format!("{found} measurements come from an earlier run"));
    }
    let bar = bar(plan.work(&rows), "measuring")?;
    let keep = &mut |scene: &ChartedScene, key: &Key, row: &Measurement| table.append(scene, key, row);
    let left_out =
        pool.install(|| plan.run(&mut rows, keep, stop, &|done| bar.inc(done)).map_err(|e| e.to_string()))?;
    bar.finish_and_clear();
    let all = plan.keys.len() * plan.replicates as usize;
    let done: usize = rows.values().map(Vec::len).sum();
    if left_out > 0 {
        let times = measure::HOPELESS;
        notes.push(format!("{left_out} of {all} images are left out: their series take over {times} times as long as the best for the same error"));
    }
    if done + left_out < all {
        notes.push(format!(
            "{EARLY}: {done} of {all} measurements, so that only what these have is compared; the same command goes on with the rest"
        ));
    }
    Ok(rows)
}

/// How the note begins that says that measurements are missing.
const EARLY: &str = "stopped early";

/// Prefix of a scene's file names: its name with special characters replaced, and a number if two scenes share it.
fn stem(summaries: &[Summary], scene: &str) -> String {
    let of = |name: &str| -> String {
        let stem = Path::new(name).file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
        stem.chars().map(|c| if c.is_ascii_alphanumeric() || "-_".contains(c) { c } else { '_' }).collect()
    };
    let before = summaries.iter().take_while(|s| s.scene != scene).filter(|s| of(&s.scene) == of(scene)).count();
    if before == 0 { of(scene) } else { format!("{}-{}", of(scene), before + 1) }
}

/// Checks that a report replaces nothing but a report.
fn check_page(page: &Path) -> Result<(), String> {
    let is_other = |bytes: Vec<u8>| !String::from_utf8_lossy(&bytes).contains(report::TITLE);
    if std::fs::read(page).is_ok_and(is_other) {
        return Err(format!("{}: this is no report of a chart: choose another folder with -o", page.display()));
    }
    Ok(())
}

/// Measures, writes the report and prints a summary. Returns the exit code: 0, or that of the signal that ended it early.
///
/// # Errors
/// Fails if a scene or reference cannot be read, or a file cannot be written, or if another page has the name of the report.
pub fn run(options: &Options, command: &str) -> Result<u8, Box<dyn Error>> {
    let page = options.output.join("report.html");
    check_page(&page)?;
    let (stop, signal) = interrupt()?;
    let outcome = measure(options, &stop)?;
    let figures: Vec<_> = outcome.summaries.iter().map(charts::all).collect();
    let stems: Vec<String> = outcome.summaries.iter().map(|s| stem(&outcome.summaries, &s.scene)).collect();
    for (stem, figures) in stems.iter().zip(&figures) {
        for figure in figures {
            let file = format!("{stem}-{}.svg", figure.file);
            files::replace(&options.output.join(file), figure.drawing.file().as_bytes())?;
        }
    }
    files::replace(&page, report::page(&outcome, &figures, &stems, command).as_bytes())?;
    print(&outcome, &page)?;
    Ok(u8::try_from(signal.load(Ordering::Relaxed)).unwrap_or(u8::MAX))
}

/// Prints what each scene's series take to reach errors, and the notes; first that they are not complete.
fn print(outcome: &Outcome, page: &Path) -> std::io::Result<()> {
    let mut out = out();
    let (early, notes): (Vec<_>, Vec<_>) = outcome.notes.iter().partition(|note| note.starts_with(EARLY));
    for note in early {
        writeln!(out, "{note}")?;
    }
    for summary in &outcome.summaries {
        let sentences = summary.sentences();
        for sentence in &sentences {
            writeln!(out, "{}: {sentence}", summary.scene)?;
        }
        if sentences.is_empty() {
            writeln!(out, "{}: no error is large enough to be measured", summary.scene)?;
        }
        let [first, second, third] = ERRORS.map(answer::percent);
        writeln!(out, "  {:36} {first:>16} {second:>16} {third:>16}  slope", "seconds to")?;
        // those that the page shows, and the baseline
        let mut shown = summary.leaders();
        shown.extend(summary.baseline.filter(|b| !shown.contains(b)));
        for series in shown.iter().map(|index| &summary.series[*index]) {
            let [first, second, third] =
                series.reaches.map(|reach| reach.map_or_else(|| "?".to_owned(), |reach| answer::seconds(&reach)));
            let slope = series.slope.as_ref().map_or_else(|| "?".to_owned(), charts::with_interval);
            writeln!(out, "  {:36} {first:>16} {second:>16} {third:>16}  {slope}", series.way.title())?;
        }
    }
    if !outcome.summaries.is_empty() {
        let words = "errors are relative RMS; about: beyond the images measured, or from one; slope: of log squared error over log samples; ?: not known from so few images";
        writeln!(out, "{words}")?;
    }
    for note in outcome.clock.remark().iter().chain(notes) {
        writeln!(out, "{note}")?;
    }
    writeln!(out, "wrote {}", page.display())
}
