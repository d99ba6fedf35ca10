//! Techniques by projected solid angle: what is below the horizon, next to it and at the zenith.

use etendue::light::parts::{ProjectedCap, ProjectedSegment, ProjectedShape};
use etendue::{Vec2, Vec3, Warp};
use etendue_judge::area_lights::{AreaLight, LightShape, Measure};
use etendue_judge::fixture::Fixture;
use etendue_judge::generators::{self, Random};
use etendue_judge::tolerances::ULP;
use etendue_oracle::{V3, along, cross, dot, length, narrow, unit, wide};

/// Where the zenith is on an edge or in a corner, but for rounding, an inverse finds the azimuth of its direction: one in ten was that of
/// another one.
#[test]
fn inverses_where_the_zenith_is_on_an_edge() {
    let mut random = Random::new(24);
    for shape in [LightShape::Triangle, LightShape::Parallelogram] {
        let all = generators::lights(shape, Measure::ProjectedSolidAngle, 200, 25);
        let (mut count, mut worst) = (0, 0.0_f64);
        for (_, light) in all.iter().filter(|(name, _)| ["zenith on an edge", "zenith on a corner"].contains(name)) {
            let (single, double) = (AreaLight::prepare::<f32>(&[*light]), AreaLight::prepare::<f64>(&[*light]));
            for _ in 0..4 {
                let w = double.sample(Vec2::new(random.unit_f64(), random.unit_f64())).direction;
                let w = Vec3::new(w.x as f32, w.y as f32, w.z as f32);
                count += 1;
                worst = worst.max((single.sample(single.invert(w)).direction - w).length().into());
            }
        }
        assert!(count == 1600 && worst < 1e-4, "{shape:?}: {worst:e} in {count} directions");
    }
}

/// Lights that are nearly a hemisphere as seen from next to their plane, or of which a horizon leaves slivers that u₀ hardly tells apart:
/// directions near their edges came back from the other end of the light.
#[test]
fn inverses_beside_the_edges_of_a_hemisphere() {
    use LightShape::{Polygon, Triangle};
    use Measure::{ProjectedSolidAngle, SolidAngle};
    let last = 1.0 - 1.0 / 16_777_216.0;
    for (shape, by, flat, normal, u) in [
        (
            Triangle,
            ProjectedSolidAngle,
            [[3.2020195, -3.3374035, -0.08635261], [-6.2841797, 7.109375, 3.046875], [-4.029785, 3.071045, -5.698242]],
            [-0.23596892, 0.056069706, -0.97014165],
            [5.9604645e-8, 0.94166917],
        ),
        (
            Triangle,
            ProjectedSolidAngle,
            [[-1241.5294, 3625.417, -3099.5828], [800.0, -3840.0, 9216.0], [2925.0, -7036.625, 79.8]],
            [0.13721295, -0.124586806, -0.9826753],
            [last, 5.9604645e-8],
        ),
        (
            Polygon,
            ProjectedSolidAngle,
            [[-30.940767, 66.4503, 25.79405], [8.285156, -99.421875, -3.15625], [55.45469, -33.94453, -47.85625]],
            [-0.92896974, 0.23285082, -0.28774238],
            [last, 5.9604645e-8],
        ),
        (
            Polygon,
            SolidAngle,
            [[144.75937, 615.7153, -455.5314], [-68.90625, -459.375, 882.0], [-220.6875, -772.78125, 30.925]],
            [0.0; 3],
            [last, last],
        ),
    ] {
        let sampler = AreaLight::prepare::<f32>(&[AreaLight::seen(shape, by, flat, normal)]);
        let w = sampler.sample(u.into()).direction;
        let off = (sampler.sample(sampler.invert(w)).direction - w).length();
        assert!(off < 1e-4, "{shape:?} {by:?} {flat:?}: {off:e}");
    }
}

/// Spheres whose centre is below the horizon and that reach above it by a few units of their radius: errors relative to the documented
/// ones.
#[test]
fn caps_that_just_reach_over_the_horizon() {
    let mut random = Random::new(37);
    let (mut greatest, mut cases) = (0.0_f64, 0);
    for i in 0..1_000_000 {
        let mut vector = || core::array::from_fn(|_| 2.0 * random.unit() - 1.0);
        let [center, normal]: [[f32; 3]; 2] = [vector(), vector()];
        let (c, n) = (wide(center), wide(normal));
        let height = dot(c, n) / length(n);
        let mut radius = height.abs() as f32;
        for _ in 0..i % 5 {
            radius = radius.next_up();
        }
        let reach = (f64::from(radius) + height) / length(c);
        if height >= 0.0 || reach <= 0.0 {
            continue;
        }
        let found = f64::from(ProjectedCap::<f32>::new(center.into(), radius, normal.into()).projected_solid_angle());
        let double = ProjectedCap::<f64>::new(c.into(), f64::from(radius), n.into()).projected_solid_angle();
        cases += 1;
        greatest = greatest.max((found / double - 1.0).abs() / (1.6e-6 + 8e-14 / reach));
    }
    println!("{cases} caps that just reach over the horizon: error of Ω⊥ {greatest:.2} of the allowed one");
    assert!(cases > 250_000 && greatest <= 1.0, "{greatest} of the allowed error, {cases} cases");
}

