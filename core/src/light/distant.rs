use super::{FAR, LightSample};
use crate::lanewise::lanewise;
use crate::real::{Mask, Real};
use crate::vector::{Frame, Vec2, Vec3};
use crate::warp::{Cone, CosineHemisphere, UniformSphere, Warp};

/// A sample of what lies beyond the scene.
#[inline(always)]
pub(super) fn distant<R: Real>(direction: Vec3<R>, pdf: R) -> LightSample<R> {
    LightSample { direction, distance: R::lit(FAR), pdf, emits: R::Mask::splat(true), delta: R::Mask::splat(false) }
}

lanewise! {
    /// A sun: constant radiance from the directions within an angle σ of one, [`Cone`], at the same place for all points.
    pub struct Sun {
        /// Unit vector towards its centre.
        pub direction: Vec3<R>,
        /// 1 − cosσ, in [0, 2]: 1.09e−5 for the sun from the earth.
        pub one_minus_cos: R,
    }
}

impl<R: Real> Sun<R> {
    /// Uniform over the cone: pdf 1/(2π(1−cosσ)), 0 where that is empty.
    #[inline(always)]
    pub fn by_solid_angle(&self, u: Vec2<R>) -> LightSample<R> {
        let cone = Cone { one_minus_cos: self.one_minus_cos };
        distant(Frame::new(self.direction).to_world(cone.sample(u)), cone.uniform_pdf())
    }
    /// The density of [`by_solid_angle`](Self::by_solid_angle) in the direction `w`: 0 off the cone.
    #[inline(always)]
    pub fn pdf(&self, w: Vec3<R>) -> R {
        Cone { one_minus_cos: self.one_minus_cos }.pdf(Frame::new(self.direction).to_local(w))
    }
    /// The `u` of a direction.
    #[inline(always)]
    pub fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        Cone { one_minus_cos: self.one_minus_cos }.invert(Frame::new(self.direction).to_local(w))
    }
}

/// The same radiance from every direction.
#[derive(Clone, Copy, Debug, Default)]
pub struct ConstantEnvironment;

impl ConstantEnvironment {
    /// Uniform over all directions, [`UniformSphere`]: half of them are below the horizon of any surface.
    #[inline(always)]
    pub fn by_solid_angle<R: Real>(&self, u: Vec2<R>) -> LightSample<R> {
        let direction: Vec3<R> = UniformSphere.sample(u);
        distant(direction, UniformSphere.pdf(direction))
    }
    /// In proportion to the cosine to the unit normal `n`, [`CosineHemisphere`]: of an open sky on a diffuse surface each sample is worth the
    /// same.
    #[inline(always)]
    pub fn by_projected_solid_angle<R: Real>(&self, n: Vec3<R>, u: Vec2<R>) -> LightSample<R> {
        let local: Vec3<R> = CosineHemisphere.sample(u);
        distant(Frame::new(n).to_world(local), CosineHemisphere.pdf(local))
    }
}
