//! Estimators: MIS weights and running variances: sums, limits, and variances by enumeration.

use etendue::estimate::{Heuristic, Welford};
use etendue::sequence::{Independent, Sequence};
use etendue::{LightSample, LightSampler, PointLight, Sphere, Triangle, Vec2, Vec3};
use etendue_judge::checks::{self, EXTREMES, HEURISTICS};

#[test]
fn weights_sum_to_one_at_every_extreme() {
    for heuristic in HEURISTICS {
        checks::extreme_weights(heuristic);
        for a in EXTREMES {
            assert_eq!(heuristic.weights([a, f32::NAN, -1.0]), heuristic.weights([a, 0.0, 0.0]));
        }
        assert!(heuristic.weights::<f32, 0>([]).is_empty());
    }
    // the formula as it is often written fails at both ends
    let naive = |a: f32, b: f32| a * a / (a * a + b * b);
    assert!(naive(3e30, 3e30).is_nan() && naive(1e-30, 1e-30).is_nan());
    assert_eq!(Heuristic::POWER.weights([3e30_f32, 3e30]), [0.5, 0.5]);
    assert_eq!(Heuristic::POWER.weights([1e-30_f32, 1e-30]), [0.5, 0.5]);
}

#[test]
fn weights_are_their_formula_at_every_scale() {
    let sequence = Independent::new(5);
    for i in 0..2000 {
        let u: Vec2<f64> = sequence.pair(0, i, 0);
        let v: Vec2<f64> = sequence.pair(0, i, 1);
        let densities = [u.x * 10.0, u.y, v.x * 0.1].map(|d| d as f32);
        for (heuristic, beta) in [(Heuristic::Balance, 1), (Heuristic::POWER, 2), (Heuristic::Power(7), 7)] {
            let weights = heuristic.weights(densities);
            let powers = densities.map(|d| f64::from(d).powi(beta));
            for (weight, power) in weights.iter().zip(powers) {
                let expected = power / powers.iter().sum::<f64>();
                assert!((f64::from(*weight) - expected).abs() < 1e-6 * expected + 1e-30, "{weight} {expected}");
            }
            for scale in [2.0_f32.powi(-100), 2.0_f32.powi(100)] {
                assert_eq!(heuristic.weights(densities.map(|d| d * scale)), weights);
            }
        }
    }
}

#[test]
fn deltas_take_all() {
    for heuristic in HEURISTICS {
        assert_eq!(heuristic.weights([Heuristic::technique_pdf(1.0_f32, 3.0, true), 1e38]), [1.0, 0.0]);
        assert_eq!(heuristic.weights([Heuristic::technique_pdf(0.0_f32, 0.0, true), f32::MAX]), [1.0, 0.0]);
        // a density that overflows is no delta
        let [huge, delta] = heuristic
            .weights([Heuristic::technique_pdf(16.0_f32, 1e38, false), Heuristic::technique_pdf(1.0, 1.0, true)]);
        assert_eq!([huge, delta], [0.0, 1.0]);
    }
    assert_eq!(Heuristic::technique_pdf(2.0_f32, 0.25, false), 0.5);
}

