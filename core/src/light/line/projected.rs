//! Lines by projected solid angle.

use super::angle::{SphericalSegment, TURNS};
use crate::lanewise::lanewise;
use crate::light::direction::{DirectionSample, above_horizon, to_unit};
use crate::light::sphere::projected::segment;
use crate::math::ratio;
use crate::real::{Real, unit_interval};
use crate::vector::Vec3;
use crate::vector::double_word::{dot_dw, rounded_sum, unit_normal};
use crate::warp::Linear;
use core::f64::consts::FRAC_PI_2;

lanewise! {
    /// One end of a segment, with the coefficients of the irradiance ∫p up to the angle x from it.
    struct End {
        /// p₀ = sinγ₀ cosθ₀
        density: R,
        /// p₀'
        slope: R,
        /// c = p₀ + cosγ₀ ∂cosθ/∂x
        bend: R,
        /// ∫p over the half of the segment next to this end
        half: R,
    }
}

impl<R: Real> End<R> {
    /// The irradiance ∫p up to the angle x ≤ π/2, p(x), and p'(x).
    #[inline(always)]
    fn irradiance(&self, x: R) -> (R, R, R) {
        let (s, c) = (x * R::lit(TURNS)).sin_cos_turns();
        let (ss, sc) = (s * s, s * c);
        let half = R::lit(0.5);
        let sum = self.density.mul_add(x, half * (self.slope * ss - self.bend * segment(x)));
        let value = self.density + (self.slope * sc - self.bend * ss);
        let slope = self.slope.mul_add((c - s) * (c + s), -(self.bend * (sc + sc)));
        (sum, value.greater(R::lit(0.0)), slope)
    }
    /// The angle x ≤ `most` up to which the irradiance is `part`: Laguerre's method, started as if p were linear.
    #[inline(always)]
    fn invert(&self, part: R, most: R) -> R {
        let zero = R::lit(0.0);
        let (_, middle, _) = self.irradiance(most);
        let mut x = Linear { a: self.density, b: middle }.sample(unit_interval(ratio(part, self.half))) * most;
        let steps = if R::DOUBLE { 4 } else { 3 };
        for _ in 0..steps {
            let (sum, value, slope) = self.irradiance(x);
            let off = sum - part;
            let root = (R::lit(4.0) * value * value - R::lit(6.0) * off * slope).greater(zero).sqrt();
            x = (x - ratio(off * R::lit(3.0), value + root)).clamped(zero, most);
        }
        x
    }
}

lanewise! {
    /// Directions from a point on a surface to a thin line light, by projected solid angle: for thin tubes over diffuse
    /// surfaces. In one dimension.
    ///
    /// [`Line::by_projected_solid_angle`](crate::Line::by_projected_solid_angle) says how.
    pub struct ProjectedSegment {
        /// the part above the horizon
        arc: SphericalSegment<R>,
        near: End<R>,
        far: End<R>,
        /// ∫p over both halves
        whole: R,
        /// unit normal of the surface
        normal: Vec3<R>,
        /// unit vector from the point to the line, perpendicular to it
        foot: Vec3<R>,
    }
}

