//! The renderer's command line.

use clap::{Args, Parser, Subcommand, ValueEnum};
use etendue_laboratory::{atlas, chart, figure, selftest};
use etendue_render::compare::Comparison;
use etendue_render::options::{name, size};
use etendue_render::{RayCount, Sampler, Sensor, Settings, Technique, World, image, scene};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::json;
use std::error::Error;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// A direct-lighting renderer that measures how well lights are sampled
#[derive(Parser)]
#[command(name = "etendue", version)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Render a scene to an EXR file, with a PNG beside it
    Render(Render),
    /// Compare an image with a reference of the same size
    Compare(Compare),
    /// Render scenes with every applicable technique and sampler, and check that the images agree
    Selftest(Selftest),
    /// Measure the error and time of techniques and samplers, and write a report with charts
    Chart(chart::Options),
    /// Draw a figure about light sampling and print the numbers behind it
    Figure(figure::Options),
    /// Map where each technique of the library loses accuracy, compared with textbook formulas
    Atlas(atlas::Options),
    /// List the built-in scenes, techniques, samplers and sensors
    List,
}

#[derive(Args)]
struct Render {
    /// Name of a built-in scene, or path of a pbrt-v4 file
    scene: String,
    /// EXR file to write [default: the scene's film filename, or SCENE.exr]
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Samples per pixel [default: from the scene]
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=1 << 22))]
    spp: Option<u32>,
    /// How to sample the lights
    #[arg(long, value_enum, default_value = "solid-angle")]
    technique: Technique,
    /// Greatest number of perfect mirrors along a camera ray
    #[arg(long, default_value_t = Settings::DEPTH, value_parser = clap::value_parser!(u32).range(0..=1024))]
    depth: u32,
    /// How to generate the random numbers
    #[arg(long, value_enum, default_value = "independent")]
    sampler: Sampler,
    /// What a pixel measures; irradiance and power need a camera with a lens
    #[arg(long, value_enum, default_value = "radiance")]
    sensor: Sensor,
    /// Independent replicates per pixel: with 1 the error is least and no variance is reported [default: 2 or 4, if --spp allows]
    #[arg(long, value_name = "1|2|4", value_parser = sets)]
    sets: Option<u32>,
    /// Image size in pixels [default: from the scene]
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<(u32, u32)>,
    /// Seed of the random numbers; different seeds give independent images
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Number of threads; 0 means one per core
    #[arg(long, default_value_t = 0)]
    threads: usize,
    /// Render the same image this many times, for timing
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    repeat: u32,
    /// Print the result as one JSON object
    #[arg(long)]
    json: bool,
}

#[derive(Args)]
struct Compare {
    /// EXR file of the reference
    reference: PathBuf,
    /// EXR file of the image
    image: PathBuf,
    /// Mean squared standard error of the reference, used if its file has no variance
    #[arg(long, default_value_t = 0.0)]
    reference_error: f64,
    /// Print the result as one JSON object
    #[arg(long)]
    json: bool,
}

#[derive(Args)]
struct Selftest {
    /// Names of built-in scenes, or paths of pbrt-v4 files [default: all built-in scenes]
    scenes: Vec<String>,
    /// Samples per pixel
    #[arg(long, default_value_t = 64, value_parser = clap::value_parser!(u32).range(2..=1 << 22))]
    spp: u32,
    /// Width and height of the images in pixels
    #[arg(long, default_value_t = 64, value_parser = clap::value_parser!(u32).range(1..=4096))]
    side: u32,
    /// Seed of the random numbers; different seeds give independent images
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Greatest number of perfect mirrors along a camera ray
    #[arg(long, default_value_t = Settings::DEPTH, value_parser = clap::value_parser!(u32).range(0..=1024))]
    depth: u32,
    /// Number of threads; 0 means one per core
    #[arg(long, default_value_t = 0)]
    threads: usize,
}

/// Instruction set extensions that the program was built for and this machine lacks.
fn missing_features() -> Vec<&'static str> {
    let mut missing = Vec::new();
    #[cfg(target_arch = "x86_64")]
    {
        macro_rules! need {
            ($($feature:tt)*) => {
                $(if cfg!(target_feature = $feature) && !std::arch::is_x86_feature_detected!($feature) {
                    missing.push($feature);
                })*
            };
        }
        need!("sse3" "ssse3" "sse4.1" "sse4.2" "popcnt" "avx" "avx2" "bmi1" "bmi2" "f16c" "fma" "lzcnt" "movbe" "avx512f");
    }
    missing
}

