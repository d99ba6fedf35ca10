//! Lights of the core's list, seen from the origin.

use super::flat::{flats, rectangles};
use super::horizon::over_horizon;
use super::round::{disks, spheres, spheres_over_horizon};
use super::{Case, Random};
use crate::area_lights::{AreaLight, LightShape, Measure};

/// The normal where there is none to speak of.
const UP: [f32; 3] = [0.0, 0.0, 1.0];

/// A shape by a technique, `each` random ones in every regime; a horizon may leave nothing of some of them.
#[must_use]
pub fn lights(shape: LightShape, by: Measure, each: usize, numbers: impl Into<Random>) -> Vec<Case<AreaLight>> {
    let random: Random = numbers.into();
    let sphere =
        |center, radius, n| AreaLight { radius, ..AreaLight::seen(shape, by, [center, [0.0; 3], [0.0; 3]], n) };
    let is_projected = by == Measure::ProjectedSolidAngle;
    match shape {
        LightShape::Sphere if is_projected => map(spheres_over_horizon(each, random), |(c, r, n)| sphere(c, r, n)),
        LightShape::Sphere => map(spheres(each, random), |(c, r)| sphere(c, r, UP)),
        LightShape::Disk => map(disks(each, random), |(c, radius, normal)| AreaLight {
            radius,
            ..AreaLight::seen(shape, by, [c, normal, [0.0; 3]], UP)
        }),
        _ if is_projected => map(over_horizon(each, random), |[p, u, v, n]| AreaLight::seen(shape, by, [p, u, v], n)),
        _ => {
            let flats = if shape == LightShape::Rectangle { rectangles(each, random) } else { flats(each, random) };
            map(flats, |flat| AreaLight::seen(shape, by, flat, UP))
        }
    }
}
fn map<T, S>(cases: Vec<Case<T>>, of: impl Fn(T) -> S) -> Vec<Case<S>> {
    cases.into_iter().map(|(name, case)| (name, of(case))).collect()
}
