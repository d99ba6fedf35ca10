//! The figure of certificates: which lights the technique `analytic` computes without samples.

use super::sheet::Svg;
use super::studio::{Finding, Studio};
use etendue_render::certify::Survey;
use etendue_render::options::name;
use etendue_render::{Sampler, Settings, Technique, World, image, scene};
use std::error::Error;
use std::sync::atomic::Ordering;

/// The scenes shown; the table has all built-in ones of few lights.
const SHOWN: [&str; 6] = ["quads", "triangle-light", "sphere-light", "cornell-box", "terrain", "mirror-room"];
/// Side of images and surveys in pixels.
const SIDE: u32 = 256;
/// Side in pixels of the images whose rays are counted, and their samples per pixel.
const COUNTED: u32 = 128;
const SPP: u32 = 16;
/// What can be known of a light, in the order of [`outcomes`], and its colour.
const OUTCOMES: [(&str, [u8; 3]); 6] = [
    ("lit", [250, 238, 160]),
    ("dark", [34, 52, 120]),
    ("1 to 4 possible blockers", [132, 204, 110]),
    ("5 to 8 possible blockers", [24, 122, 72]),
    ("known blockers, but sampled", [236, 150, 60]),
    ("sampled", [206, 52, 44]),
];
/// The colour of pixels that show no surface that reflects.
const EMPTY: (&str, [u8; 3]) = ("no surface that reflects", [222, 222, 222]);

/// Numbers of lights at a pixel.
fn outcomes(survey: &Survey) -> [u32; OUTCOMES.len()] {
    [survey.lit, survey.dark, survey.few, survey.many, survey.crowded, survey.unknown]
}

/// The mean colour of the lights at a pixel.
fn colour(survey: &Survey) -> [u8; 3] {
    let lights = survey.lights();
    if lights == 0 {
        return EMPTY.1;
    }
    let counts = outcomes(survey);
    let sum = |k: usize| OUTCOMES.iter().zip(counts).map(|((_, colour), n)| n * u32::from(colour[k])).sum::<u32>();
    std::array::from_fn(|k| (sum(k) / lights) as u8)
}

/// What is known of a scene, and what that saves.
struct Account {
    surveys: Vec<Survey>,
    /// Numbers of pairs of a pixel and a light.
    pairs: [u64; OUTCOMES.len()],
    /// Shadow rays per pixel with `solid-angle` and with `analytic`.
    rays: [f64; 2],
    /// What `auto` chooses.
    auto: Technique,
    picture: Vec<[u8; 3]>,
}

impl Account {
    fn all(&self) -> u64 {
        self.pairs.iter().sum()
    }
    /// Per cent of the pairs with each outcome; `None` without pairs.
    fn shares(&self) -> Option<[f64; OUTCOMES.len()]> {
        let all = self.all();
        (all > 0).then(|| self.pairs.map(|n| 100.0 * n as f64 / all as f64))
    }
    fn row(&self, scene: &str) -> String {
        let shares = match self.shares() {
            Some(shares) => shares.map(|share| format!("{share:>8.1}")).concat(),
            None => format!("{:>8}", "–").repeat(OUTCOMES.len()),
        };
        let ([before, after], auto) = (self.rays, name(self.auto));
        format!("{scene:14} {:>13} {shares} {before:>14.2} {after:>9.2}   {auto}", self.all())
    }
    fn panel(&self, scene: &str) -> Svg {
        let (size, width) = ([SIDE; 2], f64::from(SIDE));
        let map: Vec<_> = self.surveys.iter().map(colour).collect();
        let pictures = vec![
            Svg::image(scene, size, &self.picture, width),
            Svg::image(&format!("{scene}: what is known"), size, &map, width),
        ];
        let [lit, dark, few, many, crowded, unknown] = self.shares().unwrap_or_default();
        let ([before, after], auto) = (self.rays, name(self.auto));
        Svg::row(pictures).captioned(&[
            format!(
                "{lit:.1} % lit, {dark:.1} % dark, {few:.1} % ≤ 4, {many:.1} % ≤ 8, {:.1} % sampled",
                crowded + unknown
            ),
            format!("{before:.2} shadow rays per pixel, by analytic {after:.2}; auto: {auto}"),
        ])
    }
}

