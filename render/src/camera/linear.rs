//! Vectors that are linear in the position in the image.

use crate::packet::{V8, X8};
use crate::scene::CameraSettings;
use etendue::Vec3;

/// A vector at the top left corner of the image, and its change per pixel across and down.
#[derive(Clone, Copy, Debug)]
pub(super) struct Linear {
    exact: [[f64; 3]; 3],
    /// The same, as rays use it.
    rounded: [[f32; 3]; 3],
}

impl Linear {
    /// The place s of [`CameraSettings`] plus `offset`, for an image of `width` × `height` pixels.
    pub(super) fn new(offset: [f64; 3], camera: &CameraSettings, width: u32, height: u32) -> Self {
        let [left, right, lower, upper] = camera.edges(width, height);
        let (r, u) = (camera.right, camera.up);
        let vector = |f: &dyn Fn(usize) -> f64| std::array::from_fn(f);
        Self::of([
            vector(&|k| offset[k] + left * r[k] + upper * u[k]),
            vector(&|k| (right - left) * r[k] / f64::from(width)),
            vector(&|k| (lower - upper) * u[k] / f64::from(height)),
        ])
    }
    fn of(exact: [[f64; 3]; 3]) -> Self {
        Self { exact, rounded: exact.map(|v| v.map(|x| x as f32)) }
    }
    /// The same, for positions that are counted from this pixel.
    #[must_use]
    pub(super) fn counted_from(&self, [x, y]: [u32; 2]) -> Self {
        let [corner, across, down] = self.exact;
        let start = |k: usize| corner[k] + across[k] * f64::from(x) + down[k] * f64::from(y);
        Self::of([std::array::from_fn(start), across, down])
    }
    /// The vector at positions in pixels.
    #[inline(always)]
    pub(super) fn at(&self, x: X8, y: X8) -> V8 {
        let [corner, across, down] = self.rounded.map(V8::from);
        down.mul_add(y, across.mul_add(x, corner))
    }
    /// The vector at the top left corner.
    pub(super) fn corner(&self) -> Vec3<f64> {
        self.exact[0].into()
    }
    /// What a vector is a sum of: multiples of the changes per pixel across and down, and of a third vector.
    pub(super) fn parts(&self, v: Vec3<f64>, third: Vec3<f64>) -> [f64; 3] {
        let [_, across, down] = self.exact.map(Vec3::<f64>::from);
        let part = |one: Vec3<f64>, a: Vec3<f64>, b: Vec3<f64>| v.dot(a.cross(b)) / one.dot(a.cross(b));
        [part(across, down, third), part(down, third, across), part(third, across, down)]
    }
    /// The vector at one position, from the rounded numbers.
    pub(super) fn at_one(&self, x: f64, y: f64) -> [f64; 3] {
        let [corner, across, down] = self.rounded.map(|v| v.map(f64::from));
        std::array::from_fn(|k| corner[k] + across[k] * x + down[k] * y)
    }
}
