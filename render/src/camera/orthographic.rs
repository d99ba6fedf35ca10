//! The orthographic camera, in packets of eight rays.

use super::linear::Linear;
use crate::packet::{V8, X8};
use crate::scene::CameraSettings;
use etendue::Vec3;

/// An orthographic camera for an image of a given size: parallel rays from a plane.
#[derive(Clone, Copy, Debug)]
pub struct Orthographic {
    direction: [f32; 3],
    origins: Linear,
}

impl Orthographic {
    /// The parallel rays of `camera` for an image of `width` × `height` pixels.
    pub fn new(camera: &CameraSettings, width: u32, height: u32) -> Self {
        Self { direction: camera.forward.map(|x| x as f32), origins: Linear::new(camera.origin, camera, width, height) }
    }
    /// The same camera, for positions that are counted from this pixel.
    #[must_use]
    pub fn counted_from(&self, pixel: [u32; 2]) -> Self {
        Self { origins: self.origins.counted_from(pixel), ..*self }
    }
    /// See [`Camera::view_of`](super::Camera::view_of).
    pub(super) fn view_of(&self, p: Vec3<f64>) -> Option<([f64; 2], Vec3<f64>)> {
        let direction = Vec3::from(self.direction.map(f64::from));
        let [x, y, along] = self.origins.parts(p - self.origins.corner(), direction);
        (along > 0.0).then(|| ([x, y], p - direction * along))
    }
    /// Origin and unit direction of the rays through positions in pixels from the top left.
    #[inline]
    pub fn ray(&self, x: X8, y: X8) -> (V8, V8) {
        (self.origins.at(x, y), V8::from(self.direction))
    }
}
