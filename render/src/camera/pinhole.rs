//! The pinhole camera, in packets of eight rays.

use super::linear::Linear;
use crate::packet::{V8, X8};
use crate::scene::CameraSettings;
use etendue::Vec3;
use etendue_visible::Pyramid;

/// A pinhole camera for an image of a given size.
#[derive(Clone, Copy, Debug)]
pub struct Pinhole {
    origin: [f32; 3],
    directions: Linear,
}

impl Pinhole {
    /// The pinhole of `camera` for an image of `width` × `height` pixels.
    pub fn new(camera: &CameraSettings, width: u32, height: u32) -> Self {
        Self { origin: camera.origin.map(|x| x as f32), directions: Linear::new(camera.forward, camera, width, height) }
    }
    /// The same camera, for positions that are counted from this pixel.
    #[must_use]
    pub fn counted_from(&self, pixel: [u32; 2]) -> Self {
        Self { directions: self.directions.counted_from(pixel), ..*self }
    }
    /// The pyramid of the pixels in \[x0, x1\] × \[y0, y1\] of the image, from the top left, which is wider by an eighth of a pixel on each
    /// side, for the rounding of rays.
    pub fn pyramid(&self, [x0, y0, x1, y1]: [f64; 4]) -> Pyramid {
        let ([x0, y0], [x1, y1]) = ([x0, y0].map(|x| x - 0.125), [x1, y1].map(|x| x + 0.125));
        let corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)];
        let directions = corners.map(|(x, y)| self.directions.at_one(x, y).into());
        Pyramid::new(self.origin.map(f64::from).into(), directions)
    }
    /// See [`Camera::view_of`](super::Camera::view_of).
    pub(super) fn view_of(&self, p: Vec3<f64>) -> Option<([f64; 2], Vec3<f64>)> {
        let origin = Vec3::from(self.origin.map(f64::from));
        let [x, y, along] = self.directions.parts(p - origin, self.directions.corner());
        (along > 0.0).then(|| ([x / along, y / along], origin))
    }
    /// Origin and unit direction of the rays through positions in pixels from the top left.
    #[inline]
    pub fn ray(&self, x: X8, y: X8) -> (V8, V8) {
        let (origin, direction) = self.through(x, y);
        (origin, direction.normalize())
    }
    /// Like [`Pinhole::ray`], with directions whose component along the camera's axis is 1.
    #[inline]
    pub fn through(&self, x: X8, y: X8) -> (V8, V8) {
        (V8::from(self.origin), self.directions.at(x, y))
    }
}
