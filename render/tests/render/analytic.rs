//! Light computed from certificates, against the same light sampled.

use etendue_render::film::Film;
use etendue_render::{RayCount, Sampler, Settings, Technique, World, scene};

const SETTINGS: Settings = Settings {
    width: 64,
    height: 64,
    spp: 64,
    technique: Technique::Analytic,
    depth: Settings::DEPTH,
    sampler: Sampler::Sobol,
    sets: 4,
    seed: 0,
};
/// Scenes in which lights have an area: behind boxes, balls and meshes, through a lens and in mirrors, on diffuse surfaces and metals.
const SCENES: [&str; 7] =
    ["sphere-light", "triangle-light", "quads", "cornell-box", "mirror-room", "defocus", "plates"];

fn render(world: &World, settings: &Settings) -> (Film, RayCount) {
    world.render(settings, |_| ())
}

/// Squares of 8 × 8 pixels have the same mean as with sampled lights, within the errors that both images report; so has the image.
#[test]
fn agrees_with_sampled_lights() {
    const SIDE: usize = 8;
    for name in SCENES {
        let world = World::new(&scene::load(name).unwrap()).unwrap();
        let (film, _) = render(&world, &SETTINGS);
        let technique = if name == "plates" { Technique::MisPower } else { Technique::SolidAngle };
        let (sampled, _) = render(&world, &Settings { technique, spp: 1024, seed: 1, ..SETTINGS });
        let side = SETTINGS.width as usize;
        let squares = (side / SIDE).pow(2);
        let mut sums = vec![[0.0_f64; 2]; squares + 1];
        for (i, (a, b)) in film.pixels.iter().zip(&sampled.pixels).enumerate() {
            let square = i / side / SIDE * (side / SIDE) + i % side / SIDE;
            for to in [square, squares] {
                sums[to][0] += f64::from(a.mean[1]) - f64::from(b.mean[1]);
                // the rounding of an image, where nothing is random
                sums[to][1] += f64::from(a.variance[1]) + f64::from(b.variance[1]) + 1e-14;
            }
        }
        let z: Vec<f64> = sums.iter().map(|[sum, variance]| sum / variance.sqrt()).collect();
        let worst = z.iter().fold(0.0_f64, |worst, z| worst.max(z.abs()));
        println!("{name}: mean z {:.2}, greatest {worst:.2}", z[squares]);
        assert!(worst < 5.5, "{name}: squares differ by {worst:.1} standard deviations");
        assert!(z[squares].abs() < 4.0, "{name}: means differ by {:.1} standard deviations", z[squares]);
    }
}

/// Where everything is known, no ray is traced, and the variance is that of the pixels' edges.
#[test]
fn traces_few_rays() {
    for (name, most) in [("sphere-light", 0.0), ("quads", 0.02), ("triangle-light", 0.05), ("cornell-box", 0.03)] {
        let world = World::new(&scene::load(name).unwrap()).unwrap();
        let (film, count) = render(&world, &SETTINGS);
        let (sampled, other) = render(&world, &Settings { technique: Technique::SolidAngle, ..SETTINGS });
        let [ours, theirs] =
            [&film, &sampled].map(|film| film.pixels.iter().map(|p| f64::from(p.variance[1])).sum::<f64>());
        println!("{name}: {} of {} shadow rays, variance {:.4}", count.shadow, other.shadow, ours / theirs);
        assert!(count.shadow as f64 <= most * other.shadow as f64, "{name}: {} shadow rays", count.shadow);
        assert!(ours < 0.7 * theirs, "{name}: variance {ours:e}, {theirs:e} with sampled lights");
    }
}

/// The variance that an image reports is the one that images of other seeds have, also where only the pixel is sampled.
#[test]
fn knows_its_variance() {
    let world = World::new(&scene::load("quads").unwrap()).unwrap();
    for sampler in [Sampler::Sobol, Sampler::Adaptive] {
        let films: Vec<_> = (0..24).map(|seed| render(&world, &Settings { sampler, seed, ..SETTINGS }).0).collect();
        let n = films.len() as f64;
        let (mut reported, mut found) = (0.0, 0.0);
        for i in 0..films[0].pixels.len() {
            let mean = films.iter().map(|f| f64::from(f.pixels[i].mean[1])).sum::<f64>() / n;
            found += films.iter().map(|f| (f64::from(f.pixels[i].mean[1]) - mean).powi(2)).sum::<f64>() / (n - 1.0);
            reported += films.iter().map(|f| f64::from(f.pixels[i].variance[1])).sum::<f64>() / n;
        }
        println!("{sampler:?}: variance reported / measured: {:.3}", reported / found);
        assert!((reported / found - 1.0).abs() < 0.1, "{sampler:?}: {reported:e} reported, {found:e} measured");
    }
}

/// `auto` computes lights where that pays, and leaves rough metals, fine meshes and delta lights to samples.
#[test]
fn auto_chooses() {
    let settings = Settings { width: 256, height: 256, technique: Technique::Auto, ..SETTINGS };
    let expected = [
        ("sphere-light", Technique::Analytic),
        ("triangle-light", Technique::Analytic),
        ("quads", Technique::Analytic),
        ("cornell-box", Technique::Analytic),
        ("mirror-room", Technique::Analytic),
        ("terrain", Technique::SolidAngle),
        ("defocus", Technique::SolidAngle),
        ("delta-lights", Technique::SolidAngle),
        ("plates", Technique::MisPower),
        ("sky", Technique::MisPower),
    ];
    for (name, technique) in expected {
        let world = World::from_scene(&mut scene::load(name).unwrap()).unwrap();
        assert_eq!(world.chosen(&settings), technique, "{name}");
        if name == "quads" {
            let small = Settings { width: 64, height: 64, ..settings };
            assert_eq!(render(&world, &small), render(&world, &Settings { technique, ..small }));
        }
    }
}
