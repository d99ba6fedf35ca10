//! What a point sees of a portal along one of its edges: a range of angles.

use super::table::Span;
use crate::math::rsqrt;
use crate::real::Real;
use core::f64::consts::{FRAC_1_PI, PI};

/// The sine of the angle below which a portal is seen edge-on, as if from its plane.
const EDGE_ON: f64 = 1e-6;

/// The angles about the other edge, between the normal and directions into the portal, along one edge.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Side<R> {
    /// Sine and cosine where it begins and where it ends.
    start: [R; 2],
    end: [R; 2],
    /// Size of the range in radians, in (0, π).
    pub(super) size: R,
    /// Where it begins among all angles before the portal, in [0, 1].
    place: R,
}

impl<R: Real> Side<R> {
    /// The range along an edge of this length that begins at `start` and is `height` in front of the point, and where there is one.
    #[inline(always)]
    pub(super) fn new(start: R, length: R, height: R) -> (Self, R::Mask) {
        let zero = R::lit(0.0);
        let reach = start.abs().greater(height).greater(length);
        let scale = reach.pow2_scale();
        let (start, length, height) = (start * scale, length * scale, height * scale);
        let end = start + length;
        // closer to the plane, rounding decides on which side directions into the portal are
        let near = start.abs().greater(end.abs()) * R::lit(EDGE_ON);
        let size = (length * height).atan2(start.mul_add(end, height * height));
        let unit = |x: R| {
            let squared = x.mul_add(x, height * height);
            let some = squared.gt(zero);
            let inverse = rsqrt(R::blend(some, squared, R::lit(1.0)));
            ([x * inverse, height * inverse], some)
        };
        let ((first, some), (last, more)) = (unit(start), unit(end));
        let place = start.atan2(height).mul_add(R::lit(FRAC_1_PI), R::lit(0.5)).clamped(zero, R::lit(1.0));
        let visible = some
            & more
            & height.gt(zero)
            & height.gt(near)
            & size.gt(zero)
            & size.lt(R::lit(PI))
            & reach.lt(R::lit(1e37));
        let keep = |pair: [R; 2]| pair.map(|x| x.keep(visible));
        let size = size.keep(visible);
        (Self { start: keep(first), end: keep(last), size, place: place.keep(visible) }, visible)
    }
    /// Whether a direction with the component `along` the edge, and `ahead` along the normal, is within the range to so many radians.
    #[inline(always)]
    pub(super) fn has(&self, along: R, ahead: R, slack: R) -> R::Mask {
        let after = |[sin, cos]: [R; 2]| along.mul_add(cos, -(ahead * sin));
        after(self.start).ge(-slack) & after(self.end).le(slack)
    }
    /// The position of that direction in the range, in [0, 1].
    #[inline(always)]
    pub(super) fn position(&self, along: R, ahead: R) -> R {
        let [sin, cos] = self.start;
        let turned = along.mul_add(cos, -(ahead * sin)).atan2(along.mul_add(sin, ahead * cos));
        let some = self.size.gt(R::lit(0.0));
        (turned / R::blend(some, self.size, R::lit(1.0))).clamped(R::lit(0.0), R::lit(1.0))
    }
    /// Sine and cosine at a position.
    #[inline(always)]
    pub(super) fn at(&self, position: R) -> [R; 2] {
        let ([sin, cos], (s, c)) = (self.start, (position * self.size * R::lit(0.5 * FRAC_1_PI)).sin_cos_turns());
        [sin.mul_add(c, cos * s), cos.mul_add(c, -(sin * s)).greater(R::lit(0.0))]
    }
    /// The range in a table of so many columns or rows.
    #[inline(always)]
    pub(super) fn span(&self, lane: usize, cells: usize) -> Span {
        Span::new(self.place.lane_f64(lane), self.size.lane_f64(lane) * FRAC_1_PI, cells)
    }
}
