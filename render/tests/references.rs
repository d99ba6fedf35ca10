//! Compares images with references by an independent renderer (256×256, 32,768 samples per pixel).
//!
//! Significance: three scenes × four techniques × two samplers, and × two techniques × the five other samplers, give 54 images with four
//! figures each (z of the mean in three channels, z of the mean squared error). A correct renderer passes all 216 bounds of 4.5 with
//! probability 1 − 216 · 6.8e−6 = 0.9985. Seeds are fixed, so a test that passes once always passes. Both signs count: a variance layer
//! that claims too much is as wrong as one that claims too little. The last checks of [`scene`] show what the bounds reject. The quick
//! tier has every eleventh image.

use crate::kit::{builtin, film};
use etendue_oracle::tier::{cases, is_long};
use etendue_render::film::compare::{Comparison, Prediction, differs};
use etendue_render::film::image::{self, Picture};
use etendue_render::{Sampler, Settings, Technique};
use std::path::Path;

const TECHNIQUES: [Technique; 4] =
    [Technique::Area, Technique::SolidAngle, Technique::CosineHemisphere, Technique::UniformHemisphere];
/// The last four differ from the first two only in their random numbers, and are tested with one technique of each kind.
const SAMPLERS: [Sampler; 6] =
    [Sampler::Independent, Sampler::Stratified, Sampler::Sobol, Sampler::Sobol4d, Sampler::ZOrder, Sampler::Adaptive];

fn reference(name: &str) -> Picture {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("references/{name}.exr"));
    image::read_exr(&path).unwrap()
}

fn prediction(reference: &Picture, image: &Picture, reference_error: f64) -> Prediction {
    Comparison::new(reference, image, reference_error).unwrap().predicted.expect("the variance is finite")
}

fn mean_agrees(p: &Prediction) -> bool {
    !p.z.iter().any(|z| differs(*z))
}

/// Tests all techniques and samplers on one scene. `hemisphere_spp` is greater if few directions find a light. `hemisphere_scale` is the
/// error factor of radiance that the check must still detect in such a noisy image; for techniques that sample lights it is 1.01. The quick
/// tier begins with the image `first`.
fn scene(name: &str, mean: f64, reference_error: f64, hemisphere_spp: u32, hemisphere_scale: f32, first: usize) {
    let reference = reference(name);
    let pixels = reference.radiance.len() as f64;
    let sum: f64 = reference.radiance.iter().flatten().map(|&x| f64::from(x)).sum();
    assert!((sum / (3.0 * pixels) - mean).abs() < 1e-6, "unexpected mean of the reference: {}", sum / (3.0 * pixels));

    let world = builtin(name);
    let mut count = 0;
    for technique in TECHNIQUES {
        let towards_lights = matches!(technique, Technique::Area | Technique::SolidAngle);
        let (spp, scale) = if towards_lights { (64, 1.01) } else { (hemisphere_spp, hemisphere_scale) };
        let both = [Technique::SolidAngle, Technique::CosineHemisphere].contains(&technique);
        for sampler in SAMPLERS.into_iter().take(if both { SAMPLERS.len() } else { 2 }) {
            count += 1;
            if !is_long() && count % 11 != first {
                continue;
            }
            let settings = Settings { width: 256, height: 256, spp, technique, sampler, seed: 1, ..Settings::DEFAULT };
            let image = Picture::from(&film(&world, &settings));
            let p = prediction(&reference, &image, reference_error);
            println!("{name} {technique:?} {sampler:?} {spp} spp: {p:?}");
            assert!(p.agrees(), "{name} {technique:?} {sampler:?}: {p:?}");

            // the same check must fail for an image that is slightly wrong
            for factor in [0.4, 2.5] {
                let variance = image.variance.as_ref().unwrap().iter().map(|v| v.map(|x| x * factor)).collect();
                let wrong = Picture { variance: Some(variance), ..image.clone() };
                let p = prediction(&reference, &wrong, reference_error);
                assert!(!p.agrees(), "{name} {technique:?} {sampler:?}: variance × {factor} passes: {p:?}");
            }
            for factor in [scale, 1.0 / scale] {
                let radiance = image.radiance.iter().map(|p| p.map(|x| x * factor)).collect();
                let wrong = Picture { radiance, ..image.clone() };
                let p = prediction(&reference, &wrong, reference_error);
                assert!(!mean_agrees(&p), "{name} {technique:?} {sampler:?}: radiance × {factor} passes: {p:?}");
            }
        }
    }
}

#[test]
fn sphere_light() {
    scene("sphere-light", 0.230_541, 4.8e-9, 128, 1.05, 1);
}

#[test]
fn triangle_light() {
    scene("triangle-light", 0.297_986, 2.6e-8, 128, 1.01, 2);
}

#[test]
fn quads() {
    scene("quads", 0.123_276, 1.9e-8, 128, 1.05, 7);
}

