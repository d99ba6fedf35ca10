//! Whole images of the built-in scenes with one and with two threads: samples and rays per second by kind and the time of the processors, by solid
//! angle, which traces a shadow ray for each sample; and the seconds until an image by `auto` claims an error of 1 % and of 0.1 %.
//!
//! `cargo bench -p etendue-benches --bench two_cores -- quads` selects scenes by name. `-- --json=FILE` writes all times, `-- --baseline=FILE`
//! compares with those of an earlier run; paths are from this package's folder. `-- --limit=SECONDS` ends each search for an error,
//! `-- --limit=0` leaves them out.

use etendue_benches::report::Report;
use etendue_laboratory::cost::median;
use etendue_laboratory::processor_time::processor_seconds;
use etendue_render::drive::progressive::{self, Beside, Goal, Refinement};
use etendue_render::sampler::default_sampler;
use etendue_render::{RayCount, Settings, Technique, World};
use serde_json::{Value, json};
use std::error::Error;
use std::process::ExitCode;
use std::time::Instant;

/// Pixels along each side of the image, and samples of each.
const SIDE: u32 = 256;
const SPP: u32 = 64;
/// How often an image is rendered with each number of threads. They take turns, so that a change of the processor's clock affects both.
const REPETITIONS: usize = 9;
/// The errors that are waited for, relative to the mean of the image.
const ERRORS: [f64; 2] = [0.01, 0.001];
/// Seconds after which a search for an error is given up.
const LIMIT: f64 = 60.0;

/// What was measured of a scene with a number of threads.
struct Measured {
    scene: &'static str,
    threads: usize,
    /// Seconds of each image.
    seconds: Vec<f64>,
    /// Seconds of all processors for each image; empty where the system does not tell.
    processor: Vec<f64>,
    /// The rays of one image.
    rays: RayCount,
    /// Seconds to each of the [`ERRORS`]; `None` if the limit came first.
    to_errors: [Option<f64>; 2],
}

impl Measured {
    fn id(&self) -> String {
        format!("two_cores/{}/{}", self.scene, self.threads)
    }
    /// Millions per second.
    fn rate(&self, count: u64) -> f64 {
        count as f64 / median(&self.seconds) / 1e6
    }
    fn print(&self) {
        let RayCount { camera, shadow, mirror, .. } = self.rays;
        let [samples, camera, shadow, mirror] =
            [u64::from(SIDE * SIDE * SPP), camera, shadow, mirror].map(|count| self.rate(count));
        let wait = |seconds: Option<f64>| seconds.map_or_else(|| "—".to_owned(), |seconds| format!("{seconds:.2}"));
        let [first, second] = self.to_errors.map(wait);
        let (seconds, processor) = (median(&self.seconds), median(&self.processor));
        println!(
            "| {} | {} | {seconds:.3} | {processor:.3} | {samples:.2} | {camera:.2} | {shadow:.2} | {mirror:.2} | {first} | {second} |",
            self.scene, self.threads
        );
    }
    /// What is known beside the seconds.
    fn more(&self) -> Value {
        let RayCount { camera, shadow, mirror, corner, .. } = self.rays;
        json!({
            "processor_seconds": self.processor,
            "samples": SIDE * SIDE * SPP,
            "rays": { "camera": camera, "shadow": shadow, "mirror": mirror, "corner": corner },
            "seconds_to_errors": self.to_errors,
        })
    }
}

/// Seconds until an image claims the error, if that is within the limit.
fn seconds_to(world: &World, settings: Settings, error: f64, limit: f64) -> Result<Option<f64>, String> {
    let goal = Goal { seconds: Some(limit), error: Some(error) };
    let plan = Refinement { settings, sampler: None, goal };
    let done = progressive::render(world, &plan, Beside::NOTHING, |_, _| (), |_| Ok(()))?;
    Ok(done.error.is_some_and(|claim| claim.total() <= error).then_some(done.seconds))
}

/// Measures a scene with one and with two threads.
fn measure(scene: &'static str, limit: f64) -> Result<[Measured; 2], Box<dyn Error>> {
    let world = World::from_scene(&mut etendue_scene::load(scene)?)?;
    let base = Settings { width: SIDE, height: SIDE, spp: SPP, seed: 1, ..Settings::DEFAULT };
    let settings = Settings { sampler: default_sampler(SPP, base.sets), ..base };
    let traced = Settings { technique: Technique::SolidAngle, ..settings };
    let new = |threads| Measured {
        scene,
        threads,
        seconds: Vec::new(),
        processor: Vec::new(),
        rays: RayCount::default(),
        to_errors: [None; 2],
    };
    let mut both = [new(1), new(2)];
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pools = [pool(1)?, pool(2)?];
    // the first image of each warms up
    for repetition in 0..=REPETITIONS {
        for (measured, pool) in both.iter_mut().zip(&pools) {
            let (before, start) = (processor_seconds(), Instant::now());
            measured.rays = pool.install(|| world.render(&traced, &|_| ())).1;
            let seconds = start.elapsed().as_secs_f64();
            if repetition > 0 {
                measured.seconds.push(seconds);
                measured.processor.extend(processor_seconds().zip(before).map(|(after, before)| after - before));
            }
        }
    }
    for (measured, pool) in both.iter_mut().zip(&pools).filter(|_| limit > 0.0) {
        for (seconds, error) in measured.to_errors.iter_mut().zip(ERRORS) {
            *seconds = pool.install(|| seconds_to(&world, settings, error, limit))?;
        }
    }
    Ok(both)
}

fn run() -> Result<(), Box<dyn Error>> {
    let (mut report, arguments) = Report::from_arguments()?;
    let (mut filter, mut limit) = ("", LIMIT);
    for argument in &arguments {
        match argument.split_once('=') {
            Some(("--limit", seconds)) => {
                let valid = seconds.parse().ok().filter(|seconds| (0.0..=1e6).contains(seconds));
                limit = valid.ok_or_else(|| format!("--limit={seconds}: not a number of seconds from 0 to 1e6"))?;
            }
            None if !argument.starts_with('-') => filter = argument,
            _ => return Err(format!("{argument}: not one of --json=FILE, --baseline=FILE and --limit=SECONDS").into()),
        }
    }
    let scenes: Vec<&str> = etendue_scene::builtin().iter().map(|(name, _)| *name).collect();
    let chosen: Vec<_> = scenes.iter().copied().filter(|scene| scene.contains(filter)).collect();
    if chosen.is_empty() {
        return Err(format!("{filter}: in the name of no scene; there are {}", scenes.join(", ")).into());
    }
    println!(
        "| scene | threads | s | processor s | M samples/s | M camera rays/s | M shadow rays/s | M mirror rays/s | s to 1 % | s to 0.1 % |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    for scene in chosen {
        for measured in measure(scene, limit).map_err(|error| format!("{scene}: {error}"))? {
            measured.print();
            report.add(&measured.id(), "s", &measured.seconds, measured.more());
        }
    }
    Ok(report.finish()?)
}

fn main() -> ExitCode {
    etendue_benches::exit_code(run())
}
