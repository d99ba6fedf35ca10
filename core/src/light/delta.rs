//! Lights that reach a point from one direction only.

use super::bound::{LightBound, narrow, wide};
use super::direction::DirectionSample;
use super::sample::{FAR, LightSample, direction_to};
use super::sampler::LightSampler;
use crate::lanewise::lanewise;
use crate::real::{Mask, Real};
use crate::vector::{Vec2, Vec3};
use core::f64::consts::PI;

/// distance², where that is finite and not 0.
#[inline(always)]
fn inverse_square<R: Real>(distance: R) -> R {
    let squared = distance * distance;
    squared.keep(squared.lt(R::lit(1e37)))
}

/// `pdf`/intensity, where that is finite; 0 where the intensity is 0.
#[inline(always)]
fn attenuated<R: Real>(pdf: R, intensity: R) -> R {
    let some = intensity.gt(R::lit(0.0));
    let pdf = pdf / R::blend(some, intensity, R::lit(1.0));
    pdf.keep(some & pdf.lt(R::lit(1e37)))
}

/// A delta light prepared for a shading point.
macro_rules! by_delta {
    ($(#[$doc:meta])+ $name:ident) => {
        lanewise! {
            $(#[$doc])+
            ///
            /// Every `u` gives the same sample, and no other technique hits the light: its weight in multiple importance sampling is 1. Its
            /// density is a delta distribution, so that [`pdf`](LightSampler::pdf) returns 0.
            pub struct $name {
                direction: Vec3<R>,
                distance: R,
                pdf: R,
            }
        }

        impl<R: Real> LightSampler<R> for $name<R> {
            #[inline(always)]
            fn sample(&self, _: Vec2<R>) -> LightSample<R> {
                let Self { direction, distance, pdf, .. } = *self;
                let (emits, delta) = (pdf.gt(R::lit(0.0)), R::Mask::splat(true));
                LightSample { distance, pdf, emits, delta, ..LightSample::miss(direction) }
            }
            #[inline(always)]
            fn pdf(&self, _: Vec3<R>) -> R {
                R::lit(0.0)
            }
            #[inline(always)]
            fn invert(&self, _: Vec3<R>) -> Vec2<R> {
                Vec2::lit([0.0, 0.0])
            }
            #[inline(always)]
            fn hit(&self, w: Vec3<R>) -> LightSample<R> {
                LightSample::miss(w)
            }
        }
    };
}
by_delta! {
    /// A [`PointLight`] prepared for a shading point; its samples have pdf distance², which is no density.
    PointLightByDelta
}
by_delta! {
    /// A [`SpotLight`] prepared for a shading point; its samples have pdf distance²/falloff, which is no density.
    SpotLightByDelta
}
by_delta! {
    /// A [`DirectionalLight`]; its samples have pdf 1, which is no density.
    DirectionalLightByDelta
}

lanewise! {
    /// A point light that emits the same intensity in all directions.
    ///
    /// The estimator is `f · I · cosθ · weight()` with the intensity I in the place of the radiance, and weight 1 in multiple importance
    /// sampling. A shading point on the light gives pdf 0.
    pub struct PointLight {
        /// Position, in the coordinates of the scene.
        pub position: Vec3<R>,
    }
}

impl<R: Real> PointLight<R> {
    /// The point light at this position.
    #[inline(always)]
    pub fn new(position: Vec3<R>) -> Self {
        Self { position }
    }
    /// Prepared for the shading point `p`. `pdf` is distance², which is no density: it makes f·I·cosθ/pdf what arrives.
    #[inline(always)]
    pub fn by_delta(&self, p: Vec3<R>) -> PointLightByDelta<R> {
        let DirectionSample { direction, distance } = direction_to(self.position - p);
        PointLightByDelta { direction, distance, pdf: inverse_square(distance) }
    }
}

impl<R: Real<Scalar = R>> PointLight<R> {
    /// What it can contribute with this intensity. One that is not positive gives the power 0.
    #[must_use]
    pub fn bound(&self, intensity: R) -> LightBound {
        LightBound::about(wide(self.position), 0.0, 4.0 * PI * intensity.lane_f64(0))
    }
}

lanewise! {
    /// A point light that emits into a cone, with full intensity near its axis.
    ///
    /// The estimator is that of the [`PointLight`], with the intensity on the axis. Outside the cone `emits` is false and `pdf` 0.
    pub struct SpotLight {
        /// Position, in the coordinates of the scene.
        pub position: Vec3<R>,
        /// Unit vector along which the light travels.
        pub axis: Vec3<R>,
        /// 1 − cosθᵢ of the angle up to which the intensity is full, in [0, 2]: of narrow cones, a cosine would have few digits.
        pub one_minus_cos_inner: R,
        /// 1 − cosθₒ of the angle from which it is 0, in [0, 2]; at least `one_minus_cos_inner`.
        pub one_minus_cos_outer: R,
    }
}

impl<R: Real> SpotLight<R> {
    /// The spot light at this position, along this unit vector, with 1 − cosθ of its inner and of its outer angle.
    #[inline(always)]
    pub fn new(position: Vec3<R>, axis: Vec3<R>, [one_minus_cos_inner, one_minus_cos_outer]: [R; 2]) -> Self {
        Self { position, axis, one_minus_cos_inner, one_minus_cos_outer }
    }
    /// The intensity in the unit direction `w` away from the light, over that on the axis: t²(3−2t) with
    /// t = (cosθ − cosθₒ)/(cosθᵢ − cosθₒ), as in PBR 4th ed., 12.2.1; a step where the two angles are equal.
    #[inline(always)]
    pub fn falloff(&self, w: Vec3<R>) -> R {
        // 1 − cosθ of two unit vectors
        self.falloff_at((w - self.axis).length_squared() * R::lit(0.5))
    }
    /// The same, given 1 − cosθ of the angle to the axis.
    #[inline(always)]
    pub fn falloff_at(&self, one_minus_cos: R) -> R {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let width = self.one_minus_cos_outer - self.one_minus_cos_inner;
        let soft = width.gt(zero);
        let t = ((self.one_minus_cos_outer - one_minus_cos) / R::blend(soft, width, one)).clamped(zero, one);
        R::blend(soft, t * t * (R::lit(3.0) - (t + t)), one.keep(one_minus_cos.le(self.one_minus_cos_inner)))
    }
    /// Prepared for the shading point `p`. `pdf` is distance²/falloff, which is no density: it makes f·I·cosθ/pdf what arrives.
    #[inline(always)]
    pub fn by_delta(&self, p: Vec3<R>) -> SpotLightByDelta<R> {
        let DirectionSample { direction, distance } = direction_to(self.position - p);
        let pdf = attenuated(inverse_square(distance), self.falloff(-direction));
        SpotLightByDelta { direction, distance, pdf }
    }
}

/// The cosine of the narrowest cone that a tree tells from its axis. A narrower light counts as if it filled this cone: as bright as on its
/// axis, it would take the samples of all points around its cone, which it does not light.
const NARROWEST: f32 = 253.0 / 254.0;

impl<R: Real<Scalar = R>> SpotLight<R> {
    /// What it can contribute with this intensity on its axis. A cone of less than 5° counts as one of 5°.
    #[must_use]
    pub fn bound(&self, intensity: R) -> LightBound {
        let [inner, outer] = [self.one_minus_cos_inner, self.one_minus_cos_outer].map(|x| x.lane_f64(0));
        // the falloff is half on average, and a cone too narrow for numbers still has a chance
        let flux = (inner + outer).greater(1e-30) * PI * intensity.lane_f64(0);
        let cos = ((1.0 - outer) as f32).next_down();
        // beyond a hemisphere, a cone bounds nothing
        let axis = if cos > 0.0 { wide(self.axis).unit_and_length().0 } else { Vec3::default() };
        let cos_cone = cos.clamped(0.0, NARROWEST);
        LightBound { normal: narrow(axis), cos_cone, ..LightBound::about(wide(self.position), 0.0, flux) }
    }
}

lanewise! {
    /// Parallel light from infinitely far away.
    ///
    /// The estimator is `f · E · cosθ · weight()` with the irradiance E on a receiver that faces the light in the place of the radiance.
    pub struct DirectionalLight {
        /// Unit vector towards the light.
        pub direction: Vec3<R>,
    }
}

impl<R: Real> DirectionalLight<R> {
    /// The light from this unit direction.
    #[inline(always)]
    pub fn new(direction: Vec3<R>) -> Self {
        Self { direction }
    }
    /// Prepared for any shading point: all have the same samples. `pdf` is 1, or 0 where the direction is none.
    #[inline(always)]
    pub fn by_delta(&self) -> DirectionalLightByDelta<R> {
        let is_direction = self.direction.is_within(R::lit(f64::INFINITY));
        let (distance, pdf) = (R::lit(FAR), R::lit(1.0).keep(is_direction));
        DirectionalLightByDelta { direction: self.direction, distance, pdf }
    }
}
