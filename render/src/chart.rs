//! Speed against accuracy: measures techniques and samplers, and draws what comes of it.

pub mod charts;
pub mod machine;
pub mod measure;
pub mod pictures;
pub mod plot;
pub mod reference;
pub mod report;
pub mod stats;
pub mod summary;
pub mod warps;

use crate::{Sampler, Settings, Technique, World, image, scene, selftest};
use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use measure::{ChartedScene, Key, Plan, Table};
use reference::Reference;
use std::error::Error;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use summary::{Summary, Way};

/// What `etendue chart` is asked for.
#[derive(Args, Clone, Debug)]
pub struct Options {
    /// Built-in scenes' names, or pbrt-v4 files
    #[arg(default_values_t = ["quads", "sphere-light", "triangle-light"].map(String::from))]
    pub scenes: Vec<String>,
    /// The folder for the report; measurements that it already holds are not repeated
    #[arg(short, long, default_value = "chart")]
    pub output: PathBuf,
    /// How lights are sampled; all if not given
    #[arg(long, value_enum, value_delimiter = ',')]
    pub techniques: Vec<Technique>,
    /// Where random numbers come from; all if not given
    #[arg(long, value_enum, value_delimiter = ',')]
    pub samplers: Vec<Sampler>,
    /// Samples per pixel [default: 1,2,4,…,1024; with --quick 1,4,16,64]
    #[arg(long, value_delimiter = ',', value_parser = clap::value_parser!(u32).range(1..=1 << 22))]
    pub spp: Vec<u32>,
    /// Images of each, of different seeds [default: 5]
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub replicates: Option<u32>,
    /// The image to compare with; else that of the built-in scene, else one that is rendered
    #[arg(long, value_name = "EXR")]
    pub reference: Option<PathBuf>,
    /// Mean squared standard error of that image, if its file has no variance
    #[arg(long, value_name = "MSE", default_value_t = 0.0)]
    pub reference_error: f64,
    /// Render the image to compare with, of so many samples per pixel [default where there is none: 4096; with --quick 1024]
    #[arg(long, value_name = "SPP", conflicts_with = "reference", value_parser = clap::value_parser!(u32).range(32..=1 << 22))]
    pub reference_spp: Option<u32>,
    /// Image size in pixels; else what the scene says, with --quick half of it
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// Measurements of different seeds are independent
    #[arg(long, default_value_t = 0)]
    pub seed: u64,
    /// Threads; 0 is one per core
    #[arg(long, default_value_t = 0)]
    pub threads: usize,
    /// The technique that others are compared with
    #[arg(long, value_enum, default_value = "area")]
    pub baseline: Technique,
    /// The mean squared error to be reached; else what the best technique has at the middle of the samples
    #[arg(long, value_name = "MSE")]
    pub target: Option<f64>,
    /// Stop measuring after this long, and report what there is [default with --quick: 150]
    #[arg(long, value_name = "SECONDS")]
    pub time_limit: Option<u64>,
    /// Also time each warp of the library, and look for its greatest error
    #[arg(long)]
    pub warps: bool,
    /// Few samples of small images: within three minutes
    #[arg(long)]
    pub quick: bool,
}

/// Parses `WxH`.
///
/// # Errors
/// It is not two numbers, or they are too small or large.
pub fn size(text: &str) -> Result<(u32, u32), String> {
    let sides = text.split_once(['x', 'X']).ok_or("want WIDTHxHEIGHT, such as 640x480")?;
    let side = |s: &str| match s.parse::<u32>() {
        Ok(n) if (1..=65_536).contains(&n) => Ok(n),
        _ => Err(format!("a side of {s:?} is not within 1 and 65536")),
    };
    let (width, height) = (side(sides.0)?, side(sides.1)?);
    if u64::from(width) * u64::from(height) > 1 << 28 {
        return Err(format!("{width}x{height} is more than 2^28 pixels"));
    }
    Ok((width, height))
}

/// A value's name on the command line.
#[must_use]
pub fn name(value: impl ValueEnum) -> String {
    value.to_possible_value().map_or_else(String::new, |v| v.get_name().to_owned())
}

/// FNV-1a, which will be the same tomorrow.
pub(crate) fn hash(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |h, &b| (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3))
}

