//! Defects of samplers.

use super::Defect;
use crate::area_lights::AreaLight;
use crate::fixtures::{ConcentricDisk, Cone, CosineHemisphere};
use crate::packets::lanes_of;
use core::f64::consts::{FRAC_1_PI, PI, TAU};
use etendue::{LightSample, LightSampler, Real, Vec2, Vec3, Warp, warp};

fn one<R: Real>() -> R {
    R::lit(1.0)
}
/// The first vertex relative to the point, and the two edges.
fn vectors<R: Real>(lanes: &[AreaLight]) -> [Vec3<R>; 3] {
    let ([p, a, b, c, ..], _) = AreaLight::vectors(lanes);
    [a - p, b, c]
}
/// A sample, in another direction.
fn turned<R: Real>(right: &dyn LightSampler<R>, u: Vec2<R>, direction: Vec3<R>) -> LightSample<R> {
    LightSample { direction, ..right.sample(u) }
}

/// 1: the pdf computes 1−cosσ from a cosine, whereas the sample uses sin²σ/(1+cosσ).
#[derive(Clone, Copy, Debug)]
pub struct UnguardedCap;
impl Defect for UnguardedCap {
    type Of = AreaLight;
    fn pdf<R: Real>(right: &dyn LightSampler<R>, lanes: &[AreaLight], w: Vec3<R>) -> R {
        let (_, r): (_, R) = AreaLight::vectors(lanes);
        let squared = vectors::<R>(lanes)[0].length_squared();
        let cos = (one::<R>() - r * r / squared).greater(R::lit(0.0)).sqrt();
        let density = one::<R>() / (R::lit(TAU) * (one::<R>() - cos));
        let pdf = right.pdf(w);
        R::blend(squared.le(r * r), pdf, density).keep(pdf.gt(R::lit(0.0)))
    }
}

/// 2: Arvo's map sweeps u₀ times a solid angle computed as the excess of three angles; the pdf uses the one from an arc tangent.
#[derive(Clone, Copy, Debug)]
pub struct ExcessInSample;
impl Defect for ExcessInSample {
    type Of = AreaLight;
    fn sample<R: Real>(right: &dyn LightSampler<R>, lanes: &[AreaLight], u: Vec2<R>) -> LightSample<R> {
        let [v0, e1, e2] = vectors::<R>(lanes);
        let [a, b, c] = [v0, v0 + e1, v0 + e2].map(Vec3::normalize);
        let [ab, bc, ca] = [a.cross(b), b.cross(c), c.cross(a)].map(Vec3::normalize);
        let angles = [ab.dot(-ca), bc.dot(-ab), ca.dot(-bc)].map(R::acos);
        let excess = (angles[0] + angles[1] + angles[2] - R::lit(PI)).abs();
        let x = (u.x * excess * right.sample(u).pdf).clamped(R::lit(0.0), R::ONE_MINUS_EPSILON);
        right.sample(Vec2::new(x, u.y))
    }
}

/// 3: the square is warped by the cosines at the corners before a rectangle is sampled by solid angle (Hart et al. 2020). The pdf of a
/// sample includes the warp's factor; the evaluated pdf does not.
#[derive(Clone, Copy, Debug)]
pub struct CosineWarp;
impl Defect for CosineWarp {
    type Of = AreaLight;
    fn sample<R: Real>(right: &dyn LightSampler<R>, lanes: &[AreaLight], u: Vec2<R>) -> LightSample<R> {
        let ([_, _, _, _, n, ..], _) = AreaLight::vectors(lanes);
        let [v0, s, t] = vectors(lanes);
        let cosine = |corner: Vec3<R>| corner.normalize().dot(n).greater(R::lit(0.01));
        let warp = warp::Bilinear { corners: [v0, v0 + s, v0 + t, v0 + s + t].map(cosine) };
        let point = warp.sample(u);
        let sample = right.sample(point);
        LightSample { pdf: sample.pdf * warp.pdf(point), ..sample }
    }
}

/// A point that is uniform by area, relative to the viewpoint.
fn by_area<R: Real>([v0, e1, e2]: [Vec3<R>; 3], u: Vec2<R>) -> Vec3<R> {
    let b: Vec2<R> = warp::AreaTriangle.sample(u);
    v0 + e1 * b.x + e2 * b.y
}

/// 4: below 3e−4 sr the point is uniform by area, but the pdf is 1/Ω.
#[derive(Clone, Copy, Debug)]
pub struct AreaBetweenThresholds;
impl Defect for AreaBetweenThresholds {
    type Of = AreaLight;
    fn sample<R: Real>(right: &dyn LightSampler<R>, lanes: &[AreaLight], u: Vec2<R>) -> LightSample<R> {
        let drawn = right.sample(u);
        let small = drawn.pdf.gt(R::lit(1.0 / 3e-4));
        let direction = Vec3::blend(small, by_area(vectors(lanes), u).normalize(), drawn.direction);
        LightSample { direction, ..drawn }
    }
}

