//! The atlas of lobes: its samplers against its integrals, and what the library's documentation says of them.

use etendue_laboratory::lobes::cell::{COSINES, Cell, Place};
use etendue_laboratory::lobes::moments::{METHODS, Moments, OF_LIGHT, PROJECTED, REFLECTION};
use etendue_laboratory::lobes::quadrature::integrate;
use etendue_laboratory::lobes::samples::Drawn;
use etendue_oracle::tier::{cases, is_long};
use rayon::prelude::*;
use std::f64::consts::PI;

fn atlas() -> Vec<Moments> {
    // every seventh cell has all roughnesses, cosines, places and sizes
    Cell::all()
        .into_par_iter()
        .enumerate()
        .filter(|(k, _)| is_long() || k % 7 == 0)
        .map(|(_, c)| Moments::new(&c))
        .collect()
}

/// The estimators have the mean of the quadrature, which knows none of the samplers, within what stratified samples may err; and samples of
/// the light spread as much as their densities say.
#[test]
fn samples_have_the_moments_of_the_integrals() {
    let side = cases(64, 128);
    let worst = atlas().into_par_iter().map(|m| {
        let drawn = Drawn::new(&m.cell, side);
        let mut worst = [0.0_f64; METHODS.len()];
        for (k, worst) in worst.iter_mut().enumerate() {
            let (mean, deviation) = (drawn.means[k] / m.radiance, m.deviations[k]);
            // too few samples to find the peak of the lobe say nothing
            if deviation > f64::from(side) / 16.0 {
                continue;
            }
            // rounding errors of single precision, which stretch with the lobe
            let off = (mean - 1.0).abs() / (deviation / f64::from(side) + 2e-5);
            *worst = off;
            assert!(off < 4.0, "{}, {:?}: a mean of {mean}, {off} errors of {deviation}", METHODS[k], m.cell);
            if OF_LIGHT.contains(&k) && deviation < 1.0 {
                let spread = drawn.deviations[k] / m.radiance;
                assert!(
                    (spread - deviation).abs() < 0.3 * deviation + 2e-4,
                    "{}, {:?}: samples deviate by {spread}, integrals say {deviation}",
                    METHODS[k],
                    m.cell
                );
            }
        }
        worst
    });
    let worst = worst.reduce(|| [0.0; METHODS.len()], |a, b| std::array::from_fn(|k| a[k].max(b[k])));
    println!("greatest differences of means in standard errors of independent samples: {METHODS:?} {worst:.2?}");
}

/// All of the lobe over the hemisphere is the albedo that the library's table holds, so that the cells and the library speak of one surface.
#[test]
fn whole_lobes_have_the_albedo() {
    for (alpha, cos) in [(0.05, 0.95), (0.2, 0.7), (0.8, 0.3)] {
        let cell = Cell::new(alpha, cos, 1.0, Place::Mirror);
        // u: the sine squared of the angle to the normal; v: the azimuth, with the mirror direction in the middle
        let over = |u: f64, v: f64| {
            let (sine, azimuth) = (u.sqrt(), PI * (1.0 + v));
            let w = [sine * libm::cos(azimuth), sine * libm::sin(azimuth), (1.0 - u).sqrt()];
            [cell.reflected(w) * PI / (2.0 * w[2])]
        };
        let square = 1.0 - cos * cos;
        let [all] = integrate(&over, [[0.0, -1.0], [1.0, 1.0]], Some([square, 0.0]), 0.05 * alpha, 1e-7);
        let fit = etendue::reflection::Reflection::<f64>::new(
            alpha,
            etendue::Vec3::new(0.0, 0.0, 1.0),
            etendue::Vec3::new(square.sqrt(), 0.0, cos),
        );
        assert!((all - fit.albedo()).abs() < 4e-3, "α {alpha}, cosθ {cos}: {all}, not {}", fit.albedo());
    }
}

/// What the documentation of `etendue::reflection` says of views with at least these cosines: how far the closed form is off, of what the
/// surface reflects of a light in the mirror direction and of a white surrounding, and how much a sample by reflection deviates.
#[test]
fn published_claims_hold() {
    let all = atlas();
    for (cos, mirrored, surrounding, deviation) in
        [(0.95, 0.04, 0.009, 0.1), (0.7, 0.13, 0.031, 0.13), (0.3, 0.3, 0.065, 0.45), (0.1, 0.81, 0.11, 0.93)]
    {
        let worst = |is: &dyn Fn(&Moments) -> bool, of: &dyn Fn(&Moments) -> f64| {
            all.iter().filter(|m| m.cell.cos >= cos && is(m)).map(of).fold(0.0, f64::max)
        };
        let off = |m: &Moments| (m.closed - 1.0).abs();
        let is_mirrored = |m: &Moments| m.cell.place == Place::Mirror;
        let is_off_horizon = |m: &Moments| m.cell.place != Place::Horizon;
        for (name, found, said) in [
            ("the closed form in the mirror direction", worst(&is_mirrored, &off), mirrored),
            ("the closed form anywhere", worst(&|_| true, &|m| off(m) * m.radiance), surrounding),
            ("by reflection", worst(&is_off_horizon, &|m| m.deviations[REFLECTION]), deviation),
            ("by reflection on the horizon", worst(&|_| true, &|m| m.deviations[REFLECTION]), 1.1),
        ] {
            assert!(found <= said, "{name}, cosθ from {cos}: {found}, not {said}");
            // what is said is what is found, and not more
            let is_tight = is_long() && (said < 1.0 || cos == COSINES[COSINES.len() - 1]);
            assert!(!is_tight || found > 0.9 * said, "{name}, cosθ from {cos}: {found}, far below {said}");
        }
    }
}

/// Where samples by reflection are the best of those of the light, and a published failure: small lights on the horizon, where the fit knows
/// less of the surface than the cosine does.
#[test]
fn samplers_are_best_where_they_should_be() {
    let (mut inside, mut failed) = (0, 0);
    for m in atlas() {
        let best = OF_LIGHT[..3].iter().map(|&k| m.deviations[k]).fold(f64::INFINITY, f64::min);
        let by_reflection = m.deviations[REFLECTION];
        if m.cell.place == Place::Mirror && m.cell.size >= 64.0 {
            inside += 1;
            assert!(by_reflection < best, "{:?}: {by_reflection}, others {best}", m.cell);
        }
        if m.cell.place == Place::Horizon && m.cell.size <= 1.0 && m.cell.cos >= 0.3 {
            failed += 1;
            assert!(m.deviations[PROJECTED] < by_reflection, "{:?}: {by_reflection}, projected {best}", m.cell);
        }
    }
    assert!(inside >= 3 && failed >= 2, "{inside} {failed}");
}
