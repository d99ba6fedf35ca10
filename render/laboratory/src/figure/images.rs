//! Figures of images rendered with few samples.

use super::sheet::Svg;
use super::studio::{Finding, Studio};
use crate::chart::pictures::heat;
use crate::chart::plot::short;
use crate::chart::reference::Reference;
use crate::chart::stats::{Cost, Estimate, gain};
use crate::hash::fnv1a;
use etendue_render::film::Film;
use etendue_render::options::name;
use etendue_render::{Sampler, Settings, Technique, World, image, scene};
use std::error::Error;

/// Number of images, with different seeds, from which a figure's numbers are computed.
const REPLICATES: u64 = 12;
/// Side of an image on the sheet, in CSS pixels.
const SIDE: f64 = 256.0;

fn pixels(film: &Film) -> Vec<[u8; 3]> {
    film.pixels.iter().map(|p| image::tone_map(p.mean)).collect()
}

impl Studio<'_> {
    /// Renders replicates of an image of 256×256 pixels.
    fn films(&self, world: &World, technique: Technique, spp: u32, count: u64) -> impl Iterator<Item = Film> {
        let seed = self.seed.wrapping_add(fnv1a(format!("{}/{spp}", name(technique)).as_bytes()));
        (0..count).map(move |k| {
            let settings = Settings {
                width: 256,
                height: 256,
                spp,
                technique,
                depth: Settings::DEPTH,
                sampler: Sampler::Independent,
                sets: 0,
                seed: seed.wrapping_add(k),
            };
            world.render(&settings, &|_| ()).0
        })
    }

    /// Shows techniques side by side, with the ratio of the first one's error to each other one's.
    fn versus(&self, scene_name: &str, spp: u32, techniques: &[Technique]) -> Result<Finding, Box<dyn Error>> {
        let world = World::new(&scene::load(scene_name)?)?;
        let reference = Reference::builtin(scene_name).ok_or("the scene has no built-in reference")?;
        let mut panels = Vec::new();
        let mut costs: Vec<Vec<Cost>> = Vec::new();
        for &technique in techniques {
            let mut errors = Vec::new();
            for (k, film) in self.films(&world, technique, spp, REPLICATES).enumerate() {
                if k == 0 {
                    panels.push(Svg::image(&name(technique), [256, 256], &pixels(&film), SIDE));
                }
                let (squared, _) = reference.difference(film.pixels.iter().map(|p| p.mean));
                errors.push(Cost { mse: squared - reference.error, seconds: 1.0 });
            }
            costs.push(errors);
        }
        let truth: Vec<_> = reference.picture.radiance.iter().map(|p| image::tone_map(*p)).collect();
        panels.push(Svg::image("reference", [256, 256], &truth, SIDE));
        let mut lines = vec![format!(
            "{scene_name}, 256×256, {spp} samples per pixel, each with one shadow ray. Mean squared error over {REPLICATES} images, with \
             95 % intervals:"
        )];
        for (technique, errors) in techniques.iter().zip(&costs) {
            let e = Estimate::of(&errors.iter().map(|c| c.mse).collect::<Vec<_>>());
            lines.push(format!("{}: {:.3e} ± {:.1} %", name(*technique), e.value, 100.0 * e.relative()));
        }
        for (technique, errors) in techniques.iter().zip(&costs).skip(1) {
            let ratio = gain(errors, &costs[0]).ok_or("a measured error is not positive")?;
            let first = name(techniques[0]);
            lines.push(format!("MSE ratio {first} / {} = {}", name(*technique), ratio_text(&ratio)));
        }
        Ok(Finding { svg: Svg::row(panels).captioned(&lines), headline: lines })
    }

    pub(super) fn hemisphere_vs_area(&self) -> Result<Finding, Box<dyn Error>> {
        self.versus("quads", 16, &[Technique::UniformHemisphere, Technique::Area])
    }

    pub(super) fn sphere_area_vs_cone(&self) -> Result<Finding, Box<dyn Error>> {
        self.versus("sphere-light", 16, &[Technique::Area, Technique::SolidAngle])
    }

    pub(super) fn triangle_area_vs_solid_angle(&self) -> Result<Finding, Box<dyn Error>> {
        let techniques = [Technique::Area, Technique::SolidAngle, Technique::ProjectedSolidAngle];
        self.versus("triangle-light", 16, &techniques)
    }

    /// Shows an image of four samples, their estimate of its variance, and the true variance.
    pub(super) fn sample_variance(&self) -> Result<Finding, Box<dyn Error>> {
        const N: u32 = 4;
        let world = World::new(&scene::load("quads")?)?;
        let reference = Reference::builtin("quads").ok_or("the scene has no built-in reference")?;
        let mean = |v: [f32; 3]| (f64::from(v[0]) + f64::from(v[1]) + f64::from(v[2])) / 3.0;
        // the variance of one sample, estimated from many
        let many = self.films(&world, Technique::SolidAngle, 4096, 1).next().ok_or("no image")?;
        let truth: Vec<f64> = many.pixels.iter().map(|p| mean(p.variance) * 4096.0).collect();
        let mut first = None;
        let (mut ratios, mut shares) = (Vec::new(), Vec::new());
        for film in self.films(&world, Technique::SolidAngle, N, REPLICATES) {
            let (squared, _) = reference.difference(film.pixels.iter().map(|p| p.mean));
            let claimed: Vec<f64> = film.pixels.iter().map(|p| mean(p.variance) * f64::from(N)).collect();
            let average = claimed.iter().sum::<f64>() / claimed.len() as f64;
            ratios.push(average / f64::from(N) / (squared - reference.error));
            let low = claimed.iter().zip(&truth).filter(|(c, t)| **c < **t / 2.0).count();
            shares.push(100.0 * low as f64 / claimed.len() as f64);
            first.get_or_insert((pixels(&film), claimed));
        }
        let (picture, claimed) = first.ok_or("no image")?;
        let mut sorted: Vec<f64> = truth.iter().copied().filter(|v| *v > 0.0).collect();
        sorted.sort_by(f64::total_cmp);
        let at = |q: f64| sorted.get((sorted.len() as f64 * q) as usize).copied().unwrap_or(1.0);
        let (low, high) = (at(0.02), at(0.995));
        let scaled = |v: &[f64]| -> Vec<[u8; 3]> {
            v.iter().map(|v| heat((v.max(low) / low).ln() / (high / low).ln())).collect()
        };
        let panels = vec![
            Svg::image("mean of 4 samples", [256, 256], &picture, SIDE),
            Svg::image("variance estimated from 4", [256, 256], &scaled(&claimed), SIDE),
            Svg::image("variance estimated from 4096", [256, 256], &scaled(&truth), SIDE),
        ];
        let (ratio, share) = (Estimate::of(&ratios), Estimate::of(&shares));
        let lines = vec![
            format!(
                "quads, solid-angle, independent: variance of one sample on a logarithmic scale; black is {} or less, \
                 pale yellow {} or more.",
                short(low),
                short(high)
            ),
            format!(
                "Over the image, the sample variance/4 is correct: {:.3} ± {:.3} of the measured squared error, over {REPLICATES} images.",
                ratio.value, ratio.half
            ),
            format!(
                "In single pixels it is not: in {:.1} ± {:.1} % of them it is less than half of the true variance.",
                share.value, share.half
            ),
        ];
        Ok(Finding { svg: Svg::row(panels).captioned(&lines), headline: lines[1..].to_vec() })
    }
}

/// Formats a ratio with the interval of its logarithm.
pub(super) fn ratio_text(ratio: &Estimate) -> String {
    let factor = 1.0 + ratio.half / ratio.value;
    format!("{} ({} to {})", short(ratio.value), short(ratio.value / factor), short(ratio.value * factor))
}