/// Spheres with their centre on the horizon, but for rounding: the ellipse is thinner than the rounding of the circle's area, so that u₀ tells
/// nothing of where in it a slice is. Every slice has to be one of the cap all the same.
#[test]
fn caps_with_their_centre_on_the_horizon() {
    let mut random = Random::new(41);
    // found by the judge: a direction 0.997 long
    let mut cases =
        vec![([0.062_234_286, 0.429_168_88, 0.901_077_7], 0.3, [-0.700_660_35, -0.624_167_5, 0.345_673_17])];
    for _ in 0..2000 {
        let (center, radius) = (random.direction(), random.magnitude(1e-3, 0.999));
        let off = random.magnitude(1e-9, 1e-6);
        let normal = unit(along(cross(center, random.direction()), center, off));
        cases.push((narrow(center), radius as f32, narrow(normal)));
    }
    let (mut longest, mut outside) = (0.0_f64, 0.0_f64);
    for (center, radius, normal) in cases {
        let seen = ProjectedCap::<f32>::new(center.into(), radius, normal.into());
        let (c, r) = (wide(center), f64::from(radius));
        for u in generators::square(50, 7) {
            let w = seen.sample(Vec2::new(u[0], u[1]));
            let w = [w.x, w.y, w.z].map(f64::from);
            longest = longest.max((length(w) - 1.0).abs() / ULP);
            outside = outside.max((length(cross(w, c)).atan2(dot(w, c)) - (r / length(c)).asin()) / ULP);
        }
    }
    println!("length off by {longest:.1} units, outside by {outside:.1} units");
    assert!(longest <= 12.0 && outside <= 16.0, "length off by {longest:e} units, outside by {outside:e}");
}

/// The irradiance of a segment in both precisions, near the horizon and close to the line: errors relative to the documented ones.
#[test]
fn irradiance_of_segments() {
    const KINDS: [&str; 6] =
        ["any", "short", "from above the horizon", "next to the horizon", "line through the point", "both"];
    let mut random = Random::new(31);
    let mut greatest = [0.0_f64; KINDS.len()];
    for i in 0..600_000 {
        let kind = i % KINDS.len();
        let mut vector = || core::array::from_fn(|_| 2.0 * random.unit() - 1.0);
        let [mut a, mut edge, normal, off]: [[f32; 3]; 4] = [(); 4].map(|()| vector());
        let small = 10.0_f64.powf(-9.0 * random.unit_f64());
        let lowered = |v: [f32; 3], part: f64| {
            let n = unit(wide(normal));
            narrow(along(wide(v), n, (part - 1.0) * dot(wide(v), n)))
        };
        match kind {
            1 => edge = edge.map(|x| x * small as f32),
            2 => a = lowered(a, small),
            3 => [a, edge] = [a, edge].map(|v| lowered(v, small)),
            4 | 5 => {
                let past = 1.0 + random.unit();
                edge = core::array::from_fn(|k| off[k] * small as f32 - a[k] * past);
                if kind == 5 {
                    [a, edge] = [a, edge].map(|v| lowered(v, small));
                }
            }
            _ => {}
        }
        let seen = |[a, edge, normal]: [Vec3<f64>; 3]| ProjectedSegment::new(a, edge, normal).irradiance();
        let truth = seen([a, edge, normal].map(|v| Vec3::from(wide(v))));
        let found = f64::from(ProjectedSegment::<f32>::new(a.into(), edge.into(), normal.into()).irradiance());
        let [a, e, n] = [a, edge, normal].map(wide);
        let b = along(a, e, 1.0);
        let sine = |v: V3| (length(cross(a, e)) / (length(v) * length(e))).min(1.0);
        let elevation = |v: V3| dot(v, n) / (length(v) * length(n));
        let highest = elevation(a).max(elevation(b));
        if truth > 1e-25 && highest > 0.0 {
            let known = 1.1e-6 / sine(a).min(sine(b)) + 2e-14 / highest;
            greatest[kind] = greatest[kind].max((found / truth - 1.0).abs() / known);
        }
    }
    for (kind, greatest) in KINDS.into_iter().zip(greatest) {
        println!("segments, {kind}: error of ∫p {greatest:.2} of the allowed one");
        assert!(greatest <= 1.0, "{kind}: {greatest}");
    }
}
