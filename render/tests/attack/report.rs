//! Runs regimes, and tells what has been found.

use super::draft::Draft;
use super::judge::{Against, Effort, TECHNIQUES, Trial, Verdict, confirmed};
use super::regimes::Regime;
use etendue_render::Technique;
use rayon::prelude::*;
use std::fmt::{self, Display, Formatter};
use std::ops::Range;

/// What the scenes of a regime have shown.
#[derive(Default)]
pub(crate) struct Tally {
    regime: &'static str,
    scenes: usize,
    /// Number of blocks compared, over all techniques.
    blocks: usize,
    /// Number of scenes in which `auto` computes light without samples.
    analytic: usize,
    /// Greatest |z| of the techniques that agree.
    z: f64,
    /// Greatest difference of a block relative to the light if nothing hid it.
    difference: f64,
    /// The scenes that differ, and how; the first of them as its text.
    pub(crate) failures: Vec<String>,
}

/// Width and height of the images of a scene among thousands in pixels, and their samples per pixel.
pub(crate) const QUICK: [u32; 2] = [24, 64];

/// Judges the scenes of a regime with these seeds, on the threads of the current pool.
pub(crate) fn run(regime: &Regime, seeds: Range<u64>, [side, spp]: [u32; 2]) -> Tally {
    let judged = |seed| {
        let (draft, effort) = (regime.draft(seed), Effort::new(side, spp, seed));
        let verdict = Trial::read(&draft, side).and_then(|trial| confirmed(&trial, &TECHNIQUES, &effort));
        (draft, verdict)
    };
    let verdicts: Vec<_> = seeds.into_par_iter().map(judged).collect();
    let mut tally = Tally { regime: regime.name, scenes: verdicts.len(), ..Tally::default() };
    for (draft, verdict) in verdicts {
        match verdict {
            Ok(verdict) => tally.add(&draft, &verdict),
            Err(why) => tally.failures.push(format!("{}: cannot be rendered: {why}", draft.name)),
        }
    }
    tally
}

impl Tally {
    fn add(&mut self, draft: &Draft, verdict: &Verdict) {
        let mut failing = Vec::new();
        for row in &verdict.rows {
            let (z, difference) = (row.greatest_z(), row.greatest_difference());
            self.blocks += row.z.len();
            self.difference = self.difference.max(difference.abs());
            if row.failing().next().is_none() {
                self.z = self.z.max(z);
                continue;
            }
            let from = if row.against == Against::Sum { " from the sum" } else { "" };
            failing.push(format!("{}{from} by {difference:+.2e} (|z| {:.1})", row.technique.name(), z.min(1e9)));
        }
        self.analytic += usize::from(verdict.rows[0].chosen == Technique::Analytic);
        if !failing.is_empty() {
            let all = if failing.len() == verdict.rows.len() { ", all techniques" } else { "" };
            let text = if self.failures.is_empty() { format!("\n{draft}") } else { String::new() };
            self.failures.push(format!("{}: {}{all}{text}", draft.name, failing.join(", ")));
        }
    }
}

impl Display for Tally {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { regime, scenes, blocks, analytic, z, difference, failures } = self;
        write!(
            f,
            "{regime:13} {scenes:6} scenes, {analytic:6} analytic, {blocks:8} blocks, greatest |z| {z:.2}, \
             greatest difference {difference:.1e}, {} differ",
            failures.len()
        )
    }
}
