//! Defects of warps.

use super::{Data, Defect};
use crate::fixtures::{Cap, ConcentricDisk, Cone, CosineHemisphere, Triangle};
use crate::packets::lanes_of;
use core::f64::consts::{FRAC_1_PI, PI, TAU};
use etendue::light::shapes::{DirectionSample, SphericalCap, SphericalTriangle};
use etendue::{Mask, Real, Vec2, Vec3, Warp, warp};

fn one<R: Real>() -> R {
    R::lit(1.0)
}
fn sphere<R: Real>(lanes: &[Cap]) -> Data<R> {
    let of = |i: usize| lanes[i % lanes.len()];
    let axis = |k: usize| lanes_of(|i| f64::from(of(i).center[k]));
    let zero = R::lit(0.0);
    [axis(0), axis(1), axis(2), lanes_of(|i| f64::from(of(i).radius)), zero, zero, zero, zero, zero]
}
/// The first vertex and the two edges.
fn flat<R: Real>(lanes: &[Triangle]) -> Data<R> {
    core::array::from_fn(|k| lanes_of(|i| lanes[i % lanes.len()].edges()[k / 3][k % 3]))
}
fn vectors<R: Real>(data: &Data<R>) -> [Vec3<R>; 3] {
    [0, 3, 6].map(|k| Vec3::new(data[k], data[k + 1], data[k + 2]))
}

/// 1: the pdf computes 1−cosσ from a cosine, whereas the sample uses sin²σ/(1+cosσ).
#[derive(Clone, Copy, Debug)]
pub struct UnguardedCap;
impl Defect for UnguardedCap {
    type Of = Cap;
    fn data<R: Real>(lanes: &[Cap]) -> Data<R> {
        sphere(lanes)
    }
    fn pdf<R: Real>(right: &SphericalCap<R>, data: &Data<R>, w: Vec3<R>) -> R {
        let [x, y, z, r, ..] = *data;
        let cos = (one::<R>() - r * r / Vec3::new(x, y, z).length_squared()).greater(R::lit(0.0)).sqrt();
        let density = one::<R>() / (R::lit(TAU) * (one::<R>() - cos));
        let inside = right.pdf(w).gt(R::lit(0.0));
        R::blend(right.inside(), right.pdf(w), density).keep(inside)
    }
}

/// 2: Arvo's map sweeps u₀ times a solid angle computed as the excess of three angles; the pdf uses the one from an arc tangent.
#[derive(Clone, Copy, Debug)]
pub struct ExcessInSample;
impl Defect for ExcessInSample {
    type Of = Triangle;
    fn data<R: Real>(lanes: &[Triangle]) -> Data<R> {
        flat(lanes)
    }
    fn sample<R: Real>(right: &SphericalTriangle<R>, data: &Data<R>, u: Vec2<R>) -> Vec3<R> {
        let [v0, e1, e2] = vectors(data);
        let [a, b, c] = [v0, v0 + e1, v0 + e2].map(Vec3::normalize);
        let [ab, bc, ca] = [a.cross(b), b.cross(c), c.cross(a)].map(Vec3::normalize);
        let angles = [ab.dot(-ca), bc.dot(-ab), ca.dot(-bc)].map(R::acos);
        let excess = (angles[0] + angles[1] + angles[2] - R::lit(PI)).abs();
        let x = (u.x * excess / right.solid_angle().greater(R::lit(1e-37))).clamped(R::lit(0.0), R::ONE_MINUS_EPSILON);
        right.sample(Vec2::new(x, u.y))
    }
}

/// A point that is uniform by area, relative to the viewpoint.
fn by_area<R: Real>(data: &Data<R>, u: Vec2<R>) -> Vec3<R> {
    let [v0, e1, e2] = vectors(data);
    let b: Vec2<R> = warp::AreaTriangle.sample(u);
    v0 + e1 * b.x + e2 * b.y
}

/// 4: below 3e−4 sr the point is uniform by area, but the pdf is 1/Ω.
#[derive(Clone, Copy, Debug)]
pub struct AreaBetweenThresholds;
impl Defect for AreaBetweenThresholds {
    type Of = Triangle;
    fn data<R: Real>(lanes: &[Triangle]) -> Data<R> {
        flat(lanes)
    }
    fn sample<R: Real>(right: &SphericalTriangle<R>, data: &Data<R>, u: Vec2<R>) -> Vec3<R> {
        let small = right.solid_angle().lt(R::lit(3e-4));
        Vec3::blend(small, by_area(data, u).normalize(), right.sample(u))
    }
}

