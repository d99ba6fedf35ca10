//! The adaptive sampler takes the requested number of samples on average, reduces the error and has no bias.

use etendue_oracle::tier::cases;
use etendue_render::film::Film;
use etendue_render::image::Picture;
use etendue_render::{
    RayCount, Sampler, Settings, Technique, World,
    compare::{Comparison, LIMIT},
    image,
};
use std::path::Path;

const SETTINGS: Settings = Settings {
    width: 96,
    height: 80,
    spp: 64,
    technique: Technique::SolidAngle,
    sampler: Sampler::Adaptive,
    sets: 1,
    seed: 1,
    ..Settings::DEFAULT
};

fn world(name: &str) -> World {
    World::new(&etendue_scene::load(name).unwrap()).unwrap()
}

fn render(world: &World, settings: &Settings) -> (Film, RayCount) {
    world.render(settings, &|_| ())
}

/// The mean number of samples is the requested one, with those of second sets that only tell the variance. Each set of a pixel has a power of two of packets, at least those of the pilot.
#[test]
fn samples_are_counted() {
    for (name, spp, sets, pilot) in [
        ("sphere-light", 64, 1, 16),
        ("sphere-light", 64, 4, 8),
        ("sphere-light", 256, 0, 16),
        ("quads", 16, 1, 8),
        ("mirror-room", 100, 2, 16),
        ("defocus", 32, 0, 8),
        ("defocus", 16, 0, 8),
    ] {
        let world = world(name);
        let (film, rays) = render(&world, &Settings { spp, sets, ..SETTINGS });
        let taken: u64 = film.pixels.iter().map(|p| u64::from(p.samples)).sum();
        // of 96 × 80 pixels, 1,024 have a second set
        let second = if sets == 0 { 1024.0 / (96.0 * 80.0) } else { 0.0 };
        let checked = rays.camera as f64 / taken as f64 - 1.0;
        assert!((checked - second).abs() <= 0.06 * second, "{name}: {checked} more samples for the variance");
        let has_variance = sets != 1;
        let sets = sets.max(1);
        let share = rays.camera as f64 / (f64::from(spp) * film.pixels.len() as f64);
        assert!((share - 1.0).abs() < 0.02, "{name}, {spp} samples: {share} of the requested number");
        for pixel in &film.pixels {
            let packets = pixel.samples / (8 * sets);
            assert!(packets.is_power_of_two() && packets * 8 >= pilot, "{name}: {} samples", pixel.samples);
            assert!(pixel.variance.iter().all(|v| v.is_finite() == has_variance), "{name}: {pixel:?}");
        }
        let most = film.pixels.iter().map(|p| p.samples).max().unwrap();
        assert!(most >= 2 * spp, "{name}: at most {most} samples");
    }
}

/// What images of one set claim of their variance, against the variance over seeds: of the whole image, and of its quarters.
#[test]
fn one_set_tells_its_variance() {
    for (name, technique, spp) in [
        ("plates", Technique::MisPower, 64),
        ("sphere-light", Technique::SolidAngle, 64),
        ("quads", Technique::Analytic, 64),
        ("terrain", Technique::Area, 16),
        ("city", Technique::Auto, 32),
        ("defocus", Technique::SolidAngle, 256),
    ]
    .into_iter()
    .take(cases(3, 6))
    {
        let world = world(name);
        let settings = Settings { width: 64, height: 64, spp, technique, sets: 0, ..SETTINGS };
        // the city's noise has heavy tails: with 40 seeds its ratio is 1.24
        let count = cases(24, if spp < 256 { 80 } else { 40 });
        let films: Vec<Film> = (0..count).map(|seed| render(&world, &Settings { seed, ..settings }).0).collect();
        let mut sums = [[0.0; 2]; 5];
        for i in 0..64 * 64 {
            let quarter = 1 + (i % 64) / 32 + (i / 2048) * 2;
            for k in 0..3 {
                let values = || films.iter().map(|film| f64::from(film.pixels[i].mean[k]));
                let mean = values().sum::<f64>() / f64::from(count as u32);
                let found = values().map(|x| (x - mean).powi(2)).sum::<f64>() / f64::from(count as u32 - 1);
                let claimed = films.iter().map(|film| f64::from(film.pixels[i].variance[k])).sum::<f64>();
                for area in [0, quarter] {
                    sums[area][0] += found;
                    sums[area][1] += claimed / f64::from(count as u32);
                }
            }
        }
        let ratios = sums.map(|[found, claimed]| (claimed / found).sqrt());
        println!("{name}: claimed error over that found {:.3}, in quarters {:.3?}", ratios[0], &ratios[1..]);
        assert!((ratios[0] - 1.0).abs() < 0.15, "{name}: {ratios:?}");
        // quarters without noise have nothing to claim
        for (ratio, [found, _]) in ratios.iter().zip(sums).filter(|(_, of)| of[0] > 0.01 * sums[0][0]) {
            assert!((ratio - 1.0).abs() < 0.3, "{name}: {ratios:?}, a quarter of variance {found}");
        }
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
            (1..cases(2, 3)).map(of).sum::<f64>()
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
    let n = cases(30, 120);
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
    assert!(mean.abs() < LIMIT * error && error < 4e-5, "{mean:e} ± {error:e}");
}
