//! Shapes by solid angle, warped towards a normal.

use super::{Rectangle, Triangle};
use crate::domain::Random;
use crate::laws::{Coordinates, Subject, vectors_of};
use crate::oracle::V3;
use crate::tolerances::{Tolerance, ULP};
use core::fmt::Debug;
use etendue::seen::{CosineWarped, SphericalRectangle, SphericalTriangle};
use etendue::warp::Bilinear;
use etendue::{Real, Vec3, Warp};

macro_rules! warped {
    ($name:ident, $shape:ident, $seen:ident) => {
        #[doc = concat!("`seen::CosineWarped` over `", stringify!($seen), "`.")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name {
            /// What is warped.
            pub shape: $shape,
            /// Of the surface, a unit vector.
            pub normal: [f32; 3],
        }
        impl $name {
            /// The weights of the square by the formula, in double precision; the shape's own inverse has laws of its own.
            fn weight(&self, point: V3) -> (f64, f64) {
                let warp = Self::prepare::<f64>(&[*self]);
                let [x, y, _] = warp.shape.invert(Vec3::gather(&[point])).at(0);
                let [a, b, c, d] = warp.weights.corners;
                let value = (a * (1.0 - x) + b * x) * (1.0 - y) + (c * (1.0 - x) + d * x) * y;
                let spread = a.max(b).max(c.max(d)) - a.min(b).min(c.min(d));
                (4.0 * value / (a + b + c + d), 4.0 * spread / (a + b + c + d))
            }
        }
        impl Subject for $name {
            type Warp<R: Real> = CosineWarped<$seen<R>, R>;
            type Point<R: Real> = Vec3<R>;
            fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
                let shapes: Vec<_> = lanes.iter().map(|l| l.shape).collect();
                CosineWarped::new($shape::prepare(&shapes), vectors_of(|i| lanes[i % lanes.len()].normal))
            }
            fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
                CosineWarped { shape: $seen::splat(warp.shape), weights: Bilinear::splat(warp.weights) }
            }
            fn kin(&self, other: &Self) -> bool {
                self.shape.kin(&other.shape)
            }
            /// Of the bilinear map and its density, besides the shape's. The weights move as the corners do.
            fn tolerance(&self) -> Tolerance {
                let inner = self.shape.tolerance();
                Tolerance { steps: inner.steps + 16.0, density: inner.density + 8.0, ..inner }
            }
            fn scaled(&self, factor: f32) -> Self {
                Self { shape: self.shape.scaled(factor), ..*self }
            }
            fn density(&self, point: V3) -> f64 {
                self.shape.density(point) * self.weight(point).0
            }
            fn chart(&self, s: f64, t: f64) -> (V3, f64) {
                self.shape.chart(s, t)
            }
            fn locate(&self, point: V3) -> [f64; 2] {
                self.shape.locate(point)
            }
            fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
                self.shape.outside(margin, random)
            }
            fn extent(&self) -> [f64; 2] {
                self.shape.extent()
            }
            fn granularity(&self) -> f64 {
                self.shape.granularity()
            }
            fn condition(&self) -> f64 {
                self.shape.condition()
            }
            /// An error of the inverse, a direction's rounding over the extent, moves the density along the bilinear one.
            fn density_slack(&self, point: V3) -> f64 {
                // fuzzing has seen 4.3 times what the inverse and the weights are known to, of a triangle that fills half of the directions
                let known =
                    6.0 * (self.shape.tolerance().round_trip * self.shape.granularity() / self.extent()[1] + 8.0);
                self.shape.density(point) * self.weight(point).1 * known.min(1.0 / ULP) / self.tolerance().density
            }
            fn gradient(&self) -> f64 {
                f64::MIN_POSITIVE
            }
            fn quadrature(&self) -> f64 {
                1e-6
            }
            fn inverse_units(&self, u: [f64; 2]) -> f64 {
                self.shape.inverse_units(u) + 16.0
            }
            fn smooth(&self, u: [f64; 2]) -> bool {
                self.shape.smooth(u)
            }
        }
    };
}
warped!(CosineTriangle, Triangle, SphericalTriangle);
warped!(CosineRectangle, Rectangle, SphericalRectangle);