/// 5: the technique is chosen by the distance of the plane over |N|, although the distance was already divided by |N|. Both techniques are
/// correct.
#[derive(Clone, Copy, Debug)]
pub struct UnitsInTheSwitch;
impl UnitsInTheSwitch {
    fn far<R: Real>(data: &Data<R>) -> R::Mask {
        let [v0, e1, e2] = vectors(data);
        let n = e1.cross(e2);
        let distance = v0.dot(n.normalize()).abs() / n.length();
        distance.gt(R::lit(1e3))
    }
}
impl Defect for UnitsInTheSwitch {
    type Of = Triangle;
    fn data<R: Real>(lanes: &[Triangle]) -> Data<R> {
        flat(lanes)
    }
    fn sample<R: Real>(right: &SphericalTriangle<R>, data: &Data<R>, u: Vec2<R>) -> Vec3<R> {
        Vec3::blend(Self::far(data), by_area(data, u).normalize(), right.sample(u))
    }
    fn pdf<R: Real>(right: &SphericalTriangle<R>, data: &Data<R>, w: Vec3<R>) -> R {
        let [v0, e1, e2] = vectors(data);
        let n = e1.cross(e2);
        let (height, cos) = (v0.dot(n), w.dot(n));
        let some = cos.abs().gt(R::lit(0.0));
        let distance = height / R::blend(some, cos, one());
        let by_area = distance * distance * R::lit(2.0) / R::blend(some, cos.abs(), one());
        let inside = right.pdf(w).gt(R::lit(0.0));
        R::blend(Self::far(data), by_area.keep(some), right.pdf(w)).keep(inside)
    }
}

/// 8: b/a and a/b, unguarded where both are 0.
#[derive(Clone, Copy, Debug)]
pub struct FlatCentre;
impl Defect for FlatCentre {
    type Of = ConcentricDisk;
    fn sample<R: Real>(_: &warp::ConcentricDisk, _: &Data<R>, u: Vec2<R>) -> Vec2<R> {
        let (a, b) = (u.x + u.x - one(), u.y + u.y - one());
        let first = a.abs().gt(b.abs());
        let (r, other) = (R::blend(first, a, b), R::blend(first, b, a));
        let (s, c) = (other / r * R::lit(0.125)).sin_cos_turns();
        Vec2::new(R::blend(first, c, s), R::blend(first, s, c)) * r
    }
}

/// 9: barycentric coordinates of the sampled direction are divided by their sum where that exceeds 1, but the sum for the second uses the
/// first after its division. The point then lies beyond the far edge.
#[derive(Clone, Copy, Debug)]
pub struct SelfClampingBarycentrics<const WRONG: bool>;
impl<const WRONG: bool> Defect for SelfClampingBarycentrics<WRONG> {
    type Of = Triangle;
    fn data<R: Real>(lanes: &[Triangle]) -> Data<R> {
        flat(lanes)
    }
    fn sample_direction<R: Real>(
        right: &SphericalTriangle<R>,
        data: &Data<R>,
        u: Vec2<R>,
    ) -> Option<DirectionSample<R>> {
        let (zero, one) = (R::lit(0.0), one::<R>());
        let [v0, e1, e2] = vectors(data);
        let w = right.sample(u);
        let across = w.cross(e2);
        let divisor = across.dot(e1);
        let some = divisor.abs().gt(R::lit(1e-30));
        let divisor = R::blend(some, divisor, one);
        let third = R::lit(1.0 / 3.0);
        let b1 = R::blend(some, -v0.dot(across) / divisor, third).clamped(zero, one);
        let b2 = R::blend(some, w.dot((-v0).cross(e1)) / divisor, third).clamped(zero, one);
        let sum = b1 + b2;
        let beyond = sum.gt(one);
        let c1 = R::blend(beyond, b1 / sum, b1);
        let c2 = R::blend(beyond, b2 / if WRONG { c1 + b2 } else { sum }, b2);
        let point = v0 + e1 * c1 + e2 * c2;
        let distance = point.length();
        Some(DirectionSample { direction: w, distance })
    }
}

/// 10: directions less than 1e−5 above the horizon are dropped.
#[derive(Clone, Copy, Debug)]
pub struct DroppedGrazing;
impl Defect for DroppedGrazing {
    type Of = CosineHemisphere;
    fn pdf<R: Real>(_: &warp::CosineHemisphere, _: &Data<R>, w: Vec3<R>) -> R {
        (w.z * R::lit(FRAC_1_PI)).keep(w.z.gt(R::lit(1e-5)))
    }
}

/// 12: the sine of a direction is computed from its cosine as √(1+z²).
#[derive(Clone, Copy, Debug)]
pub struct ConeOverflow;
impl Defect for ConeOverflow {
    type Of = Cone;
    fn data<R: Real>(lanes: &[Cone]) -> Data<R> {
        [lanes_of(|i| f64::from(lanes[i % lanes.len()].one_minus_cos)); 9]
    }
    fn sample<R: Real>(_: &warp::Cone<R>, data: &Data<R>, u: Vec2<R>) -> Vec3<R> {
        let z = one::<R>() - u.x * data[0];
        let sin = (one::<R>() + z * z).sqrt();
        let (s, c) = u.y.sin_cos_turns();
        Vec3::new(sin * c, sin * s, z)
    }
}

/// 13: the pdf of a sphere is 1/Ω in every direction.
#[derive(Clone, Copy, Debug)]
pub struct NonZeroOffTheCone;
impl Defect for NonZeroOffTheCone {
    type Of = Cap;
    fn pdf<R: Real>(right: &SphericalCap<R>, _: &Data<R>, _: Vec3<R>) -> R {
        right.uniform_pdf().keep(R::Mask::splat(true))
    }
}
