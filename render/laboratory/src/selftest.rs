//! Renders a scene with every applicable technique and sampler, and checks that the images agree.

mod touching;

use clap::ValueEnum;
use etendue_render::film::Film;
use etendue_render::sampler::reports_variance;
use etendue_render::scene::{Material, Scene};
use etendue_render::{Sampler, Settings, Technique, World};

/// One image of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// How lights were sampled.
    pub technique: Technique,
    /// How random numbers were generated.
    pub sampler: Sampler,
    /// Mean over pixels, per channel.
    pub mean: [f64; 3],
    /// Standard error of the mean, from the variance of the pixels.
    pub error: [f64; 3],
    /// Difference from the combined mean of all other images, in standard deviations.
    pub z: [f64; 3],
}

/// An image disagrees with the others if its |z| is at least this.
pub const LIMIT: f64 = 4.0;

/// Settings of a self-test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Width and height of the images in pixels.
    pub side: u32,
    /// Samples per pixel.
    pub spp: u32,
    /// Seed of the random numbers; different seeds give independent images.
    pub seed: u64,
    /// Greatest number of mirrors along a camera ray, as in [`Settings`].
    pub depth: u32,
}

/// Whether the technique applies to the scene: all do, except that directions over the hemisphere find the highlights of a rough
/// metal so rarely that their sample variance does not reveal the error.
pub fn applies(technique: Technique, scene: &Scene) -> bool {
    let blind = matches!(technique, Technique::UniformHemisphere | Technique::CosineHemisphere);
    !(blind && scene.materials.iter().any(Material::is_glossy))
}

/// Why a technique is not compared on a scene; `None` if it is.
pub fn left_out(technique: Technique, scene: &Scene) -> Option<&'static str> {
    if !applies(technique, scene) {
        Some("it finds the highlights of a rough metal so rarely that its variance does not reveal its error")
    } else if technique == Technique::Area && touching::touches(scene) {
        Some("a light touches a surface there, and its variance is infinite")
    } else {
        None
    }
}

/// Renders the scene with every technique that is not [`left_out`] and every sampler that can estimate its variance from this many samples.
pub fn rows(scene: &Scene, world: &World, effort: &Effort) -> Vec<Row> {
    let mut rows = Vec::new();
    let mut images = 0;
    for &technique in Technique::value_variants().iter().filter(|&&t| left_out(t, scene).is_none()) {
        let Effort { side, spp, seed, depth } = *effort;
        let lens = scene.camera.lens.is_some();
        for &sampler in Sampler::value_variants().iter().filter(|s| s.check(spp, 0, lens).is_ok()) {
            // images of one seed share their noise
            images += 1;
            let seed = seed.wrapping_mul(0x1_0000).wrapping_add(images);
            let settings = Settings { width: side, height: side, spp, technique, depth, sampler, sets: 0, seed };
            let (film, _) = world.render(&settings, &|_| ());
            // a single replicate has no variance estimate
            if reports_variance(sampler, spp, 0, lens) {
                rows.push(Row { technique, sampler, mean: film.mean(), error: error(&film), z: [0.0; 3] });
            }
        }
    }
    judge(&mut rows);
    rows
}

fn error(film: &Film) -> [f64; 3] {
    let total = |k: usize| film.pixels.iter().map(|p| f64::from(p.variance[k])).sum::<f64>();
    std::array::from_fn(|k| total(k).sqrt() / film.pixels.len() as f64)
}

/// Sets `z` of each row by comparing its mean with the precision-weighted mean of all others. It is NaN if its mean or error is not finite.
pub fn judge(rows: &mut [Row]) {
    for k in 0..3 {
        // the rounding of sums in f32
        let variance = |row: &Row| (row.error[k].powi(2) + (row.mean[k] / 4_194_304.0).powi(2)).max(f64::MIN_POSITIVE);
        let z: Vec<f64> = (0..rows.len())
            .map(|i| {
                let is_finite = |row: &Row| row.mean[k].is_finite() && row.error[k].is_finite();
                if !is_finite(&rows[i]) {
                    return f64::NAN;
                }
                let others = rows.iter().enumerate().filter(|(j, row)| *j != i && is_finite(row));
                let (mut weight, mut sum) = (0.0, 0.0);
                for (_, row) in others {
                    weight += 1.0 / variance(row);
                    sum += row.mean[k] / variance(row);
                }
                let difference = rows[i].mean[k] - sum / weight;
                if rows.len() < 2 || difference == 0.0 {
                    0.0
                } else {
                    difference / (variance(&rows[i]) + 1.0 / weight).sqrt()
                }
            })
            .collect();
        rows.iter_mut().zip(z).for_each(|(row, z)| row.z[k] = z);
    }
}

/// The greatest |z|; infinite if one is NaN.
pub fn worst(rows: &[Row]) -> f64 {
    let size = |z: f64| if z.is_nan() { f64::INFINITY } else { z.abs() };
    rows.iter().flat_map(|row| row.z).map(size).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn disagreement_is_seen_and_agreement_is_not() {
        let row = |mean: f64, error: f64| Row {
            technique: Technique::Area,
            sampler: Sampler::Independent,
            mean: [mean, 1.0, 0.0],
            error: [error, 0.01, 0.0],
            z: [0.0; 3],
        };
        let mut rows = vec![row(1.0, 0.01), row(1.01, 0.01), row(0.99, 0.01), row(1.0, 0.3)];
        judge(&mut rows);
        assert!(worst(&rows) < 2.0, "{rows:?}");
        let z = 0.01 / (1e-4_f64 + 1.0 / (2e4 + 1.0 / 0.09)).sqrt();
        assert!((rows[1].z[0] - z).abs() < 0.5, "{rows:?}");
        assert_eq!(rows[0].z[1..], [0.0; 2]);
        rows.push(row(1.1, 0.01));
        judge(&mut rows);
        assert!(rows[4].z[0] > 8.0 && worst(&rows) > LIMIT, "{rows:?}");
        rows[1].mean[2] = f64::NAN;
        judge(&mut rows);
        assert_eq!(worst(&rows), f64::INFINITY);
        // one image agrees with itself
        let mut one = vec![row(1.0, 0.01)];
        judge(&mut one);
        assert_eq!(worst(&one), 0.0);
    }
}
