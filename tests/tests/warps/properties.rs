//! Every property of every warp in every regime. `-- --nocapture` prints the greatest figure of each (warp, regime, property).

use etendue::Sphere;
use etendue_judge::area_lights::{AreaLight, LightShape, Measure};
use etendue_judge::fixture::Fixture;
use etendue_judge::generators::{self, Case, lights};
use etendue_judge::packets::squares_of;
use etendue_judge::properties;
use etendue_judge::suite;
use etendue_oracle::Greatest;
use etendue_oracle::tier::is_long;
use std::collections::BTreeSet;

/// Properties that say nothing of a warp: it has no lengths, as none without parameters has, or its points scale with them, or nothing is
/// outside of its shape.
const VACUOUS: [(&str, &str); 4] =
    [("scale", "cone"), ("scale", "patch_surface"), ("outside", "uniform_sphere"), ("outside", "octahedral")];

/// Known limits: properties that a warp breaks in a regime in which it has many cases. The directions of slivers that a horizon cuts are off by up
/// to 43 units of 2⁻²⁴, a quarter of what the contract allows.
const LIMITS: [(&str, &str, &str); 1] = [("accurate", "projected_triangle", "cut, sliver 1e2")];

/// Runs all properties over the cases; in the quick tier, over one of each regime. Reports every regime that breaks one, with its first
/// message.
fn all<S: Fixture>(warp: &str, is_fixed: bool, cases: Vec<Case<S>>, random: usize) {
    let mut cases = generators::seen(cases);
    if !is_long() {
        let mut seen = BTreeSet::new();
        cases.retain(|case| seen.insert(case.0));
    }
    let outcomes = suite::all(&cases, if is_long() { random } else { random / 8 });
    for o in &outcomes {
        let said = match (o.checked, o.broken) {
            (0, _) => "nothing to check",
            (_, 0) => "",
            _ => "BROKEN",
        };
        println!("{:10} {:28} {:9.3e} {said}", o.property, o.regime, o.figure.error());
    }
    let regimes: BTreeSet<_> = cases.iter().map(|case| case.0).collect();
    for of_property in outcomes.chunk_by(|a, b| a.property == b.property) {
        let property = of_property[0].property;
        let is_vacuous = of_property.iter().all(|o| o.checked == 0);
        let expected = VACUOUS.contains(&(property, warp)) || is_fixed && property == "scale";
        assert_eq!(is_vacuous, expected, "{warp}: whether {property} has nothing to check");
        if property == "accurate" || property == "density" {
            // in units of 2⁻²⁴: of a sample against the same code in f64, or of a pdf against the truth
            let greatest = of_property.iter().map(|o| o.figure.error()).collect::<Greatest>().error();
            println!("{warp:36} {:3} regimes {:4} cases  {property} {greatest:5.1}", regimes.len(), cases.len());
        }
    }
    let broken: Vec<_> = outcomes
        .iter()
        .filter(|o| o.broken > 0 && !LIMITS.contains(&(o.property, warp, o.regime)))
        .map(|o| format!("{} [{}] ×{}: {}", o.property, o.regime, o.broken, o.first))
        .collect();
    assert!(broken.is_empty(), "broken properties:\n{}", broken.join("\n"));
}

use LightShape::{Parallelogram, Rectangle, Triangle};
use Measure::{ProjectedSolidAngle, SolidAngle};

/// A test for each warp.
macro_rules! tests {
    ($($name:ident $points:ident $random:literal $(: $warp:path)? $(= $cases:expr)?;)+) => {
        $(#[test]
        fn $name() {
            let is_fixed = !concat!($(stringify!($warp))?).is_empty();
            all(stringify!($name), is_fixed, etendue_judge::warps!(@cases $(: $warp)? $(= $cases)?), $random);
        })+
    };
}
etendue_judge::warps!(tests! {});
tests! {
    spherical_polygon_of_every_size Seen 60 = generators::hexagons_of_every_size(3, 16);
    projected_polygon_of_every_size Seen 40 = generators::projected_pentagons_of_every_size(2, 19);
}

