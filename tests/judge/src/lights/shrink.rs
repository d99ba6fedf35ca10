//! Makes the input that shows a finding smaller: at the origin, along the axes, with few digits.

use super::measured::Measured;
use super::scene::is_sound;
use crate::area_lights::AreaLight;

/// Rounds to a number of decimal digits of the greatest coordinate.
fn rounded(v: [f32; 3], digits: i32) -> [f32; 3] {
    let greatest = v.iter().fold(0.0_f64, |most, x| most.max(f64::from(x.abs())));
    if greatest == 0.0 {
        return v;
    }
    let step = 10.0_f64.powi(greatest.log10().floor() as i32 + 1 - digits);
    v.map(|x| ((f64::from(x) / step).round() * step) as f32)
}
fn nearest_axis(v: [f32; 3]) -> [f32; 3] {
    let most = (0..3).max_by(|i, j| v[*i].abs().total_cmp(&v[*j].abs())).unwrap_or(0);
    core::array::from_fn(|k| if k == most { 1.0_f32.copysign(v[k]) } else { 0.0 })
}

/// The smallest light for which `fails` still returns a finding, and that finding.
pub fn smallest(
    light: AreaLight,
    fails: &mut impl FnMut(&AreaLight) -> Option<Measured>,
) -> (AreaLight, Option<Measured>) {
    let mut best = (light, None);
    let mut accept = |best: &mut (AreaLight, Option<Measured>), smaller: AreaLight| -> bool {
        let is_new = format!("{smaller:?}") != format!("{:?}", best.0);
        if !is_new || !is_sound(&smaller) {
            return false;
        }
        let found = fails(&smaller);
        let is_found = found.is_some();
        if is_found {
            *best = (smaller, found);
        }
        is_found
    };
    let l = best.0;
    accept(&mut best, AreaLight { p: [0.0; 3], a: core::array::from_fn(|k| l.a[k] - l.p[k]), ..l });
    let l = best.0;
    accept(&mut best, AreaLight { n: nearest_axis(l.n), ..l });
    let l = best.0;
    if l.shape.has_normal() {
        accept(&mut best, AreaLight { b: nearest_axis(l.b), ..l });
    }
    // fewer digits, each vector on its own
    for part in 0..5 {
        for digits in 1..5 {
            let l = best.0;
            let smaller = match part {
                0 => AreaLight { p: rounded(l.p, digits), ..l },
                1 => AreaLight { a: rounded(l.a, digits), ..l },
                2 if !l.shape.has_normal() => AreaLight { b: rounded(l.b, digits), ..l },
                3 => AreaLight { c: rounded(l.c, digits), ..l },
                _ => AreaLight { radius: rounded([l.radius, 0.0, 0.0], digits)[0], ..l },
            };
            if accept(&mut best, smaller) {
                break;
            }
        }
    }
    best
}
