//! Measures the error and time of techniques and samplers, and writes a report with charts.

pub mod charts;
pub mod machine;
pub mod measure;
pub mod outcome;
pub mod pictures;
pub mod plot;
pub mod reference;
pub mod report;
pub mod stats;
pub mod summary;
pub mod warps;

use crate::hash::fnv1a;
use crate::interrupt::interrupt;
use crate::options::{named, out, size, threads, whole};
use clap::Args;
use etendue_render::files;
use etendue_render::limits::MOST_SAMPLES;
use etendue_render::scene::{Material, Scene};
use etendue_render::{ChoiceBy, Sampler, Settings, Technique, World, identity};
use indicatif::{ProgressBar, ProgressStyle};
use measure::{ChartedScene, Key, Plan, Table, inapplicable, method};
pub use outcome::Outcome;
use reference::Reference;
use std::error::Error;
use std::ffi::{OsStr, OsString};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use summary::{Summary, Way};

/// Options of `etendue chart`.
#[derive(Args, Clone, Debug)]
pub struct Options {
    /// Names of built-in scenes, or paths of pbrt-v4 or glTF files
    #[arg(default_values_os_t = ["quads", "sphere-light", "triangle-light"].map(OsString::from))]
    pub scenes: Vec<OsString>,
    /// Folder for the report; measurements it already holds are not repeated
    #[arg(short, long, default_value = "chart")]
    pub output: PathBuf,
    /// How to sample the lights [default: all techniques]
    #[arg(long, value_parser = named::<Technique>(&Technique::NAMES), value_delimiter = ',')]
    pub techniques: Vec<Technique>,
    /// How to choose one of the lights
    #[arg(long = "choice", value_name = "CHOICES", value_parser = named::<ChoiceBy>(&ChoiceBy::NAMES), value_delimiter = ',', default_value = "auto")]
    pub choices: Vec<ChoiceBy>,
    /// How to generate the random numbers [default: all samplers]
    #[arg(long, value_parser = named::<Sampler>(&Sampler::NAMES), value_delimiter = ',')]
    pub samplers: Vec<Sampler>,
    /// Samples per pixel [default: 1,2,4,…,1024; with --quick 1,4,16,64]
    #[arg(long, value_delimiter = ',', value_parser = whole::<u32>(1..=MOST_SAMPLES.into()))]
    pub spp: Vec<u32>,
    /// Number of images per measurement, with different seeds [default: 5]
    #[arg(long, value_parser = whole::<u32>(1..=10_000))]
    pub replicates: Option<u32>,
    /// Light the scenes by this image of a sky (EXR, HDR, PFM or PNG), instead of their own skies
    #[arg(long, value_name = "FILE")]
    pub environment: Option<PathBuf>,
    /// Reference image [default: the built-in one of the scene, or else one rendered now]
    #[arg(long, value_name = "EXR")]
    pub reference: Option<PathBuf>,
    /// Mean squared standard error of the reference, used if its file has no variance
    #[arg(long, value_name = "MSE", default_value_t = 0.0)]
    pub reference_error: f64,
    /// Render the reference with this many samples per pixel [default without a built-in one: 4096; with --quick 1024]
    #[arg(long, value_name = "SPP", conflicts_with = "reference", value_parser = whole::<u32>(32..=MOST_SAMPLES.into()))]
    pub reference_spp: Option<u32>,
    /// Image size in pixels [default: from the scene; with --quick half of that]
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// Seed of the random numbers; different seeds give independent measurements
    #[arg(long, default_value_t = 0, value_parser = whole::<u64>(0..=u64::MAX))]
    pub seed: u64,
    /// Number of threads; 0 means one per core
    #[arg(long, default_value_t = 0, value_parser = threads)]
    pub threads: usize,
    /// The technique that all others are compared with
    #[arg(long, value_parser = named::<Technique>(&Technique::NAMES), default_value = "area")]
    pub baseline: Technique,
    /// Mean squared error to reach [default: the error of the best technique at the median sample count]
    #[arg(long, value_name = "MSE")]
    pub target: Option<f64>,
    /// Stop measuring after this many seconds and report what has been measured [default with --quick: 150]
    #[arg(long, value_name = "SECONDS", value_parser = whole::<u64>(0..=u64::MAX))]
    pub time_limit: Option<u64>,
    /// Also measure the time and greatest error of each warp of the library
    #[arg(long)]
    pub warps: bool,
    /// Measure small images with few samples, in less than three minutes
    #[arg(long)]
    pub quick: bool,
}

