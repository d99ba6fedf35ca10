//! The pinhole camera, in packets of eight rays.

use crate::packet::{V8, X8};
use crate::scene;

/// A pinhole camera for an image of a given size.
#[derive(Clone, Copy, Debug)]
pub struct Pinhole {
    origin: [f32; 3],
    /// Direction at the top left corner, and its change per pixel across and down the image.
    corner: [f32; 3],
    across: [f32; 3],
    down: [f32; 3],
}

impl Pinhole {
    /// The pinhole of `camera` for an image of `width` × `height` pixels.
    pub fn new(camera: &scene::CameraSettings, width: u32, height: u32) -> Self {
        let [kx, ky] = camera.tan_half(width, height);
        let (f, r, u) = (camera.forward, camera.right, camera.up);
        let vector = |f: &dyn Fn(usize) -> f64| std::array::from_fn(|k| f(k) as f32);
        Self {
            origin: vector(&|k| camera.origin[k]),
            corner: vector(&|k| f[k] - kx * r[k] + ky * u[k]),
            across: vector(&|k| 2.0 * kx * r[k] / f64::from(width)),
            down: vector(&|k| -2.0 * ky * u[k] / f64::from(height)),
        }
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
        let direction = V8::from(self.down).mul_add(y, V8::from(self.across).mul_add(x, V8::from(self.corner)));
        (V8::from(self.origin), direction)
    }
}