/// Points on a vertex, on an edge and in the plane of flat shapes; shapes below the horizon or without area; points on and in spheres. If
/// nothing is visible, the pdf is 0.
#[test]
fn contact() {
    let (o, x, y, z) = ([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let plane = [
        [o, x, y],
        [[-0.5, 0.0, 0.0], x, [0.5, 1.0, 0.0]],
        [[1.0, 1.0, 0.0], x, y],
        [[-1.0, -1.0, 0.0], [3.0, 0.0, 0.0], [1.0, 3.0, 0.0]],
        [o, [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]],
        [x, y, [0.3, 0.4, 0.0]],
        // without area
        [z, o, [1.0, 0.0, -1.0]],
        [z, [0.5, 0.0, 0.0], x],
    ];
    let low = [[[1.0, 0.0, -1.0], [0.0, 1.0, 0.3], [0.3, 0.0, -1.0]], [x, y, [0.3, 0.0, -1.0]]];
    for u in generators::square(20, 6) {
        for shape in [Triangle, Parallelogram] {
            let above = [SolidAngle, ProjectedSolidAngle].into_iter().flat_map(|by| plane.map(|flat| (by, flat)));
            for (by, flat) in above.chain(low.map(|flat| (ProjectedSolidAngle, flat))) {
                let light = AreaLight::seen(shape, by, flat, z);
                properties::any_bits(&light, u);
                let seen = AreaLight::prepare::<f32>(&[light]).sample(squares_of(&[u]));
                assert!(seen.pdf == 0.0, "{light:?} {seen:?}");
            }
        }
        for (center, radius, omega) in
            [(o, 1.0, 4.0), (x, 1.0, 2.0), ([0.5, 0.0, 0.0], 1.0, 4.0), (x, 0.0, 0.0), (x, -1.0, 0.0)]
        {
            let sphere = AreaLight::seen(LightShape::Sphere, SolidAngle, [center, o, o], o);
            properties::any_bits(&AreaLight { radius, ..sphere }, u);
            let solid_angle: f32 = Sphere::new(center.into(), radius).by_solid_angle(o.into()).solid_angle();
            let truth = omega * core::f64::consts::PI;
            assert!((f64::from(solid_angle) - truth).abs() < 1e-6, "{center:?}, {radius}: {solid_angle}");
        }
    }
}

/// The distance to a sphere is that of its near side.
#[test]
fn spheres_are_hit_on_the_near_side() {
    let square = generators::square(200, 7);
    for (_, sphere) in lights(LightShape::Sphere, SolidAngle, 3, 17) {
        square.iter().for_each(|&u| properties::nearest_hit(&sphere, u));
    }
}
/// No point is beyond its shape, in every regime and where the distance is least certain: nearly in a plane with the shape.
#[test]
fn no_point_is_beyond_its_shape() {
    fn check<S: Fixture>(cases: &[Case<S>]) {
        let broken = suite::within_reach(cases).into_iter().filter(|o| o.broken > 0);
        let broken: Vec<_> = broken.map(|o| format!("[{}] ×{}: {}", o.regime, o.broken, o.first)).collect();
        assert!(broken.is_empty(), "{}", broken.join("\n"));
    }
    for (shape, seed) in [(Triangle, 12), (Parallelogram, 13), (Rectangle, 14)] {
        check(&lights(shape, SolidAngle, 4, seed));
        let flat = |flat| ("nearly in plane", AreaLight::seen(shape, SolidAngle, flat, [0.0; 3]));
        if shape != Rectangle {
            check(&generators::nearly_in_plane(50, 19).into_iter().map(flat).collect::<Vec<_>>());
        }
    }
    check(&generators::hexagons(4, 15));
    check(&generators::hexagons_of_every_size(4, 15));
}
/// Surfaces too smooth for a density, and views that see no normal, have pdf 0 everywhere; a little rougher, they have one.
#[test]
fn mirrors_have_no_density() {
    use etendue::warp::{GgxVisibleNormals, Warp};
    use etendue::{Vec2, Vec3};
    let (view, up, below) = ([0.6_f32, 0.0, 0.8], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]);
    for (alpha, wi, some) in [
        ([1e-15, 0.5], view, false),
        ([0.5, 1e-15], view, false),
        ([0.0, 0.0], up, false),
        ([-0.5, 0.5], view, false),
        ([0.5, 0.5], [0.0; 3], false),
        ([0.5, 0.5], below, false),
        ([1e-6, 0.5], view, true),
        ([0.5, 0.5], view, true),
    ] {
        let normals = GgxVisibleNormals::new(alpha[0], alpha[1], Vec3::from(wi));
        for [x, y] in generators::square(20, 8) {
            let m = normals.sample(Vec2::new(x, y));
            let densities = [normals.pdf(m), normals.reflected_pdf(m)];
            assert!((m.length_squared() - 1.0).abs() < 1e-5, "{alpha:?} {wi:?}: {m:?}");
            assert!(some || densities == [0.0; 2], "{alpha:?} {wi:?}: {densities:?} at {m:?}");
        }
        let around = normals.pdf(normals.sample(Vec2::new(0.5, 0.5)));
        assert_eq!(around > 0.0, some, "{alpha:?} {wi:?}: {around}");
    }
}
