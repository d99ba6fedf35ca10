//! Directions to a sphere.

use super::{Quantity, direction, length, limit, outputs, pair, relative};
use crate::search::{Range, Statement, Theorem};
use crate::traced::Traced;
use core::f64::consts::TAU;
use etendue::light::parts::{SphericalCap, SphericalShape};
use etendue::warp::Warp;
use etendue::{Real, Vec3};

/// Spheres whose centre is farthest along one axis.
pub(super) struct Sphere {
    pub(super) axis: usize,
    pub(super) sign: f32,
    pub(super) radii: [f32; 2],
    pub(super) quantity: Quantity,
}
impl Sphere {
    /// The centre from its coordinates, the greatest first.
    fn turned<T: Copy>(&self, c: [T; 3]) -> [T; 3] {
        core::array::from_fn(|i| c[(i + 3 - self.axis) % 3])
    }
    fn outputs<R: Real>(&self, x: &[R]) -> Vec<R> {
        let cap = self.cap(x);
        direction(cap.sample(pair(x))).into_iter().chain([cap.uniform_pdf()]).collect()
    }
    fn cap<R: Real>(&self, x: &[R]) -> SphericalCap<R> {
        let [a, b, c] = self.turned([x[2], x[3], x[4]]);
        SphericalCap::new(Vec3::new(a, b, c), x[5])
    }
}
impl Theorem for Sphere {
    outputs!();
    fn statement(&self) -> Statement {
        let sign = if self.sign > 0.0 { '+' } else { '−' };
        let first = if self.sign > 0.0 { Range::Linear(1.0, 2.0) } else { Range::Linear(-2.0, -1.0) };
        let other = Range::Linear(-2.0, 2.0);
        // the pdf of a sample does not depend on u
        let u = if self.quantity == Quantity::Pdf { Range::Steps(0, 0) } else { Range::UNIT };
        Statement {
            name: "SphericalCap",
            domain: format!(
                "all 2⁴⁸ pairs u, centres whose {sign}{} is in [1, 2] and whose other coordinates are in [−2, 2], radii from {} to {} (and these \
             lengths times any power of two)",
                ["x", "y", "z"][self.axis],
                self.radii[0],
                self.radii[1]
            ),
            ranges: vec![u, u, first, other, other, Range::Logarithmic(self.radii[0], self.radii[1])],
            limits: if self.quantity == Quantity::Pdf {
                vec![limit("relative error of the pdf", 2e-6)]
            } else {
                vec![limit("error of the direction, in radians", 1.5e-6)]
            },
        }
    }
    fn bounds(&self, x: &[Traced]) -> Vec<f64> {
        let cap = self.cap(x);
        if self.quantity == Quantity::Pdf {
            return vec![relative(cap.uniform_pdf())];
        }
        let w = cap.sample(pair(x));
        vec![length(&[w.x, w.y, w.z])]
    }
    fn definition(&self, x: &[Traced], values: &[f64]) -> Vec<[f64; 3]> {
        let cap = self.cap(x);
        let w = cap.sample(pair(x));
        let c = self.turned([values[2], values[3], values[4]]);
        let squared = c.iter().map(|c| c * c).sum::<f64>();
        let [nx, ny, nz] = c.map(|c| c / squared.sqrt());
        let sin_squared = values[5] * values[5] / squared;
        let h = sin_squared / (1.0 + (1.0 - sin_squared).sqrt());
        let (k, angle) = (values[0] * h, TAU * values[1]);
        let sin = (k * (2.0 - k)).sqrt();
        let (lx, ly, lz) = (sin * angle.cos(), sin * angle.sin(), 1.0 - k);
        // the frame of Duff et al. 2017
        let sign = 1.0_f64.copysign(nz);
        let (a, b) = (-1.0 / (sign + nz), -nx * ny / (sign + nz));
        let s = [1.0 + sign * nx * nx * a, sign * b, -sign * nx];
        let t = [b, sign + ny * ny * a, -ny];
        let world = |i: usize| s[i] * lx + t[i] * ly + [nx, ny, nz][i] * lz;
        let pdf = cap.uniform_pdf();
        vec![
            [w.x.exact(), world(0), 1.0],
            [w.y.exact(), world(1), 1.0],
            [w.z.exact(), world(2), 1.0],
            [pdf.exact(), 1.0 / (TAU * h), 1.0 / (TAU * h)],
        ]
    }
}