/// A direction that both the light and the surface can draw has weights of both that sum to 1, and a delta light has all.
#[test]
fn weights_of_both_techniques_sum_to_one() {
    let p = Vec3::lit([0.0, 0.0, 0.0]);
    let triangle = Triangle::new(Vec3::lit([-1.0, 2.0, -1.0]), Vec3::lit([1.5, 2.0, 0.0]), Vec3::lit([0.0, 2.5, 1.0]));
    let sphere = Sphere::new(Vec3::lit([1.0, 2.0, 0.5]), 0.4_f32);
    let (by_angle, by_area, ball) = (
        triangle.by_solid_angle(p),
        triangle.by_area(p),
        sphere.by_projected_solid_angle(p, Vec3::lit([0.0, 1.0, 0.0])),
    );
    type Both<'a> = &'a dyn Fn(Vec2<f32>) -> [LightSample<f32>; 2];
    let lights: [(&str, Both<'_>); 3] = [
        ("triangle by solid angle", &|u| both(&by_angle, u)),
        ("triangle by area", &|u| both(&by_area, u)),
        ("sphere by projected solid angle", &|u| both(&ball, u)),
    ];
    for (name, light) in lights {
        let mut compared = 0;
        for i in 0..500 {
            let [sample, hit] = light(Independent::new(4).pair(0, i, 0));
            let u: Vec2<f32> = Independent::new(4).pair(0, i, 1);
            // from a pdf far below that of the light to one far above
            let bsdf = sample.pdf * (u.x * 20.0 - 10.0).exp2();
            for heuristic in HEURISTICS {
                let of_light = heuristic.light_weight(&sample, bsdf) * sample.pdf;
                let of_bsdf = heuristic.bsdf_weight(bsdf, &hit) * bsdf;
                let off = of_light + of_bsdf - 1.0;
                assert!(!sample.valid() || off.abs() < 5e-7, "{name}, {heuristic:?}: {of_light} + {of_bsdf}");
                // neither counts where the light does not emit, nor for a direction that the surface cannot draw
                let dark = LightSample { emits: false, ..sample };
                assert_eq!([heuristic.light_weight(&dark, bsdf), heuristic.bsdf_weight(bsdf, &dark)], [0.0; 2]);
                assert_eq!(heuristic.bsdf_weight(0.0, &hit), 0.0);
                // a mirror counts as pdf 1
                assert!(!sample.valid() || heuristic.bsdf_weight(f32::INFINITY, &hit) == 1.0);
            }
            compared += u32::from(sample.valid());
        }
        assert!(compared > 400, "{name}: {compared}");
    }
    let point = PointLight::new(Vec3::lit([0.0, 3.0, 0.0])).by_delta(p).sample(Vec2::lit([0.5, 0.5]));
    assert!(point.delta);
    for heuristic in HEURISTICS {
        assert_eq!(heuristic.light_weight(&point, 7.0), 1.0 / point.pdf);
    }
}

/// A sample of a light, and what a ray of its direction hits.
fn both(light: &dyn LightSampler<f32>, u: Vec2<f32>) -> [LightSample<f32>; 2] {
    let sample = light.sample(u);
    [sample, light.hit(sample.direction)]
}

/// Over all sequences of n values of a small distribution, the variance of a sequence has the expectation σ², also of merged parts.
#[test]
fn variance_has_the_true_expectation() {
    let (values, chances) = ([0.0, 1.0, 7.0], [0.5, 0.3, 0.2]);
    assert!(Welford::<f32>::default().variance().is_infinite());
    let mean = 0.3 + 1.4;
    let variance = 0.3 + 0.2 * 49.0 - mean * mean;
    for n in 2_u32..8 {
        let mut expectations = [0.0; 3];
        for sequence in 0..3_usize.pow(n) {
            let digits = (0..n).map(|k| sequence / 3_usize.pow(k) % 3);
            let chance: f64 = digits.clone().map(|digit| chances[digit]).product();
            let run = |range: core::ops::Range<usize>| {
                let mut welford = Welford::<f64>::default();
                digits.clone().skip(range.start).take(range.len()).for_each(|digit| welford.push(values[digit]));
                welford
            };
            let n = n as usize;
            let (whole, merged) = (run(0..n), run(0..n / 3).merge(run(n / 3..n)));
            for (expectation, figure) in
                expectations.iter_mut().zip([whole.mean(), whole.variance(), merged.variance()])
            {
                *expectation += chance * figure;
            }
        }
        for (expectation, truth) in expectations.into_iter().zip([mean, variance, variance]) {
            assert!((expectation - truth).abs() < 1e-12, "{n}: {expectations:?}");
        }
    }
}