impl Studio<'_> {
    fn account(&self, scene: &str) -> Result<Account, Box<dyn Error>> {
        let mut scene = scene::load(scene)?;
        let world = World::from_scene(&mut scene)?;
        let settings = |side: u32, technique: Technique| Settings {
            width: side,
            height: side,
            spp: SPP,
            technique,
            depth: Settings::DEPTH,
            sampler: Sampler::Sobol,
            sets: 0,
            seed: self.seed,
        };
        let automatic = world.view(&settings(SIDE, Technique::Auto));
        let surveys = automatic.survey();
        let mut pairs = [0; OUTCOMES.len()];
        for survey in &surveys {
            pairs.iter_mut().zip(outcomes(survey)).for_each(|(sum, n)| *sum += u64::from(n));
        }
        let rays = [Technique::SolidAngle, Technique::Analytic].map(|technique| {
            let (_, rays) = world.render(&settings(COUNTED, technique), &|_| ());
            rays.shadow as f64 / f64::from(COUNTED * COUNTED)
        });
        let (film, _) = automatic.image(&|_| ());
        let picture = film.pixels.iter().map(|pixel| image::tone_map(pixel.mean)).collect();
        Ok(Account { surveys, pairs, rays, auto: automatic.technique(), picture })
    }

    pub(super) fn certificates(&self) -> Result<Finding, Box<dyn Error>> {
        let mut headline = vec![
            format!(
                "What is known of each light in the middle of each pixel, {SIDE}×{SIDE}; the technique that auto chooses there; and shadow \
                 rays per pixel at {SPP} samples, sobol, {COUNTED}×{COUNTED}."
            ),
            format!(
                "{:14} {:>13} {:>8}{:>8}{:>8}{:>8}{:>8}{:>8} {:>14} {:>9}   auto",
                "scene",
                "pixels×lights",
                "lit %",
                "dark %",
                "≤ 4 %",
                "≤ 8 %",
                "≤ 16 %",
                "more %",
                "solid-angle",
                "analytic"
            ),
        ];
        let mut panels: [Option<Svg>; SHOWN.len()] = Default::default();
        for (scene, _) in scene::builtin_of_few_lights() {
            if self.stop.load(Ordering::Relaxed) {
                break;
            }
            let account = self.account(scene)?;
            headline.push(account.row(scene));
            if let Some(place) = SHOWN.iter().position(|shown| shown == scene) {
                panels[place] = Some(account.panel(scene));
            }
        }
        let mut panels = panels.into_iter().flatten();
        let mut rows = vec![Svg::legend(&[&OUTCOMES[..], &[EMPTY]].concat())];
        while let Some(first) = panels.next() {
            rows.push(Svg::row([first].into_iter().chain(panels.next()).collect()));
        }
        let lines = [
            "What geometry proves about each light for the surface in the middle of each pixel; several lights have the mean of their \
             colours. Lit: nothing occludes any part of the light. Dark: no part of it illuminates the surface. Blockers are the polygons, \
             spheres and solids that might occlude it: the part they leave visible is computed exactly, unless they overlap in a way that \
             has no formula. Sampled: more than 8 blockers, overlapping spheres, or nothing is proved."
                .to_owned(),
            format!(
                "Percentages count each light at each pixel whose surface reflects. Shadow rays are those of solid-angle and of analytic, \
                 with {SPP} samples per pixel, sobol, {COUNTED}×{COUNTED}."
            ),
        ];
        Ok(Finding { svg: Svg::column(rows).captioned(&lines), headline })
    }
}
