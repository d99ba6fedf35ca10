//! Images over many seeds: the variance that they report is the one that they have, and their mean is that of precise images.

use crate::kit::{builtin, film, settings, sum, world};
use etendue_oracle::tier::cases;
use etendue_render::film::compare::LIMIT;
use etendue_render::film::sums::Moments;
use etendue_render::film::{Film, Pixel};
use etendue_render::{Claim, Sampler, Settings, Technique, World};

/// What images claim of their error, over that found among seeds: of the whole image, and of its quarters, as far as they have noise.
fn claimed_over_found(world: &World, settings: &Settings, seeds: u64) -> Vec<f64> {
    let films = (0..seeds).map(|seed| film(world, &Settings { seed, ..*settings }));
    // what has met something rare in a single pixel says that it does not know its error
    let foreseen = world.view(settings).foreseen();
    let is_sure =
        |film: &Film| Claim::new(film, &foreseen, settings.spp.into()).is_some_and(|claim| claim.uncertain().is_none());
    let films: Vec<Film> = films.filter(is_sure).collect();
    assert!(8 * films.len() as u64 >= 7 * seeds, "{} of {seeds} images are sure of their error", films.len());
    let [width, height] = [settings.width, settings.height].map(|side| side as usize);
    let n = films.len() as f64;
    let mut sums = [[0.0; 2]; 5];
    for i in 0..width * height {
        let quarter = 1 + (i % width) / (width / 2) + (i / width) / (height / 2) * 2;
        for k in 0..3 {
            let values = || films.iter().map(|film| f64::from(film.pixels[i].mean[k]));
            let mean = values().sum::<f64>() / n;
            let found = values().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0);
            let claimed = films.iter().map(|film| f64::from(film.pixels[i].variance[k])).sum::<f64>() / n;
            for area in [0, quarter] {
                sums[area][0] += found;
                sums[area][1] += claimed;
            }
        }
    }
    let noisy = sums.iter().filter(|[found, _]| *found > 0.01 * sums[0][0]);
    noisy.map(|[found, claimed]| (claimed / found).sqrt()).collect()
}

/// What images claim, also where only pixels are sampled, and where a single set is checked by second sets.
#[test]
fn images_tell_their_error() {
    use Technique::{Analytic, Area, Auto, MisPower, SolidAngle};
    for (name, technique, sampler, spp, sets, limits, seeds) in [
        ("quads", SolidAngle, Sampler::Sobol, 64, 4, [0.025, 0.3], cases(12, 24)),
        ("quads", Analytic, Sampler::Adaptive, 64, 4, [0.05, 0.3], cases(12, 24)),
        // lamps in view, at whose outlines rays only look
        ("studio", SolidAngle, Sampler::Adaptive, 64, 0, [0.15, 0.3], cases(24, 80)),
        ("plates", MisPower, Sampler::Adaptive, 64, 0, [0.15, 0.3], cases(24, 80)),
        ("sphere-light", SolidAngle, Sampler::Adaptive, 64, 0, [0.15, 0.3], cases(24, 80)),
        ("quads", Analytic, Sampler::Adaptive, 64, 0, [0.15, 0.3], cases(24, 80)),
        ("quads", Analytic, Sampler::Sobol, 64, 4, [0.05, 0.3], 24),
        ("terrain", Area, Sampler::Adaptive, 16, 0, [0.15, 0.3], 80),
        // the city's noise has heavy tails: with 40 seeds its ratio is 1.24
        ("city", Auto, Sampler::Adaptive, 32, 0, [0.15, 0.3], 80),
        ("defocus", SolidAngle, Sampler::Adaptive, 256, 0, [0.15, 0.3], 40),
    ]
    .into_iter()
    .take(cases(5, 10))
    {
        let settings = Settings { width: 64, height: 64, technique, sampler, spp, sets, ..Settings::DEFAULT };
        let ratios = claimed_over_found(&builtin(name), &settings, seeds);
        println!("{name}, {technique:?}, {sampler:?}: claimed error over that found {ratios:.3?}");
        assert!((ratios[0] - 1.0).abs() < limits[0], "{name}, {technique:?}, {sampler:?}: {ratios:?}");
        let are_near = ratios[1..].iter().all(|ratio| (ratio - 1.0).abs() < limits[1]);
        assert!(are_near, "{name}, {technique:?}, {sampler:?}: {ratios:?}");
    }
}

