//! CIE's general sky against its formula with the standard's own list of parameters.

use etendue::{Vec3, f32x8};
use etendue_judge::generators::{self, Random};
use etendue_judge::packets::{Coordinates, vectors_of};
use etendue_oracle::tier::cases;
use etendue_oracle::{V3, dot, gauss_legendre, length, unit};
use etendue_render::lights::sky::GeneralSky;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Parameters a to e of the types 1 to 15, as ISO 15469:2004 lists them.
const STANDARD: [[f64; 5]; 15] = [
    [4.0, -0.70, 0.0, -1.0, 0.0],
    [4.0, -0.70, 2.0, -1.5, 0.15],
    [1.1, -0.80, 0.0, -1.0, 0.0],
    [1.1, -0.80, 2.0, -1.5, 0.15],
    [0.0, -1.00, 0.0, -1.0, 0.0],
    [0.0, -1.00, 2.0, -1.5, 0.15],
    [0.0, -1.00, 5.0, -2.5, 0.30],
    [0.0, -1.00, 10.0, -3.0, 0.45],
    [-1.0, -0.55, 2.0, -1.5, 0.15],
    [-1.0, -0.55, 5.0, -2.5, 0.30],
    [-1.0, -0.55, 10.0, -3.0, 0.45],
    [-1.0, -0.32, 10.0, -3.0, 0.45],
    [-1.0, -0.32, 16.0, -3.0, 0.30],
    [-1.0, -0.15, 16.0, -3.0, 0.30],
    [-1.0, -0.15, 24.0, -2.8, 0.15],
];

/// Luminance over that of the zenith, by angles.
fn truth(kind: usize, w: V3, sun: V3) -> f64 {
    let [a, b, c, d, e] = STANDARD[kind - 1];
    let gradation = |z: f64| 1.0 + a * (b / z).exp();
    let indicatrix = |w: V3| {
        let [x, y] = [0, 1].map(|sign| length(std::array::from_fn(|k| w[k] + [1.0, -1.0][sign] * sun[k])));
        // the angle in a triangle with two sides of length 1, also where it is small
        let (angle, cos) = (2.0 * y.atan2(x), dot(w, sun));
        1.0 + c * ((d * angle).exp() - (d * FRAC_PI_2).exp()) + e * cos * cos
    };
    if w[2] < 0.0 {
        return 0.0;
    }
    gradation(w[2]) * indicatrix(w) / (gradation(1.0) * indicatrix([0.0, 0.0, 1.0]))
}

/// A direction at these degrees from the zenith, and clockwise from north.
fn at(zenith: f64, azimuth: f64) -> V3 {
    let ((s, c), (sin, cos)) = (zenith.to_radians().sin_cos(), azimuth.to_radians().sin_cos());
    [s * sin, s * cos, c]
}

#[test]
fn luminance_is_the_standards() {
    let mut random = Random::new(1);
    let mut worst = 0.0_f64;
    for kind in 1..=15 {
        for _ in 0..cases(2000, 100_000) {
            let sun = random.direction();
            let sun = [sun[0], sun[1], sun[2].abs()];
            let sky = GeneralSky::new(kind, sun).unwrap();
            let sun = unit(sun);
            let w = match random.below(4) {
                // beside the sun, and beside the horizon
                0 => {
                    let d = random.direction();
                    unit(std::array::from_fn(|k| sun[k] + 1e-3 * d[k]))
                }
                1 => {
                    let (s, c) = (TAU * random.unit_f64()).sin_cos();
                    unit([s, c, 0.05 * random.range(-1.0, 1.0)])
                }
                _ => random.direction(),
            };
            let expected = truth(kind as usize, w, sun);
            let double = sky.luminance(Vec3::<f64>::new(w[0], w[1], w[2]));
            assert!(
                (double - expected).abs() <= 1e-7 * expected + 1e-12,
                "{kind}: {double}, expected {expected} at {w:?}"
            );
            let rounded = unit(w.map(|x| f64::from(x as f32)));
            let expected = truth(kind as usize, rounded, sun);
            let single: Vec3<f32> = Coordinates::gather(&[w]);
            let single = f64::from(sky.luminance(single));
            if expected > 0.0 {
                worst = worst.max((single / expected - 1.0).abs());
            }
            assert!((single - expected).abs() <= 1.5e-6 * expected, "{kind}: {single}, expected {expected} at {w:?}");
        }
    }
    println!("relative error in single precision: {worst:.1e}");
    assert!(worst < 1e-6, "{worst:e}");
}

