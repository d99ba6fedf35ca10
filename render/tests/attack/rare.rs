//! Whether the mean of images is right where few samples meet what is bright.

use super::judge::read;
use super::regimes::lights::RARE_SIDE;
use super::regimes::named;
use etendue_render::sampler::default_sampler;
use etendue_render::{Sampler, Settings, World};

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
