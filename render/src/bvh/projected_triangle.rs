//! The test of a ray against a triangle, with the triangle seen along the ray.

use crate::geometry::NEAR_LIMIT;
use crate::packet::{M8, V8, X8};
use etendue::Real;

/// What an edge function may be beyond 0, relative to the greatest, so that rounding may have put a ray outside.
const BAND: f64 = 1.0 / 4096.0;

/// Edge functions of a triangle seen along a ray, and their sum.
pub(super) struct Projected {
    pub(super) inside: M8,
    /// Lanes that see the triangle not edge-on.
    some: M8,
    pub(super) weights: [X8; 3],
    pub(super) sum: X8,
    relative: [V8; 3],
}

/// Projects the corners along each ray and evaluates the three edge functions.
///
/// The projection of a corner depends only on the corner and the ray, and each edge function is a difference of two rounded products,
/// whose sign is correct or 0. Two triangles that share an edge therefore never both miss a ray between them, nor do all triangles
/// around a vertex. (After Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection", with a rotation instead of the shear,
/// so that lanes need not agree on an axis.)
#[inline(always)]
pub(super) fn project(corners: [V8; 3], origin: V8, [s, t]: [V8; 2]) -> Projected {
    let [a, b, c] = corners;
    let relative = [a - origin, b - origin, c - origin];
    let [a, b, c] = relative;
    let (ax, ay, bx, by, cx, cy) = (a.dot(s), a.dot(t), b.dot(s), b.dot(t), c.dot(s), c.dot(t));
    let weights = [bx * cy - by * cx, cx * ay - cy * ax, ax * by - ay * bx];
    let [u, v, w] = weights;
    let zero = X8::lit(0.0);
    let least = u.lesser(v).lesser(w);
    let most = u.greater(v).greater(w);
    let sum = u + v + w;
    let some = sum.abs().gt(zero);
    Projected { inside: (least.ge(zero) | most.le(zero)) & some, some, weights, sum, relative }
}

impl Projected {
    /// Lanes that are inside, or outside by rounding.
    #[inline]
    pub(super) fn nearly(&self) -> M8 {
        let [u, v, w] = self.weights;
        let (least, most, band) = (u.lesser(v).lesser(w), u.greater(v).greater(w), X8::lit(-BAND));
        (least.ge(most * band) | most.le(least * band)) & self.some
    }
    /// Lanes whose distance is negative by more than its error, if it is less than `near` in magnitude: a ray that leaves a surface, moved
    /// off it, need not ask in double precision whether it hits that surface.
    ///
    /// With ε = 2⁻²⁴ and all corners within M of the origin, each weight has an error below 19 ε M², and the numerator of the distance one
    /// below 90 ε M³. `near` is at least 1/32 of the longest edge: if one corner is within 34 near, M is at most 66 near and the error below
    /// 1.6 near³. The denominator is then above 2 near², more than its error. Where a bound underflows or overflows, no lane is sure.
    #[inline(always)]
    pub(super) fn surely_behind(&self, distance: X8, near: X8) -> M8 {
        let (square, corner) = (near * near, self.relative[0]);
        let bound = (square * near * X8::lit(2.0)).greater(X8::lit(1e-30));
        corner.dot(corner).le(square * X8::lit(34.0 * 34.0)) & (distance * self.sum.abs()).lt(-bound)
    }
    /// Distances along the rays. The weights of slivers, and thus their distances, may be nothing but rounding error.
    #[inline(always)]
    pub(super) fn distance(&self, direction: V8) -> X8 {
        let [a, b, c] = self.relative;
        let (z0, z1, z2) = (a.dot(direction), b.dot(direction), c.dot(direction));
        let [u, v, w] = self.weights;
        u.mul_add(z0, v.mul_add(z1, w * z2)) / Real::blend(self.some, self.sum, X8::lit(1.0))
    }
}

/// Lanes whose distance is decided in double precision: it is near 0, or near the limit if `ANY` hit before that occludes.
#[inline(always)]
pub(super) fn undecided<const ANY: bool>(distance: X8, near: X8, limit: X8) -> M8 {
    // also where it is not a number
    let undecided = !distance.abs().gt(near);
    let band = (limit * X8::lit(NEAR_LIMIT)).greater(near * X8::lit(1.0 / 4096.0));
    if ANY { undecided | (distance - limit).abs().lt(band) } else { undecided }
}
