//! Every property over two axes at once, where sizes, elevations, aspect ratios and horizons meet: in which part of all places all of them hold.

use etendue_judge::area_lights::{AreaLight, LightShape, Measure};
use etendue_judge::fixture::Subject;
use etendue_judge::generators::{self, Random, square};
use etendue_judge::lights::definition::Definition;
use etendue_judge::lights::scene::{Axis, place};
use etendue_judge::{properties, suite};
use etendue_oracle::tier::{cases, is_long};
use etendue_oracle::{V3, along, cross, dot, length, narrow, unit, wide};

/// The least part of the places at which every property holds. The others are slivers, lights that are nearly a hemisphere, and points next to
/// the plane of a light, where the documentation says what is lost.
const LEAST: [(LightShape, Measure, f64); 10] = [
    (LightShape::Sphere, Measure::SolidAngle, 1.0),
    (LightShape::Sphere, Measure::ProjectedSolidAngle, 0.98),
    (LightShape::Triangle, Measure::SolidAngle, 1.0),
    (LightShape::Parallelogram, Measure::SolidAngle, 0.98),
    (LightShape::Rectangle, Measure::SolidAngle, 1.0),
    (LightShape::Polygon, Measure::SolidAngle, 0.98),
    (LightShape::Disk, Measure::SolidAngle, 1.0),
    (LightShape::Triangle, Measure::ProjectedSolidAngle, 0.97),
    (LightShape::Parallelogram, Measure::ProjectedSolidAngle, 0.96),
    (LightShape::Polygon, Measure::ProjectedSolidAngle, 0.97),
];

/// The axes of a shape's maps.
fn maps(shape: LightShape, by: Measure) -> Vec<[Axis; 2]> {
    use Axis::{Aspect, Elevation, Horizon, Size};
    let mut all = if shape == LightShape::Sphere { Vec::new() } else { vec![[Size, Elevation]] };
    if !matches!(shape, LightShape::Sphere | LightShape::Disk) {
        all.push([Aspect, Elevation]);
    }
    if shape == LightShape::Sphere || by == Measure::ProjectedSolidAngle {
        all.push([Size, Horizon]);
    }
    all
}

/// A rectangle whose edges are perpendicular after rounding, too, in another orientation.
fn with_right_angles(light: &AreaLight, random: &mut Random) -> AreaLight {
    let [a, b, c, n] = [light.a, light.b, light.c, light.n].map(wide);
    let mut integer = || generators::small_integer(random);
    let axes = generators::exact_axes([integer() + 0.5, integer(), integer(), integer()]);
    let from = [b, c, cross(b, c)].map(unit);
    let turned = |v: V3| (0..3).fold([0.0; 3], |sum, k| along(sum, unit(axes[k]), dot(v, from[k])));
    let edge = |k: usize, of: V3| axes[k].map(|x| x * generators::coarse(length(of) / length(axes[k])));
    let [a, b, c, n] = [turned(a), edge(0, b), edge(1, c), turned(n)].map(narrow);
    AreaLight { a, b, c, n, ..*light }
}

#[test]
fn properties_hold_where_two_axes_meet() {
    let mut too_few = false;
    for (shape, by, least) in LEAST {
        let mut random = Random::new(61);
        let (mut held, mut all) = (0, 0);
        for [across, up] in maps(shape, by) {
            let values = |axis: Axis| axis.values(shape, !is_long());
            for (x, y) in values(across).into_iter().flat_map(|x| values(up).into_iter().map(move |y| (x, y))) {
                let light = place(shape, by, &[(across, x), (up, y)], &mut random);
                // seen from the origin, its coordinates have no rounding of their own
                let a = core::array::from_fn(|k| light.a[k] - light.p[k]);
                let mut light = AreaLight { a, p: [0.0; 3], ..light };
                if shape == LightShape::Rectangle {
                    light = with_right_angles(&light, &mut random);
                }
                let subject = Subject::new(&light);
                if !subject.truth.is_seen() || !Definition::new(&light).is_some_and(|seen| seen.is_convex()) {
                    continue;
                }
                let square = square(cases(4, 32), 5).into_iter().step_by(cases(9, 2));
                let outcome = suite::quietly(|| square.for_each(|u| properties::pointwise(&subject, u, &mut random)));
                all += 1;
                held += u32::from(outcome.is_ok());
                if let Err(message) = outcome {
                    println!("{across:?} {x}, {up:?} {y}: {message}");
                }
            }
        }
        let part = f64::from(held) / f64::from(all);
        println!("{shape:?} by {by:?}: every property holds at {part:.3} of {all} places");
        too_few |= part < least || all <= 20;
    }
    assert!(!too_few, "see above");
}