/// The requested values without duplicates, or all values if none is requested.
fn chosen<T: Copy + PartialEq>(asked: &[T], all: &[T]) -> Vec<T> {
    let mut list: Vec<T> = Vec::new();
    for &value in if asked.is_empty() { all } else { asked } {
        if !list.contains(&value) {
            list.push(value);
        }
    }
    list
}

/// A technique, and a choice of a light.
type Method = (Technique, ChoiceBy);

/// The techniques and choices that apply to a scene and differ from one another there, and notes on those that are left out.
fn methods(scene: &Scene, subject: &ChartedScene, asked: impl Iterator<Item = Method>) -> (Vec<Method>, Vec<String>) {
    let (mut list, mut images, mut notes) = (Vec::<Method>::new(), Vec::new(), Vec::new());
    for (technique, choice) in asked {
        let own = method(technique, choice);
        let mut leave = |why: &str| notes.push(format!("{}: {own} is left out: {why}", subject.name));
        let is_blind = matches!(technique, Technique::UniformHemisphere | Technique::CosineHemisphere);
        if is_blind && scene.materials.iter().any(Material::is_glossy) {
            leave(
                "it finds reflections of lights in this scene's rough metals too rarely for its error to be measured",
            );
            continue;
        }
        let [width, height] = subject.size.map(|side| side.min(64));
        let sampler = Sampler::Independent;
        let depth = Settings::DEPTH;
        let settings = Settings { width, height, spp: 8, technique, choice, depth, sampler, sets: 1, seed: 1 };
        if let Err(why) = subject.world.check(&settings) {
            leave(&why);
            continue;
        }
        // `auto` chooses by the whole image
        let [width, height] = subject.size;
        let chosen = subject.world.view(&Settings { width, height, ..settings }).technique();
        let settings = Settings { technique: chosen, ..settings };
        let pixels = subject.world.render(&settings, &|_| ()).0.pixels;
        match images.iter().position(|other| *other == pixels) {
            Some(first) => {
                let (technique, choice) = list[first];
                leave(&format!("it gives the same image as {} in this scene", method(technique, choice)));
            }
            None => {
                list.push((technique, choice));
                images.push(pixels);
            }
        }
    }
    (list, notes)
}

/// A scene ready to be measured, the methods to measure, and notes for the report.
struct Prepared {
    subject: ChartedScene,
    methods: Vec<Method>,
    notes: Vec<String>,
}

/// Loads a scene and its reference.
fn prepare(options: &Options, path: &OsStr, circumstances: &str) -> Result<Prepared, Box<dyn Error>> {
    let scene = match &options.environment {
        Some(sky) => etendue_scene::load_with_sky(path, sky),
        None => etendue_scene::load(path),
    }?;
    let name = &*path.to_string_lossy();
    let mut notes: Vec<String> = scene.warnings.iter().map(|w| format!("warning: {w}")).collect();
    let (width, height) = options.size.unwrap_or_else(|| {
        let shrink = |side: u32| if options.quick { (side / 2).max(1) } else { side };
        (shrink(scene.film.width), shrink(scene.film.height))
    });
    let size = [width, height];
    let world = World::new(&scene)?;
    let is_builtin = etendue_scene::builtin().iter().any(|(builtin, _)| *builtin == name);
    let own = if is_builtin && options.reference_spp.is_none() && options.environment.is_none() {
        Reference::builtin(name).and_then(|r| r.shrunk(size).ok())
    } else {
        None
    };
    let reference = if let Some(path) = &options.reference {
        let of_size = Reference::read(path, options.reference_error)?.shrunk(size);
        of_size.map_err(|what| format!("{}: {what}", path.display()))?
    } else if let Some(own) = own {
        own
    } else {
        let spp = options.reference_spp.unwrap_or(if options.quick { 1024 } else { 4096 });
        let bar = bar(u64::from(width) * u64::from(height), &format!("reference of {name}"))?;
        let reference = Reference::render(&world, size, spp, &|done| bar.inc(done));
        bar.finish_and_clear();
        reference
    };
    let mut bytes = Vec::new();
    // what a built-in scene computes is in no file: its settings as text, its mesh as bytes
    let files = scene.digest();
    write!(bytes, "{files}{:?}{:?}{:?}{circumstances}{}", scene.camera, scene.materials, scene.shapes, options.seed)?;
    bytes.extend(scene.triangles.iter().flatten().flatten().flat_map(|x| x.to_le_bytes()));
    bytes.extend(scene.triangle_materials.iter().flat_map(|x| x.to_le_bytes()));
    bytes.extend(size.iter().flat_map(|x| x.to_le_bytes()));
    bytes.extend(reference.picture.radiance.iter().flatten().flat_map(|x| x.to_le_bytes()));
    let subject = ChartedScene { name: name.to_owned(), world, size, settings: fnv1a(&bytes), reference };
    let techniques = chosen(&options.techniques, &Technique::ALL);
    let choices = chosen(&options.choices, &ChoiceBy::ALL);
    let asked = techniques.iter().flat_map(|&technique| choices.iter().map(move |&choice| (technique, choice)));
    let (methods, left_out) = methods(&scene, &subject, asked);
    notes.extend(left_out);
    Ok(Prepared { subject, methods, notes })
}