/// Hash of the program itself: what another build has measured does not count.
fn build() -> u64 {
    std::env::current_exe().and_then(std::fs::read).map_or(0, |bytes| hash(&bytes))
}

/// All of them, or those that were asked for, each once.
fn chosen<T: ValueEnum + Clone + PartialEq>(asked: &[T]) -> Vec<T> {
    let all = if asked.is_empty() { T::value_variants() } else { asked };
    let mut list: Vec<T> = Vec::new();
    for value in all {
        if !list.contains(value) {
            list.push(value.clone());
        }
    }
    list
}

/// Sets in a pixel: one, which has the least error, since errors are told from replicates of the image; those of stratified-4d have few
/// sizes.
fn sets(sampler: Sampler) -> u32 {
    u32::from(sampler != Sampler::Stratified4d)
}

/// Why a sampler cannot take so many samples, if so.
fn inapplicable(sampler: Sampler, spp: u32, lens: bool) -> Option<String> {
    sampler.check(spp, sets(sampler), lens).err()
}

/// The techniques that apply to a scene and differ there; and why others do not.
fn techniques(scene: &scene::Scene, subject: &ChartedScene, asked: &[Technique]) -> (Vec<Technique>, Vec<String>) {
    let (mut list, mut images, mut notes) = (Vec::new(), Vec::new(), Vec::new());
    for &technique in asked {
        let mut leave = |why: &str| notes.push(format!("{}: {} is left out: {why}", subject.name, name(technique)));
        if !selftest::applies(technique, scene) {
            leave("it finds the lights in this scene's rough metals too rarely for its error to be known");
            continue;
        }
        let [width, height] = subject.size.map(|side| side.min(64));
        let sampler = Sampler::Independent;
        let settings = Settings { width, height, spp: 8, technique, depth: Settings::DEPTH, sampler, sets: 1, seed: 1 };
        let pixels = subject.world.render(&settings, |_| ()).0.pixels;
        match images.iter().position(|other| *other == pixels) {
            Some(first) => leave(&format!("it makes the same image as {} here", name(list[first]))),
            None => {
                list.push(technique);
                images.push(pixels);
            }
        }
    }
    (list, notes)
}

/// A scene that is ready to be measured, with the techniques to measure.
struct Prepared {
    subject: ChartedScene,
    techniques: Vec<Technique>,
    notes: Vec<String>,
}

/// A scene, ready to be measured.
fn prepare(options: &Options, name: &str, circumstances: &str) -> Result<Prepared, Box<dyn Error>> {
    let scene = scene::load(name)?;
    let mut notes: Vec<String> = scene.warnings.iter().map(|w| format!("warning: {w}")).collect();
    let (width, height) = options.size.unwrap_or_else(|| {
        let shrink = |side: u32| if options.quick { (side / 2).max(1) } else { side };
        (shrink(scene.film.width), shrink(scene.film.height))
    });
    let size = [width, height];
    let world = World::new(&scene)?;
    let is_builtin = scene::builtin().iter().any(|(builtin, _)| *builtin == name);
    let own = if is_builtin && options.reference_spp.is_none() {
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
        let reference = Reference::render(&world, size, spp, |done| bar.inc(done));
        bar.finish_and_clear();
        reference
    };
    let mut bytes = Vec::new();
    // every number of a scene that is not a mesh; the mesh as it is
    write!(bytes, "{:?}{:?}{:?}{circumstances}{}", scene.camera, scene.materials, scene.shapes, options.seed)?;
    bytes.extend(scene.triangles.iter().flatten().flatten().flat_map(|x| x.to_le_bytes()));
    bytes.extend(scene.triangle_materials.iter().flat_map(|x| x.to_le_bytes()));
    bytes.extend(size.iter().flat_map(|x| x.to_le_bytes()));
    bytes.extend(reference.picture.radiance.iter().flatten().flat_map(|x| x.to_le_bytes()));
    let lens = scene.camera.lens.is_some();
    let subject = ChartedScene { name: name.to_owned(), world, size, lens, settings: hash(&bytes), reference };
    let (techniques, left_out) = techniques(&scene, &subject, &chosen(&options.techniques));
    notes.extend(left_out);
    Ok(Prepared { subject, techniques, notes })
}

