//! Shapes by solid angle, warped towards a normal.

use super::{Rectangle, Triangle};
use crate::domain::Random;
use crate::laws::{Coordinates, Subject, vectors_of};
use crate::oracle::{V3, along, cross, length, unit};
use crate::tolerances::{Tolerance, ULP};
use core::f64::consts::PI;
use core::fmt::Debug;
use etendue::seen::{CosineWarped, SphericalRectangle, SphericalTriangle};
use etendue::warp::Bilinear;
use etendue::{Real, Vec3, Warp};

/// Units to which the cosine of a corner is known, of a unit vector's.
const CORNERS: f64 = 6.0;

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
            /// The weight of the square by the formula, in double precision, the greatest one, and what one is per cosine at a corner; the shape's own inverse has laws of its own.
            fn weight(&self, warp: &CosineWarped<$seen<f64>, f64>, point: V3) -> (f64, f64, f64) {
                let [x, y, _] = warp.shape.invert(Vec3::gather(&[point])).at(0);
                let [a, b, c, d] = warp.weights.corners;
                let value = (a * (1.0 - x) + b * x) * (1.0 - y) + (c * (1.0 - x) + d * x) * y;
                let scale = 4.0 / (a + b + c + d);
                (scale * value, scale * a.max(b).max(c.max(d)), scale)
            }
            /// By how much the weight changes per turn of the direction, at the most within `step`.
            fn steepness(&self, warp: &CosineWarped<$seen<f64>, f64>, w: V3, step: f64) -> f64 {
                let here = self.weight(warp, w).0;
                let axis = cross(w, unit(self.normal.map(f64::from)));
                let axis = if length(axis) > 0.0 { unit(axis) } else { [1.0, 0.0, 0.0] };
                let other = cross(w, axis);
                let turns = [0.0, 0.25, 0.5, 0.75].map(|t: f64| (PI * t).sin_cos());
                let change = |(s, c): (f64, f64), step: f64| {
                    let w = along(along(w, axis, step * c), other, step * s);
                    (self.weight(warp, unit(w)).0 - here).abs() / step.abs()
                };
                turns.map(|turn| change(turn, step).max(change(turn, -step))).into_iter().fold(0.0, f64::max)
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
                self.shape.density(point) * self.weight(&Self::prepare(&[*self]), point).0
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
            /// What the inverse is known to, moves the density along the bilinear one; and the weights at the corners are rounded.
            fn density_slack(&self, point: V3) -> f64 {
                let warp = Self::prepare(&[*self]);
                let known = self.shape.tolerance().round_trip * self.shape.granularity();
                let (_, greatest, scale) = self.weight(&warp, point);
                let steps = known * self.steepness(&warp, point, known * ULP)
                    + greatest * self.shape.inverse_units([0.5; 2])
                    + scale * CORNERS;
                self.shape.density(point) * steps.min(greatest / ULP) / self.tolerance().density
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
