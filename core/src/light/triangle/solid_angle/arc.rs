//! The arcs from the second vertex to the far edge that sweep a triangle.

use super::SphericalTriangle;
use crate::math::rsqrt;
use crate::real::{Mask, Real};
use crate::vector::Vec3;

const INV_TWO_PI: f64 = 0.5 / core::f64::consts::PI;

/// The arc from `v1` to the point P of the far edge.
pub(super) struct Arc<R> {
    /// X, the stereographic projection of P from opposite `v1`, towards v0: tan(θ/2) cosφ
    pub(super) x: R,
    /// Y, the same perpendicular to it: tan(θ/2) sinφ
    pub(super) y: R,
    /// M = X² + Y² = tan²(θ/2)
    pub(super) m: R,
    /// sinη, and r = sin(H−η)/sinH
    pub(super) swept: [R; 2],
}

impl<R: Real> SphericalTriangle<R> {
    /// The arc that cuts off the share `u` of the area and leaves `rest` = 1−u.
    #[inline(always)]
    pub(super) fn arc(&self, u: R, rest: R) -> Arc<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        // from the nearer end: near the other, α−η and H−η are small differences
        let far = u.gt(R::lit(0.5));
        let part = R::blend(far, rest, u);
        let (sin, cos) = (part * self.solid_angle * R::lit(0.5 * INV_TWO_PI)).sin_cos_turns();
        let s = R::blend(far, self.half.x * cos - self.half.y * sin, sin);
        // cos(α−η) and sin(α−η), over sinα
        let from_sin = R::blend(far, self.turned.x, one);
        let from_cos = R::blend(far, self.turned.y, -self.cot_alpha);
        let turn_sin = from_sin.mul_add(cos, from_cos * sin);
        let turn_cos = from_cos.mul_add(cos, -(from_sin * sin)).negate_where(!far);
        let stretched = s * self.stretch;
        // P opposite v1 would be at infinity; keep its square finite
        let most = R::lit(1e15);
        let x = (-stretched).mul_add(turn_cos, self.tan_half).clamped(-most, most);
        let y = (stretched * turn_sin).clamped(zero, most);
        let left = R::blend(far, sin * self.inv_half_sin, (-sin).mul_add(self.cot_half, cos));
        let arc = Arc { x, y, m: x.mul_add(x, y * y), swept: [s, left] };
        // a side of more than 120° is rare: do the extra work only where there is one
        let long = self.g2.lt(R::lit(0.5));
        if long.any() { self.opposite_arc(arc, long) } else { arc }
    }

    /// Where v0 lies nearly opposite v1, the angle no longer determines the arc: takes it from P itself where that is better
    /// conditioned.
    #[inline]
    fn opposite_arc(&self, arc: Arc<R>, long: R::Mask) -> Arc<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let [w0, w2] = self.weights(arc.swept);
        // 1 + P·V₁/l₁ with V₁/l₁ = −V₀/l₀ + S, where S·V₀/l₀ = G₂ and S·V₂/l₂ = G₁ are small; 1 − P·V₀/l₀ comes from the sine
        let along = w2.mul_add(self.one_plus_d02 - one, w0);
        let apart = R::blend(along.gt(zero), w2 * w2 * self.sin02_squared / (one + along.greater(zero)), one - along);
        let sum = w0.mul_add(self.g2, apart + w2 * self.g1.abs());
        let plus = w0.mul_add(self.g2, apart + w2 * self.g1);
        let inverse = one / plus.greater(R::lit(1e-30));
        let (first, second) = (w0 * self.sin_side * inverse, w2 * self.x2 * inverse);
        // either X is a sum: of these two terms, or of tan(c/2) and the rest; take the one with less cancellation. The weights
        // of P sum to at least 1, unless v0 is opposite v1 to the last bit, which loses them
        let known = plus.gt(sum * R::lit(0.125))
            & (w0 + w2).gt(R::lit(0.5))
            & (first + second.abs()).lt(self.tan_half.greater(arc.x.abs()));
        let better = long & known;
        let most = R::lit(1e15);
        let x = R::blend(better, (first + second).clamped(-most, most), arc.x);
        let y = R::blend(better, (w2 * self.y2 * inverse).lesser(most), arc.y);
        Arc { x, y, m: x.mul_add(x, y * y), swept: arc.swept }
    }

    /// The weights w₀ and w₂ of P = w₀V₀/l₀ + w₂V₂/l₂.
    #[inline(always)]
    pub(super) fn weights(&self, [s, left]: [R; 2]) -> [R; 2] {
        let (zero, two) = (R::lit(0.0), R::lit(2.0));
        // r = a − b = cosη − sinη (G₁+G₂)/G₀ = sin(H−η)/sinH
        let b = s * self.g2_over_g0;
        let a = left + b;
        let w0 = (left * (a + b)).greater(zero);
        // b d₀₂ + a, w₂ − w₀ and |P|²: small differences where v0 and v2 are nearly opposite
        let w2 = (two * b * b.mul_add(self.one_plus_d02, left)).greater(zero);
        let more = two * b * b * self.one_plus_d02 - left * left;
        let squared = more.mul_add(more, two * self.one_plus_d02 * w0 * w2);
        let inverse = rsqrt(squared.greater(R::lit(1e-30)));
        [w0 * inverse, w2 * inverse]
    }

    /// The direction at `u` along the arc, the cosine z of its angle to v1, and the sine of that angle over √M.
    #[inline]
    pub(super) fn along_arc(&self, arc: &Arc<R>, u: R) -> (Vec3<R>, R, R) {
        let (zero, one, two) = (R::lit(0.0), R::lit(1.0), R::lit(2.0));
        // 1−z = 2uM/(1+M), and the sine over √M
        let over = u * (two / (one + arc.m));
        let z = (-over).mul_add(arc.m, one);
        // 1+z = 2(1 + (1−u)M)/(1+M): near the antipode of v1, z no longer determines the sine
        let plus = (one - u).mul_add(arc.m, one) * (two / (one + arc.m));
        let sin_over = (over * plus).greater(zero).sqrt();
        let tangent = self.along.mul_add(arc.x, self.across * arc.y);
        let direction = self.apex.mul_add(z, tangent * sin_over);
        // a unit vector up to rounding: one Newton step for 1/√
        let unit = direction * direction.length_squared().mul_add(R::lit(-0.5), R::lit(1.5));
        (unit, z, sin_over)
    }
}
