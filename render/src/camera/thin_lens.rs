//! A camera with a thin lens.

use super::pinhole::Pinhole;
use crate::packet::{V8, X8};
use crate::scene::{CameraSettings, Lens};
use etendue::{Real, Vec2, Vec3};

/// A thin-lens camera for an image of a given size.
///
/// A ray leaves from a point ℓ of the lens, uniform over its disk, towards the point where the ray d from the lens's centre (whose
/// component along the axis is 1) meets the plane of focus at distance f. Its direction is that of d − ℓ/f.
#[derive(Clone, Copy, Debug)]
pub struct ThinLens {
    center: Pinhole,
    /// Radii to the right and upwards, in world space.
    radii: [[f32; 3]; 2],
    /// The same radii over the distance of the plane of focus.
    bends: [[f32; 3]; 2],
}

impl ThinLens {
    /// The lens camera for an image of `width` × `height` pixels.
    pub fn new(camera: &CameraSettings, lens: &Lens, width: u32, height: u32) -> Self {
        let along = |length: f64| [camera.right, camera.up].map(|axis| axis.map(|x| (x * length) as f32));
        Self {
            center: Pinhole::new(camera, width, height),
            radii: along(lens.radius * lens.unit),
            bends: along(lens.radius / lens.focus),
        }
    }
    /// The same camera, for positions that are counted from this pixel.
    #[must_use]
    pub fn counted_from(&self, pixel: [u32; 2]) -> Self {
        Self { center: self.center.counted_from(pixel), ..*self }
    }
    /// See [`Camera::view_of`](super::Camera::view_of).
    pub(super) fn view_of(&self, p: Vec3<f64>) -> Option<([f64; 2], Vec3<f64>)> {
        self.center.view_of(p)
    }
    /// Origin and unit direction of the rays through positions in pixels from the top left and points of the lens in units of its
    /// radius.
    #[inline]
    pub fn ray(&self, x: X8, y: X8, lens: Vec2<X8>) -> (V8, V8) {
        let at = |[right, up]: [[f32; 3]; 2]| V8::from(up).mul_add(lens.y, V8::from(right) * lens.x);
        let (origin, direction) = self.center.through(x, y);
        (origin + at(self.radii), (direction - at(self.bends)).normalize())
    }
}

/// Slopes of the rays through the lens's centre: their steps to the right and upwards per unit along the axis.
#[derive(Clone, Copy, Debug)]
pub struct Slopes {
    /// Slope at the top left corner, and its change for a pixel to the right and for one down.
    corner: [f64; 2],
    step: [f64; 2],
}

impl Slopes {
    /// The slopes for an image of `width` × `height` pixels.
    pub fn new(camera: &CameraSettings, width: u32, height: u32) -> Self {
        let [left, right, lower, upper] = camera.edges(width, height);
        let step = [(right - left) / f64::from(width), (lower - upper) / f64::from(height)];
        Self { corner: [left, upper], step }
    }
    /// The same slopes, for positions that are counted from this pixel.
    #[must_use]
    pub fn counted_from(&self, pixel: [u32; 2]) -> Self {
        Self { corner: std::array::from_fn(|k| self.corner[k] + self.step[k] * f64::from(pixel[k])), ..*self }
    }
    /// Slopes at positions in pixels from the top left.
    #[inline]
    pub fn at(&self, x: X8, y: X8) -> Vec2<X8> {
        let slope = |k: usize, place: X8| X8::lit(self.step[k]).mul_add(place, X8::lit(self.corner[k]));
        Vec2::new(slope(0, x), slope(1, y))
    }
}
