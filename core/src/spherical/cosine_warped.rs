use crate::real::Real;
use crate::vector::{Vec2, Vec3};
use crate::warp::{Bilinear, Warp};

/// Least weight of a corner: a corner below the horizon keeps a part of the samples, since the shape's inside may be above it.
const FLOOR: f64 = 0.01;

/// The directions from a point to a shape, by solid angle times an approximation of the cosine to a surface normal: [`Bilinear`] on the
/// unit square, before the shape's own map.
///
/// The weights of the corners of the square are the cosines in the directions to which the shape maps them, and at least 0.01: what
/// is warped is the square, so the fit is good where the shape's map is close to bilinear (triangles and rectangles that are not
/// huge), and the density is exact everywhere. It is not cut at the horizon.
///
/// - Formula: ω = shape(v), v = bilinear(u).
/// - Domain: u in [0, 1)²; any shape with constant density, an inverse and a fixed measure: [`SphericalTriangle`](super::SphericalTriangle),
///   [`SphericalRectangle`](super::SphericalRectangle).
/// - Density: the shape's times the bilinear density at v, which `pdf` finds by the shape's inverse: the same factor.
/// - Degenerate input: as the shape.
/// - Greatest error: that of the shape; of the density, 8 ulp more, the bilinear density's change by an error of v, and the rounding
///   of the cosines at the corners over their mean.
/// - Source: Hart, Pharr, Müller, Lopes, McGuire and Shirley, "Practical Product Sampling by Fitting and Composing Warps", EGSR 2020, 4.
#[derive(Clone, Copy, Debug, Default)]
pub struct CosineWarped<S, R> {
    /// The shape, by solid angle.
    pub shape: S,
    /// Density on the unit square.
    pub weights: Bilinear<R>,
}

impl<R: Real, S: Warp<R, Point = Vec3<R>>> CosineWarped<S, R> {
    /// For a surface with the unit normal `normal`; the corners are where the shape's map takes those of the square.
    #[inline(always)]
    pub fn new(shape: S, normal: Vec3<R>) -> Self {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let corners = [(zero, zero), (one, zero), (zero, one), (one, one)];
        let cosines = corners.map(|(x, y)| normal.dot(shape.sample(Vec2 { x, y })));
        Self::with_cosines(shape, cosines)
    }
    /// For known cosines in the directions of the corners (0, 0), (1, 0), (0, 1) and (1, 1).
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
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        self.shape.pdf(w) * self.weights.pdf(self.shape.invert(w))
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        self.weights.invert(self.shape.invert(w))
    }
}