/// The film depends on the seed, not on the number of threads, which process tiles in different orders.
#[test]
fn threads_do_not_matter_and_seeds_do() {
    let world = builtin("quads");
    let all = [
        (Technique::SolidAngle, Sampler::Adaptive, 64),
        (Technique::SolidAngle, Sampler::Stratified, 16),
        (Technique::Area, Sampler::Independent, 5),
        (Technique::CosineHemisphere, Sampler::Independent, 8),
        (Technique::UniformHemisphere, Sampler::Stratified, 6),
        (Technique::SolidAngle, Sampler::Sobol, 16),
        (Technique::SolidAngle, Sampler::Sobol4d, 12),
        (Technique::Area, Sampler::Stratified, 20),
        (Technique::Area, Sampler::ZOrder, 6),
    ];
    for (technique, sampler, spp) in all.into_iter().step_by(cases(4, 1)) {
        // 16 divides neither side, so some tiles are smaller
        let settings = Settings { width: 100, height: 75, spp, technique, sampler, seed: 7, ..Settings::DEFAULT };
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| world.render(&settings, &|_| ()))
        };
        let one = on(1);
        assert_eq!(one, on(2));
        assert_eq!(one, on(3));
        let other = world.render(&Settings { seed: 8, ..settings }, &|_| ());
        // adaptive samples depend on the image
        assert!(other.1.camera == one.1.camera || sampler == Sampler::Adaptive);
        let same = one.0.pixels.iter().zip(&other.0.pixels).filter(|(a, b)| a == b && a.mean != [0.0; 3]).count();
        assert!(same * 100 < one.0.pixels.len(), "{same} pixels do not depend on the seed");
        // images with different seeds agree
        let p = prediction(&Picture::from(&one.0), &Picture::from(&other.0), 0.0);
        assert!(mean_agrees(&p), "{technique:?} {sampler:?}: {p:?}");
    }
}

/// Sample counts that do not fill packets or strata, and images smaller than a tile, have the mean of a precise image.
#[test]
fn any_number_of_samples_and_any_size() {
    let world = builtin("triangle-light");
    for (width, height) in [(1, 1), (17, 5), (33, 18)].into_iter().take(cases(2, 3)) {
        let of = |spp, technique, sampler, seed| {
            let settings = Settings { width, height, spp, technique, sampler, seed, ..Settings::DEFAULT };
            let (film, rays) = world.render(&settings, &|_| ());
            assert_eq!((film.width, film.height, film.pixels[0].samples), (width, height, spp));
            assert_eq!(film.pixels.len(), (width * height) as usize);
            assert_eq!(rays.camera, u64::from(width * height * spp));
            assert!(film.pixels.iter().flat_map(|p| p.mean).all(|x| x.is_finite() && x >= 0.0));
            Picture::from(&film)
        };
        let precise = of(cases(512, 4096), Technique::SolidAngle, Sampler::Stratified, 1);
        for spp in [1, 2, 3, 7, 8, 12, 15, 16, 20, 24].into_iter().step_by(cases(5, 1)) {
            for technique in TECHNIQUES {
                // adaptive needs at least 8 samples, and varies them between pixels
                for sampler in SAMPLERS.into_iter().filter(|s| *s != Sampler::Adaptive) {
                    let mut image = of(spp, technique, sampler, 2);
                    let known = match sampler {
                        Sampler::Independent => spp > 1,
                        _ => spp.is_multiple_of(2),
                    };
                    let variance = image.variance.as_ref().unwrap();
                    let at = |i: usize| variance[i].iter().all(|x| x.is_finite() && *x >= 0.0);
                    assert!((0..variance.len()).all(|i| at(i) == known), "{spp} {sampler:?}: {variance:?}");
                    if !known {
                        // the variance is at most that of independent samples, estimated from many seeds
                        let more: Vec<_> = (3..19).map(|seed| of(spp, technique, sampler, seed).radiance).collect();
                        let n = more.len() as f32;
                        image.radiance = (0..variance.len())
                            .map(|i| std::array::from_fn(|k| more.iter().map(|r| r[i][k]).sum::<f32>() / n))
                            .collect();
                        let mean = image.radiance.clone();
                        let spread = |i: usize, k: usize| {
                            more.iter().map(|r| (r[i][k] - mean[i][k]).powi(2)).sum::<f32>() / (n - 1.0) / n
                        };
                        image.variance = Some((0..mean.len()).map(|i| std::array::from_fn(|k| spread(i, k))).collect());
                    }
                    // the mean of one pixel with few samples is not normally distributed; larger images test z
                    if width > 1 {
                        let p = prediction(&precise, &image, 0.0);
                        assert!(mean_agrees(&p), "{width}x{height}, {spp} spp, {technique:?} {sampler:?}: {p:?}");
                    }
                }
            }
        }
    }
}

/// Two techniques that share only the scene agree on a million triangles.
#[test]
fn terrain_agrees_with_itself() {
    let world = builtin("terrain");
    // techniques with the same seed share part of their noise
    let of = |spp, technique| {
        let seed = technique as u64;
        let settings = Settings {
            width: 64,
            height: 64,
            spp,
            technique,
            sampler: Sampler::Independent,
            seed,
            ..Settings::DEFAULT
        };
        Picture::from(&film(&world, &settings))
    };
    let lights = of(64, Technique::SolidAngle);
    for (spp, technique) in
        [(64, Technique::Area), (cases(256, 1024), Technique::CosineHemisphere), (1024, Technique::UniformHemisphere)]
            .into_iter()
            .take(cases(2, 3))
    {
        let p = prediction(&lights, &of(spp, technique), 0.0);
        println!("{technique:?}: {p:?}");
        assert!(p.agrees(), "{technique:?}: {p:?}");
    }
}
