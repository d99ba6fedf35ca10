//! How honest the estimated error of images is: the true one over the claimed one, for random scenes.

use etendue_render::film::Film;
use etendue_render::sampler::default_sampler;
use etendue_render::scene::Scene;
use etendue_render::{Claim, Settings, Technique, World};
use std::cell::LazyCell;

/// A reference has this many times the samples.
const FINER: u32 = 16;
/// References are precise enough if their squared error is at most this part of that of the images.
const PRECISE: f64 = 0.1;

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
    /// Mean of the product of the differences of an image from both, and the squared error of a reference. Where they have no error in common,
    /// the former is the squared error of the image.
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
            (own <= PRECISE * product).then_some(product)
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
