//! Runs regimes, and tells what has been found.

use super::draft::Draft;
use super::judge::{Against, Effort, Row, TECHNIQUES, Trial, confirmed};
use super::regimes::Regime;
use super::shrink::shrink;
use etendue_render::Technique;
use rayon::prelude::*;
use std::fmt::{self, Display, Formatter};
use std::ops::Range;
use std::time::Instant;

/// A scene on which a technique differs from the oracle, or from the sum of its lights.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// Name of the regime.
    pub regime: &'static str,
    /// Seed of the scene in its regime.
    pub seed: u64,
    /// The techniques that differ, from what, each with its greatest |z| and its greatest difference relative to the light if nothing hid
    /// it.
    pub techniques: Vec<(Technique, Against, f64, f64)>,
    /// Whether all techniques differ that have been compared.
    pub all: bool,
    /// Why the scene cannot be rendered, if it cannot.
    pub broken: Option<String>,
}

/// What the scenes of a regime have shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Tally {
    /// Name of the regime.
    pub regime: &'static str,
    /// Number of scenes.
    pub scenes: usize,
    /// Number of blocks compared, over all techniques.
    pub blocks: usize,
    /// Number of scenes in which `auto` computes light without samples.
    pub analytic: usize,
    /// Greatest |z| of the scenes that agree.
    pub z: f64,
    /// Greatest difference of a block relative to the light if nothing hid it.
    pub difference: f64,
    /// Time in seconds.
    pub seconds: f64,
    /// The scenes that differ.
    pub failures: Vec<Failure>,
}

/// Width and height of the images of a scene among thousands in pixels, and their samples per pixel.
pub const QUICK: [u32; 2] = [24, 64];

/// Judges the scenes of a regime with these seeds, on the threads of the current pool.
#[must_use]
pub fn run(regime: &Regime, seeds: Range<u64>, [side, spp]: [u32; 2]) -> Tally {
    let start = Instant::now();
    let verdicts: Vec<_> = seeds
        .clone()
        .into_par_iter()
        .map(|seed| {
            let effort = Effort::new(side, spp, seed);
            (seed, Trial::read(&regime.draft(seed), side).and_then(|trial| confirmed(&trial, &TECHNIQUES, &effort)))
        })
        .collect();
    let mut tally = Tally {
        regime: regime.name,
        scenes: verdicts.len(),
        blocks: 0,
        analytic: 0,
        z: 0.0,
        difference: 0.0,
        seconds: 0.0,
        failures: Vec::new(),
    };
    for (seed, verdict) in verdicts {
        let verdict = match verdict {
            Ok(verdict) => verdict,
            Err(why) => {
                let broken = Some(why);
                tally.failures.push(Failure { regime: regime.name, seed, techniques: Vec::new(), all: true, broken });
                continue;
            }
        };
        let differs = |row: &&Row| row.failing().next().is_some();
        let failing: Vec<&Row> = verdict.rows.iter().filter(differs).collect();
        for row in &verdict.rows {
            tally.blocks += row.z.len();
            tally.difference = tally.difference.max(row.greatest_difference().abs());
            if !differs(&row) {
                tally.z = tally.z.max(row.greatest_z());
            }
        }
        tally.analytic += usize::from(verdict.rows[0].chosen == Technique::Analytic);
        if !failing.is_empty() {
            let of = |row: &&Row| (row.technique, row.against, row.greatest_z(), row.greatest_difference());
            tally.failures.push(Failure {
                regime: regime.name,
                seed,
                techniques: failing.iter().map(of).collect(),
                all: failing.len() == verdict.rows.len(),
                broken: None,
            });
        }
    }
    tally.seconds = start.elapsed().as_secs_f64();
    tally
}

/// The fewest parts of a scene on which this technique still differs.
#[must_use]
pub fn shrunk(draft: &Draft, technique: Technique, effort: &Effort) -> Draft {
    let fails = |candidate: &Draft| {
        let trial = Trial::read(candidate, effort.side);
        let verdict = trial.and_then(|trial| confirmed(&trial, &[technique], effort));
        verdict.is_ok_and(|verdict| verdict.failing().next().is_some())
    };
    shrink(draft, fails)
}

impl Display for Failure {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}:", self.regime, self.seed)?;
        if let Some(why) = &self.broken {
            return write!(f, " cannot be rendered: {why}");
        }
        for (technique, against, z, difference) in &self.techniques {
            let sum = if *against == Against::Sum { " from the sum" } else { "" };
            write!(f, " {}{sum} by {difference:+.2e} (|z| {:.1})", technique.name(), z.min(1e9))?;
        }
        f.write_str(if self.all { ", all techniques" } else { "" })
    }
}

impl Display for Tally {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{:13} {:6} scenes, {:6} analytic, {:8} blocks, greatest |z| {:.2}, greatest difference {:.1e}, {:6.1} s",
            self.regime, self.scenes, self.analytic, self.blocks, self.z, self.difference, self.seconds
        )?;
        let all = self.failures.iter().filter(|failure| failure.all).count();
        if !self.failures.is_empty() {
            write!(f, ", {} DIFFER ({all} by all techniques)", self.failures.len())?;
        }
        Ok(())
    }
}
