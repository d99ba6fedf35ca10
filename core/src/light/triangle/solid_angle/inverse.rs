//! The `u` of a direction in a triangle.

use super::SphericalTriangle;
use crate::light::surface::SURFACE_SLACK;
use crate::math::rsqrt;
use crate::real::{Real, unit_interval};
use crate::vector::{Vec2, Vec3};

/// Part of the sweep below which a change of the arc counts as steep: a step of u₀ then changes u₁ by less than 1e−5 elsewhere.
const STEEP: f64 = 1.0 / 128.0;
/// Share of the area by which an inverse may be corrected: some roundings.
const BEYOND_ARC: f64 = 8.0 / 16_777_216.0;
/// Sine of the angle within which a direction counts as on an edge: the rounding of both.
const BESIDE: f64 = 4.0 / 16_777_216.0;

impl<R: Real> SphericalTriangle<R> {
    /// Sine and cosine of the angle at v0.
    #[inline(always)]
    fn alpha(&self) -> (R, R) {
        // past 1e18 the square of the cotangent would overflow, and the sine is 0 to working precision
        let cot = self.cot_alpha.clamped(R::lit(-1e18), R::lit(1e18));
        let sin = rsqrt(cot.mul_add(cot, R::lit(1.0)));
        (sin, cot * sin)
    }

    /// The side from v1 to the far edge, at the azimuth φ from v0: its sine over the unit, 1−|cos| and cos, by cotθ = (cosφ
    /// cos(side) + sinφ cotα)/sin(side). `x` and `y` are cosφ and sinφ in a unit whose square is `unit_squared`.
    #[inline(always)]
    fn side(&self, x: R, y: R, unit_squared: R) -> (R, R, R) {
        let one = R::lit(1.0);
        let (sin_alpha, cos_alpha) = self.alpha();
        let opposite = sin_alpha * self.sin_side;
        let adjacent = (self.g2 - one).mul_add(x * sin_alpha, y * cos_alpha);
        let squared = (opposite * opposite).mul_add(unit_squared, adjacent * adjacent);
        let inverse = rsqrt(squared).keep(squared.gt(R::lit(1e-36)));
        let (sin, cos) = (opposite * inverse, adjacent * inverse);
        (sin, sin * sin * unit_squared / (one + cos.abs()), cos)
    }

    /// The inverse of a direction, and 1 − cos of its angle from v1.
    #[inline(always)]
    pub(in crate::light) fn locate(&self, w: Vec3<R>) -> (Vec2<R>, R) {
        let (zero, one, two) = (R::lit(0.0), R::lit(1.0), R::lit(2.0));
        let (x, y) = (w.dot(self.along), w.dot(self.across).greater(zero));
        // beyond the edge to v2, where a great circle returns to the far edge's from the other side
        let after = (x * self.y2).lt(y * self.x2);
        let squared = x.mul_add(x, y * y);
        let inverse = rsqrt(squared).keep(squared.gt(R::lit(1e-36)));
        let (x, y) = (x * inverse, y * inverse);
        let (sin, small, cos) = self.side(x, y, one);
        let acute = cos.gt(zero);
        let (minus, plus) = (R::blend(acute, small, two - small), R::blend(acute, two - small, small));
        // tan(swept/2) from two sides and the angle between them
        let both = self.sin_side * sin;
        let swept = two * (both * y).atan2(self.g2.mul_add(plus, both * x));
        let swept = R::blend(after, self.solid_angle, swept);
        // 1 − cos of the angle from v1; ahead it comes from the tangents, since along v1 w has a rounding error that would
        // swamp a small triangle
        let (away, ahead) = (w - self.apex, w.dot(self.apex));
        let near = ahead.gt(zero);
        let (x, y) = (away.dot(self.along), away.dot(self.across));
        let by_sine = x.mul_add(x, y * y) / (one + ahead.keep(near));
        let moved = R::blend(near, by_sine, away.length_squared() * R::lit(0.5));
        let u = Vec2 {
            x: unit_interval(swept / self.solid_angle.greater(R::lit(1e-37))),
            y: unit_interval(moved / minus.greater(R::lit(1e-37))),
        };
        (u, moved)
    }
    /// Where the arc to the far edge changes within the rounding of a u₀ that sweeps `whole`, at one of its ends.
    #[inline(always)]
    pub(in crate::light) fn steep(&self, whole: R) -> R::Mask {
        let small = whole * R::lit(STEEP);
        // P leaves v0 and arrives at v2 within these parts of η
        let steep = (self.g2_over_g0 * small).gt(R::lit(1.0)) | (self.g2_over_g0 * self.half.x * self.half.x).lt(small);
        steep & self.solid_angle.gt(R::lit(0.0))
    }
    /// The area by which a direction lies beyond the arc for `u` that leaves `rest` = 1−u₀, at most a few roundings: the map is more
    /// accurate than a swept area.
    #[inline(always)]
    pub(in crate::light) fn area_beyond(&self, u: R, rest: R, w: Vec3<R>, whole: R) -> R {
        let arc = self.arc(u, rest);
        let (x, y) = (w.dot(self.along), w.dot(self.across));
        let turned = arc.x * y - arc.y * x;
        // sine of the angle between both arcs, times 1 − cos of the length of this one
        let squared = (arc.m * x.mul_add(x, y * y)).greater(R::lit(1e-36));
        let most = whole * R::lit(BEYOND_ARC);
        (turned * rsqrt(squared) * (arc.m + arc.m) / (R::lit(1.0) + arc.m)).clamped(-most, most)
    }
    /// Whether a direction lies at more than 90° from the edge from v1 to v0, about v1.
    #[inline(always)]
    pub(in crate::light) fn away_from_v0(&self, w: Vec3<R>) -> R::Mask {
        w.dot(self.along).lt(R::lit(0.0))
    }
    /// Whether a direction lies on the edge from v1 to v0 or outside, to rounding.
    #[inline(always)]
    pub(in crate::light) fn beside_v0(&self, w: Vec3<R>) -> R::Mask {
        let zero = R::lit(0.0);
        w.dot(self.across).le(R::lit(BESIDE)) & w.dot(self.along).gt(zero) & self.solid_angle.gt(zero)
    }
    /// Whether a direction lies on the edge from v1 to v2 or outside, to rounding.
    #[inline(always)]
    pub(in crate::light) fn beside_v2(&self, w: Vec3<R>) -> R::Mask {
        let zero = R::lit(0.0);
        let towards = self.x2.mul_add(w.dot(self.along), self.y2 * w.dot(self.across));
        w.dot(self.side12).le(self.slack.y * R::lit(BESIDE / SURFACE_SLACK))
            & towards.gt(zero)
            & self.solid_angle.gt(zero)
    }
    /// u₁ of a direction, given 1 − cos of its angle from v1, on the arc for `u` that leaves `rest` = 1−u₀: a rounded u₀ has an arc of
    /// its own, and the pair must lead back to the direction.
    #[inline(always)]
    pub(in crate::light) fn share_of_arc(&self, u: R, rest: R, moved: R) -> R {
        let (one, half) = (R::lit(1.0), R::lit(0.5));
        let m = self.arc(u, rest).m.greater(R::lit(1e-37));
        unit_interval(moved * (half * (one + m) / m))
    }
}
