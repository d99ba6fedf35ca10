//! Figures of measured convergence and efficiency.

use super::images::ratio_text;
use super::sheet::Svg;
use super::studio::{Finding, Studio};
use crate::chart::charts::{self, Show, with_interval};
use crate::chart::summary::Summary;
use crate::chart::{self, Outcome};
use clap::ValueEnum;
use etendue_render::options::name;
use etendue_render::{Sampler, Settings, Technique, World, image, scene};
use std::error::Error;

/// The samplers with these names, as far as they exist.
fn samplers(names: &[&str]) -> Vec<Sampler> {
    names.iter().filter_map(|name| Sampler::from_str(name, false).ok()).collect()
}

impl Studio<'_> {
    /// Measures, with the results in a folder beside the figures.
    #[expect(clippy::too_many_arguments, reason = "the options that differ between figures")]
    fn measure(
        &self,
        folder: &str,
        scenes: &[&str],
        techniques: Vec<Technique>,
        samplers: Vec<Sampler>,
        spp: Vec<u32>,
        replicates: u32,
        reference_spp: Option<u32>,
    ) -> Result<Outcome, Box<dyn Error>> {
        let options = chart::Options {
            environment: None,
            scenes: scenes.iter().map(|s| (*s).into()).collect(),
            output: self.output.join(folder),
            techniques,
            samplers,
            spp,
            replicates: Some(replicates),
            reference: None,
            reference_error: 0.0,
            reference_spp,
            size: Some((128, 128)),
            seed: self.seed,
            threads: self.threads,
            baseline: Technique::Area,
            target: None,
            time_limit: Some(3600),
            warps: false,
            // renders missing references with fewer samples
            quick: true,
        };
        chart::measure(&options, self.stop)
    }

    pub(super) fn quads_convergence(&self) -> Result<Finding, Box<dyn Error>> {
        let samplers = samplers(&["independent", "stratified"]);
        let counts: Vec<u32> = (0..11).map(|k| 1 << k).collect();
        let outcome = self.measure(
            "quads-convergence",
            &["quads"],
            vec![Technique::SolidAngle],
            samplers.clone(),
            counts,
            5,
            None,
        )?;
        let summary = outcome.summaries.first().ok_or("nothing was measured")?;
        let mut headline = slopes(summary);
        let last = |k: usize| summary.series[k].points.last().map(|p| p.mse);
        if let [Some(a), Some(b)] = [last(0), last(1)] {
            headline.push(format!(
                "at 1024 samples, independent has {:.1} times the error of stratified",
                a.value / b.value
            ));
        }
        // crops of a box's corner with its shadows
        let world = World::new(&scene::load("quads")?)?;
        let mut rows = vec![Svg::chart(&charts::error_over_samples(summary, Show::All).drawing)];
        for sampler in samplers {
            let crops = [1, 4, 16, 64, 256].map(|spp| {
                let settings = Settings {
                    width: 256,
                    height: 256,
                    spp,
                    technique: Technique::SolidAngle,
                    depth: Settings::DEPTH,
                    sampler,
                    sets: 1,
                    seed: self.seed,
                };
                let film = world.render(&settings, &|_| ()).0;
                let at = |i: usize| &film.pixels[(84 + i / 80) * 256 + 60 + i % 80];
                let pixels: Vec<_> = (0..80 * 80).map(|i| image::tone_map(at(i).mean)).collect();
                Svg::image(&format!("{}, {spp}", name(sampler)), [80, 80], &pixels, 150.0)
            });
            rows.push(Svg::row(crops.into()));
        }
        Ok(Finding { svg: Svg::column(rows).captioned(&headline), headline })
    }

    pub(super) fn efficiency(&self) -> Result<Finding, Box<dyn Error>> {
        let scenes: Vec<&str> = scene::builtin_of_few_lights().iter().map(|(name, _)| *name).collect();
        let outcome = self.measure("efficiency", &scenes, Vec::new(), vec![Sampler::Independent], vec![16], 8, None)?;
        let mut headline = Vec::new();
        let mut charts = Vec::new();
        // a scene in which all techniques coincide has nothing to compare
        for summary in outcome.summaries.iter().filter(|s| s.series.len() > 1) {
            charts.extend(charts::efficiency(summary, Show::All).map(|f| Svg::chart(&f.drawing)));
            let best = summary.gains.iter().max_by(|a, b| a.gain.value.total_cmp(&b.gain.value));
            headline.push(match best {
                Some(best) if Some(best.series) != summary.baseline => format!(
                    "{}: {} has {} times the efficiency of area",
                    summary.scene,
                    name(summary.series[best.series].way.technique),
                    ratio_text(&best.gain)
                ),
                _ => format!("{}: no technique is more efficient than area", summary.scene),
            });
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
        // all counts are n⁴, 2n⁴ or 4n⁴
        let about = "Pixel and light have four dimensions: points are well distributed in pairs that are combined at random (padding), \
                     or in all four dimensions together.";
        self.joint("padding", "sphere-light", vec![1, 4, 16, 64, 256, 1024], about)
    }

    pub(super) fn defocus(&self) -> Result<Finding, Box<dyn Error>> {
        // stratified-4d uses only the counts n⁶, 2n⁶ and 4n⁶
        let about = "Pixel, lens and light have six dimensions: points are well distributed in pairs that are combined at random \
                     (padding), or in all six dimensions together.";
        self.joint("defocus", "defocus", vec![1, 4, 16, 64, 256, 1024], about)
    }

    /// Compares padded with joint samplers.
    fn joint(&self, name: &str, scene: &str, counts: Vec<u32>, about: &str) -> Result<Finding, Box<dyn Error>> {
        const AT: u32 = 256;
        // with fewer samples, the error of the reference would hide that of the best samplers
        let reference_spp = (scene == "defocus").then_some(8192);
        let samplers = samplers(&["independent", "stratified", "sobol", "stratified-4d", "sobol-4d"]);
        let techniques = vec![Technique::SolidAngle];
        let outcome = self.measure(name, &[scene], techniques, samplers, counts, 5, reference_spp)?;
        let summary = outcome.summaries.first().ok_or("nothing was measured")?;
        let mut headline = slopes(summary);
        let error = |k: usize| summary.series[k].at(AT).map(|p| p.mse);
        for k in 1..summary.series.len() {
            if let [Some(a), Some(b)] = [error(0), error(k)] {
                let ratio = a.value / b.value;
                let half = ratio * (a.relative() + b.relative());
                let name = etendue_render::options::name(summary.series[k].way.sampler);
                headline
                    .push(format!("at {AT} samples, independent has {ratio:.1} ± {half:.1} times the error of {name}"));
            }
        }
        let mut lines = vec![about.to_owned()];
        lines.extend(headline.iter().cloned());
        let svg = Svg::chart(&charts::error_over_samples(summary, Show::All).drawing);
        Ok(Finding { svg: svg.captioned(&lines), headline })
    }
}

/// Describes the slope of each series.
fn slopes(summary: &Summary) -> Vec<String> {
    let one = |s: &crate::chart::summary::Series| {
        let slope = s.slope.as_ref().map_or_else(|| "?".to_owned(), |e| with_interval(e).replace('-', "−"));
        format!("{}: slope {slope}", s.way.title())
    };
    summary.series.iter().map(one).collect()
}
