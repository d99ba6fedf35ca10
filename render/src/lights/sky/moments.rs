//! What a sky without portals gives to a surface, by its normal.

use crate::packet::{V8, X8};
use etendue::{Real, Vec2};
use rayon::prelude::*;

/// The moments of a radiance L over all directions w: ∫L dω, ∫L w dω and ∫L wwᵀ dω.
///
/// They give the irradiance ∫L max(0, w·n) dω for all normals n, since max(0, t) is nearly 3/32 + t/2 + 15t²/32, which is the series of
/// Legendre polynomials up to the second (Ramamoorthi and Hanrahan, "An Efficient Representation for Irradiance Environment Maps", SIGGRAPH
/// 2001). The polynomial is within 3/32 of max(0, t) for t in [−1, 1].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Moments {
    flux: f64,
    mean: [f64; 3],
    /// xx, yy, zz, xy, xz, yz.
    squares: [f64; 6],
}

/// Each texel is looked at in so many places along its edges that there are this many rows of places.
const ROWS: usize = 64;

impl Moments {
    /// The moments of an image of this many columns and rows. `look` returns the directions, and the radiance times the solid angle, of eight
    /// columns of a row at once, at a position within their texels. The last of the eight columns may be beyond the image.
    pub(super) fn of_image(
        [width, height]: [usize; 2],
        look: impl Fn(usize, usize, Vec2<X8>) -> (V8, X8) + Sync,
    ) -> Self {
        let places = ROWS.div_ceil(height).max(1);
        let middle = |k: usize| X8::lit((k as f64 + 0.5) / places as f64);
        let row = |y: usize| {
            let mut sum = Self::default();
            for place in 0..places * places {
                let offset = Vec2::new(middle(place % places), middle(place / places));
                for first in (0..width).step_by(8) {
                    let (w, worth) = look(first, y, offset);
                    for lane in 0..8.min(width - first) {
                        sum.add(w.map(|x| x.lane_f64(lane)).into(), worth.lane_f64(lane) / (places * places) as f64);
                    }
                }
            }
            sum
        };
        // in the order of the rows, so that the sum does not depend on the threads
        let rows: Vec<Self> = (0..height).into_par_iter().map(row).collect();
        rows.iter().fold(Self::default(), |sum, row| sum.plus(row))
    }
    /// The moments of a constant radiance with this ∫L dω.
    pub(super) fn constant(flux: f64) -> Self {
        let third = flux / 3.0;
        Self { flux, squares: [third, third, third, 0.0, 0.0, 0.0], ..Self::default() }
    }
    fn add(&mut self, [x, y, z]: [f64; 3], worth: f64) {
        let squares = [x * x, y * y, z * z, x * y, x * z, y * z].map(|s| s * worth);
        *self = self.plus(&Self { flux: worth, mean: [x, y, z].map(|m| m * worth), squares });
    }
    fn plus(&self, other: &Self) -> Self {
        Self {
            flux: self.flux + other.flux,
            mean: std::array::from_fn(|k| self.mean[k] + other.mean[k]),
            squares: std::array::from_fn(|k| self.squares[k] + other.squares[k]),
        }
    }
    /// An estimate of the irradiance of surfaces with this unit normal, in the unit of the radiance times steradian. It is at least ⅛ of the mean
    /// over all normals, so that it stays positive.
    #[inline]
    pub(super) fn irradiance(&self, n: V8) -> X8 {
        let lit = X8::lit;
        let [xx, yy, zz, xy, xz, yz] = self.squares.map(lit);
        let squared = n.x * n.x * xx
            + n.y * n.y * yy
            + n.z * n.z * zz
            + lit(2.0) * (n.x * n.y * xy + n.x * n.z * xz + n.y * n.z * yz);
        let linear = n.dot(V8::lit(self.mean));
        let sum = lit(3.0 / 32.0 * self.flux) + lit(0.5) * linear + lit(15.0 / 32.0) * squared;
        sum.greater(lit(self.flux / 32.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The irradiance is right for a constant radiance, and within 0.03 π for the radiance max(0, w·a), whose irradiance has a closed form. Images
    /// of 1 to 20,000 texels agree.
    #[test]
    fn the_irradiance_is_that_of_the_radiance() {
        use std::f64::consts::PI;
        let one = Moments::constant(4.0 * PI);
        assert!((one.irradiance(V8::lit([0.0, 0.6, 0.8])).lane_f64(3) / PI - 1.0).abs() < 1e-6);
        for [width, height] in [[1, 1], [3, 2], [64, 32], [200, 100]] {
            let solid_angle = 4.0 * PI / (width * height) as f64;
            // columns by azimuth, rows by height: uniform by solid angle
            let look = |first: usize, y: usize, offset: Vec2<X8>| {
                let lane = |lane: usize| {
                    let x = ((first + lane) as f64 + offset.x.lane_f64(lane)) / width as f64 * 2.0 * PI;
                    let z = 1.0 - 2.0 * (y as f64 + offset.y.lane_f64(lane)) / height as f64;
                    let r = (1.0 - z * z).max(0.0).sqrt();
                    [r * x.cos(), r * x.sin(), z].map(|x| x as f32)
                };
                let w = V8::new(X8::from_fn(|k| lane(k)[0]), X8::from_fn(|k| lane(k)[1]), X8::from_fn(|k| lane(k)[2]));
                (w, w.z.greater(X8::lit(0.0)) * X8::lit(solid_angle))
            };
            let moments = Moments::of_image([width, height], look);
            for tenth in -10..=10_i32 {
                let cos = f64::from(tenth) / 10.0;
                let sin = (1.0 - cos * cos).sqrt();
                let found = moments.irradiance(V8::lit([0.6 * sin, -0.8 * sin, cos])).lane_f64(0);
                // ∫ max(0, w·a) max(0, w·n) dω for the angle θ between a and n
                let exact = 2.0 / 3.0 * (sin + (PI - cos.acos()) * cos);
                let least = moments.flux / 32.0;
                assert!((found - exact.max(least)).abs() < 0.03 * PI, "{width}: {cos}: {found} {exact}");
            }
        }
    }
}
