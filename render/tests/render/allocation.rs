//! Allocating samples to a few lights reduces the error and has no bias.

use crate::variance::reported_to_measured;
use etendue_oracle::tier::cases;
use etendue_render::film::{Film, Pixel};
use etendue_render::image::Picture;
use etendue_render::{
    Sampler, Settings, Technique, World,
    compare::{Comparison, LIMIT},
    image,
};
use std::path::Path;

const SETTINGS: Settings = Settings {
    width: 32,
    height: 32,
    spp: 16,
    technique: Technique::SolidAngle,
    sets: 1,
    seed: 1,
    ..Settings::DEFAULT
};

fn world(name: &str) -> World {
    World::new(&etendue_scene::load(name).unwrap()).unwrap()
}

/// Each tile of 16×16 pixels traces each corner once, and only if samples are allocated: in scenes with several lights, for samplers that
/// can count samples per light.
#[test]
fn corners_are_looked_through_where_it_helps() {
    let corners = |name: &str, settings: Settings| world(name).render(&settings, &|_| ()).1.corner;
    let four_tiles = 4 * 17 * 17;
    assert_eq!(corners("quads", SETTINGS), four_tiles);
    assert_eq!(corners("quads", Settings { spp: 64, sets: 4, ..SETTINGS }), four_tiles);
    // for the pilot only, which determines the rest
    assert_eq!(corners("quads", Settings { sampler: Sampler::Adaptive, ..SETTINGS }), four_tiles);
    assert_eq!(corners("quads", Settings { width: 17, height: 3, ..SETTINGS }), 17 * 4 + 2 * 4);
    // through a lens, on metals and with MIS weights, too
    assert_eq!(corners("defocus", SETTINGS), four_tiles);
    assert_eq!(corners("plates", Settings { technique: Technique::MisPower, ..SETTINGS }), four_tiles);
    for other in [
        // one light
        ("sphere-light", SETTINGS),
        // lights chosen at random
        ("quads", Settings { sampler: Sampler::Independent, ..SETTINGS }),
        ("quads", Settings { sampler: Sampler::Sobol4d, ..SETTINGS }),
        // not a power of two, or less than a packet
        ("quads", Settings { spp: 24, ..SETTINGS }),
        ("quads", Settings { spp: 4, ..SETTINGS }),
        // lights are not sampled
        ("quads", Settings { technique: Technique::CosineHemisphere, ..SETTINGS }),
    ] {
        assert_eq!(corners(other.0, other.1), 0, "{other:?}");
    }
}

/// Mean difference of `n` images from a precise one, and its standard error, which includes that of the precise image.
fn bias(world: &World, precise: &Film, settings: Settings, n: u64) -> [f64; 2] {
    let pixels = precise.pixels.len() as f64;
    let off: Vec<f64> = (0..n)
        .map(|seed| {
            let film = world.render(&Settings { seed: 100 + seed, ..settings }, &|_| ()).0;
            let difference = |(a, b): (&Pixel, &Pixel)| f64::from(a.mean[0]) - f64::from(b.mean[0]);
            film.pixels.iter().zip(&precise.pixels).map(difference).sum::<f64>() / pixels
        })
        .collect();
    let mean = off.iter().sum::<f64>() / n as f64;
    let squared = off.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n * (n - 1)) as f64;
    let own = precise.pixels.iter().map(|p| f64::from(p.variance[0])).sum::<f64>() / (pixels * pixels);
    let error = (squared + own).sqrt();
    println!("{settings:?}: bias {mean:.1e} ± {error:.1e} of {:.3}", precise.mean()[0]);
    [mean, error]
}

/// The mean over seeds equals that of an image with randomly chosen lights, also where corners do not see what the pixel sees.
#[test]
fn is_not_biased() {
    let world = world("quads");
    let precise = Settings { spp: cases(1 << 12, 1 << 16), sampler: Sampler::Sobol4d, sets: 4, seed: 7, ..SETTINGS };
    let precise = world.render(&precise, &|_| ()).0;
    for (sampler, spp, sets) in [(Sampler::Sobol, 8, 1), (Sampler::Sobol, 64, 4), (Sampler::Adaptive, 64, 1)] {
        let [mean, error] = bias(&world, &precise, Settings { spp, sets, sampler, ..SETTINGS }, cases(12, 60));
        assert!(mean.abs() < LIMIT * error && error < cases(1.5e-4, 1e-4), "{sampler:?}: {mean:e} ± {error:e}");
    }
}

/// The same through a lens, and for metals, where the BSDF's samples are weighted by the pmf of the allocation.
#[test]
fn is_not_biased_in_other_scenes() {
    for (name, technique) in
        [("plates", Technique::MisPower), ("defocus", Technique::SolidAngle)].into_iter().take(cases(1, 2))
    {
        let world = world(name);
        let precise = Settings {
            spp: cases(1 << 10, 1 << 13),
            technique,
            sampler: Sampler::Sobol4d,
            sets: 4,
            seed: 7,
            ..SETTINGS
        };
        let precise = world.render(&precise, &|_| ()).0;
        for (sampler, spp) in [(Sampler::Sobol, 8), (Sampler::Adaptive, 64)] {
            let [mean, error] = bias(&world, &precise, Settings { spp, technique, sampler, ..SETTINGS }, cases(12, 40));
            assert!(
                mean.abs() < LIMIT * error && error < cases(1.8e-2, 1e-2),
                "{name}, {sampler:?}: {mean:e} ± {error:e}"
            );
        }
    }
}

/// The variance computed from the sets is that of the image.
#[test]
fn sets_tell_the_error() {
    let world = world("quads");
    let settings = Settings { width: 64, height: 64, spp: 64, sets: 4, ..SETTINGS };
    let ratio = reported_to_measured(&world, &settings);
    assert!((ratio - 1.0).abs() < 0.05, "{ratio}");
}

/// Compares errors against the built-in reference, minus its own: lights chosen at random (sobol-4d) and allocated (sobol).
#[test]
fn errs_less_than_by_chance() {
    let reference = image::read_exr(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/references/quads.exr")).unwrap();
    let world = world("quads");
    let measured = |sampler| {
        let settings = Settings { width: 256, height: 256, spp: 64, sampler, ..SETTINGS };
        Comparison::new(&reference, &Picture::from(&world.render(&settings, &|_| ()).0), 1.9e-8).unwrap().mse
    };
    let (chance, allocated) = (measured(Sampler::Sobol4d), measured(Sampler::Sobol));
    println!("quads: {chance:.2e} at random, {allocated:.2e} allocated, ratio {:.2}", chance / allocated);
    assert!(chance > 3.0 * allocated, "{chance:e} {allocated:e}");
}
