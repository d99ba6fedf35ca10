//! How honest the estimated error of images is: the true one over the claimed one, for random scenes.

use super::judge::read;
use super::regimes::Regime;
use etendue_render::drive::progressive::{Goal, Progress, Refinement, render};
use etendue_render::film::Film;
use etendue_render::sampler::default_sampler;
use etendue_render::scene::Scene;
use etendue_render::{Claim, Settings, Technique, World};
use rayon::prelude::*;
use std::cell::LazyCell;
use std::fmt::{self, Display, Formatter};
use std::ops::{Range, RangeInclusive};

/// The true error should be this many times the claimed one, …
pub(crate) const HONEST: RangeInclusive<f64> = 0.7..=1.4;
/// … in this part of all images.
pub(crate) const SHARE: f64 = 0.95;
/// A reference has this many times the samples.
const FINER: u32 = 16;
/// A reference is precise enough if its squared error is at most this part of that of the image.
const PRECISE: f64 = 0.5;
/// The same for many images together.
const PRECISE_OF_ROW: f64 = 0.1;
/// Images of a scene with each number of samples.
const SEEDS: u64 = 2;

/// An image whose true error is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Run {
    /// The true error over the claimed one.
    pub(crate) ratio: f64,
    /// Whether the claim is mostly the bound of closed forms' error, or due to small lights that few samples meet: the error may be much less.
    pub(crate) bounded: bool,
}

/// The images of a regime.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Tally {
    /// The images whose error is known.
    pub(crate) runs: Vec<Run>,
    /// How many others are black, or have no error that the references show.
    pub(crate) without: usize,
    /// How many more call their error uncertain.
    pub(crate) uncertain: usize,
}

/// Renders scenes of a regime with these seeds, several times with `spp` and with fewer samples, and until an error or a time, and measures
/// their errors.
pub(crate) fn run(regime: &Regime, seeds: Range<u64>, quality: [u32; 2]) -> Tally {
    let tallies = seeds.into_par_iter().map(|seed| measure(&read(&regime.draft(seed)).unwrap(), seed, quality));
    tallies.collect::<Vec<_>>().into_iter().fold(Tally::default(), Tally::and)
}

/// The technique by which a reference is rendered.
const fn other(technique: Technique) -> Technique {
    match technique {
        Technique::SolidAngle => Technique::ProjectedSolidAngle,
        Technique::MisPower => Technique::MisBalance,
        Technique::MisLobe => Technique::MisPower,
        _ => Technique::SolidAngle,
    }
}

/// Two images of a scene by a technique, of which each has an error of its own.
struct Reference([Film; 2]);

impl Reference {
    fn new(world: &World, settings: &Settings, technique: Technique) -> Self {
        let spp = FINER * settings.spp;
        let sampler = default_sampler(spp, 0);
        let of = |seed| world.render(&Settings { technique, spp, sampler, seed, ..*settings }, &|_| ()).0;
        Self([of(settings.seed ^ 0x7072_6563), of(settings.seed ^ 0x6973_6521)])
    }
    /// Mean of the product of the differences of an image from both. Where they have no error in common, that is the squared error of the
    /// image; `None` if the references are not precise enough.
    fn squared_error(&self, film: &Film) -> Option<f64> {
        let [product, own] = self.products(film);
        (own <= PRECISE * product).then_some(product)
    }
    /// The same, whether they are precise enough or not, and the squared error of a reference.
    fn products(&self, film: &Film) -> [f64; 2] {
        let [a, b] = &self.0;
        let (mut product, mut own, mut count) = (0.0, 0.0, 0.0);
        for ((x, a), b) in film.pixels.iter().zip(&a.pixels).zip(&b.pixels) {
            for k in 0..3 {
                let [x, a, b] = [x.mean[k], a.mean[k], b.mean[k]].map(f64::from);
                product += (x - a) * (x - b);
                own += 0.5 * (a - b).powi(2);
                count += 1.0;
            }
        }
        [product, own].map(|sum| sum / count)
    }
}

/// The images of a scene with so many samples, over many seeds: what they claim, all together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ClaimRow {
    /// The root of the mean of the squared errors over that of the squares that are claimed; `None` if the image is black, or too little of
    /// an error for the reference.
    pub(crate) ratio: Option<f64>,
    /// The part of the images that call their error uncertain.
    pub(crate) uncertain: f64,
    /// Whether what is claimed is mostly a bound of systematic errors.
    pub(crate) bounded: bool,
}

