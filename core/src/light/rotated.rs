//! Skies in axes of their own.

use super::sample::LightSample;
use super::sampler::LightSampler;
use crate::real::Real;
use crate::vector::{Frame, Vec2, Vec3};

/// A light around the scene in axes of its own: an image of the sky where the scene has y up, for example, or one that the host turns.
///
/// A direction is rounded once more on its way into the scene. A sample has the pdf, per steradian, that [`pdf`](LightSampler::pdf) returns
/// for the rounded direction.
///
/// ```
/// use etendue::light::{EnvironmentMap, ImageEnvironment, Rotated};
/// use etendue::{Frame, LightSampler, Vec2};
/// let mut buffer = [0.0; ImageEnvironment::buffer(1, 2)];
/// // all light comes from the upper half of the image
/// let image = ImageEnvironment::build(&[1.0, 0.0], 1, EnvironmentMap::Equirectangular, &mut buffer).unwrap();
/// let y_up = Frame { s: [0.0, 0.0, 1.0].into(), t: [1.0, 0.0, 0.0].into(), n: [0.0, 1.0, 0.0_f32].into() };
/// let sky = Rotated { sampler: image.by_radiance(), frame: y_up };
/// let s = sky.sample(Vec2::new(0.3, 0.6));
/// assert!(s.direction.y > 0.0 && s.pdf == sky.pdf(s.direction));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Rotated<S, R> {
    /// The light in axes of its own.
    pub sampler: S,
    /// Its axes x, y and z in the scene: unit vectors at right angles.
    pub frame: Frame<R>,
}

impl<R: Real, S: LightSampler<R>> LightSampler<R> for Rotated<S, R> {
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> LightSample<R> {
        self.hit(self.frame.to_world(self.sampler.sample(u).direction))
    }
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        self.sampler.pdf(self.frame.to_local(w))
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        self.sampler.invert(self.frame.to_local(w))
    }
    #[inline(always)]
    fn hit(&self, w: Vec3<R>) -> LightSample<R> {
        let hit = self.sampler.hit(self.frame.to_local(w));
        LightSample { direction: w, normal: self.frame.to_world(hit.normal), ..hit }
    }
}
