//! Lights in one direction only. They have no density, so their `pdf` is what the estimator divides by: f·I·cosθ/pdf with the
//! intensity I (or the irradiance of a directional light) in the place of the radiance. It is no density and never part of MIS.

use super::{FAR, LightSample, direction_to};
use crate::lanewise::lanewise;
use crate::real::{Mask, Real};
use crate::spherical::DirectionSample;
use crate::vector::Vec3;

/// Square of a distance, where it is finite and not 0.
#[inline(always)]
fn inverse_square<R: Real>(distance: R) -> R {
    let squared = distance * distance;
    squared.keep(squared.lt(R::lit(1e37)))
}

lanewise! {
    /// A point that emits the same intensity in all directions.
    pub struct PointLight {
        /// Where.
        pub position: Vec3<R>,
    }
}

impl<R: Real> PointLight<R> {
    /// The one direction: with `pdf` = distance², f·I·cosθ/pdf is what arrives of the intensity I. At the point itself `pdf` is 0.
    #[inline(always)]
    pub fn sample(&self, p: Vec3<R>) -> LightSample<R> {
        let DirectionSample { direction, distance } = direction_to(self.position - p);
        let pdf = inverse_square(distance);
        LightSample { direction, distance, pdf, emits: pdf.gt(R::lit(0.0)), delta: R::Mask::splat(true) }
    }
}

lanewise! {
    /// A point that emits into a cone, with full intensity near its axis.
    pub struct SpotLight {
        /// Where.
        pub position: Vec3<R>,
        /// Unit vector along which the light travels.
        pub axis: Vec3<R>,
        /// Cosine of the angle up to which the intensity is full.
        pub cos_inner: R,
        /// Cosine of the angle from which it is 0; below `cos_inner`.
        pub cos_outer: R,
    }
}

impl<R: Real> SpotLight<R> {
    /// The intensity in the direction `w` away from the light, over that on the axis: t²(3−2t) with
    /// t = (cosθ − cosθₒ)/(cosθᵢ − cosθₒ), as in PBR 4th ed., 12.2.1; a step where the two cosines are equal.
    #[inline(always)]
    pub fn falloff(&self, w: Vec3<R>) -> R {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let cos = w.dot(self.axis);
        let width = self.cos_inner - self.cos_outer;
        let soft = width.gt(zero);
        let t = ((cos - self.cos_outer) / R::blend(soft, width, one)).clamped(zero, one);
        R::blend(soft, t * t * (R::lit(3.0) - (t + t)), one.keep(cos.ge(self.cos_inner)))
    }
    /// The one direction: with `pdf` = distance²/falloff, f·I·cosθ/pdf is what arrives of the intensity I on the axis. Outside the cone
    /// `emits` is false and `pdf` 0.
    #[inline(always)]
    pub fn sample(&self, p: Vec3<R>) -> LightSample<R> {
        let DirectionSample { direction, distance } = direction_to(self.position - p);
        let falloff = self.falloff(-direction);
        let some = falloff.gt(R::lit(0.0));
        let pdf = inverse_square(distance) / R::blend(some, falloff, R::lit(1.0));
        let pdf = pdf.keep(some & pdf.lt(R::lit(1e37)));
        LightSample { direction, distance, pdf, emits: pdf.gt(R::lit(0.0)), delta: R::Mask::splat(true) }
    }
}

lanewise! {
    /// Parallel light from far away.
    pub struct DirectionalLight {
        /// Unit vector towards the light.
        pub direction: Vec3<R>,
    }
}

impl<R: Real> DirectionalLight<R> {
    /// The one direction: with `pdf` = 1, f·E·cosθ/pdf is what arrives of the irradiance E on a receiver that faces the light.
    #[inline(always)]
    pub fn sample(&self) -> LightSample<R> {
        LightSample {
            direction: self.direction,
            distance: R::lit(FAR),
            pdf: R::lit(1.0),
            emits: R::Mask::splat(true),
            delta: R::Mask::splat(true),
        }
    }
}