/// The rows of a scene, one for each number of samples.
pub(crate) fn rows<const N: usize>(scene: &Scene, side: u32, numbers: [u32; N], seeds: u64) -> [ClaimRow; N] {
    let world = World::new(scene).unwrap();
    let settings = |spp: u32, seed: u64| Settings {
        width: side,
        height: side,
        spp,
        sampler: default_sampler(spp, 0),
        seed,
        ..Settings::DEFAULT
    };
    let most = settings(numbers.into_iter().max().unwrap_or(1), 0x5eed);
    let view = world.view(&most);
    let (technique, foreseen) = (view.technique(), view.foreseen());
    let references = [other(technique), technique].map(|technique| {
        LazyCell::new({
            let world = &world;
            move || Reference::new(world, &most, technique)
        })
    });
    numbers.map(|spp| {
        let films: Vec<Film> = (1..=seeds).map(|seed| world.render(&settings(spp, seed), &|_| ()).0).collect();
        // by the technique itself only where the other is not precise enough
        let found = references.iter().find_map(|reference| {
            let products = films.iter().map(|film| reference.products(film));
            let [product, own] = products.fold([0.0; 2], |sum, x| [sum[0] + x[0], sum[1] + x[1]]);
            (own <= PRECISE_OF_ROW * product).then_some(product)
        });
        let (mut claimed, mut uncertain, mut systematic, mut is_known) = (0.0, 0.0, 0.0, true);
        for film in &films {
            let Some(claim) = Claim::new(film, &foreseen, spp.into()) else {
                is_known = false;
                break;
            };
            let mean = film.mean().iter().sum::<f64>() / 3.0;
            claimed += (claim.total() * mean).powi(2);
            systematic += (claim.systematic * mean).powi(2);
            uncertain += if claim.uncertain().is_some() { 1.0 } else { 0.0 };
        }
        let ratio = found.filter(|_| is_known && claimed > 0.0).map(|found| (found / claimed).sqrt());
        ClaimRow { ratio, uncertain: uncertain / seeds as f64, bounded: systematic > 0.2 * claimed }
    })
}

/// Renders a scene, and measures the errors of the images.
fn measure(scene: &Scene, seed: u64, [side, spp]: [u32; 2]) -> Tally {
    let world = World::new(scene).unwrap();
    let settings = |spp: u32, run: u64| Settings {
        width: side,
        height: side,
        spp,
        sampler: default_sampler(spp, 0),
        seed: seed.wrapping_mul(0x9e37_79b9) ^ run << 40,
        ..Settings::DEFAULT
    };
    let base = settings(spp, 0);
    let view = world.view(&base);
    let (technique, foreseen) = (view.technique(), view.foreseen());
    let mut images: Vec<(Film, Option<Claim>)> = Vec::new();
    for spp in [2, spp / 4, spp] {
        for run in 1..=SEEDS {
            let (film, _) = world.render(&settings(spp, run), &|_| ());
            let claim = Claim::new(&film, &foreseen, spp.into());
            images.push((film, claim));
        }
    }
    let mut refine = |goal| {
        let plan = Refinement { settings: settings(spp, SEEDS + 1), sampler: None, goal };
        let Progress { film, error, .. } = render(&world, &plan, &|_| (), |_, _| (), |_| Ok(())).unwrap();
        images.push((film, error));
    };
    refine(Goal { seconds: Some(0.05), error: None });
    let (film, _) = world.render(&settings(spp, 0), &|_| ());
    if let Some(claim) = Claim::new(&film, &foreseen, spp.into()).filter(|claim| 0.5 * claim.random > claim.systematic)
    {
        refine(Goal { seconds: None, error: Some(0.5 * claim.total()) });
    }
    // by the technique itself only where the other is not precise enough
    let (world, base) = (&world, &base);
    let references =
        [other(technique), technique].map(|technique| LazyCell::new(move || Reference::new(world, base, technique)));
    let mut tally = Tally::default();
    for (film, claim) in images {
        let found = references.iter().find_map(|reference| reference.squared_error(&film));
        let (Some(claim), Some(square)) = (claim, found) else {
            tally.without += 1;
            continue;
        };
        let mean = film.mean().iter().sum::<f64>() / 3.0;
        if claim.uncertain().is_some() {
            tally.uncertain += 1;
            continue;
        }
        let ratio = square.sqrt() / mean / claim.total();
        if !ratio.is_finite() {
            tally.without += 1;
            continue;
        }
        let bounded = claim.systematic.max(claim.missed) > 0.5 * claim.random;
        tally.runs.push(Run { ratio, bounded });
    }
    tally
}

/// The part of images whose ratio of errors is [`HONEST`]. Where the claim is mostly a bound, the error may be less.
pub(crate) fn honest<'a>(runs: impl IntoIterator<Item = &'a Run>) -> f64 {
    let (mut within, mut all) = (0.0, 0.0);
    for run in runs {
        all += 1.0;
        let least = if run.bounded { 0.0 } else { *HONEST.start() };
        within += if (least..=*HONEST.end()).contains(&run.ratio) { 1.0 } else { 0.0 };
    }
    within / all
}

impl Tally {
    /// All images of both.
    pub(crate) fn and(mut self, other: Self) -> Self {
        self.runs.extend(other.runs);
        Self { without: self.without + other.without, uncertain: self.uncertain + other.uncertain, ..self }
    }
    /// The ratio that this part of the images does not exceed.
    pub(crate) fn quantile(&self, part: f64) -> f64 {
        let mut ratios: Vec<f64> = self.runs.iter().map(|run| run.ratio).collect();
        ratios.sort_by(f64::total_cmp);
        let last = ratios.len().saturating_sub(1) as f64;
        ratios.get((part * last).round() as usize).copied().unwrap_or(f64::NAN)
    }
}

impl Display for Tally {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let [least, median, greatest] = [0.0, 0.5, 1.0].map(|part| self.quantile(part));
        write!(
            f,
            "{:5} images, true/claimed {least:5.2} {median:5.2} {greatest:5.2}, {:5.1} % within {} to {}; {} left out, {} uncertain",
            self.runs.len(),
            100.0 * honest(&self.runs),
            HONEST.start(),
            HONEST.end(),
            self.without,
            self.uncertain
        )
    }
}
