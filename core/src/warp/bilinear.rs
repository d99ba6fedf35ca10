//! The unit square with a bilinear density.

use super::{Linear, Warp};
use crate::lanewise::lanewise_by_map;
use crate::real::Real;
use crate::vector::Vec2;

/// Points of the unit square with a pdf bilinear between four corner values: for emitters that are tilted or carry a smooth
/// texture.
///
/// Set `corners`, then call `sample`, `pdf` or `invert`. If no corner is positive, the pdf is 0 and `sample` returns `u`.
///
/// - Formula: the density of y is linear between the sums of the lower and of the upper corners, that of x between the values that the left
///   and the right side have at y; between a and b, x = u(a+b) / (a + √(a²(1−u) + b²u)).
/// - Domain: u in [0, 1)²; corners ≥ 0 in any unit (negative ones count as 0).
/// - Density: the pdf is 4 × the interpolated value / the sum of the corners, per unit area of [0, 1]²; 0 elsewhere.
/// - Degenerate input: if all corners are 0, the pdf is 0 and the point is u.
/// - Greatest error: 2e−7 in the point, 4e−7 relative in the pdf.
/// - Source: Pharr, Jakob and Humphreys, PBR 4th ed., A.5.5 (bilinear), by the marginal and the conditional (2.3.2), rationalised.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub struct Bilinear<R> {
    /// Relative densities at (0, 0), (1, 0), (0, 1) and (1, 1): ≥ 0, in any common unit.
    pub corners: [R; 4],
}

impl<R> Bilinear<R> {
    /// Replaces each number x by `f(x)`.
    #[inline(always)]
    pub fn map<S>(self, f: impl FnMut(R) -> S) -> Bilinear<S> {
        Bilinear { corners: self.corners.map(f) }
    }
}

lanewise_by_map!(Bilinear);

impl<R: Real> Bilinear<R> {
    /// The marginal of y, and the corners, times a power of two where their squares would leave the range.
    #[inline(always)]
    fn marginal(&self) -> (Linear<R>, [R; 4]) {
        let corners = self.corners.map(|w| w.greater(R::lit(0.0)));
        let [a, b, c, d] = corners;
        let most = a.greater(b).greater(c.greater(d));
        let far = most.lt(R::lit(1.0 / 65_536.0)) | most.gt(R::lit(65_536.0));
        let [a, b, c, d] = R::where_any(far, corners, || {
            let scale = most.pow2_scale();
            corners.map(|w| w * scale)
        });
        (Linear { a: a + b, b: c + d }, [a, b, c, d])
    }
    /// The distribution of x given y in [0, 1].
    #[inline(always)]
    fn conditional([a, b, c, d]: [R; 4], y: R) -> Linear<R> {
        let rest = R::lit(1.0) - y;
        Linear { a: a.mul_add(rest, c * y), b: b.mul_add(rest, d * y) }.scaled_if_small()
    }
    /// The same, of a point's y.
    #[inline(always)]
    fn conditional_at(corners: [R; 4], y: R) -> Linear<R> {
        Self::conditional(corners, y.clamped(R::lit(0.0), R::lit(1.0)))
    }
}

impl<R: Real> Warp<R> for Bilinear<R> {
    type Point = Vec2<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec2<R> {
        let (marginal, corners) = self.marginal();
        let y = marginal.sample_in_range(u.y);
        Vec2 { x: Self::conditional(corners, y).sample_in_range(u.x), y }
    }
    /// The pdf per unit area of [0, 1]².
    #[inline(always)]
    fn pdf(&self, p: Vec2<R>) -> R {
        let (marginal, corners) = self.marginal();
        marginal.pdf_in_range(p.y) * Self::conditional_at(corners, p.y).pdf_in_range(p.x)
    }
    #[inline(always)]
    fn invert(&self, p: Vec2<R>) -> Vec2<R> {
        let (marginal, corners) = self.marginal();
        Vec2 { x: Self::conditional_at(corners, p.y).invert(p.x), y: marginal.invert(p.y) }
    }
}
