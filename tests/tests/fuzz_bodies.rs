//! The bodies of the fuzz targets without a fuzzer: on the committed seeds, which include past findings, and on random bytes.

use etendue_judge::area_lights::{AreaLight, LightShape, Measure};
use etendue_judge::fixture::Subject;
use etendue_judge::fuzz_bodies::{TARGETS, run};
use etendue_judge::properties;
use etendue_oracle::tier::cases;

#[test]
fn seeds() {
    run::seeds(TARGETS, |_| 0);
}

/// Every light of the core's list.
#[test]
fn every_light_has_a_target() {
    for (shape, _) in AreaLight::kinds() {
        let name = format!("{shape:?}_light").to_lowercase();
        assert!(TARGETS.iter().any(|target| target.name == name), "{name}");
    }
}

/// A past finding as plain numbers: a triangle with an edge that rises vertically above the horizon, and a direction next to that edge.
#[test]
fn inverse_beside_an_upright_edge() {
    let flat =
        [[-1.0866929, 0.21072814, 0.14530581], [0.5384565, 0.15991381, 0.8273404], [-0.33004466, 0.755619, -0.5657831]];
    let normal = [0.09743712, -0.066804275, 0.15172845];
    let triangle = AreaLight::seen(LightShape::Triangle, Measure::ProjectedSolidAngle, flat, normal);
    properties::inverse(&Subject::new(&triangle), [-0.504813015, 0.341584474, 0.79276967]);
}

/// A past finding: a rectangle whose edges are parallel, and whose line the point is on.
#[test]
fn a_rectangle_without_a_plane() {
    let a = [-0.07624698, -0.26919866, -0.5767062];
    let (b, c) = ([0.12529406, 0.442365, 0.9476816], [0.12529406, 0.44236502, 0.9476816]);
    let light =
        AreaLight::seen(LightShape::Rectangle, Measure::SolidAngle, [a, b, c], [0.28337574, 0.3628821, -0.8877019]);
    properties::any_bits(&light, [0.5, 0.50224024]);
}

#[test]
fn a_million_random_inputs() {
    let shares: u32 = TARGETS.iter().map(|t| t.share).sum();
    run::random(TARGETS, |target| u64::from(target.share) * cases(43_180, 863_589) / u64::from(shares) + 1);
}
#[test]
#[ignore = "a million inputs for each target: half an hour"]
fn a_million_random_inputs_each() {
    run::random(TARGETS, |_| 1_000_000);
}
