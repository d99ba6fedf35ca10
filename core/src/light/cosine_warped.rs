//! Shapes by solid angle, warped towards the cosine.

use crate::lanewise::Lanewise;
use crate::real::Real;
use crate::vector::{Vec2, Vec3};
use crate::warp::{Bilinear, Warp};

/// Least weight of a corner: a corner below the horizon keeps some samples, since the shape between may rise above it.
const FLOOR: f64 = 0.01;

/// Directions from a point to a shape, by solid angle times an approximate cosine: for diffuse surfaces, and lights near the
/// horizon.
///
/// [`Triangle::by_cosine_warp`](crate::Triangle::by_cosine_warp) says how.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub struct CosineWarped<S, R> {
    /// The shape, prepared for the point and uniform in solid angle.
    pub shape: S,
    /// Distribution on the unit square; its corner values are cosines ≥ 0.01.
    pub weights: Bilinear<R>,
}

impl<R: Real, S: Warp<R, Point = Vec3<R>>> CosineWarped<S, R> {
    /// Prepares for a surface with the unit normal `normal`, whose cosines it takes where the shape maps the corners of the
    /// square.
    #[inline(always)]
    pub fn new(shape: S, normal: Vec3<R>) -> Self {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let corners = [(zero, zero), (one, zero), (zero, one), (one, one)];
        let cosines = corners.map(|(x, y)| normal.dot(shape.sample(Vec2 { x, y })));
        Self::with_cosines(shape, cosines)
    }
    /// Prepares from known cosines at the directions of the corners (0, 0), (1, 0), (0, 1) and (1, 1).
    #[inline(always)]
    pub fn with_cosines(shape: S, cosines: [R; 4]) -> Self {
        Self { shape, weights: Bilinear { corners: cosines.map(|c| c.greater(R::lit(FLOOR))) } }
    }
}

impl<R: Real, S: Warp<R, Point = Vec3<R>>> Warp<R> for CosineWarped<S, R> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        self.shape.sample(self.weights.sample(u))
    }
    /// The pdf in the shape's measure, per steradian; 0 where the shape's is.
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        self.shape.pdf(w) * self.weights.pdf(self.shape.invert(w))
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        self.weights.invert(self.shape.invert(w))
    }
}

impl<R, S: Lanewise<R>> CosineWarped<S, R> {
    /// Replaces each number x by `f(x)`.
    #[inline(always)]
    pub fn map<T>(self, mut f: impl FnMut(R) -> T) -> CosineWarped<S::With<T>, T> {
        CosineWarped { shape: self.shape.map(&mut f), weights: self.weights.map(&mut f) }
    }
}
