//! Line segments by angle, and by projected solid angle.

use crate::lanewise::lanewise;
use crate::light::direction::{DirectionSample, to_unit};
use crate::math::ratio;
use crate::real::{Real, unit_interval};
use crate::vector::Vec3;
use core::f64::consts::FRAC_1_PI;

/// Angle by which the rounding of its direction may move a sample out of the segment: 4 ulp of a component near 1.
const LINE_SLACK: f64 = 4.0 / 16_777_216.0;
/// A turn over the radians of one.
pub(super) const TURNS: f64 = 0.5 * FRAC_1_PI;

lanewise! {
    /// Directions from a point to a line segment, uniform in angle: for thin tubes, and for equiangular sampling of a ray about
    /// a point light. A one-dimensional [`Warp`](crate::Warp).
    ///
    /// [`Line::by_angle`](crate::Line::by_angle) says how.
    pub struct SphericalSegment {
        /// unit direction a/|a| of the first end
        pub(super) from: Vec3<R>,
        /// unit tangent there, towards the other end
        pub(super) from_turn: Vec3<R>,
        /// unit direction b/|b| of the second end
        pub(super) to: Vec3<R>,
        /// unit tangent there, towards the first end
        pub(super) to_turn: Vec3<R>,
        /// α in radians
        pub(super) angle: R,
        /// |a|, in units of `unit`
        pub(super) from_distance: R,
        /// |b|, in units of `unit`
        pub(super) to_distance: R,
        /// |a×b|, in units of `unit`²
        pub(super) area: R,
        /// unit of the lengths above, a power of two
        pub(super) unit: R,
    }
}

impl<R: Real> SphericalSegment<R> {
    /// Prepares for the segment from `a` to `a + edge`, with `a` relative to the point; both in one unit of length.
    #[inline(always)]
    pub fn new(a: Vec3<R>, edge: Vec3<R>) -> Self {
        let ([a, edge], scale) = to_unit([a, edge]);
        let b = a + edge;
        let (normal, area) = a.cross(edge).unit_and_length();
        let ((from, from_distance), (to, to_distance)) = (a.unit_and_length(), b.unit_and_length());
        Self::between([from, to], [from_distance, to_distance], normal, area, R::lit(1.0) / scale)
    }
    #[inline(always)]
    pub(super) fn between(ends: [Vec3<R>; 2], distances: [R; 2], normal: Vec3<R>, area: R, unit: R) -> Self {
        let angle = area.atan2(distances[0] * distances[1] * ends[0].dot(ends[1]));
        // below this, its factors are subnormal
        let least = R::lit(1e-30);
        Self {
            from: ends[0],
            from_turn: normal.cross(ends[0]),
            to: ends[1],
            to_turn: ends[1].cross(normal),
            angle: angle.keep(angle.gt(least) & area.gt(least)),
            from_distance: distances[0],
            to_distance: distances[1],
            area,
            unit,
        }
    }

    /// The angle α that the segment subtends, in radians, in [0, π]; 0 where it is degenerate.
    #[inline(always)]
    pub fn angle(&self) -> R {
        self.angle
    }
    /// The pdf per radian of every direction that hits the segment, 1/α; 0 where α is 0.
    #[inline(always)]
    pub fn uniform_pdf(&self) -> R {
        ratio(R::lit(1.0), self.angle)
    }

    /// The direction at the angle θ from the first end and the distance along it; `rest` = α − θ.
    #[inline(always)]
    pub(super) fn at(&self, theta: R, rest: R) -> DirectionSample<R> {
        let turns = R::lit(TURNS);
        let ((s, c), (rest_s, rest_c)) = ((theta * turns).sin_cos_turns(), (rest * turns).sin_cos_turns());
        let sum = self.from_distance.mul_add(s, self.to_distance * rest_s);
        let farthest = self.from_distance.greater(self.to_distance);
        let distance = ratio(self.area, sum).lesser(farthest) * self.unit;
        // from the nearer end
        let near = theta.le(rest);
        let along = Vec3::blend(near, self.from, self.to) * R::blend(near, c, rest_c);
        let direction = Vec3::blend(near, self.from_turn, self.to_turn).mul_add(R::blend(near, s, rest_s), along);
        DirectionSample {
            direction,
            distance: distance.lesser(R::lit(f64::from(f32::MAX))).keep(self.angle.gt(R::lit(0.0))),
        }
    }
    /// Maps `u` to a direction and the distance to the segment along it.
    #[inline(always)]
    pub fn sample_direction(&self, u: R) -> DirectionSample<R> {
        self.at(u * self.angle, (R::lit(1.0) - u) * self.angle)
    }
    /// Maps `u` in [0, 1) to a direction.
    #[inline(always)]
    pub fn sample(&self, u: R) -> Vec3<R> {
        self.sample_direction(u).direction
    }
    /// Tells whether the direction lies between the ends; allows for its rounding.
    #[inline(always)]
    pub(super) fn between_ends(&self, w: Vec3<R>) -> R::Mask {
        let slack = R::lit(-LINE_SLACK);
        // along the bisector of the ends, of length 2 or more
        let ahead = (self.from + self.to) + (self.from_turn + self.to_turn);
        w.dot(self.from_turn).ge(slack) & w.dot(self.to_turn).ge(slack) & w.dot(ahead).ge(slack)
    }
    /// The pdf of a direction, per radian; 0 beyond the ends.
    #[inline(always)]
    pub fn pdf(&self, w: Vec3<R>) -> R {
        self.uniform_pdf().keep(self.between_ends(w))
    }
    /// Angles of a direction from the two ends.
    #[inline(always)]
    pub(super) fn angles(&self, w: Vec3<R>) -> (R, R) {
        let zero = R::lit(0.0);
        let of = |turn: Vec3<R>, end: Vec3<R>| w.dot(turn).greater(zero).atan2(w.dot(end)).lesser(self.angle);
        (of(self.from_turn, self.from), of(self.to_turn, self.to))
    }
    /// Returns the `u` in [0, 1) that [`sample`](Self::sample) maps to the direction; for one beyond the ends, some value in
    /// [0, 1).
    #[inline(always)]
    pub fn invert(&self, w: Vec3<R>) -> R {
        let (theta, rest) = self.angles(w);
        let (u, v) = (ratio(theta, self.angle), ratio(rest, self.angle));
        unit_interval(R::blend(theta.le(rest), u, R::lit(1.0) - v))
    }
}
