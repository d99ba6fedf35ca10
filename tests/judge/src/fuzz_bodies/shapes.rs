//! Warps, and shapes seen from a point.

use super::{Input, scalable};
use crate::area_lights::{AreaLight, LightShape, Measure};
use crate::fixture::{Fixture, Subject};
use crate::fixtures::{Bilinear, Cone, Corners, GgxVisibleNormals, Segment};
use crate::generators::{self, Case, Random};
use crate::packets::squares_of;
use crate::properties;
use etendue::Warp;

/// Cones of any 1−cosσ.
pub(super) fn cone(input: &mut Input<'_>) {
    let (cone, u) = (Cone { one_minus_cos: input.number() }, input.square());
    check(&cone, u, &[], (1e-30..=2.0).contains(&cone.one_minus_cos), input);
    let warp = etendue::warp::Cone { one_minus_cos: cone.one_minus_cos };
    assert_eq!(warp.pdf(warp.sample(squares_of(&[u]))).to_bits(), warp.uniform_pdf().to_bits(), "{cone:?} at {u:?}");
}

/// What holds for any numbers; what holds for these lengths at any scale; and all properties if the numbers are fair.
fn check<S: Fixture>(s: &S, u: [f32; 2], lengths: &[f32], is_fair: bool, input: &mut Input<'_>) {
    properties::any_bits(s, u);
    if !lengths.is_empty() && scalable(lengths, 1e18) {
        properties::scale(&Subject::new(s), u);
    }
    if is_fair {
        properties::pointwise(&Subject::new(s), u, &mut input.points());
    }
}