/// A scene, and how it is sampled: samplers with numbers of samples and sets, samples of the precise image, images, and the greatest error.
type VarianceCase = (&'static str, Technique, &'static [(Sampler, u32, u32)], u32, u64, f64);

/// The mean over seeds is that of an image with randomly chosen lights, also where corners do not see what the pixel sees, through a lens, and for
/// metals, where the BSDF's samples are weighted by the pmf of the allocation; and beside lamps in view. (If the number of samples depended on the pixel itself, dark
/// pixels would be left dark.)
#[test]
fn allocated_samples_have_no_bias() {
    use Sampler::{Adaptive, Sobol};
    let rows: [VarianceCase; 5] = [
        ("sphere-light", Technique::SolidAngle, &[(Adaptive, 16, 1)], cases(1 << 11, 1 << 14), cases(30, 120), 4e-5),
        // lamps in view, at whose outlines rays only look
        ("studio", Technique::SolidAngle, &[(Adaptive, 16, 1), (Adaptive, 64, 0)], 1 << 12, cases(30, 120), 1.5e-3),
        (
            "quads",
            Technique::SolidAngle,
            &[(Sobol, 8, 1), (Sobol, 64, 4), (Adaptive, 64, 1)],
            cases(1 << 12, 1 << 16),
            cases(12, 60),
            cases(1.5e-4, 1e-4),
        ),
        (
            "plates",
            Technique::MisPower,
            &[(Sobol, 8, 4), (Adaptive, 64, 4)],
            cases(1 << 10, 1 << 13),
            cases(12, 40),
            cases(1.8e-2, 1e-2),
        ),
        ("defocus", Technique::SolidAngle, &[(Sobol, 8, 4), (Adaptive, 64, 4)], 1 << 13, 40, 1e-2),
    ];
    for (name, technique, ways, precise, images, most) in rows.into_iter().take(cases(4, 5)) {
        let world = builtin(name);
        let of = |sampler, spp, sets, seed| {
            let settings = Settings { width: 32, height: 32, technique, sampler, spp, sets, seed, ..Settings::DEFAULT };
            sum(&film(&world, &settings)).map(|sum| sum / (32.0 * 32.0))
        };
        let [truth, own] = of(Sampler::Sobol4d, precise, 4, 7);
        for &(sampler, spp, sets) in ways {
            let off: Vec<f64> = (0..images).map(|seed| of(sampler, spp, sets, 100 + seed)[0] - truth).collect();
            let n = images as f64;
            let mean = off.iter().sum::<f64>() / n;
            let squared = off.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n * (n - 1.0));
            // with that of the precise image
            let error = (squared + own / (32.0 * 32.0)).sqrt();
            println!("{name}, {sampler:?}, {spp} samples: bias {mean:.1e} ± {error:.1e} of {truth:.3}");
            assert!(mean.abs() < LIMIT * error && error < most, "{name}, {sampler:?}: {mean:e} ± {error:e}");
        }
    }
}

/// Coloured lamps above a floor with balls: by name, so many.
fn lamps(count: usize) -> World {
    let mut text = String::from("LookAt 0 -7 4  0 0 0.4  0 0 1\nCamera \"perspective\" \"float fov\" 42\nWorldBegin\n");
    let lamp = "Rotate 180 1 0 0 Shape \"disk\" \"float radius\" 0.2 AttributeEnd\n";
    for k in 0..count {
        let radius = 1.0 + 2.0 * (7 * k % count) as f64 / count as f64;
        let (sin, cos) = (2.4 * k as f64).sin_cos();
        let [r, g, b] = [0, 1, 2].map(|channel| if (k + channel).is_multiple_of(3) { 30 } else { 6 });
        text += &format!("AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [{r} {g} {b}] ");
        text += &format!("Translate {} {} 3 {lamp}", radius * cos, radius * sin);
    }
    text += "Material \"diffuse\" \"rgb reflectance\" [0.6 0.6 0.6]\n";
    text += "Shape \"bilinearmesh\" \"point3 P\" [-9 -9 0  9 -9 0  -9 9 0  9 9 0]\n";
    for k in 0..20 {
        let [x, y] = [1.2 * f64::from(k % 5) - 2.4, 1.1 * f64::from(k / 5) - 1.6];
        text += &format!("AttributeBegin Translate {x} {y} 0.4 Shape \"sphere\" \"float radius\" 0.3 AttributeEnd\n");
    }
    world(&text)
}

