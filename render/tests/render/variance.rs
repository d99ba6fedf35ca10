//! The variance that images report, against the one that they have.

use etendue_oracle::tier::cases;
use etendue_render::film::Pixel;
use etendue_render::sums::Moments;
use etendue_render::{Settings, World};

/// The variance that images of 24 seeds (12 in the quick tier) report, relative to the variance among them: sums over all pixels, of green.
pub(crate) fn reported_to_measured(world: &World, settings: &Settings) -> f64 {
    let films: Vec<_> =
        (0..cases(12, 24)).map(|seed| world.render(&Settings { seed, ..*settings }, &|_| ()).0).collect();
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