fn main() -> ExitCode {
    let missing = missing_features();
    if !missing.is_empty() {
        eprintln!(
            "etendue: this program was built for a processor with {}, which this machine lacks.\n\
             Rebuild it without that requirement: CARGO_ENCODED_RUSTFLAGS= cargo build --release",
            missing.join(", ")
        );
        return ExitCode::from(3);
    }
    let result = match Cli::parse().command {
        Command::Selftest(options) => match run_selftest(&options) {
            Ok(true) => Ok(()),
            Ok(false) => return ExitCode::FAILURE,
            Err(error) => Err(error),
        },
        Command::Render(options) => render(&options),
        Command::Compare(options) => compare(&options),
        Command::Chart(options) => chart::run(&options, &command_line()),
        Command::Figure(options) => figure::run(&options),
        Command::Atlas(options) => atlas::run(&options),
        Command::List => list().map_err(Into::into),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        // the reader has closed the pipe, as `head` does
        Err(error) if error.downcast_ref::<io::Error>().is_some_and(|e| e.kind() == io::ErrorKind::BrokenPipe) => {
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("etendue: {error}");
            ExitCode::from(2)
        }
    }
}

/// The command line, for the report.
fn command_line() -> String {
    let arguments = std::env::args().skip(1).map(|a| if a.contains(' ') { format!("{a:?}") } else { a });
    std::iter::once("etendue".to_owned()).chain(arguments).collect::<Vec<_>>().join(" ")
}

/// Parses `--sets`.
fn sets(text: &str) -> Result<u32, String> {
    [1, 2, 4].into_iter().find(|n| text == n.to_string()).ok_or_else(|| "must be 1, 2 or 4".to_owned())
}

fn list() -> io::Result<()> {
    let mut out = io::stdout().lock();
    writeln!(out, "scenes")?;
    for (name, about) in scene::builtin() {
        writeln!(out, "  {name:20} {about}")?;
    }
    fn values<T: ValueEnum>(out: &mut impl Write, title: &str) -> io::Result<()> {
        writeln!(out, "{title}")?;
        for value in T::value_variants().iter().filter_map(ValueEnum::to_possible_value) {
            let help = value.get_help().map(ToString::to_string).unwrap_or_default();
            writeln!(out, "  {:20} {help}", value.get_name())?;
        }
        Ok(())
    }
    values::<Technique>(&mut out, "techniques")?;
    values::<Sampler>(&mut out, "samplers")?;
    values::<Sensor>(&mut out, "sensors")
}

fn render(options: &Render) -> Result<(), Box<dyn Error>> {
    let start = Instant::now();
    let mut scene = scene::load(&options.scene)?;
    let load = start.elapsed().as_secs_f64();
    for warning in &scene.warnings {
        eprintln!("warning: {warning}");
    }
    let (width, height) = options.size.unwrap_or((scene.film.width, scene.film.height));
    let settings = Settings {
        width,
        height,
        spp: options.spp.unwrap_or(scene.pixel_samples),
        technique: options.technique,
        depth: options.depth,
        sampler: options.sampler,
        sets: options.sets.unwrap_or(0),
        seed: options.seed,
    };
    if options.sensor != Sensor::Radiance && scene.camera.lens.is_none() {
        let (sensor, scene) = (name(options.sensor), &options.scene);
        return Err(format!(
            "--sensor {sensor}: the camera of {scene} is a pinhole: it needs a \"lensradius\" greater than 0"
        )
        .into());
    }
    let check = settings.sampler.check(settings.spp, settings.sets, scene.camera.lens.is_some());
    check.map_err(|what| format!("--sampler: {what}"))?;
    let output = options.output.clone().unwrap_or_else(|| match &scene.film.filename {
        Some(file) => Path::new(file).with_extension("exr"),
        None => PathBuf::from(format!("{}.exr", scene.name)),
    });
    image::check_writable(&output)?;

    let pool = rayon::ThreadPoolBuilder::new().num_threads(options.threads).build()?;
    let start = Instant::now();
    let world = pool.install(|| World::from_scene(&mut scene))?.with_sensor(options.sensor);
    let build = start.elapsed().as_secs_f64();

    let pixels = u64::from(width) * u64::from(height);
    // indicatif draws nothing unless stderr is a terminal
    let bar = ProgressBar::new(pixels * u64::from(options.repeat))
        .with_style(ProgressStyle::with_template("{wide_bar} {percent:>3} %  {elapsed} of {duration}")?);
    let mut seconds = Vec::new();
    let mut last = None;
    for _ in 0..options.repeat {
        let start = Instant::now();
        last = Some(pool.install(|| world.render(&settings, |done| bar.inc(done))));
        seconds.push(start.elapsed().as_secs_f64());
    }
    bar.finish_and_clear();
    let (film, rays) = last.unwrap_or_else(|| unreachable!("--repeat is at least 1"));
    image::write_exr(&output, &film)?;
    let picture = output.with_extension("png");
    match world.exposure(width, height) {
        None => image::write_png(&picture, &film)?,
        // a uniform scene looks the same with every sensor in the middle of the image
        Some(exposure) => image::write_png(&picture, &film.scaled(1.0 / exposure.on_axis()))?,
    }

    let mean = film.mean();
    if options.json {
        let report = json!({
            "scene": options.scene,
            "width": width,
            "height": height,
            "spp": settings.spp,
            "sets": settings.sampler.sets(settings.spp, settings.sets, scene.camera.lens.is_some()),
            "technique": name(settings.technique),
            "sampler": name(settings.sampler),
            "sensor": name(options.sensor),
            "seed": settings.seed,
            "threads": pool.current_num_threads(),
            "seconds": { "load": load, "build": build, "render": seconds },
            "rays": { "camera": rays.camera, "mirror": rays.mirror, "shadow": rays.shadow, "corner": rays.corner },
            "mean": mean,
            "output": output,
        });
        writeln!(io::stdout(), "{report}")?;
    } else {
        let seconds = [load, build, median(&mut seconds)];
        report(&settings, &scene.name, options.sensor, [&output, &picture], mean, rays, seconds)?;
    }
    Ok(())
}