/// A progress bar, which draws nothing unless stderr is a terminal.
fn bar(total: u64, what: &str) -> Result<ProgressBar, Box<dyn Error>> {
    let style = ProgressStyle::with_template("{msg} {wide_bar} {percent:>3} %  {elapsed}, {eta} left")?;
    Ok(ProgressBar::new(total).with_style(style).with_message(what.to_owned()))
}

/// Sets `stop` after this many seconds.
fn alarm(stop: &Arc<AtomicBool>, seconds: Option<u64>) {
    if let Some(seconds) = seconds {
        let stop = Arc::clone(stop);
        std::thread::spawn(move || {
            std::thread::sleep(Duration::from_secs(seconds));
            stop.store(true, Ordering::Relaxed);
        });
    }
}

/// Runs and summarises the measurements.
///
/// # Errors
/// Fails if a scene or reference cannot be read, or the table cannot be written.
pub fn measure(options: &Options, stop: &Arc<AtomicBool>) -> Result<Outcome, Box<dyn Error>> {
    let start = Instant::now();
    if options.reference.is_some() && options.scenes.len() != 1 {
        return Err("--reference needs exactly one scene".into());
    }
    if !(0.0..f64::INFINITY).contains(&options.reference_error) {
        return Err(format!("--reference-error {}: must be finite and at least 0", options.reference_error).into());
    }
    if options.target.is_some_and(|t| !t.is_finite() || t <= 0.0) {
        return Err("--target: must be finite and greater than 0".into());
    }
    let pool = crate::options::pool(options.threads)?;
    let facts = machine::facts(pool.current_num_threads());
    // measurements of another build do not count; a new commit does not matter as long as the program stays the same
    let kept: Vec<_> = facts.iter().filter(|(name, _)| *name != "commit").collect();
    let circumstances = format!("{kept:?}{}", identity::build());
    let mut notes = Vec::new();
    let mut scenes: Vec<ChartedScene> = Vec::new();
    let mut methods = Vec::new();
    for (i, scene) in options.scenes.iter().enumerate() {
        if options.scenes[..i].contains(scene) {
            continue;
        }
        let prepared = pool.install(|| prepare(options, scene, &circumstances).map_err(|e| e.to_string()))?;
        notes.extend(prepared.notes);
        scenes.push(prepared.subject);
        methods.push(prepared.methods);
    }
    let default =
        if options.quick { (0..4).map(|k| 1 << (2 * k)).collect() } else { (0..11).map(|k| 1 << k).collect() };
    let mut spps: Vec<u32> = if options.spp.is_empty() { default } else { options.spp.clone() };
    spps.sort_unstable();
    spps.dedup();
    let mut keys = Vec::new();
    for (scene, methods) in methods.iter().enumerate() {
        for &spp in &spps {
            for &sampler in &chosen(&options.samplers, &Sampler::ALL) {
                for &(technique, choice) in methods {
                    match inapplicable(sampler, spp) {
                        Some(reason) if !notes.contains(&reason) => notes.push(reason),
                        Some(_) => (),
                        None => keys.push(Key { scene, technique, choice, sampler, spp }),
                    }
                }
            }
        }
    }
    if keys.is_empty() {
        return Err(format!("nothing to measure: {}", notes.join("; ")).into());
    }
    let replicates = options.replicates.unwrap_or(5);
    let plan = Plan { scenes, keys, replicates, seed: options.seed };

    files::make_folder(&options.output)?;
    let file = options.output.join("measurements.csv");
    let (mut table, mut rows, others) = Table::open(&file, &plan)?;
    if others > 0 {
        notes.push(format!("{}: {others} measurements with other settings are kept but not shown", file.display()));
    }
    let found: usize = rows.values().map(Vec::len).sum();
    if found > 0 {
        notes.push(format!("{found} measurements come from an earlier run"));
    }
    let limit = options.time_limit.or(options.quick.then_some(150));
    alarm(stop, limit.map(|l| l.saturating_sub(start.elapsed().as_secs())));
    let bar = bar(plan.work(&rows), "measuring")?;
    pool.install(|| plan.run(&mut table, &mut rows, stop, &|done| bar.inc(done)).map_err(|e| e.to_string()))?;
    bar.finish_and_clear();

    let all = plan.keys.len() * plan.replicates as usize;
    let done: usize = rows.values().map(Vec::len).sum();
    if done < all {
        notes.push(format!("stopped early: {done} of {all} measurements; run the same command again for the rest"));
    }
    let baseline = Way { technique: options.baseline, choice: options.choices[0], sampler: Sampler::Independent };
    let summaries = (0..plan.scenes.len())
        .map(|scene| Summary::new(&plan, &rows, scene, baseline, options.target))
        .filter(|s| !s.series.is_empty())
        .collect();
    Ok(Outcome { plan, rows, summaries, facts, notes })
}

