//! What images depend on, and that images of different techniques and samplers are one.

use crate::kit::builtin;
use etendue_oracle::tier::cases;
use etendue_render::film::compare::{Comparison, Prediction, differs};
use etendue_render::film::image::Picture;
use etendue_render::{Sampler, Settings, Technique};

const TECHNIQUES: [Technique; 4] =
    [Technique::Area, Technique::SolidAngle, Technique::CosineHemisphere, Technique::UniformHemisphere];
/// All but `adaptive`, which needs at least 8 samples, and varies them between pixels.
const SAMPLERS: [Sampler; 5] =
    [Sampler::Independent, Sampler::Stratified, Sampler::Sobol, Sampler::Sobol4d, Sampler::ZOrder];

fn prediction(reference: &Picture, image: &Picture) -> Prediction {
    Comparison::new(reference, image, 0.0).unwrap().predicted.expect("the variance is finite")
}
fn mean_agrees(p: &Prediction) -> bool {
    !p.z.iter().any(|z| differs(*z))
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
        let p = prediction(&Picture::from(&one.0), &Picture::from(&other.0));
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
                for sampler in SAMPLERS {
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
                        let p = prediction(&precise, &image);
                        assert!(mean_agrees(&p), "{width}x{height}, {spp} spp, {technique:?} {sampler:?}: {p:?}");
                    }
                }
            }
        }
    }
}