impl<R: Real> ProjectedSegment<R> {
    /// Prepares for the segment from `a` to `a + edge`, with `a` relative to the point, on a surface with the normal `normal`
    /// (of any length).
    #[inline(always)]
    pub fn new(a: Vec3<R>, edge: Vec3<R>, normal: Vec3<R>) -> Self {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let ([a, edge], scale) = to_unit([a, edge]);
        let b = a + edge;
        let (normal, long, shrink) = unit_normal(normal);
        let (across, area) = a.cross(edge).unit_and_length();
        let (along, length) = edge.unit_and_length();
        let ((a_way, a_distance), (b_way, b_distance)) = (a.unit_and_length(), b.unit_and_length());

        // heights over the horizon are small differences, and the second is a difference of such
        let (from, up) = (dot_dw(long, a), dot_dw(long, edge));
        let heights = [from[0] + from[1], up[0] + up[1], rounded_sum(from, up)];
        let [low, rise, high] = heights.map(|z| z * shrink);
        let (enters, leaves) = (low.lt(zero), high.lt(zero));
        let (level, sine) = normal.cross(across).unit_and_length();
        // the end on the horizon: its place is a small difference where the line passes near the point; there, the angles to
        // the ends determine the distance
        let height = ratio(area, length);
        let farthest = a_distance.greater(b_distance);
        let (place, there) = edge.mul_add(ratio(low.abs(), rise.abs()).lesser(one), a).unit_and_length();
        let steep = (sine * farthest).ge(there);
        let clip = |below: R::Mask, way: Vec3<R>, distance: R, level: Vec3<R>| {
            let level = Vec3::blend(steep, level, place);
            let sum = a_distance * level.dot(across.cross(a_way)).greater(zero)
                + b_distance * level.dot(b_way.cross(across)).greater(zero);
            let by_angles = ratio(area, sum).lesser(farthest);
            let distance_there = R::blend(height.le(R::lit(4.0) * there * there), there, by_angles);
            (Vec3::blend(below, level, way), R::blend(below, distance_there, distance))
        };
        let (from, from_distance) = clip(enters, a_way, a_distance, level);
        let (to, to_distance) = clip(leaves, b_way, b_distance, -level);
        let lifted = !(enters & leaves);
        let above = R::blend(enters, high, low);
        let part = R::blend(enters | leaves, ratio(above.abs(), rise.abs()).lesser(one), one);
        let arc = SphericalSegment::between([from, to], [from_distance, to_distance], across, area * part, one / scale);

        let cos = |below: R::Mask, height: R, distance: R| ratio(height.greater(zero), distance).keep(!below);
        let (from_cos, to_cos) = (cos(enters, low, from_distance), cos(leaves, high, to_distance));
        // the slope of the cosine: near the horizon from the heights, elsewhere from the normal
        let (sin, level) = (ratio(area * part, from_distance * to_distance), from.dot(to));
        let flat = (from_cos + to_cos).lt(sin);
        // to the accuracy of the nearer end
        let most = ratio(from_distance.lesser(to_distance), farthest);
        let end = |way: Vec3<R>, turn: Vec3<R>, along: Vec3<R>, distance: R, cos: R, other: R| {
            let sine = ratio(height, distance).lesser(one);
            let cosine = along.dot(way);
            let rise = normal.dot(turn);
            let by_heights = ratio((-cos).mul_add(level, other), sin);
            let rise = R::blend(flat & rise.abs().lt(most), by_heights, rise);
            let density = sine * cos;
            let end = End { density, slope: sine * rise - cosine * cos, bend: density + cosine * rise, half: zero };
            let (half, ..) = end.irradiance(arc.angle * R::lit(0.5));
            End { half: half.greater(zero), ..end }
        };
        let near = end(from, arc.from_turn, along, from_distance, from_cos, to_cos);
        let far = end(to, arc.to_turn, -along, to_distance, to_cos, from_cos);
        let whole = near.half + far.half;
        Self {
            arc,
            near,
            far,
            whole: whole.keep(lifted & whole.gt(R::lit(1e-30)) & arc.angle.gt(zero)),
            normal,
            foot: along.cross(across),
        }
    }

    /// The irradiance of the segment per unit of its radiance and width, times the distance of the point from the line: ∫p; 0
    /// where it is degenerate.
    #[inline(always)]
    pub fn irradiance(&self) -> R {
        self.whole
    }
    /// Maps `u` to a direction and the distance to the segment along it.
    #[inline(always)]
    pub fn sample_direction(&self, u: R) -> DirectionSample<R> {
        let (one, half) = (R::lit(1.0), R::lit(0.5));
        let part = u * self.whole;
        let first = part.le(self.near.half);
        let pick = |a: R, b: R| R::blend(first, a, b);
        let end = End {
            density: pick(self.near.density, self.far.density),
            slope: pick(self.near.slope, self.far.slope),
            bend: pick(self.near.bend, self.far.bend),
            half: pick(self.near.half, self.far.half),
        };
        let x = end.invert(pick(part, (one - u) * self.whole), self.arc.angle * half);
        let rest = self.arc.angle - x;
        let DirectionSample { direction, distance } = self.arc.at(pick(x, rest), pick(rest, x));
        DirectionSample { direction: above_horizon(direction, self.normal), distance }
    }
    /// Maps `u` in [0, 1) to a direction.
    #[inline(always)]
    pub fn sample(&self, u: R) -> Vec3<R> {
        self.sample_direction(u).direction
    }
    /// The pdf of a direction, per radian; 0 beyond the ends and below the horizon.
    #[inline(always)]
    pub fn pdf(&self, w: Vec3<R>) -> R {
        let zero = R::lit(0.0);
        let value = w.dot(self.foot).greater(zero) * w.dot(self.normal).greater(zero);
        ratio(value, self.whole).keep(self.arc.between_ends(w))
    }
    /// Returns the `u` in [0, 1) that [`sample`](Self::sample) maps to the direction; for one beyond the ends, some value in
    /// [0, 1).
    #[inline(always)]
    pub fn invert(&self, w: Vec3<R>) -> R {
        let (x, y) = self.arc.angles(w);
        let most = (self.arc.angle * R::lit(0.5)).lesser(R::lit(FRAC_PI_2));
        let (near, ..) = self.near.irradiance(x.lesser(most));
        let (far, ..) = self.far.irradiance(y.lesser(most));
        let (u, v) = (ratio(near, self.whole), ratio(far, self.whole));
        unit_interval(R::blend(x.le(y), u, R::lit(1.0) - v))
    }
}
