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
/// Call `CosineWarped::new(shape, normal)` with a prepared shape, then `sample`. Degenerate input is as for the shape.
///
/// A [`Bilinear`] warp of the unit square precedes the shape's own map. The weights of the square's corners are the cosines of
/// the directions to which the shape maps them, and at least 0.01. Since it is the square that is warped, the fit is good where
/// the shape's map is close to bilinear (triangles and rectangles that are not huge); the pdf is exact everywhere. Samples are
/// not clipped at the horizon.
///
/// - Formula: ω = shape(v), v = bilinear(u).
/// - Domain: u in [0, 1)²; any shape with a constant pdf, an inverse and a fixed measure:
///   [`SphericalTriangle`](super::SphericalTriangle), [`SphericalRectangle`](super::SphericalRectangle).
/// - Density: the pdf is the shape's pdf, per steradian, times the bilinear pdf at v; `pdf` finds v by the shape's inverse.
/// - Degenerate input: as for the shape.
/// - Greatest error: that of the shape; the pdf adds 8 ulp, the change of the bilinear pdf by the error of v, and the rounding
///   of the corners' cosines over their mean.
/// - Source: Hart, Pharr, Müller, Lopes, McGuire and Shirley, "Practical Product Sampling by Fitting and Composing Warps", EGSR
///   2020, 4.
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
