//! What a light sampler returns.

use super::direction::DirectionSample;
use crate::math::rsqrt;
use crate::real::{Mask, Real};
use crate::vector::{Vec2, Vec3};

/// The distance to a light that is infinitely far away: the largest single-precision number.
pub const FAR: f64 = f32::MAX as f64;

/// Below this a pdf counts as 0: its reciprocal would not be finite in single precision.
const LEAST_PDF: f64 = 1e-37;

/// One sample of a light as seen from a shading point, or the point of a light that a ray hits.
///
/// The estimator of reflected radiance is `f · L · cosθ · weight()`, once a shadow ray along `direction` has reached `distance`.
/// [`weight`](Self::weight) is 0 in lanes that hold no sample, so these need no branch.
#[derive(Clone, Copy, Debug)]
pub struct LightSample<R: Real> {
    /// Unit direction from the shading point to the light.
    pub direction: Vec3<R>,
    /// Distance to the light along that direction, in the unit of the coordinates; [`FAR`] for lights at infinity.
    pub distance: R,
    /// Probability density of the direction, per steradian; 0 in lanes that hold no sample (a degenerate light, a point in the
    /// plane of a flat light, a ray that misses). Where `delta` holds it is only what the estimator divides by.
    pub pdf: R,
    /// Unit normal of the light at the sampled point; for lights without a surface, the direction back to the shading point. Not
    /// meaningful where `pdf` is 0.
    pub normal: Vec3<R>,
    /// Surface coordinates of the sampled point in [0, 1]², for textures; each shape documents its own. Not meaningful where `pdf` is 0.
    pub uv: Vec2<R>,
    /// True where the shading point is on the side of the light that emits, which is the side of the normal. `pdf` does not depend on
    /// it: a light that emits from both sides ignores it.
    pub emits: R::Mask,
    /// True where no other technique can hit the light ([`PointLight`](super::PointLight), [`SpotLight`](super::SpotLight),
    /// [`DirectionalLight`](super::DirectionalLight), [`Line`](super::Line)), so that its weight in multiple importance sampling is 1.
    pub delta: R::Mask,
}

/// A sample of a light with an image, and the texel that it comes from.
#[derive(Clone, Copy, Debug)]
pub struct TexelSample<R: Real> {
    /// Direction and density.
    pub light: LightSample<R>,
    /// Column of the texel.
    pub x: R::Uint,
    /// Row of the texel.
    pub y: R::Uint,
}

impl<R: Real> LightSample<R> {
    /// What a ray that misses the light gets: `pdf` 0 and `emits` false.
    #[inline(always)]
    pub fn miss(direction: Vec3<R>) -> Self {
        let (zero, none) = (R::lit(0.0), R::Mask::splat(false));
        let (normal, uv) = (-direction, Vec2::new(zero, zero));
        Self { direction, distance: zero, pdf: zero, normal, uv, emits: none, delta: none }
    }
    /// True where there is a sample and the light emits towards the shading point.
    #[inline(always)]
    pub fn valid(&self) -> R::Mask {
        self.emits & self.pdf.gt(R::lit(LEAST_PDF))
    }
    /// 1/pdf where the sample is [`valid`](Self::valid), 0 elsewhere: what an estimator multiplies by. Always finite.
    #[inline(always)]
    pub fn weight(&self) -> R {
        let valid = self.valid();
        (R::lit(1.0) / R::blend(valid, self.pdf, R::lit(1.0))).keep(valid)
    }
    /// The sample if `u`, from which it was drawn, consists of finite numbers; without them its pdf is 0.
    #[inline(always)]
    pub(super) fn drawn_from(self, u: Vec2<R>) -> Self {
        let zero = R::lit(0.0);
        // adds 0 or NaN, which `greater` turns into 0
        Self { pdf: ((u.x + u.y) * zero + self.pdf).greater(zero), ..self }
    }
    /// The same sample for a light that emits from both sides.
    #[inline(always)]
    #[must_use]
    pub fn two_sided(self) -> Self {
        Self { emits: R::Mask::splat(true), ..self }
    }
    /// The sample in lane `i`. Panics past the last lane.
    #[inline(always)]
    pub fn lane(&self, i: usize) -> LightSample<R::Scalar> {
        let truth = |mask: R::Mask| <<R::Scalar as Real>::Mask as Mask>::splat(mask.lane(i));
        LightSample {
            direction: self.direction.lane(i),
            distance: self.distance.lane(i),
            pdf: self.pdf.lane(i),
            normal: self.normal.lane(i),
            uv: self.uv.lane(i),
            emits: truth(self.emits),
            delta: truth(self.delta),
        }
    }
    /// Takes the lanes of `yes` where the mask is true, and those of `no` elsewhere: mixes lights of different shapes in one packet.
    #[inline(always)]
    pub fn blend(mask: R::Mask, yes: Self, no: Self) -> Self {
        let truth = |yes: R::Mask, no: R::Mask| (yes & mask) | (no & !mask);
        Self {
            direction: Vec3::blend(mask, yes.direction, no.direction),
            distance: R::blend(mask, yes.distance, no.distance),
            pdf: R::blend(mask, yes.pdf, no.pdf),
            normal: Vec3::blend(mask, yes.normal, no.normal),
            uv: Vec2::blend(mask, yes.uv, no.uv),
            emits: truth(yes.emits, no.emits),
            delta: truth(yes.delta, no.delta),
        }
    }
}

/// Pdf per steradian of a point that is uniform by area: distance²/(|cosθ'| area), given `along` = |cosθ'| area; 0 where that is not finite.
#[inline(always)]
pub(super) fn solid_angle_pdf<R: Real>(distance: R, along: R) -> R {
    // in this order, as the square of a short distance may underflow
    let pdf = distance * (distance / R::blend(along.gt(R::lit(0.0)), along, R::lit(1.0)));
    pdf.keep(along.gt(R::lit(0.0)) & pdf.lt(R::lit(1e37)) & distance.gt(R::lit(0.0)))
}

/// Direction and distance of a point relative to the shading point, at any scale; zeros where either exceeds the largest number.
#[inline(always)]
pub(super) fn direction_to<R: Real>(point: Vec3<R>) -> DirectionSample<R> {
    let (zero, infinity) = (R::lit(0.0), R::lit(f64::INFINITY));
    let reach = point.max_abs();
    let finite = reach.lt(infinity);
    let scale = reach.keep(finite).pow2_scale();
    let scaled = point.keep(finite) * scale;
    let squared = scaled.length_squared();
    let inverse = rsqrt(squared).keep(squared.gt(zero));
    let distance = squared * inverse / scale;
    DirectionSample { direction: scaled * inverse, distance: distance.keep(distance.lt(infinity)) }
}
