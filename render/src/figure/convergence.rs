//! Figures of measurements: how error falls, and what it costs.

use super::images::ratio_text;
use super::sheet::Svg;
use super::{Finding, Studio};
use crate::chart::charts::{self, with_interval};
use crate::chart::stats::Estimate;
use crate::chart::summary::Summary;
use crate::chart::{self, Outcome, name};
use crate::{Sampler, Settings, Technique, World, image, scene};
use clap::ValueEnum;
use std::error::Error;

/// Samplers of these names that this program has.
fn samplers(names: &[&str]) -> Vec<Sampler> {
    names.iter().filter_map(|name| Sampler::from_str(name, false).ok()).collect()
}

impl Studio<'_> {
    /// Measures into a folder beside the figures.
    fn measure(
        &self,
        folder: &str,
        scenes: &[&str],
        techniques: Vec<Technique>,
        samplers: Vec<Sampler>,
        spp: Vec<u32>,
        replicates: u32,
    ) -> Result<Outcome, Box<dyn Error>> {
        let options = chart::Options {
            scenes: scenes.iter().map(|s| (*s).to_owned()).collect(),
            output: self.options.output.join(folder),
            techniques,
            samplers,
            spp,
            replicates: Some(replicates),
            reference: None,
            reference_error: 0.0,
            reference_spp: None,
            size: Some((128, 128)),
            seed: self.options.seed,
            threads: self.options.threads,
            baseline: Technique::Area,
            target: None,
            time_limit: None,
            warps: false,
            quick: false,
        };
        chart::measure(&options, self.stop)
    }

    pub(super) fn quads_convergence(&self) -> Result<Finding, Box<dyn Error>> {
        let samplers = samplers(&["independent", "stratified"]);
        let counts: Vec<u32> = (0..11).map(|k| 1 << k).collect();
        let outcome =
            self.measure("quads-convergence", &["quads"], vec![Technique::SolidAngle], samplers.clone(), counts, 5)?;
        let summary = outcome.summaries.first().ok_or("nothing was measured")?;
        let mut headline = slopes(summary);
        let last = |k: usize| summary.series[k].points.last().map(|p| p.mse);
        if let [Some(a), Some(b)] = [last(0), last(1)] {
            headline.push(format!("at 1024 samples stratified has {:.1} times less error", a.value / b.value));
        }
        // a corner of a box with its shadows
        let world = World::new(&scene::load("quads")?)?;
        let mut rows = vec![Svg::chart(&charts::error_over_samples(summary).drawing)];
        for sampler in samplers {
            let crops = [1, 4, 16, 64, 256].map(|spp| {
                let settings = Settings {
                    width: 256,
                    height: 256,
                    spp,
                    technique: Technique::SolidAngle,
                    sampler,
                    seed: self.options.seed,
                    depth: Settings::DEPTH,
                };
                let film = world.render(&settings, |_| ()).0;
                let at = |i: usize| &film.pixels[(84 + i / 80) * 256 + 60 + i % 80];
                let pixels: Vec<_> = (0..80 * 80).map(|i| image::tone_map(at(i).mean)).collect();
                Svg::image(&format!("{}, {spp}", name(sampler)), [80, 80], &pixels, 150.0)
            });
            rows.push(Svg::row(crops.into()));
        }
        Ok(Finding { svg: Svg::column(rows).captioned(&headline), headline })
    }

    pub(super) fn efficiency(&self) -> Result<Finding, Box<dyn Error>> {
        let scenes: Vec<&str> = scene::builtin().iter().map(|(name, _)| *name).collect();
        let outcome = self.measure("efficiency", &scenes, Vec::new(), vec![Sampler::Independent], vec![16], 8)?;
        let mut headline = Vec::new();
        let mut charts = Vec::new();
        for summary in &outcome.summaries {
            charts.extend(charts::efficiency(summary).map(|f| Svg::chart(&f.drawing)));
            let best = summary.gains.iter().max_by(|a, b| a.gain.value.total_cmp(&b.gain.value));
            if let Some(best) = best {
                headline.push(format!(
                    "{}: {} has {} times the efficiency of area",
                    summary.scene,
                    name(summary.series[best.series].way.technique),
                    ratio_text(&best.gain)
                ));
            }
        }
        let mut charts = charts.into_iter();
        let mut rows = Vec::new();
        loop {
            let two: Vec<_> = charts.by_ref().take(2).collect();
            if two.is_empty() {
                break;
            }
            rows.push(Svg::row(two));
        }
        Ok(Finding { svg: Svg::column(rows).captioned(&headline), headline })
    }

    pub(super) fn padding(&self) -> Result<Finding, Box<dyn Error>> {
        let samplers = samplers(&["independent", "stratified", "sobol", "stratified-4d", "sobol-4d"]);
        // each is n⁴, 2n⁴ or 4n⁴
        let counts = vec![1, 4, 16, 64, 256, 1024];
        let outcome = self.measure("padding", &["sphere-light"], vec![Technique::SolidAngle], samplers, counts, 5)?;
        let summary = outcome.summaries.first().ok_or("nothing was measured")?;
        let mut headline = slopes(summary);
        let error = |k: usize, spp: u32| summary.series[k].at(spp).map(|p| p.mse);
        for k in 1..summary.series.len() {
            if let [Some(a), Some(b)] = [error(0, 256), error(k, 256)] {
                let ratio =
                    Estimate { value: a.value / b.value, half: a.value / b.value * (a.relative() + b.relative()) };
                let name = name(summary.series[k].way.sampler);
                headline.push(format!(
                    "at 256 samples {name} has {:.1} ± {:.1} times less error than independent",
                    ratio.value, ratio.half
                ));
            }
        }
        let mut lines = vec!["Pixel and light are four dimensions: strata in pairs that are associated at random (padding), or together.".to_owned()];
        lines.extend(headline.iter().cloned());
        let svg = Svg::chart(&charts::error_over_samples(summary).drawing);
        Ok(Finding { svg: svg.captioned(&lines), headline })
    }
}

/// The slope of each series.
fn slopes(summary: &Summary) -> Vec<String> {
    let one = |s: &crate::chart::summary::Series| {
        let slope = s.slope.as_ref().map_or_else(|| "?".to_owned(), |e| with_interval(e).replace('-', "−"));
        format!("{}: slope {slope}", s.way.title())
    };
    summary.series.iter().map(one).collect()
}
