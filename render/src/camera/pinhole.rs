//! The pinhole camera, in packets of eight rays.

use crate::packet::{V8, X8};
use crate::scene;
use etendue::Vec3;

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
    /// The pinhole, and the directions through the corners of a rectangle [x0, y0, x1, y1] in pixels, in order around.
    pub fn rectangle(&self, [x0, y0, x1, y1]: [f64; 4]) -> ([f64; 3], [[f64; 3]; 4]) {
        let wide = |v: [f32; 3]| v.map(f64::from);
        let (corner, across, down) = (wide(self.corner), wide(self.across), wide(self.down));
        let through = |x: f64, y: f64| std::array::from_fn(|k| corner[k] + across[k] * x + down[k] * y);
        (wide(self.origin), [through(x0, y0), through(x1, y0), through(x1, y1), through(x0, y1)])
    }
    /// Where the ray passes the film that leaves the pinhole along a vector of any length, in pixels from the top left; `None` behind it.
    pub fn film_of(&self, v: Vec3<f64>) -> Option<[f64; 2]> {
        let [corner, across, down] = [self.corner, self.across, self.down].map(|v| Vec3::<f64>::from(v.map(f64::from)));
        // v = t (corner + x across + y down)
        let t = v.dot(across.cross(down)) / corner.dot(across.cross(down));
        let along = |axis: Vec3<f64>, normal: Vec3<f64>| v.dot(normal) / (axis.dot(normal) * t);
        (t > 0.0).then(|| [along(across, down.cross(corner)), along(down, corner.cross(across))])
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