/// Values of another implementation of the standard (colour-science 0.4.7), for the sun 30° from the zenith, in the north.
#[test]
fn luminance_is_that_of_others() {
    for (kind, expected) in [(1, 0.832_584_6), (12, 0.454_452_4)] {
        let sky = GeneralSky::new(kind, at(30.0, 0.0)).unwrap();
        let w = at(45.0, 180.0);
        let found = sky.luminance(Vec3::<f64>::new(w[0], w[1], w[2]));
        assert!((found - expected).abs() < 1e-7, "{kind}: {found}, expected {expected}");
    }
}

/// ∫ luminance cosZ dω by Gauss and Legendre's rule about the sun, whose corona has a tip; of a uniform sky it is π.
#[test]
fn horizontal_illuminance() {
    let uniform = GeneralSky::new(5, [0.0, 0.3, 0.6]).unwrap().horizontal();
    assert!((uniform - PI).abs() < 1e-9, "{uniform}");
    let mut worst = 0.0_f64;
    for kind in 1..=15 {
        for zenith in [0.0, 25.0, 60.0, 88.0].into_iter().skip(kind % cases(4, 1)).step_by(cases(4, 1)) {
            let sun = at(zenith, 70.0);
            let (rule_u, rule_v) = (gauss_legendre::<120>(), 240);
            // polar coordinates about the sun
            let side = unit([sun[2], 0.0, -sun[0]]);
            let other = [
                sun[1] * side[2] - sun[2] * side[1],
                sun[2] * side[0] - sun[0] * side[2],
                sun[0] * side[1] - sun[1] * side[0],
            ];
            let mut sum = 0.0;
            for j in 0..rule_v {
                let (sin, cos) = (TAU * (f64::from(j) + 0.5) / f64::from(rule_v)).sin_cos();
                let across: V3 = std::array::from_fn(|k| cos * side[k] + sin * other[k]);
                // a meridian ends at the horizon
                let end = FRAC_PI_2 + across[2].atan2(sun[2]);
                for &(x, weight) in &rule_u {
                    let (s, c) = (end * x).sin_cos();
                    let w: V3 = std::array::from_fn(|k| c * sun[k] + s * across[k]);
                    sum += truth(kind, w, sun) * w[2].max(0.0) * s * weight * end * TAU / f64::from(rule_v);
                }
            }
            let found = GeneralSky::new(kind as u32, sun).unwrap().horizontal();
            worst = worst.max((found / sum - 1.0).abs());
            assert!((found / sum - 1.0).abs() < 2e-5, "{kind} at {zenith}°: {found}, expected {sum}");
        }
    }
    println!("relative error: {worst:.1e}");
}

#[test]
fn there_is_no_sky_of_another_type_or_without_a_direction() {
    for (kind, sun) in
        [(0, [0.0, 0.0, 1.0]), (16, [0.0, 0.0, 1.0]), (u32::MAX, [0.0, 0.0, 1.0]), (1, [0.0; 3]), (1, [f64::NAN; 3])]
    {
        assert_eq!(GeneralSky::new(kind, sun), None, "{kind} {sun:?}");
    }
    assert_eq!(GeneralSky::new(3, [0.0, f64::INFINITY, 0.0]), None);
}

/// Any bits give a finite luminance, the same in a packet and alone.
#[test]
fn any_bits_in_every_lane() {
    let mut random = Random::new(7);
    for round in 0..cases(400, 20_000) {
        let sky = GeneralSky::new(1 + round as u32 % 15, random.direction()).unwrap();
        let w: [[f32; 3]; 8] = std::array::from_fn(|_| {
            if round % 2 == 0 { generators::nasty(&mut random) } else { random.direction().map(|x| x as f32) }
        });
        let found = sky.luminance::<f32x8>(vectors_of(|i| w[i])).to_array();
        for (found, w) in found.into_iter().zip(w) {
            assert!((0.0..1e4).contains(&found), "{found}");
            assert_eq!(found.to_bits(), sky.luminance(Vec3::<f32>::from(w)).to_bits());
        }
    }
}