/// 5: the technique is chosen by the distance of the plane over |N|, although the distance was already divided by |N|. Both techniques are
/// correct.
#[derive(Clone, Copy, Debug)]
pub struct UnitsInTheSwitch;
impl UnitsInTheSwitch {
    fn far<R: Real>([v0, e1, e2]: [Vec3<R>; 3]) -> R::Mask {
        let n = e1.cross(e2);
        let distance = v0.dot(n.normalize()).abs() / n.length();
        distance.gt(R::lit(1e3))
    }
}
impl Defect for UnitsInTheSwitch {
    type Of = AreaLight;
    fn sample<R: Real>(right: &dyn LightSampler<R>, lanes: &[AreaLight], u: Vec2<R>) -> LightSample<R> {
        let (flat, drawn) = (vectors(lanes), right.sample(u));
        let direction = Vec3::blend(Self::far(flat), by_area(flat, u).normalize(), drawn.direction);
        LightSample { direction, ..drawn }
    }
    fn pdf<R: Real>(right: &dyn LightSampler<R>, lanes: &[AreaLight], w: Vec3<R>) -> R {
        let [v0, e1, e2] = vectors::<R>(lanes);
        let n = e1.cross(e2);
        let (height, cos) = (v0.dot(n), w.dot(n));
        let some = cos.abs().gt(R::lit(0.0));
        let distance = height / R::blend(some, cos, one());
        let by_area = distance * distance * R::lit(2.0) / R::blend(some, cos.abs(), one());
        let pdf = right.pdf(w);
        R::blend(Self::far([v0, e1, e2]), by_area.keep(some), pdf).keep(pdf.gt(R::lit(0.0)))
    }
}

/// 8: b/a and a/b, unguarded where both are 0.
#[derive(Clone, Copy, Debug)]
pub struct FlatCentre;
impl Defect for FlatCentre {
    type Of = ConcentricDisk;
    fn sample<R: Real>(right: &dyn LightSampler<R>, _: &[ConcentricDisk], u: Vec2<R>) -> LightSample<R> {
        let (a, b) = (u.x + u.x - one(), u.y + u.y - one());
        let first = a.abs().gt(b.abs());
        let (r, other) = (R::blend(first, a, b), R::blend(first, b, a));
        let (s, c) = (other / r * R::lit(0.125)).sin_cos_turns();
        turned(right, u, Vec3::new(R::blend(first, c, s) * r, R::blend(first, s, c) * r, R::lit(0.0)))
    }
}

/// 9: barycentric coordinates of the sampled direction are divided by their sum where that exceeds 1, but the sum for the second uses the
/// first after its division. The point then lies beyond the far edge.
#[derive(Clone, Copy, Debug)]
pub struct SelfClampingBarycentrics<const WRONG: bool>;
impl<const WRONG: bool> Defect for SelfClampingBarycentrics<WRONG> {
    type Of = AreaLight;
    fn sample<R: Real>(right: &dyn LightSampler<R>, lanes: &[AreaLight], u: Vec2<R>) -> LightSample<R> {
        let (zero, one) = (R::lit(0.0), one::<R>());
        let ([v0, e1, e2], drawn) = (vectors::<R>(lanes), right.sample(u));
        let w = drawn.direction;
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
        LightSample { distance: (v0 + e1 * c1 + e2 * c2).length(), ..drawn }
    }
}

/// 10: directions less than 1e−5 above the horizon are dropped.
#[derive(Clone, Copy, Debug)]
pub struct DroppedGrazing;
impl Defect for DroppedGrazing {
    type Of = CosineHemisphere;
    fn pdf<R: Real>(_: &dyn LightSampler<R>, _: &[CosineHemisphere], w: Vec3<R>) -> R {
        (w.z * R::lit(FRAC_1_PI)).keep(w.z.gt(R::lit(1e-5)))
    }
}

/// 11: 1e−4 is added to the divisor of a pdf by area, to keep it from being 0.
#[derive(Clone, Copy, Debug)]
pub struct PaddedDisk;
impl Defect for PaddedDisk {
    type Of = AreaLight;
    fn sample<R: Real>(right: &dyn LightSampler<R>, _: &[AreaLight], u: Vec2<R>) -> LightSample<R> {
        let drawn = right.sample(u);
        let squared = drawn.distance * drawn.distance;
        let some = drawn.pdf.gt(R::lit(0.0));
        let divisor = squared / R::blend(some, drawn.pdf, one()) + R::lit(1e-4);
        LightSample { pdf: (squared / divisor).keep(some), ..drawn }
    }
}

/// 12: the sine of a direction is computed from its cosine as √(1+z²).
#[derive(Clone, Copy, Debug)]
pub struct ConeOverflow;
impl Defect for ConeOverflow {
    type Of = Cone;
    fn sample<R: Real>(right: &dyn LightSampler<R>, lanes: &[Cone], u: Vec2<R>) -> LightSample<R> {
        let z = one::<R>() - u.x * lanes_of(|i| f64::from(lanes[i % lanes.len()].one_minus_cos));
        let sin = (one::<R>() + z * z).sqrt();
        let (s, c) = u.y.sin_cos_turns();
        turned(right, u, Vec3::new(sin * c, sin * s, z))
    }
}

/// 13: the pdf of a sphere is 1/Ω in every direction.
#[derive(Clone, Copy, Debug)]
pub struct NonZeroOffTheCone;
impl Defect for NonZeroOffTheCone {
    type Of = AreaLight;
    fn pdf<R: Real>(right: &dyn LightSampler<R>, _: &[AreaLight], _: Vec3<R>) -> R {
        right.sample(Vec2::lit([0.5; 2])).pdf
    }
}
