//! The adaptive sampler takes the requested number of samples on average, reduces the error and has no bias.

use etendue_oracle::tier::cases;
use etendue_render::film::Film;
use etendue_render::image::Picture;
use etendue_render::{RayCount, Sampler, Settings, Technique, World, compare::Comparison, image, scene};
use std::path::Path;

const SETTINGS: Settings = Settings {
    width: 96,
    height: 80,
    spp: 64,
    technique: Technique::SolidAngle,
    depth: 8,
    sampler: Sampler::Adaptive,
    sets: 1,
    seed: 1,
};

fn world(name: &str) -> World {
    World::new(&scene::load(name).unwrap()).unwrap()
}

fn render(world: &World, settings: &Settings) -> (Film, RayCount) {
    world.render(settings, &|_| ())
}

/// The mean number of samples is the requested one. Each set of a pixel has a power of two of packets, at least those of the pilot.
#[test]
fn samples_are_counted() {
    for (name, spp, sets, pilot) in [
        ("sphere-light", 64, 1, 16),
        ("sphere-light", 64, 4, 8),
        ("sphere-light", 256, 0, 16),
        ("quads", 16, 1, 8),
        ("mirror-room", 100, 2, 16),
        ("defocus", 32, 0, 8),
    ] {
        let world = world(name);
        let (film, rays) = render(&world, &Settings { spp, sets, ..SETTINGS });
        let sets = if sets == 0 { [4, 2].into_iter().find(|n| spp >= 16 * n).unwrap_or(1) } else { sets };
        let taken: u64 = film.pixels.iter().map(|p| u64::from(p.samples)).sum();
        assert_eq!(rays.camera, taken, "{name}");
        let share = taken as f64 / (f64::from(spp) * film.pixels.len() as f64);
        assert!((share - 1.0).abs() < 0.02, "{name}, {spp} samples: {share} of the requested number");
        for pixel in &film.pixels {
            let packets = pixel.samples / (8 * sets);
            assert!(packets.is_power_of_two() && packets * 8 >= pilot, "{name}: {} samples", pixel.samples);
            assert!(pixel.variance.iter().all(|v| v.is_finite() == (sets > 1)), "{name}: {pixel:?}");
        }
        let most = film.pixels.iter().map(|p| p.samples).max().unwrap();
        assert!(most >= 2 * spp, "{name}: at most {most} samples");
    }
}

#[test]
fn threads_do_not_matter() {
    let world = world("quads");
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| render(&world, &SETTINGS))
    };
    let one = on(1);
    assert_eq!(one, on(2));
    assert_eq!(one, on(3));
}

/// Compares errors against the built-in references, minus the references' own. With 32 samples, the lower edge of the triangle matters:
/// it covers a sixteenth of its pixels, and a pilot of eight samples would miss it in some of them (a gain of only 5.3).
#[test]
fn errs_less_than_as_many_samples_everywhere() {
    for (name, spp, error, least) in [
        ("sphere-light", 64, 4.8e-9, 4.0),
        ("triangle-light", 64, 2.6e-8, 4.0),
        ("triangle-light", 32, 2.6e-8, 6.5),
        ("quads", 64, 1.9e-8, 1.8),
    ]
    .into_iter()
    .skip(cases(2, 0))
    {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/references/{name}.exr"));
        let reference = image::read_exr(&path).unwrap();
        let world = world(name);
        let measured = |sampler| {
            let of = |seed| {
                let film = render(&world, &Settings { width: 256, height: 256, spp, sampler, seed, ..SETTINGS }).0;
                Comparison::new(&reference, &Picture::from(&film), error).unwrap().mse
            };
            (1..cases(2, 4)).map(of).sum::<f64>()
        };
        let gain = measured(Sampler::Sobol) / measured(Sampler::Adaptive);
        println!("{name}, {spp} samples: sobol has {gain:.2} times the error");
        assert!(gain > least, "{name}, {spp} samples: {gain}");
    }
}

/// The mean over seeds equals that of a precise image. (If the number of samples depended on the pixel itself, dark pixels would be
/// left dark.)
#[test]
fn is_not_biased() {
    let world = world("sphere-light");
    let settings = Settings { width: 32, height: 32, spp: 16, ..SETTINGS };
    let precise = render(&world, &Settings { spp: cases(1 << 11, 1 << 14), sampler: Sampler::Sobol, ..settings }).0;
    let n = cases(30, 400);
    let off: Vec<f64> = (0..n)
        .map(|seed| {
            let film = render(&world, &Settings { seed: 100 + seed, ..settings }).0;
            let difference = |(a, b): (&etendue_render::film::Pixel, &etendue_render::film::Pixel)| {
                f64::from(a.mean[0]) - f64::from(b.mean[0])
            };
            film.pixels.iter().zip(&precise.pixels).map(difference).sum::<f64>() / film.pixels.len() as f64
        })
        .collect();
    let mean = off.iter().sum::<f64>() / n as f64;
    let error = (off.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n * (n - 1)) as f64).sqrt();
    println!("bias {mean:.1e} ± {error:.1e} of {:.3}", precise.mean()[0]);
    assert!(mean.abs() < 4.0 * error && error < cases(4e-5, 2e-5), "{mean:e} ± {error:e}");
}
