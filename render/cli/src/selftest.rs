//! `etendue selftest`: prints a table of images that should agree.

use clap::{Args, ValueEnum};
use etendue_laboratory::attack::report;
use etendue_laboratory::selftest::{self, Effort};
use etendue_render::limits::MOST_SAMPLES;
use etendue_render::options::{name, out, pool, threads, whole};
use etendue_render::{Settings, Technique, World, scene};
use std::error::Error;
use std::ffi::OsString;
use std::io::Write;
use std::time::Instant;

#[derive(Args)]
pub(crate) struct Options {
    /// Names of built-in scenes, or paths of pbrt-v4 or glTF files [default: all built-in scenes of few lights]
    scenes: Vec<OsString>,
    /// Take this many samples per pixel
    #[arg(long, default_value_t = 64, value_parser = whole::<u32>(2..=MOST_SAMPLES.into()))]
    spp: u32,
    /// Render images of this width and height in pixels [default: 64, or 24 with --attack]
    #[arg(long, value_parser = whole::<u32>(1..=4096))]
    side: Option<u32>,
    /// Seed the random numbers with this; different seeds give independent images
    #[arg(long, default_value_t = 0, value_parser = whole::<u64>(0..=u64::MAX))]
    seed: u64,
    /// Follow a camera ray through at most this many perfect mirrors
    #[arg(long, default_value_t = Settings::DEPTH, value_parser = whole::<u32>(0..=1024))]
    depth: u32,
    /// Use this many threads; 0 means one per core
    #[arg(long, default_value_t = 0, value_parser = threads)]
    threads: usize,
    #[command(flatten)]
    attack: crate::attack::AttackOptions,
}

/// Prints the table; returns whether all images agree.
pub(crate) fn run(options: &Options) -> Result<bool, Box<dyn Error>> {
    if options.attack.is_asked() {
        let quality = [options.side.unwrap_or(report::QUICK[0]), options.spp];
        return options.attack.run(options.seed, quality, options.threads);
    }
    let mut names = options.scenes.clone();
    if names.is_empty() {
        names.extend(scene::builtin_of_few_lights().iter().map(|(name, _)| OsString::from(name)));
    }
    let effort =
        Effort { side: options.side.unwrap_or(64), spp: options.spp, seed: options.seed, depth: options.depth };
    let pool = pool(options.threads)?;
    let scenes = names.iter().map(scene::load).collect::<Result<Vec<_>, _>>()?;
    let start = Instant::now();
    let (mut worst, mut images) = (0.0_f64, 0);
    writeln!(
        out(),
        "{side}x{side} pixels, {spp} samples per pixel, seed {seed}; z compares each image with all others of its scene",
        side = effort.side,
        spp = options.spp,
        seed = options.seed
    )?;
    for scene in &scenes {
        let world = pool.install(|| World::new(scene))?;
        let rows = pool.install(|| selftest::rows(scene, &world, &effort));
        let mut out = out();
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
        for &technique in Technique::value_variants() {
            if let Some(why) = selftest::left_out(technique, scene) {
                writeln!(out, "  {:21} not compared, because {why}", name(technique))?;
            }
        }
        worst = worst.max(selftest::worst(&rows));
        images += rows.len();
    }
    let seconds = start.elapsed().as_secs_f64();
    let verdict = if worst < selftest::LIMIT { "all agree" } else { "NOT all agree" };
    writeln!(out(), "{} scenes, {images} images, {seconds:.1} s: greatest |z| {worst:.2}, {verdict}", scenes.len())?;
    Ok(worst < selftest::LIMIT)
}
