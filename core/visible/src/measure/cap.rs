//! Spheres as seen from a point, and the part of them within an outline.

use super::capacity::TooMany;
use super::outline::Outline;
use etendue::math::rsqrt;
use etendue::{Frame, Mask, Real, Vec2, Vec3};

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
        let distance = R::blend(some, distance, one);
        let sin = R::blend(some, radius / distance, one).lesser(one).greater(zero);
        let scale = center.max_abs().greater(radius).pow2_scale();
        let power = (center * scale).length_squared_minus_square(radius * scale) / (distance * scale);
        let cos = (power / (distance * scale)).greater(R::lit(1e-12)).lesser(one).sqrt();
        // from the centre, nothing is in front
        let tangents = (power / scale).keep(some);
        Self { axis, sin, cos, tangents }
    }
    /// The corners of a square around the cap, unless that is close to a hemisphere in any lane.
    pub(super) fn square(&self) -> Result<[Vec3<R>; 4], TooMany> {
        if self.cos.lt(R::lit(0.1)).any() {
            return Err(TooMany);
        }
        let Frame { s, t, n } = Frame::new(self.axis);
        // a little wider, for rounding
        let (s, t, n) = (s * self.sin, t * self.sin, n * (self.cos * R::lit(0.999)));
        Ok([n + s + t, n - s + t, n - s - t, n + s - t])
    }
    /// Whether the caps have no direction in common, in all of these lanes.
    pub(super) fn is_apart_from(&self, other: &Self, lanes: R::Mask) -> bool {
        // cos(α + β), and a reserve for its rounding
        let both = self.cos.mul_add(other.cos, -(self.sin * other.sin)) - R::lit(1e-6);
        !(lanes & self.axis.dot(other.axis).ge(both)).any()
    }

    /// Ω⊥ of the part of the cap within an outline that lies above the horizon. The last argument is memory for another outline.
    ///
    /// Each edge contributes its part inside the cap. What the edge has outside is moved to the cap's circle, along great circles through
    /// the axis. ∫ (r − a cosα) × dr around the part is that of r × dr, because the curve is closed. On the circle it is sin²α a per
    /// radian, and elsewhere it is small at the circle, so that what is rounded there does not matter.
    #[inline]
    pub(super) fn projected_solid_angle_within<const MOST: usize>(
        &self,
        within: &Outline<R, MOST>,
        normal: Vec3<R>,
        outline: &mut Outline<R, MOST>,
    ) -> Result<R, TooMany> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let Self { axis, sin, cos, .. } = *self;
        // the edges are seen in the hemisphere about the axis; a reserve keeps the slopes below finite
        outline.take(within, |v| v);
        outline.clip(axis, zero)?;
        if outline.is_empty() {
            return Ok(zero);
        }
        let sin_squared = sin * sin;
        let up = axis.dot(normal);
        // one frame for all edges, so that what is moved stays closed
        let Frame { s, t, .. } = Frame::new(axis);
        let azimuth = |v: Vec3<R>| Vec2::new(v.dot(s), v.dot(t));
        let turn = |a: Vec2<R>, b: Vec2<R>| (a.x * b.y - a.y * b.x).atan2(a.dot(b));
        let inverse_length = |tan: R| rsqrt(tan.mul_add(tan, one));
        let (mut sum, mut turned) = (zero, zero);
        let (base, corners) = (outline.base(), outline.corners());
        let mut from = base + corners[corners.len() - 1];
        let mut azimuth_from = azimuth(from);
        for &to in corners {
            let to = base + to;
            let azimuth_to = azimuth(to);
            let across = from.cross(to);
            let square = across.length_squared();
            let edge = square.gt(R::lit(1e-36));
            let m = across * rsqrt(R::blend(edge, square, one));
            // the edge's great circle passes the axis at a distance with this sine
            let sine = axis.dot(m);
            let half_squared = sin_squared - sine * sine;
            let near = edge & half_squared.gt(zero);
            if !near.any() {
                turned += turn(azimuth_from, azimuth_to).keep(edge);
                (from, azimuth_from) = (to, azimuth_to);
                continue;
            }
            let cosine_squared = ((one - sine) * (one + sine)).greater(R::lit(1e-12));
            let inverse_cosine = rsqrt(cosine_squared);
            // along the edge's circle, whose point nearest to the axis is in the middle of what is inside
            let along = m.cross(axis) * inverse_cosine;
            let half = half_squared.greater(zero).sqrt();
            // tangents of the angles from the nearest point of the circle
            let slope = half / cos;
            let tangent = |v: Vec3<R>| {
                let forward = v.dot(axis).greater(R::lit(1e-12) * v.max_abs());
                v.dot(along) / (forward * inverse_cosine).greater(R::lit(1e-30))
            };
            let (start, end) = (tangent(from), tangent(to));
            // an edge may be shorter than its rounding, or point backwards
            let meets = near & start.lt(slope) & end.gt(-slope);
            let (low, high) = (start.greater(-slope), end.lesser(slope));
            let angle = (high - low).atan2(low.mul_add(high, one));
            let (from_low, from_high) = (inverse_length(low), inverse_length(high));
            // the axis times the chord, by its parts along the circle and towards the axis
            let chord = high.mul_add(from_high, -(low * from_low));
            let (over_m, over_along) = (m.dot(normal), along.dot(normal));
            let cross =
                sine.mul_add(-up, over_m) * (chord * inverse_cosine) + over_along * (sine * (from_high - from_low));
            sum += (angle * over_m - cos * cross).keep(meets);
            // the parts outside, along the circle of the cap
            let before = edge & (!meets | start.lt(-slope));
            let after = meets & end.gt(slope);
            let nearest = (axis - m * sine) * (cos * inverse_cosine);
            let reach = along * half;
            let until = Vec2::blend(meets, azimuth(nearest - reach), azimuth_to);
            turned += turn(azimuth_from, until).keep(before);
            if after.any() {
                turned += turn(azimuth(nearest + reach), azimuth_to).keep(after);
            }
            (from, azimuth_from) = (to, azimuth_to);
        }
        sum += sin_squared * turned * up;
        Ok((sum * R::lit(0.5)).abs().keep(outline.some()))
    }
}
