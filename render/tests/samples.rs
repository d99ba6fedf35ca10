//! Where samples go: to pixels and lights where they reduce the error most, as many as were requested.

use crate::kit::{builtin, film};
use etendue_oracle::tier::cases;
use etendue_render::film::compare::Comparison;
use etendue_render::film::image::{self, Picture};
use etendue_render::{Sampler, Settings, Technique};
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

/// The mean number of samples of adaptive images is the requested one, with those of second sets that only tell the variance; eight, which are a
/// pilot, are followed by an eighth more. Each set of a pixel has a power of two of packets, at least those of the pilot.
#[test]
fn samples_are_counted() {
    for (name, spp, sets, pilot) in [
        ("sphere-light", 64, 1, 16),
        ("sphere-light", 64, 4, 8),
        ("sphere-light", 256, 0, 16),
        ("quads", 16, 1, 8),
        ("quads", 8, 0, 8),
        ("mirror-room", 100, 2, 16),
        ("defocus", 32, 0, 8),
        ("defocus", 16, 0, 8),
    ] {
        let settings = Settings { width: 96, height: 80, spp, sets, sampler: Sampler::Adaptive, ..SETTINGS };
        let (film, rays) = builtin(name).render(&settings, &|_| ());
        let taken: u64 = film.pixels.iter().map(|p| u64::from(p.samples)).sum();
        // of 96 × 80 pixels, 512 have a second set
        let second = if sets == 0 { 512.0 / (96.0 * 80.0) } else { 0.0 };
        let checked = rays.camera as f64 / taken as f64 - 1.0;
        assert!((checked - second).abs() <= 0.06 * second, "{name}: {checked} more samples for the variance");
        let has_variance = sets != 1;
        let sets = sets.max(1);
        // what only looks takes part of the time of a sample
        let asked = f64::from(spp).max(9.0 * (1.0 + second));
        let share = (rays.camera as f64 + 0.4 * rays.look as f64) / (asked * film.pixels.len() as f64);
        assert!((share - 1.0).abs() < 0.02, "{name}, {spp} samples: {share} of the requested number");
        for pixel in &film.pixels {
            let packets = pixel.samples / (8 * sets);
            assert!(packets.is_power_of_two() && packets * 8 >= pilot, "{name}: {} samples", pixel.samples);
            assert!(pixel.variance.iter().all(|v| v.is_finite() == has_variance), "{name}: {pixel:?}");
        }
        let most = film.pixels.iter().map(|p| p.samples).max().unwrap();
        // where outlines of lights in view are most of the variance, rays that only look take the time
        assert!(most >= 2 * spp || rays.look > rays.camera / 8, "{name}: at most {most} samples, {rays:?}");
    }
}

/// Each tile of 16×16 pixels traces each corner once, and only if samples are allocated: in scenes with several lights, for samplers that
/// can count samples per light.
#[test]
fn corners_are_looked_through_where_it_helps() {
    let corners = |name: &str, settings: Settings| builtin(name).render(&settings, &|_| ()).1.corner;
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

/// Compares squared errors against the built-in references, minus the references' own: of as many samples everywhere (sobol) or of lights chosen
/// at random (sobol-4d) with allocated ones. With 32 samples, the lower edge of the triangle matters: it covers a sixteenth of its pixels, and
/// a pilot of eight samples would miss it in some of them (a gain of only 5.3).
#[test]
fn errors_are_less_than_without_allocation() {
    use Sampler::{Adaptive, Sobol, Sobol4d};
    for (name, spp, [before, after], error, least) in [
        ("quads", 64, [Sobol4d, Sobol], 1.9e-8, 3.0),
        ("triangle-light", 32, [Sobol, Adaptive], 2.6e-8, 6.5),
        ("quads", 64, [Sobol, Adaptive], 1.9e-8, 1.8),
        ("sphere-light", 64, [Sobol, Adaptive], 4.8e-9, 4.0),
        ("triangle-light", 64, [Sobol, Adaptive], 2.6e-8, 4.0),
    ]
    .into_iter()
    .take(cases(2, 5))
    {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("references/{name}.exr"));
        let reference = image::read_exr(&path).unwrap();
        let world = builtin(name);
        let [before_error, after_error] = [before, after].map(|sampler| {
            let of = |seed| {
                let settings = Settings { width: 256, height: 256, spp, sampler, seed, ..SETTINGS };
                Comparison::new(&reference, &Picture::from(&film(&world, &settings)), error).unwrap().mse
            };
            (1..cases(2, 3)).map(of).sum::<f64>()
        });
        let gain = before_error / after_error;
        println!("{name}, {spp} samples: {before:?} has {gain:.2} times the squared error of {after:?}");
        assert!(gain > least, "{name}, {spp} samples, {before:?} and {after:?}: {gain}");
    }
}
