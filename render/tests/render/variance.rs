//! The variance that images report, against the one that they have.

use etendue_render::{Settings, World};

/// The variance that images of 24 seeds report, relative to the variance among them: sums over all pixels, of green.
pub(crate) fn reported_to_measured(world: &World, settings: &Settings) -> f64 {
    let films: Vec<_> = (0..24).map(|seed| world.render(&Settings { seed, ..*settings }, |_| ()).0).collect();
    let n = films.len() as f64;
    let (mut reported, mut measured) = (0.0, 0.0);
    for i in 0..films[0].pixels.len() {
        let mean = films.iter().map(|f| f64::from(f.pixels[i].mean[1])).sum::<f64>() / n;
        measured += films.iter().map(|f| (f64::from(f.pixels[i].mean[1]) - mean).powi(2)).sum::<f64>() / (n - 1.0);
        reported += films.iter().map(|f| f64::from(f.pixels[i].variance[1])).sum::<f64>() / n;
    }
    println!("{:?}: variance reported / measured: {:.3}", settings.sampler, reported / measured);
    reported / measured
}
