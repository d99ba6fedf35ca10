//! Thirteen well-known defects of renderers, reintroduced: the properties detect every one, and report nothing without it. `-- --nocapture`
//! prints which property detected what, in which regimes.

use etendue::Real;
use etendue::estimate::Heuristic;
use etendue_judge::area_lights::{AreaLight, LightShape, Measure};
use etendue_judge::fixture::Fixture;
use etendue_judge::fixtures::{ConcentricDisk, Cone, CosineHemisphere};
use etendue_judge::generators::{self, Case};
use etendue_judge::mutants::{
    AreaBetweenThresholds, ConeOverflow, CosineWarp, Defect, DroppedGrazing, ExcessInSample, FlatCentre,
    NonZeroOffTheCone, PaddedDisk, Planted, SelfClampingBarycentrics, Sound, UnguardedCap, UnitsInTheSwitch, plant,
};
use etendue_judge::{checks, properties, suite};

/// The properties that detected a defect, each with its regimes; empty if none did.
type Noticed = Vec<(String, String)>;

/// The power heuristic with β = 2 as often written: its squares overflow; where they underflow, it is the balance heuristic.
fn squares<const N: usize>(densities: [f32; N]) -> [f32; N] {
    let sum: f32 = densities.iter().map(|d| d * d).sum();
    if sum > 1e-30 { densities.map(|d| d * d / sum) } else { Heuristic::Balance.weights(densities) }
}

/// Runs all properties of warps.
fn all<D: Defect>(cases: &[Case<D::Of>]) -> Noticed {
    noticed(&suite::all(&plant::<D>(cases), 8))
}
/// Runs only the property that points are on the shape.
fn reach<D: Defect>(cases: &[Case<D::Of>]) -> Noticed {
    noticed(&[suite::within_reach(&plant::<D>(cases))])
}
fn noticed(outcomes: &[suite::PropertyOutcome]) -> Noticed {
    outcomes
        .iter()
        .filter(|outcome| outcome.broken().next().is_some())
        .map(|outcome| {
            let regimes: Vec<_> = outcome.broken().map(|r| r.name).collect();
            let said = outcome.broken().next().map_or("", |r| &r.first);
            (
                outcome.property.to_owned(),
                format!("in {}: {}", regimes.join(", "), said.chars().take(160).collect::<String>()),
            )
        })
        .collect()
}
/// Runs the property that there is one pdf, and that it is the true one by area.
fn one_pdf<D: Defect<Of = AreaLight>>(light: AreaLight) -> Noticed {
    let sampler = Planted::<D>::prepare::<f32>(&[Planted(light)]);
    let square = generators::square(60, 3);
    let noticed = check("one pdf", || square.iter().for_each(|&u| properties::one_pdf(&light, &*sampler, u)));
    let by_area = check("measure", || square.iter().for_each(|&u| properties::measure(&light, &*sampler, u)));
    [noticed, by_area].concat()
}
/// Runs one check.
fn check(name: &str, run: impl FnOnce()) -> Noticed {
    match suite::quietly(run) {
        Ok(()) => Vec::new(),
        Err(message) => vec![(name.to_owned(), message.chars().take(200).collect())],
    }
}