/// Prints the table; returns whether all images agree.
fn run_selftest(options: &Selftest) -> Result<bool, Box<dyn Error>> {
    let mut names = options.scenes.clone();
    if names.is_empty() {
        names.extend(scene::builtin().iter().map(|(name, _)| (*name).to_owned()));
    }
    let effort = selftest::Effort { side: options.side, spp: options.spp, seed: options.seed, depth: options.depth };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(options.threads).build()?;
    let scenes = names.iter().map(|name| scene::load(name)).collect::<Result<Vec<_>, _>>()?;
    let start = Instant::now();
    let (mut worst, mut images) = (0.0_f64, 0);
    writeln!(
        io::stdout(),
        "{side}x{side} pixels, {spp} samples per pixel, seed {seed}; z compares each image with all others of its scene",
        side = options.side,
        spp = options.spp,
        seed = options.seed
    )?;
    for scene in &scenes {
        let world = pool.install(|| World::new(scene))?;
        let rows = pool.install(|| selftest::rows(scene, &world, &effort));
        let mut out = io::stdout().lock();
        writeln!(out, "{}", scene.name)?;
        for row in &rows {
            let [r, g, b] = row.mean;
            let [x, y, z] = row.z;
            let technique = name(row.technique);
            let sampler = name(row.sampler);
            let mark = if selftest::worst(std::slice::from_ref(row)) < selftest::LIMIT { "" } else { "  disagrees" };
            writeln!(
                out,
                "  {technique:21} {sampler:13} {r:.6} {g:.6} {b:.6}   ± {:.1e}   z {x:+.2} {y:+.2} {z:+.2}{mark}",
                row.error.iter().fold(0.0_f64, |m, &e| m.max(e))
            )?;
        }
        worst = worst.max(selftest::worst(&rows));
        images += rows.len();
    }
    let seconds = start.elapsed().as_secs_f64();
    let verdict = if worst < selftest::LIMIT { "all agree" } else { "NOT all agree" };
    writeln!(
        io::stdout(),
        "{} scenes, {images} images, {seconds:.1} s: greatest |z| {worst:.2}, {verdict}",
        scenes.len()
    )?;
    Ok(worst < selftest::LIMIT)
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn report(
    settings: &Settings,
    scene: &str,
    sensor: Sensor,
    [output, picture]: [&Path; 2],
    [r, g, b]: [f64; 3],
    rays: RayCount,
    [load, build, render]: [f64; 3],
) -> io::Result<()> {
    let mut out = io::stdout().lock();
    let Settings { width, height, spp, .. } = settings;
    let (technique, sampler) = (name(settings.technique), name(settings.sampler));
    writeln!(out, "{scene}: {width}x{height}, {spp} samples per pixel, {technique}, {sampler}")?;
    writeln!(out, "load {load:.3} s, build {build:.3} s, render {render:.3} s")?;
    let rate = rays.camera as f64 / render / 1e6;
    writeln!(out, "{rate:.1} million samples/s; {} camera rays, {} shadow rays", rays.camera, rays.shadow)?;
    match sensor {
        Sensor::Radiance => writeln!(out, "mean radiance {r:.6} {g:.6} {b:.6}")?,
        Sensor::Irradiance | Sensor::Power => writeln!(out, "mean {} {r:.6e} {g:.6e} {b:.6e}", name(sensor))?,
    }
    writeln!(out, "wrote {} and {}", output.display(), picture.display())
}

fn compare(options: &Compare) -> Result<(), Box<dyn Error>> {
    let reference = image::read_exr(&options.reference)?;
    let other = image::read_exr(&options.image)?;
    let comparison = Comparison::new(&reference, &other, options.reference_error)
        .map_err(|what| format!("{}: {what}", options.image.display()))?;
    if options.json {
        writeln!(io::stdout(), "{}", comparison.to_json())?;
    } else {
        writeln!(io::stdout(), "{comparison}")?;
    }
    Ok(())
}
