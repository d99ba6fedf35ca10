//! Whether the mean of images is right where few samples meet what is bright.

use super::judge::read;
use super::regimes::lights::RARE_SIDE;
use super::regimes::named;
use crate::kit::world;
use etendue_render::sampler::default_sampler;
use etendue_render::{Sampler, Settings, Technique, World};
use rayon::prelude::*;

/// So many more samples has a pixel of the images that are taken for the truth, whose counts do not depend on what they find.
const FINER: u32 = 8;
/// Images that are taken for the truth.
const TRUE: u64 = 16;

/// The mean of images of a scene over seeds, and its difference from the truth in standard errors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mean {
    /// The mean relative to the truth.
    pub(crate) ratio: f64,
    /// The difference in standard errors.
    pub(crate) z: f64,
}

/// The mean of so many values and its squared standard error.
fn mean(values: &[f64]) -> [f64; 2] {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let square = values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0);
    [mean, square / n]
}

/// The mean of the images of a scene of the regime "rare" with so many samples per pixel.
pub(crate) fn of_scene(scene: u64, spp: u32, seeds: u64) -> Mean {
    let world = World::new(&read(&named("rare").draft(scene)).unwrap()).unwrap();
    let image = |sampler: Sampler, spp: u32, seed: u64| {
        let settings =
            Settings { width: RARE_SIDE, height: RARE_SIDE, spp, sampler, sets: 0, seed, ..Settings::DEFAULT };
        world.render(&settings, &|_| ()).0.mean().iter().sum::<f64>() / 3.0
    };
    assert_eq!(default_sampler(spp, 0), Sampler::Adaptive);
    let found: Vec<f64> = (0..seeds).map(|seed| image(Sampler::Adaptive, spp, seed)).collect();
    let truth: Vec<f64> = (0..TRUE).map(|seed| image(Sampler::Sobol, FINER * spp, 1 << 40 | seed)).collect();
    let ([found, a], [truth, b]) = (mean(&found), mean(&truth));
    // what rounding in single precision does to the sum of an image is no bias
    let z = (found - truth) / (a + b + (1e-6 * truth).powi(2)).sqrt();
    // a scene that is black to all images tells nothing
    if found == 0.0 && truth == 0.0 { Mean { ratio: 1.0, z: 0.0 } } else { Mean { ratio: found / truth, z } }
}

/// A square lamp of a 160,000th of the film before a wall that a dim lamp lights; or without it.
fn speck(side: u32, is_there: bool) -> World {
    let [a, b] = [0.01910843729897562, 0.02638784198429967];
    let lamp = |radiance: f64, corners: String, reversed: &str| {
        format!(
            "AttributeBegin Material \"diffuse\" \"rgb reflectance\" [0 0 0] AreaLightSource \"diffuse\" \"rgb L\" [{radiance} \
             {radiance} {radiance}] {reversed} Shape \"bilinearmesh\" \"point3 P\" [{corners}] AttributeEnd "
        )
    };
    let own = lamp(160_000.0, format!("{a} {a} 4 {a} {b} 4 {b} {a} 4 {b} {b} 4"), "");
    let dim = lamp(0.1, "-4 -3 -1 -4 3 -1 4 -3 -1 4 3 -1".to_owned(), "ReverseOrientation");
    let wall = "Material \"diffuse\" \"rgb reflectance\" [.5 .5 .5] Shape \"trianglemesh\" \"point3 P\" [-9 -9 6 9 -9 6 9 9 6 -9 9 6] \
                \"integer indices\" [0 1 2 0 2 3] ";
    world(&format!(
        "LookAt 0 0 0 0 0 1 0 1 0 Camera \"perspective\" \"float fov\" 40 Film \"rgb\" \"integer xresolution\" {side} \"integer \
         yresolution\" {side} PixelFilter \"box\" WorldBegin {} {wall} {dim}",
        if is_there { &own } else { "" }
    ))
}

/// The mean of images of a bright speck over seeds, less that of the rest: 1, which is its radiance times its share of the film.
pub(crate) fn of_speck(side: u32, spp: u32, seeds: u64) -> Mean {
    let of = |world: &World, sampler: Sampler, seed: u64| {
        let technique = Technique::Area;
        let settings =
            Settings { width: side, height: side, spp, technique, sampler, sets: 0, seed, ..Settings::DEFAULT };
        world.render(&settings, &|_| ()).0.mean()[0]
    };
    let [with, without] = [true, false].map(|is_there| speck(side, is_there));
    let found: Vec<f64> = (0..seeds).into_par_iter().map(|seed| of(&with, Sampler::Adaptive, seed)).collect();
    let rest: Vec<f64> = (0..seeds.min(32)).map(|seed| of(&without, Sampler::Sobol, seed)).collect();
    let ([found, a], [rest, b]) = (mean(&found), mean(&rest));
    let half = 4.0 * libm::tan(20.0_f64.to_radians());
    let share = ((0.02638784198429967 - 0.01910843729897562) / (2.0 * half)).powi(2);
    let expected = 160_000.0 * share;
    Mean { ratio: (found - rest) / expected, z: (found - rest - expected) / (a + b).sqrt() }
}