struct Report {
    number: u32,
    noticed: Noticed,
    falsely: Noticed,
}
/// Prints one line for each property that detected the defect.
fn report(number: u32, what: &str, noticed: Noticed, falsely: Noticed) -> Report {
    println!("{number:2} {what}: {}", if noticed.is_empty() { "NOT DETECTED" } else { "detected" });
    for (property, said) in &noticed {
        println!("     {property} {said}");
    }
    for (property, said) in &falsely {
        println!("     FALSELY, without the defect: {property} {said}");
    }
    Report { number, noticed, falsely }
}
#[test]
fn every_mutant_is_detected() {
    let caps = generators::lights(LightShape::Sphere, Measure::SolidAngle, 1, 11);
    let triangles = generators::lights(LightShape::Triangle, Measure::SolidAngle, 1, 12);
    let (cones, disk): (Vec<Case<Cone>>, _) = (generators::cones(), [("whole", ConcentricDisk)]);
    let hemisphere = [("whole", CosineHemisphere)];

    let panel = [[0.5, -0.4, 0.2], [0.0, 0.8, 0.0], [0.3, 0.0, 0.6]];
    let panel = AreaLight::seen(LightShape::Rectangle, Measure::SolidAngle, panel, [0.0, 0.0, 1.0]);
    let disk_light = AreaLight { radius: 0.5, ..panel };
    let disk_light = AreaLight { shape: LightShape::Disk, by: Measure::Area, b: [0.0, 0.0, -1.0], ..disk_light };

    let flushed = |x: f32| if x.is_subnormal() { 0.0_f32.copysign(x) } else { x };
    let power = Heuristic::POWER;

    // with the correct clamp the distance is inaccurate too, but the point stays on the triangle
    let edge_on: Vec<_> = generators::nearly_in_plane(50, 19)
        .into_iter()
        .map(|flat| ("nearly in plane", AreaLight { a: flat[0], b: flat[1], c: flat[2], ..triangles[0].1 }))
        .collect();
    // the correct fixtures, once each
    let (cap, triangle) = (all::<Sound<AreaLight>>(&caps), all::<Sound<AreaLight>>(&triangles));
    let all = [
        report(1, "1−cosσ unguarded in the pdf", all::<UnguardedCap>(&caps), cap.clone()),
        report(2, "Ω by angle excess in the sample", all::<ExcessInSample>(&triangles), triangle.clone()),
        report(
            3,
            "cosine warp's factor missing in the evaluated pdf",
            one_pdf::<CosineWarp>(panel),
            one_pdf::<Sound<AreaLight>>(panel),
        ),
        report(4, "area-uniform point with pdf 1/Ω", all::<AreaBetweenThresholds>(&triangles), triangle.clone()),
        report(
            5,
            "switch of technique that depends on the units",
            all::<UnitsInTheSwitch>(&triangles),
            triangle.clone(),
        ),
        report(
            6,
            "subnormal numbers flushed in atan2",
            check("atan2", || checks::atan2(|y, x| flushed(Real::atan2(flushed(y), flushed(x))))),
            check("atan2", || checks::atan2(Real::atan2)),
        ),
        report(
            7,
            "∞/∞ in the power heuristic",
            check("weights", || checks::extreme_weights(power, squares, squares)),
            check("weights", || checks::extreme_weights(power, |d| power.weights(d), |d| power.weights(d))),
        ),
        report(
            8,
            "0/0 at the centre of the concentric disk",
            all::<FlatCentre>(&disk),
            all::<Sound<ConcentricDisk>>(&disk),
        ),
        report(
            9,
            "barycentric clamp that divides by a modified sum",
            reach::<SelfClampingBarycentrics<true>>(&edge_on),
            reach::<SelfClampingBarycentrics<false>>(&edge_on),
        ),
        report(
            10,
            "directions below 1e−5 dropped",
            all::<DroppedGrazing>(&hemisphere),
            all::<Sound<CosineHemisphere>>(&hemisphere),
        ),
        report(
            11,
            "1e−4 added to a pdf's divisor",
            one_pdf::<PaddedDisk>(disk_light),
            one_pdf::<Sound<AreaLight>>(disk_light),
        ),
        report(12, "√(1+z²) for √(1−z²)", all::<ConeOverflow>(&cones), all::<Sound<Cone>>(&cones)),
        report(13, "pdf of a sphere off its cone", all::<NonZeroOffTheCone>(&caps), cap.clone()),
    ];
    let noticed = all.iter().filter(|r| !r.noticed.is_empty()).count();
    println!("mutants: {noticed} of {} detected", all.len());
    for r in &all {
        assert!(!r.noticed.is_empty(), "mutant {} is not detected", r.number);
        assert!(r.falsely.is_empty(), "without the defect of mutant {}: {:?}", r.number, r.falsely);
    }
}
