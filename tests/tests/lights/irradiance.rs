//! Estimators against definitions: the mean of cosθ/pdf over a fine grid of `u` is the light's projected solid angle, and by that measure each
//! sample's is.

use etendue::{Mask, Real, Vec2, Vec3, f32x8};
use etendue_judge::area_lights::{AreaLight, LightShape, Measure};
use etendue_judge::fixture::Fixture;
use etendue_judge::generators::Random;
use etendue_judge::lights::definition::Definition;
use etendue_judge::lights::sampler::SHAPES;
use etendue_judge::lights::scene::{Axis, place};
use etendue_judge::tolerances::{GRID, GRID_AREA};
use etendue_oracle::tier::cases;
use etendue_oracle::{along, unit};

/// Where lights are seen: those that the horizon cuts have their middle above, on and below it.
const PLACES: [(Axis, f64); 16] = [
    (Axis::Ordinary, 1.0),
    (Axis::Size, 1e-3),
    (Axis::Size, 0.1),
    (Axis::Horizon, 0.4),
    (Axis::Horizon, -0.8),
    (Axis::Size, 0.9),
    (Axis::Unit, 1e3),
    (Axis::Elevation, 0.1),
    (Axis::Horizon, 0.0),
    (Axis::Flipped, 1.0),
    (Axis::Size, 1e-6),
    (Axis::Size, 3.0),
    (Axis::Unit, 1e-3),
    (Axis::Horizon, -0.4),
    (Axis::Horizon, 0.8),
    (Axis::Aspect, 10.0),
];

/// Mean and variance of cosθ/pdf over the midpoints of a grid of `side` × `side`, and the number of samples that are worth nothing. The mean is
/// accurate to 1/12n² where the integrand is smooth, to n^(−3/2) across kinks.
fn estimate(light: &AreaLight, side: usize) -> (f64, f64, usize) {
    let (sampler, n) = (AreaLight::prepare::<f32x8>(&[*light]), Vec3::<f32x8>::from(light.n));
    let (mut sum, mut squares, mut lost) = (0.0, 0.0, 0);
    let middle = |i: usize| (i as f32 + 0.5) / side as f32;
    for i in 0..side * side / 8 {
        let y = f32x8::from_fn(|k| middle(i * 8 % side + k));
        let s = sampler.sample(Vec2::new(f32x8::splat(middle(i * 8 / side)), y));
        let cos = s.direction.dot(n);
        for k in 0..8 {
            let (pdf, cos) = (s.pdf.lane_f64(k), cos.lane_f64(k).max(0.0));
            // as in an integrator, a sample of pdf 0 contributes nothing
            let value = if s.emits.lane(k) && pdf > 0.0 { cos / pdf } else { 0.0 };
            sum += value;
            squares += value * value;
            lost += usize::from(value == 0.0);
        }
    }
    let (mean, squares) = (sum / (side * side) as f64, squares / (side * side) as f64);
    (mean, squares - mean * mean, lost)
}

/// A light that emits to the other side.
fn reversed(light: &AreaLight) -> AreaLight {
    let b = if light.shape.has_normal() { light.b.map(|x| -x) } else { light.c };
    AreaLight { b, c: light.b, ..*light }
}

#[test]
fn means_are_the_projected_solid_angle() {
    let kinds = AreaLight::KINDS.iter().filter(|kind| SHAPES.iter().any(|shape| shape.0 == kind.0));
    let mut random = Random::new(21);
    for &(shape, by) in kinds {
        for (axis, value) in PLACES.into_iter().take(cases(10, 16)) {
            let is_round = shape == LightShape::Sphere;
            // from inside, a sphere is seen in all directions, and emits none of them
            if is_round && axis == Axis::Size && value > 1.0 {
                continue;
            }
            let light = place(shape, by, &[(axis, value)], &mut random);
            let seen = Definition::new(&light).expect("each of these shapes has one");
            let truth = seen.irradiance(seen.normal());
            let name = format!("{shape:?} by {by:?}, {axis:?} {value}");
            if by == Measure::ProjectedSolidAngle {
                let (mean, variance, lost) = estimate(&light, 64);
                if truth == 0.0 {
                    assert_eq!(mean, 0.0, "{name}: {light:?}");
                    continue;
                }
                println!("{name:50} {truth:.6e} off by {:.1e}, {variance:.1e}", mean / truth - 1.0);
                // that of a rounded quotient is 1e−14; the cosine of a lune's axis is rounded
                let condition = if is_round { 1e-6 * light.truth().condition() } else { 5e-6 };
                assert!(variance < 1e-10 * mean * mean && lost == 0, "{name}: {variance:e}, {lost} lost: {light:?}");
                assert!((mean / truth - 1.0).abs() < condition, "{name}: {mean}, expected {truth}: {light:?}");
                continue;
            }
            // the grid must resolve the visible part, and the peak of 1/d² on a sphere that nearly touches the point
            if by == Measure::Area && is_round && axis == Axis::Size && value < 0.01 {
                continue;
            }
            let (mean, ..) = estimate(&light, 1024);
            // relative to the unclipped light, so that a sliver above the horizon may err as much as all of it
            let towards = unit(seen.grid().iter().fold([0.0; 3], |sum, w| along(sum, *w, 1.0)));
            let scale = seen.irradiance(towards);
            println!("{name:50} {truth:.6e} off by {:.1e}", (mean - truth) / scale);
            let tolerance = if by == Measure::Area { GRID_AREA } else { GRID };
            assert!((mean - truth).abs() <= tolerance * scale, "{name}: {mean}, expected {truth}: {light:?}");
            assert!(is_round || estimate(&reversed(&light), 32).0 == 0.0, "{name}: emitted backwards: {light:?}");
        }
    }
}
