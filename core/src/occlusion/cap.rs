//! Spheres as seen from a point, and the part of them within an outline.

use super::TooMany;
use super::outline::Outline;
use crate::math::rsqrt;
use crate::real::{Mask, Real};
use crate::vector::Vec3;

/// The directions to a sphere: a cap about an axis.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cap<R> {
    /// Unit direction to the centre.
    pub(super) axis: Vec3<R>,
    /// Sine and cosine of the angle between the axis and the edge of the sphere.
    pub(super) sin: R,
    pub(super) cos: R,
    /// Distance along the axis of the circle in which the sphere's tangents touch it; 0 or less inside.
    pub(super) tangents: R,
}

impl<R: Real> Cap<R> {
    #[inline(always)]
    pub(super) fn new(center: Vec3<R>, radius: R) -> Self {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let (axis, distance) = center.unit_and_length();
        let some = distance.gt(zero);
        let sin = (radius / R::blend(some, distance, one)).lesser(one).greater(zero);
        let cos = ((one - sin) * (one + sin)).greater(R::lit(1e-12)).sqrt();
        let tangents = center.length_squared_minus_square(radius) / R::blend(some, distance, one);
        Self { axis, sin, cos, tangents }
    }
    /// Whether the caps have no direction in common, in all of these lanes.
    pub(super) fn is_apart_from(&self, other: &Self, lanes: R::Mask) -> bool {
        // cos(α + β), and a reserve for its rounding
        let both = self.cos.mul_add(other.cos, -(self.sin * other.sin)) - R::lit(1e-6);
        !(lanes & self.axis.dot(other.axis).ge(both)).any()
    }

    /// Ω⊥ of the part of the cap within an outline that lies above the horizon.
    ///
    /// Each edge contributes its part inside the cap. What the edge has outside is moved to the cap's circle, along great circles through
    /// the axis. The edges moved form a closed curve however they are rounded, and every contribution is continuous in the corners.
    #[inline]
    pub(super) fn projected_solid_angle_within<const MOST: usize>(
        &self,
        outline: &Outline<R, MOST>,
        normal: Vec3<R>,
    ) -> Result<R, TooMany> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let Self { axis, sin, cos, .. } = *self;
        // the edges are seen in the hemisphere about the axis; a reserve keeps the slopes below finite
        let mut outline = *outline;
        outline.clip(axis, zero)?;
        if outline.is_empty() {
            return Ok(zero);
        }
        let sin_squared = sin * sin;
        let up = axis.dot(normal);
        let unit = |x: R, y: R| {
            let square = x.mul_add(x, y * y);
            let inverse = rsqrt(R::blend(square.gt(zero), square, one));
            (x * inverse, y * inverse)
        };
        let mut sum = zero;
        let corners = outline.corners();
        let mut from = corners[corners.len() - 1];
        for &to in corners {
            let across = from.cross(to);
            let square = across.length_squared();
            let edge = square.gt(zero);
            let m = across * rsqrt(R::blend(edge, square, one));
            // the edge's great circle passes the axis at a distance with this sine
            let sine = axis.dot(m);
            let cosine_squared = ((one - sine) * (one + sine)).greater(R::lit(1e-12));
            let inverse_cosine = rsqrt(cosine_squared);
            // a frame about the axis: away from the edge's circle, and along it
            let along = m.cross(axis) * inverse_cosine;
            let away = (axis * sine - m) * inverse_cosine;
            let half_squared = sin_squared - sine * sine;
            let meets = edge & half_squared.gt(zero);
            let half = half_squared.greater(zero).sqrt();
            // tangents of the angles from the nearest point of the circle
            let slope = half / cos;
            let tangent = |v: Vec3<R>| {
                let forward = v.dot(axis).greater(R::lit(1e-12) * v.max_abs());
                v.dot(along) / (forward * inverse_cosine).greater(R::lit(1e-30))
            };
            let (start, end) = (tangent(from), tangent(to));
            let (low, high) = (start.greater(-slope), end.lesser(slope));
            let meets = meets & low.lt(high);
            let angle = (high - low).atan2(low.mul_add(high, one)).keep(meets);
            // the parts outside, along the circle of the cap
            let (x0, y0) = unit(from.dot(away), from.dot(along));
            let (x1, y1) = unit(to.dot(away), to.dot(along));
            let (x, y) = unit(cos * sine, half);
            let before = edge & (!meets | start.lt(-slope));
            let after = meets & end.gt(slope);
            let (x2, y2) = (R::blend(meets, x, x1), R::blend(meets, -y, y1));
            let turn = |x0: R, y0: R, x1: R, y1: R| (x0 * y1 - y0 * x1).atan2(x0.mul_add(x1, y0 * y1));
            let mut turned = turn(x0, y0, x2, y2).keep(before);
            let (mut dx, mut dy) = ((x2 - x0).keep(before), (y2 - y0).keep(before));
            if after.any() {
                turned += turn(x, y, x1, y1).keep(after);
                dx += (x1 - x).keep(after);
                dy += (y1 - y).keep(after);
            }
            let bend = dx.mul_add(along.dot(normal), -(dy * away.dot(normal)));
            sum += angle * m.dot(normal) + sin_squared * turned * up + sin * cos * bend;
            from = to;
        }
        Ok((sum * R::lit(0.5)).abs().keep(outline.some()))
    }
}