macro_rules! fixed {
    ($($name:ident $points:ident $random:literal $(: $warp:path)? $(= $cases:expr)?;)+) => {
        /// Checks of the warps without parameters.
        const FIXED: &[fn([f32; 2], &mut Input<'_>)] = &[$($(|u, input| check(&$warp, u, &[], true, input),)?)+];
    };
}
crate::warps!(fixed! {});
/// Warps without parameters.
pub(super) fn fixed_warps(input: &mut Input<'_>) {
    let (kind, u) = (input.below(FIXED.len() as u8), input.square());
    FIXED[usize::from(kind)](u, input);
}

/// The bilinear density.
pub(super) fn bilinear(input: &mut Input<'_>) {
    let (u, corners) = (input.square(), [(); 4].map(|()| input.number()));
    let s = Bilinear { corners };
    check(&s, u, &[], false, input);
    if corners.iter().all(|x| (1e-2..1e2).contains(x)) {
        let (s, mut random) = (Subject::new(&s), input.points());
        properties::pdf(&s, u, [random.unit_f64(), random.unit_f64()]);
        properties::jacobian(&s, [random.unit_f64(), random.unit_f64()]);
    }
}

/// Microsurfaces.
pub(super) fn visible_normals(input: &mut Input<'_>) {
    let u = input.square();
    let s = GgxVisibleNormals { alpha: [input.number(), input.number()], wi: input.vector(&[]) };
    properties::any_bits(&s, u);
    properties::any_bits(&GgxVisibleNormals { wi: input.direction(), ..s }, u);
    let all = generators::microsurfaces();
    let (_, s) = all[input.below(all.len() as u8) as usize];
    properties::pointwise(&Subject::new(&s), u, &mut input.points());
}

/// Prints the regime if a property is broken.
struct Said(&'static str);
impl Drop for Said {
    fn drop(&mut self) {
        if std::thread::panicking() {
            eprintln!("regime: {}", self.0);
        }
    }
}

/// What holds in a regime.
#[derive(PartialEq)]
enum Holds {
    /// All properties.
    All,
    /// All that say nothing of directions' accuracy: a step of `u` turns the direction a lot.
    Density,
    /// Only the properties that every sampler keeps, whatever its numbers are.
    Bits,
}
/// What holds of a shape by solid angle. Known limits: near a hemisphere, one distance in 1e4 is off by more than the tolerance; beside a corner
/// of a rectangle the direction may be off by 1.2e−5; the pdf of a fan of slivers may be off by 1.3e−6.
fn by_solid_angle(shape: LightShape, name: &str) -> Holds {
    let is_beside = name.starts_with("grazing 1e-4") || name == "near a vertex";
    if shape == LightShape::Rectangle && is_beside || shape == LightShape::Polygon && name.starts_with("sliver") {
        Holds::Bits
    } else if name.starts_with("near-hemisphere") || name.starts_with("large") {
        Holds::Density
    } else {
        Holds::All
    }
}
/// What holds of a shape over a horizon. Known limits: near a hemisphere a step of `u` turns the direction by more than the tolerance; for
/// slivers the pdf and the direction may be off by twice the tolerance; where the horizon passes through a corner, what it leaves may be no more than
/// the rounding of double precision; next to shapes of 1e−7 the pdf may not yet be 0 at 16 units outside.
/// Of spheres, only the density is checked.
fn over_horizon(shape: LightShape, name: &str) -> Holds {
    let is_limit =
        ["hemisphere", "huge", "close", "sliver", "1e-7", "through a corner"].iter().any(|part| name.contains(part));
    match shape {
        LightShape::Sphere => Holds::Density,
        _ if is_limit => Holds::Bits,
        _ => Holds::All,
    }
}
/// The properties of a shape from a regime.
fn regime<S: Fixture>((name, s): Case<S>, holds: Holds, u: [f32; 2], mut random: Random) {
    let (_said, subject) = (Said(name), Subject::new(&s));
    // a subnormal number has fewer digits, and loses them as its length is multiplied
    let is_scalable = format!("{s:?}") == format!("{:?}", s.scaled(2_f32.powi(-20)).scaled(2_f32.powi(20)));
    if !is_scalable || !subject.truth.is_seen() {
        return;
    }
    properties::within_reach(&subject, u);
    if holds == Holds::All {
        return properties::pointwise(&subject, u, &mut random);
    }
    properties::any_bits(&s, u);
    properties::scale(&subject, u);
    if holds == Holds::Density {
        properties::pdf(&subject, u, [random.unit_f64(), random.unit_f64()]);
    }
}

/// A light of any numbers, rectangles without right angles included, and one from a regime.
pub(super) fn seen(shape: LightShape, by: Measure, input: &mut Input<'_>) {
    let (u, a) = (input.square(), input.vector(&[]));
    let is_round = shape == LightShape::Sphere || shape == LightShape::Disk;
    let b = if shape == LightShape::Disk { input.direction() } else { input.vector(&[a]) };
    let (c, radius) = if is_round { ([0.0; 3], input.number()) } else { (input.vector(&[a, b]), 0.0) };
    let light = AreaLight { radius, ..AreaLight::seen(shape, by, [a, b, c], input.direction()) };
    let lengths = [a, if shape == LightShape::Disk { a } else { b }, c, [radius; 3]].concat();
    check(&light, u, &lengths, false, input);
    // normals of any length
    let any = input.vector(&[a, b]);
    properties::any_bits(&AreaLight { b: if shape == LightShape::Disk { any } else { b }, n: any, ..light }, u);
    let case = input.case(|each, random| generators::lights(shape, by, each, random));
    let is_projected = by == Measure::ProjectedSolidAngle;
    let holds = if is_projected { over_horizon(shape, case.0) } else { by_solid_angle(shape, case.0) };
    regime(case, holds, u, input.points());
    if shape == LightShape::Sphere {
        properties::nearest_hit(&case.1, u);
        let sampler = AreaLight::prepare::<f32>(&[case.1]);
        let s = sampler.sample(squares_of(&[u]));
        assert_eq!(s.pdf.to_bits(), sampler.pdf(s.direction).to_bits(), "{:?} at {u:?}", case.1);
    }
}

fn corners<const N: usize>(input: &mut Input<'_>) -> ([[f32; 3]; N], Vec<f32>) {
    let mut corners = [[0.0; 3]; N];
    for k in 0..N {
        corners[k] = input.vector(&corners[..k]);
    }
    (corners, corners.concat())
}
/// Polygons, including malformed ones.
pub(super) fn spherical_polygon(input: &mut Input<'_>) {
    let (u, (corners, lengths)) = (input.square(), corners::<6>(input));
    check(&Corners { corners, point: [0.0; 3], normal: None }, u, &lengths, false, input);
    for cases in [generators::hexagons, generators::hexagons_of_every_size] {
        let case = input.case(cases);
        regime(case, by_solid_angle(LightShape::Polygon, case.0), u, input.points());
    }
}
/// Parallelograms and pentagons over a horizon, including malformed ones.
pub(super) fn projected_polygon(input: &mut Input<'_>) {
    let (u, (corners, lengths)) = (input.square(), corners::<5>(input));
    let normal = Some(input.vector(&corners));
    check(&Corners { corners, point: [0.0; 3], normal }, u, &lengths, false, input);
    for cases in [generators::projected_pentagons, generators::projected_pentagons_of_every_size] {
        let case = input.case(cases);
        regime(case, over_horizon(LightShape::Polygon, case.0), u, input.points());
    }
    seen(LightShape::Parallelogram, Measure::ProjectedSolidAngle, input);
}

/// Line segments, or, with 1, those over a horizon.
pub(super) fn segment(which: usize, input: &mut Input<'_>) {
    let (u, a) = (input.square(), input.vector(&[]));
    let ends = [a, input.vector(&[a])];
    let normal = (which == 1).then(|| input.direction());
    check(&Segment { ends, normal }, u, &ends.concat(), false, input);
    let any = Segment { ends, normal: normal.map(|_| input.vector(&ends)) };
    properties::any_bits(&any, u);
    let (name, s) = input.case(|each, random| generators::segments(each, random)[which].clone());
    // the rounding of the normal may move the horizon past the whole of a tiny segment
    if Segment::prepare::<f32>(&[s]).sample(squares_of(&[u])).pdf > 0.0 {
        regime((name, s), Holds::All, u, input.points());
    }
}