/// Powers of two of samples are enough to allocate them to 9 to 32 lights: an eighth more of them brings no jump. (With a pilot of at most a
/// quarter, the squared error of 144 samples was 3.1 to 5.6 times less than that of 128.)
#[test]
fn samples_are_allocated_to_many_lights() {
    for (lights, spp) in [(9, 128), (14, 128), (32, 256)] {
        let world = lamps(lights);
        let squared = |spp: u32| {
            let settings = Settings { sampler: Sampler::Adaptive, ..settings(Technique::Auto, 64, spp) };
            (0..4).map(|seed| sum(&film(&world, &Settings { seed, ..settings }))[1]).sum::<f64>()
        };
        let jump = squared(spp) / squared(spp / 8 * 9);
        println!("{lights} lights: {jump:.2} times the squared error of {} samples with {spp}", spp / 8 * 9);
        assert!((0.9..1.6).contains(&jump), "{lights} lights: {jump}");
    }
}

/// Over all outcomes of a few sets of a few samples, the variance that a pixel reports has the expectation σ²/N, that of its mean: for
/// sets of equal and of different numbers of samples, and for independent samples.
#[test]
fn reported_variance_has_the_true_expectation() {
    let (values, chances) = ([[0.0, 2.0, 1.0], [1.0, 0.0, 1.0], [7.0, 1.0, 1.0]], [0.5, 0.3, 0.2]);
    let moment = |k: usize, power: i32| (0..3).map(|i| chances[i] * f64::powi(values[i][k], power)).sum::<f64>();
    for (counts, independent) in [
        (&[1_u32, 1][..], false),
        (&[2, 2, 2], false),
        (&[4, 2], false),
        (&[1, 2, 4], false),
        (&[1, 1, 1, 1], false),
        (&[2], true),
        (&[7], true),
    ] {
        let n: u32 = counts.iter().sum();
        let mut expectations = [[0.0; 3]; 2];
        for outcome in 0..3_usize.pow(n) {
            let digits: Vec<usize> = (0..n).map(|k| outcome / 3_usize.pow(k) % 3).collect();
            let chance: f64 = digits.iter().map(|&digit| chances[digit]).product();
            let mut rest = &digits[..];
            let sets: Vec<_> = counts
                .iter()
                .map(|&count| {
                    let samples = rest.split_off(..count as usize).unwrap();
                    let sum = |k: usize| samples.iter().map(|&digit| values[digit][k]).sum::<f64>();
                    let sum = [0, 1, 2].map(sum);
                    let deviation = |k: usize, digit: usize| values[digit][k] - sum[k] / f64::from(count);
                    let squares = |k: usize| samples.iter().map(|&digit| deviation(k, digit).powi(2)).sum::<f64>();
                    let squares = if independent { [0, 1, 2].map(squares) } else { [0.0; 3] };
                    (count, Moments { sum, squares })
                })
                .collect();
            let pixel = Pixel::of_sets(sets.iter().copied(), independent);
            assert_eq!(pixel.samples, n);
            for (expectation, found) in expectations.iter_mut().zip([pixel.mean, pixel.variance]) {
                for (sum, x) in expectation.iter_mut().zip(found) {
                    *sum += chance * f64::from(x);
                }
            }
        }
        for k in 0..3 {
            let (mean, variance) = (moment(k, 1), (moment(k, 2) - moment(k, 1).powi(2)) / f64::from(n));
            // each pixel is rounded to single precision
            assert!((expectations[0][k] - mean).abs() < 1e-6, "{counts:?}: {expectations:?}");
            assert!((expectations[1][k] - variance).abs() < 1e-6 * variance + 1e-12, "{counts:?}: {expectations:?}");
        }
    }
    // nothing is known of the error of one set, or of one sample
    let one = Moments { sum: [3.0; 3], ..Moments::default() };
    for (count, independent) in [(3, false), (1, false), (1, true)] {
        let pixel = Pixel::of_sets([(count, one)].into_iter(), independent);
        assert_eq!((pixel.mean, pixel.variance), ([3.0 / count as f32; 3], [f32::INFINITY; 3]));
    }
}