/// indicatif draws nothing where stderr is not a terminal.
fn bar(total: u64, what: &str) -> Result<ProgressBar, Box<dyn Error>> {
    let style = ProgressStyle::with_template("{msg} {wide_bar} {percent:>3} %  {elapsed}, {eta} left")?;
    Ok(ProgressBar::new(total).with_style(style).with_message(what.to_owned()))
}

/// Set by Ctrl-C: what runs ends after its current image; a second one ends the program.
///
/// # Errors
/// The system does not let the program catch it.
pub fn interrupt() -> Result<Arc<AtomicBool>, ctrlc::Error> {
    let flag = Arc::new(AtomicBool::new(false));
    let set = Arc::clone(&flag);
    ctrlc::set_handler(move || {
        if set.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    })?;
    Ok(flag)
}

/// Sets `stop` when the time is over.
fn alarm(stop: &Arc<AtomicBool>, seconds: Option<u64>) {
    if let Some(seconds) = seconds {
        let stop = Arc::clone(stop);
        std::thread::spawn(move || {
            std::thread::sleep(Duration::from_secs(seconds));
            stop.store(true, Ordering::Relaxed);
        });
    }
}

/// All that a report is made of.
#[derive(Debug)]
pub struct Outcome {
    /// What was to be measured.
    pub plan: Plan,
    /// What was.
    pub rows: measure::Rows,
    /// For each scene.
    pub summaries: Vec<Summary>,
    /// Name and value of what the figures depend on.
    pub facts: Vec<(&'static str, String)>,
    /// What the reader should know besides.
    pub notes: Vec<String>,
}

/// Measures, and summarises.
///
/// # Errors
/// A scene or reference cannot be read, or the table not be written.
pub fn measure(options: &Options, stop: &Arc<AtomicBool>) -> Result<Outcome, Box<dyn Error>> {
    let start = Instant::now();
    if options.reference.is_some() && options.scenes.len() != 1 {
        return Err("--reference is of one scene: name that scene alone".into());
    }
    if !(0.0..f64::INFINITY).contains(&options.reference_error) {
        return Err(format!("--reference-error {}: want a number from 0 on", options.reference_error).into());
    }
    if options.target.is_some_and(|t| !t.is_finite() || t <= 0.0) {
        return Err("--target: want a number over 0".into());
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(options.threads).build()?;
    let facts = machine::facts(pool.current_num_threads());
    // the commit may move on, as long as the program stays
    let kept: Vec<_> = facts.iter().filter(|(name, _)| *name != "commit").collect();
    let circumstances = format!("{kept:?}{:016x}", build());
    let mut notes = Vec::new();
    let mut scenes: Vec<ChartedScene> = Vec::new();
    let mut techniques = Vec::new();
    for scene in &options.scenes {
        if scenes.iter().any(|s| s.name == *scene) {
            continue;
        }
        let prepared = pool.install(|| prepare(options, scene, &circumstances).map_err(|e| e.to_string()))?;
        notes.extend(prepared.notes);
        scenes.push(prepared.subject);
        techniques.push(prepared.techniques);
    }
    let default =
        if options.quick { (0..4).map(|k| 1 << (2 * k)).collect() } else { (0..11).map(|k| 1 << k).collect() };
    let mut spps: Vec<u32> = if options.spp.is_empty() { default } else { options.spp.clone() };
    spps.sort_unstable();
    spps.dedup();
    let mut keys = Vec::new();
    for (scene, techniques) in techniques.iter().enumerate() {
        for &spp in &spps {
            for &sampler in &chosen(&options.samplers) {
                for &technique in techniques {
                    match inapplicable(sampler, spp, scenes[scene].lens) {
                        Some(reason) if !notes.contains(&reason) => notes.push(reason),
                        Some(_) => (),
                        None => keys.push(Key { scene, technique, sampler, spp }),
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

    std::fs::create_dir_all(&options.output).map_err(|e| format!("{}: {e}", options.output.display()))?;
    let file = options.output.join("measurements.csv");
    let (mut table, mut rows, others) = Table::open(&file, &plan)?;
    if others > 0 {
        notes.push(format!("{}: {others} measurements of other settings are kept but not shown", file.display()));
    }
    let found: usize = rows.values().map(Vec::len).sum();
    if found > 0 {
        notes.push(format!("{found} measurements were made by an earlier run"));
    }
    let limit = options.time_limit.or(options.quick.then_some(150));
    alarm(stop, limit.map(|l| l.saturating_sub(start.elapsed().as_secs())));
    let bar = bar(plan.work(&rows), "measuring")?;
    pool.install(|| plan.run(&mut table, &mut rows, stop, |done| bar.inc(done)).map_err(|e| e.to_string()))?;
    bar.finish_and_clear();

    let all = plan.keys.len() * plan.replicates as usize;
    let done: usize = rows.values().map(Vec::len).sum();
    if done < all {
        notes.push(format!("stopped early: {done} of {all} measurements; run the same command again for the rest"));
    }
    let baseline = Way { technique: options.baseline, sampler: Sampler::Independent };
    let summaries = (0..plan.scenes.len())
        .map(|scene| Summary::new(&plan, &rows, scene, baseline, options.target))
        .filter(|s| !s.series.is_empty())
        .collect();
    Ok(Outcome { plan, rows, summaries, facts, notes })
}

/// How the files of a scene begin: its name without what a path may not hold, and a number where two have the same.
fn stem(summaries: &[Summary], scene: &str) -> String {
    let of = |name: &str| -> String {
        let stem = Path::new(name).file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
        stem.chars().map(|c| if c.is_ascii_alphanumeric() || "-_".contains(c) { c } else { '_' }).collect()
    };
    let before = summaries.iter().take_while(|s| s.scene != scene).filter(|s| of(&s.scene) == of(scene)).count();
    if before == 0 { of(scene) } else { format!("{}-{}", of(scene), before + 1) }
}

/// Times the warps and looks for their errors; writes what it finds.
fn measure_warps(folder: &Path, stop: &AtomicBool) -> Result<(charts::Figure, String), Box<dyn Error>> {
    let bar = bar(0, "warps")?;
    let measured = warps::measure(stop, |done, all| {
        bar.set_length(all);
        bar.set_position(done);
    });
    bar.finish_and_clear();
    let figure = warps::figure(&measured);
    image::replace(&folder.join("warps.svg"), figure.drawing.file().as_bytes())?;
    image::replace(&folder.join("warps.csv"), warps::csv(&measured).as_bytes())?;
    Ok((figure, warps::table(&measured)))
}

/// Measures, writes the report, and says where and what.
///
/// # Errors
/// A scene or reference cannot be read, or a file not be written.
pub fn run(options: &Options, command: &str) -> Result<(), Box<dyn Error>> {
    let stop = interrupt()?;
    let outcome = measure(options, &stop)?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(options.threads).build()?;
    let mut figures = Vec::new();
    for summary in &outcome.summaries {
        let mut list = vec![charts::error_over_time(summary), charts::error_over_samples(summary)];
        list.extend(charts::efficiency(summary));
        list.extend(charts::time_to_error(summary));
        for figure in &list {
            let file = format!("{}-{}.svg", stem(&outcome.summaries, &summary.scene), figure.file);
            image::replace(&options.output.join(file), figure.drawing.file().as_bytes())?;
        }
        figures.push(list);
    }
    let pictures: Vec<pictures::Panel> =
        pool.install(|| outcome.summaries.iter().map(|s| pictures::panel(&outcome, s)).collect());
    for panel in &pictures {
        for picture in &panel.pictures {
            let file = format!("{}-{}.png", stem(&outcome.summaries, &panel.scene), picture.file);
            image::replace(&options.output.join(file), &picture.png)?;
        }
    }
    let warps = if options.warps { Some(measure_warps(&options.output, &stop)?) } else { None };
    let page = options.output.join("report.html");
    image::replace(&page, report::page(&outcome, &figures, &pictures, warps.as_ref(), command).as_bytes())?;

    let mut out = std::io::stdout().lock();
    for summary in &outcome.summaries {
        writeln!(out, "{}", summary.scene)?;
        for (index, series) in summary.series.iter().enumerate() {
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
