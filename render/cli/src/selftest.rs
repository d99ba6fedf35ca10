//! `etendue selftest`: random scenes by all techniques against the oracle.

use clap::Args;
use etendue_laboratory::attack::judge::Effort;
use etendue_laboratory::attack::regimes::{REGIMES, Regime, named};
use etendue_laboratory::attack::report::{self, QUICK, shrunk};
use etendue_laboratory::options::{out, pool, threads, whole};
use etendue_render::files;
use etendue_render::limits::MOST_SAMPLES;
use rayon::ThreadPool;
use std::error::Error;
use std::io::Write;
use std::ops::Range;
use std::path::PathBuf;
use std::time::Instant;

#[derive(Args)]
pub(crate) struct Options {
    /// Number of random scenes of each regime
    #[arg(default_value_t = 10, value_parser = whole::<u64>(1..=1 << 32))]
    scenes: u64,
    /// Take random scenes of these regimes only [default: all]
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    regime: Vec<String>,
    /// Write the scenes that differ to this folder, reduced to what still differs
    #[arg(long, value_name = "FOLDER")]
    shrink: Option<PathBuf>,
    /// Take this many samples per pixel
    #[arg(long, default_value_t = QUICK[1], value_parser = whole::<u32>(2..=MOST_SAMPLES.into()))]
    spp: u32,
    /// Render images of this width and height in pixels
    #[arg(long, default_value_t = QUICK[0], value_parser = whole::<u32>(1..=4096))]
    side: u32,
    /// Seed of the first scene of each regime; the others have the next ones
    #[arg(long, default_value_t = 0, value_parser = whole::<u64>(0..=1 << 63))]
    seed: u64,
    /// Use this many threads; 0 means one per core
    #[arg(long, default_value_t = 0, value_parser = threads)]
    threads: usize,
}

/// Prints the tables; returns whether all is well.
pub(crate) fn run(options: &Options) -> Result<bool, Box<dyn Error>> {
    let pool = pool(options.threads)?;
    let find = |name: &String| named(name).ok_or_else(|| format!("no regime is called {name:?}: {}", known()));
    let mut regimes = options.regime.iter().map(find).collect::<Result<Vec<&Regime>, _>>()?;
    if regimes.is_empty() {
        regimes.extend(&REGIMES);
    }
    let seeds = options.seed..options.seed + options.scenes;
    compare(options, &regimes, &seeds, &pool)
}

/// Compares random scenes by all techniques with the oracle; returns whether all agree.
fn compare(
    Options { side, spp, shrink, .. }: &Options,
    regimes: &[&Regime],
    seeds: &Range<u64>,
    pool: &ThreadPool,
) -> Result<bool, Box<dyn Error>> {
    if let Some(folder) = shrink {
        files::make_folder(folder)?;
    }
    let start = Instant::now();
    let (mut scenes, mut differ, mut z) = (0, 0, 0.0_f64);
    for regime in regimes {
        let tally = pool.install(|| report::run(regime, seeds.clone(), [*side, *spp]));
        writeln!(out(), "{tally}")?;
        for failure in &tally.failures {
            writeln!(out(), "  {failure}")?;
            let Some((folder, (technique, ..))) = shrink.as_ref().zip(failure.techniques.first()) else {
                continue;
            };
            let effort = Effort::new(*side, *spp, failure.seed);
            let least = pool.install(|| shrunk(&regime.draft(failure.seed), *technique, &effort));
            let path = folder.join(format!("{}-{}.pbrt", failure.regime, failure.seed));
            files::replace(&path, least.to_string().as_bytes())?;
            let (size, shown) = (least.size(), path.display());
            writeln!(out(), "    {size} primitives: etendue render {shown} --technique {}", technique.name())?;
        }
        scenes += tally.scenes;
        differ += tally.failures.len();
        z = z.max(tally.z);
    }
    let seconds = start.elapsed().as_secs_f64();
    let verdict = if differ == 0 { "all agree".to_owned() } else { format!("{differ} DIFFER") };
    writeln!(out(), "{scenes} scenes, {seconds:.1} s: greatest |z| {z:.2}, {verdict}")?;
    Ok(differ == 0)
}

/// The names of all regimes.
fn known() -> String {
    REGIMES.map(|regime| regime.name).join(", ")
}