/// Prefix of a scene's file names: its name with special characters replaced, and a number if two scenes share it.
fn stem(summaries: &[Summary], scene: &str) -> String {
    let of = |name: &str| -> String {
        let stem = Path::new(name).file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
        stem.chars().map(|c| if c.is_ascii_alphanumeric() || "-_".contains(c) { c } else { '_' }).collect()
    };
    let before = summaries.iter().take_while(|s| s.scene != scene).filter(|s| of(&s.scene) == of(scene)).count();
    if before == 0 { of(scene) } else { format!("{}-{}", of(scene), before + 1) }
}

/// Measures the time and error of the warps and writes warps.svg and warps.csv.
fn measure_warps(folder: &Path, stop: &AtomicBool) -> Result<(charts::Figure, String), Box<dyn Error>> {
    let bar = bar(0, "warps")?;
    let measured = warps::measure(stop, |done, all| {
        bar.set_length(all);
        bar.set_position(done);
    });
    bar.finish_and_clear();
    let figure = warps::figure(&measured);
    files::replace(&folder.join("warps.svg"), figure.drawing.file().as_bytes())?;
    files::replace(&folder.join("warps.csv"), warps::csv(&measured).as_bytes())?;
    Ok((figure, warps::table(&measured)))
}

/// Checks that a report replaces nothing but a report.
fn check_page(page: &Path) -> Result<(), String> {
    let is_other = |bytes: Vec<u8>| !String::from_utf8_lossy(&bytes).contains(report::TITLE);
    if std::fs::read(page).is_ok_and(is_other) {
        return Err(format!("{}: this is no report of a chart: choose another folder with -o", page.display()));
    }
    Ok(())
}

/// Measures, writes the report and prints a summary.
///
/// # Errors
/// Fails if a scene or reference cannot be read, or a file cannot be written, or if another page has the name of the report.
pub fn run(options: &Options, command: &str) -> Result<(), Box<dyn Error>> {
    let page = options.output.join("report.html");
    check_page(&page)?;
    let stop = interrupt()?;
    let outcome = measure(options, &stop)?;
    let pool = crate::options::pool(options.threads)?;
    let mut figures = Vec::new();
    for summary in &outcome.summaries {
        let mut list = vec![charts::error_over_time(summary), charts::error_over_samples(summary)];
        list.extend(charts::efficiency(summary));
        list.extend(charts::time_to_error(summary));
        for figure in &list {
            let file = format!("{}-{}.svg", stem(&outcome.summaries, &summary.scene), figure.file);
            files::replace(&options.output.join(file), figure.drawing.file().as_bytes())?;
        }
        figures.push(list);
    }
    let pictures: Vec<pictures::Panel> =
        pool.install(|| outcome.summaries.iter().map(|s| pictures::panel(&outcome, s)).collect());
    for panel in &pictures {
        for picture in &panel.pictures {
            let file = format!("{}-{}.png", stem(&outcome.summaries, &panel.scene), picture.file);
            files::replace(&options.output.join(file), &picture.png)?;
        }
    }
    let warps = if options.warps { Some(measure_warps(&options.output, &stop)?) } else { None };
    files::replace(&page, report::page(&outcome, &figures, &pictures, warps.as_ref(), command).as_bytes())?;

    let mut out = out();
    for summary in &outcome.summaries {
        writeln!(out, "{}", summary.headline())?;
        for &index in &summary.ranking {
            let series = &summary.series[index];
            let gain = summary.gains.iter().find(|g| g.series == index);
            let gain = gain.map_or_else(|| "?".to_owned(), |g| plot::short(g.gain.value));
            let slope = series.slope.as_ref().map_or_else(|| "?".to_owned(), charts::with_interval);
            writeln!(out, "  {:36} slope {slope:18} efficiency {gain} at {} spp", series.way.title(), summary.spp)?;
        }
    }
    for note in &outcome.notes {
        writeln!(out, "{note}")?;
    }
    writeln!(out, "wrote {}", page.display())?;
    Ok(())
}
