//! Lights at infinity: suns, and skies of constant radiance.

use super::sample::{FAR, LightSample};
use super::sampler::LightSampler;
use crate::lanewise::lanewise;
use crate::real::{Mask, Real};
use crate::vector::{Frame, Vec2, Vec3};
use crate::warp::{Cone, CosineHemisphere, UniformSphere, Warp};
use core::f64::consts::FRAC_1_PI;

/// A sample of what lies beyond the scene.
#[inline(always)]
pub(super) fn distant<R: Real>(direction: Vec3<R>, pdf: R, uv: Vec2<R>) -> LightSample<R> {
    let emits = R::Mask::splat(true);
    LightSample { distance: R::lit(FAR), pdf, uv, emits, ..LightSample::miss(direction) }
}

/// What a direction meets beyond the scene.
#[inline(always)]
pub(super) fn met<R: Real>(w: Vec3<R>, pdf: R, uv: Vec2<R>) -> LightSample<R> {
    let some = pdf.gt(R::lit(0.0));
    LightSample { distance: R::lit(FAR).keep(some), emits: some, ..distant(w, pdf, uv) }
}

lanewise! {
    /// A sun: constant radiance from the directions within an angle σ of one, the same for all points.
    ///
    /// Surface coordinates: those of the [`Cone`]: (1 − cosθ)/(1 − cosσ) from the centre, for limb darkening, and the azimuth in turns.
    pub struct Sun {
        /// Unit vector towards the centre of the sun.
        pub direction: Vec3<R>,
        /// 1 − cosσ, in [0, 2]: 1.09e−5 for the sun from the earth.
        pub one_minus_cos: R,
    }
}

impl<R: Real> Sun<R> {
    /// The sun about this unit direction, with σ given by 1 − cosσ in [0, 2].
    #[inline(always)]
    pub fn new(direction: Vec3<R>, one_minus_cos: R) -> Self {
        Self { direction, one_minus_cos }
    }
    /// Uniform over the cone: pdf 1/(2π(1−cosσ)) per steradian, 0 where the cone is empty.
    #[inline(always)]
    pub fn by_solid_angle(&self) -> SunBySolidAngle<R> {
        // nothing where the direction is no number
        let one_minus_cos = self.one_minus_cos.keep(self.direction.length_squared().ge(R::lit(0.0)));
        SunBySolidAngle { frame: Frame::new(self.direction), cone: Cone { one_minus_cos } }
    }
}

lanewise! {
    /// A [`Sun`] sampled by solid angle.
    pub struct SunBySolidAngle {
        frame: Frame<R>,
        cone: Cone<R>,
    }
}

impl<R: Real> SunBySolidAngle<R> {
    /// Solid angle in steradians, in [0, 4π].
    #[inline(always)]
    pub fn solid_angle(&self) -> R {
        self.cone.solid_angle()
    }
}

impl<R: Real> LightSampler<R> for SunBySolidAngle<R> {
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> LightSample<R> {
        distant(self.frame.to_world(self.cone.sample(u)), self.cone.uniform_pdf(), u).drawn_from(u)
    }
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        self.cone.pdf_in_frame(&self.frame, w)
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        self.cone.invert(self.frame.to_local(w))
    }
    #[inline(always)]
    fn hit(&self, w: Vec3<R>) -> LightSample<R> {
        met(w, self.pdf(w), self.invert(w))
    }
}

/// A sky with the same radiance in every direction. Surface coordinates: those of [`UniformSphere`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ConstantEnvironment;

impl ConstantEnvironment {
    /// Uniform over all directions, [`UniformSphere`]: pdf 1/(4π) per steradian. Half of the samples are below the horizon of any surface.
    #[inline(always)]
    pub fn by_solid_angle(&self) -> EnvironmentBySolidAngle {
        EnvironmentBySolidAngle
    }
    /// In proportion to the cosine to the unit normal `n`, [`CosineHemisphere`]: pdf cosθ/π per steradian above the horizon. On an
    /// unoccluded diffuse surface every sample has the same value.
    #[inline(always)]
    pub fn by_projected_solid_angle<R: Real>(&self, n: Vec3<R>) -> EnvironmentByProjectedSolidAngle<R> {
        EnvironmentByProjectedSolidAngle { frame: Frame::new(n) }
    }
}

/// A [`ConstantEnvironment`] sampled by solid angle.
#[derive(Clone, Copy, Debug, Default)]
pub struct EnvironmentBySolidAngle;

impl<R: Real> LightSampler<R> for EnvironmentBySolidAngle {
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> LightSample<R> {
        let direction: Vec3<R> = UniformSphere.sample(u);
        distant(direction, UniformSphere.pdf(direction), u).drawn_from(u)
    }
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        UniformSphere.pdf(w)
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        UniformSphere.invert(w)
    }
    #[inline(always)]
    fn hit(&self, w: Vec3<R>) -> LightSample<R> {
        met(w, UniformSphere.pdf(w), UniformSphere.invert(w))
    }
}

lanewise! {
    /// A [`ConstantEnvironment`] sampled by projected solid angle.
    pub struct EnvironmentByProjectedSolidAngle {
        frame: Frame<R>,
    }
}

impl<R: Real> LightSampler<R> for EnvironmentByProjectedSolidAngle<R> {
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> LightSample<R> {
        let local: Vec3<R> = CosineHemisphere.sample(u);
        let direction = self.frame.to_world(local);
        distant(direction, self.pdf(direction), UniformSphere.invert(direction))
    }
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        w.dot(self.frame.n).greater(R::lit(0.0)) * R::lit(FRAC_1_PI)
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        CosineHemisphere.invert(self.frame.to_local(w))
    }
    #[inline(always)]
    fn hit(&self, w: Vec3<R>) -> LightSample<R> {
        met(w, self.pdf(w), UniformSphere.invert(w))
    }
}
