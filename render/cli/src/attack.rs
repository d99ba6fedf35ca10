//! `etendue selftest --attack`, `--claims` and `--choices`: random scenes by all techniques against the oracle, the errors that they claim,
//! and how well they choose between kinds of lights.

use clap::Args;
use etendue_laboratory::attack::choice;
use etendue_laboratory::attack::claims::{self, SHARE, Tally, honest};
use etendue_laboratory::attack::defects::{self, Table};
use etendue_laboratory::attack::judge::Effort;
use etendue_laboratory::attack::regimes::{REGIMES, Regime, named};
use etendue_laboratory::attack::report::{run, shrunk};
use etendue_render::files;
use etendue_render::options::{name, out, pool};
use std::error::Error;
use std::io::{self, Write};
use std::path::PathBuf;
use std::time::Instant;

#[derive(Args)]
pub(crate) struct AttackOptions {
    /// Render this many random scenes per regime, and compare them with an exhaustive renderer in double precision
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1 << 32))]
    attack: Option<u64>,
    /// Render this many random scenes per regime, and compare the errors that the images claim with those that they have
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1 << 32), conflicts_with = "attack")]
    claims: Option<u64>,
    /// Measure how well this many random scenes per regime choose between lamps, skies and suns
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1 << 32), conflicts_with_all = ["attack", "claims"])]
    choices: Option<u64>,
    /// Take random scenes of these regimes only [default: all]
    #[arg(long, value_name = "NAME", value_delimiter = ',', conflicts_with = "defects")]
    regime: Vec<String>,
    /// Write the scenes that differ to this folder, reduced to what still differs
    #[arg(long, value_name = "FOLDER", requires = "attack")]
    shrink: Option<PathBuf>,
    /// Compare the scenes on which the renderer was wrong once
    #[arg(long, conflicts_with_all = ["attack", "claims", "choices"])]
    defects: bool,
}

impl AttackOptions {
    /// Whether anything of this is asked for.
    pub(crate) const fn is_asked(&self) -> bool {
        self.attack.is_some()
            || self.claims.is_some()
            || self.choices.is_some()
            || self.defects
            || !self.regime.is_empty()
    }

    /// Prints the tables, with seeds from `seed` on, and `quality` as the width of images and their samples per pixel; returns whether all images agree.
    pub(crate) fn run(&self, seed: u64, quality: [u32; 2], threads: usize) -> Result<bool, Box<dyn Error>> {
        let pool = pool(threads)?;
        if self.defects {
            let compare = |case: &defects::Case| defects::compare(case, &defects::EFFORT);
            let cases = defects::all();
            let tables = pool.install(|| cases.iter().map(compare).collect::<Result<Vec<_>, _>>())?;
            tables.iter().try_for_each(|table| write!(io::stdout(), "{table}"))?;
            return Ok(tables.iter().all(Table::agrees));
        }
        if self.attack.is_none() && self.claims.is_none() && self.choices.is_none() {
            return Err("--regime needs --attack, --claims or --choices".into());
        }
        let find = |name: &String| named(name).ok_or_else(|| format!("no regime is called {name:?}: {}", known()));
        let mut regimes = self.regime.iter().map(find).collect::<Result<Vec<&Regime>, _>>()?;
        if regimes.is_empty() {
            regimes.extend(&REGIMES);
        }
        if let Some(count) = self.claims {
            return claim(&regimes, |regime| pool.install(|| claims::run(regime, seed..seed + count, quality)));
        }
        if let Some(count) = self.choices {
            let mut is_good = true;
            for regime in regimes {
                let tally = pool.install(|| choice::run(regime, seed..seed + count, quality))?;
                writeln!(out(), "{tally}")?;
                is_good &= !tally.choices.iter().any(|(choice, _)| choice.is_poor());
            }
            return Ok(is_good);
        }
        if let Some(folder) = &self.shrink {
            files::make_folder(folder)?;
        }
        let start = Instant::now();
        let (mut scenes, mut differ, mut z) = (0, 0, 0.0_f64);
        for regime in regimes {
            let tally = pool.install(|| run(regime, seed..seed + self.attack.unwrap_or(0), quality));
            let mut out = io::stdout().lock();
            writeln!(out, "{tally}")?;
            for failure in &tally.failures {
                writeln!(out, "  {failure}")?;
                let Some((folder, (technique, ..))) = self.shrink.as_ref().zip(failure.techniques.first()) else {
                    continue;
                };
                let effort = Effort::new(quality[0], quality[1], failure.seed);
                let least = pool.install(|| shrunk(&regime.draft(failure.seed), *technique, &effort));
                let path = folder.join(format!("{}-{}.pbrt", failure.regime, failure.seed));
                files::replace(&path, least.to_string().as_bytes())?;
                let shown = path.display();
                writeln!(
                    out,
                    "    {} primitives: etendue render {shown} --technique {}",
                    least.size(),
                    name(*technique)
                )?;
            }
            scenes += tally.scenes;
            differ += tally.failures.len();
            z = z.max(tally.z);
        }
        let seconds = start.elapsed().as_secs_f64();
        let verdict = if differ == 0 { "all agree".to_owned() } else { format!("{differ} DIFFER") };
        writeln!(io::stdout(), "{scenes} scenes, {seconds:.1} s: greatest |z| {z:.2}, {verdict}")?;
        Ok(differ == 0)
    }
}

/// Prints how the errors of images compare with those that they claim; returns whether enough are alike.
fn claim(regimes: &[&Regime], run: impl Fn(&Regime) -> Result<Tally, String>) -> Result<bool, Box<dyn Error>> {
    let mut all = Tally::default();
    for regime in regimes {
        let tally = run(regime)?;
        writeln!(out(), "{:13} {tally}", regime.name)?;
        all = all.and(tally);
    }
    let mut out = out();
    for way in all.ways() {
        writeln!(out, "{:13} {}", way.to_string(), all.by(way))?;
    }
    for (from, to) in [1.0, 8.0, 16.0, 64.0, f64::INFINITY].windows(2).map(|w| (w[0], w[1])) {
        writeln!(out, "{:13} {}", format!("{from} to {to} px"), all.spread(from..to))?;
    }
    writeln!(out, "{:13} {all}", "all")?;
    Ok(honest(&all.runs) >= SHARE)
}

/// The names of all regimes.
fn known() -> String {
    REGIMES.map(|regime| regime.name).join(", ")
}
