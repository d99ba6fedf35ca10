//! Line segments by angle, and by projected solid angle.

use super::direction::{DirectionSample, above_horizon};
use super::double_word::{dot_dw, rounded_sum, unit_normal};
use super::projected_cap::segment;
use crate::lanewise::lanewise;
use crate::math::ratio;
use crate::real::{Real, unit_interval};
use crate::vector::Vec3;
use crate::warp::{Linear, Warp1};
use core::f64::consts::{FRAC_1_PI, FRAC_PI_2};

/// Angle by which the rounding of its direction may move a sample out of the segment: 4 ulp of a component near 1.
const LINE_SLACK: f64 = 4.0 / 16_777_216.0;
const TURNS: f64 = 0.5 * FRAC_1_PI;

/// Scales both by a power of two, and returns that scale; both become 0 if a coordinate is infinite.
#[inline(always)]
fn common_scale<R: Real>(a: Vec3<R>, edge: Vec3<R>) -> (Vec3<R>, Vec3<R>, R) {
    let reach = a.max_abs().greater(edge.max_abs());
    let finite = reach.lt(R::lit(f64::INFINITY));
    let scale = reach.keep(finite).pow2_scale();
    (a.keep(finite) * scale, edge.keep(finite) * scale, scale)
}

lanewise! {
    /// Directions from a point to a line segment, uniform in angle: for thin tubes, and for equiangular sampling of a ray about
    /// a point light. A one-dimensional [`Warp`](crate::Warp).
    ///
    /// Call `SphericalSegment::new(a, edge)` with `a` relative to the point, then `sample_direction`. A point on the line of
    /// the segment gives pdf 0.
    ///
    /// - Formula: θ = uα from the first end, where α = atan2(|a×e|, a·(a+e)) is the angle that the segment subtends; the
    ///   direction is a/|a| cosθ + t sinθ, t = (a×e)/|a×e| × a/|a|; the distance is |a×b|/(|a| sinθ + |b| sin(α−θ)), where
    ///   nothing cancels.
    /// - Domain: u in [0, 1); any segment.
    /// - Density: the pdf is 1/α per radian, in the plane of point and segment, between the ends (and within 4 ulp beyond), 0
    ///   elsewhere. A direction off that plane counts as its projection onto it. Per unit of length, at the distance r, the pdf
    ///   is sinγ/r times that, with γ the angle between direction and segment.
    /// - Degenerate input: the point on the line of the segment (|a×e| < 1e−30 of the squared greatest coordinate), a length of
    ///   0, or α < 1e−30 gives pdf 0.
    /// - Greatest error: direction 3e−7; pdf 3.1e−7 relative; distance 4e−7 relative, over sinγ.
    /// - Source: Kulla and Fajardo, "Importance Sampling Techniques for Path Tracing in Participating Media", EGSR 2012, 4.1,
    ///   by angles at the ends instead of the foot of the perpendicular.
    pub struct SphericalSegment {
        /// unit direction a/|a| of the first end
        from: Vec3<R>,
        /// unit tangent there, towards the other end
        from_turn: Vec3<R>,
        /// unit direction b/|b| of the second end
        to: Vec3<R>,
        /// unit tangent there, towards the first end
        to_turn: Vec3<R>,
        /// α in radians
        angle: R,
        /// |a|, in units of `unit`
        from_distance: R,
        /// |b|, in units of `unit`
        to_distance: R,
        /// |a×b|, in units of `unit`²
        area: R,
        /// unit of the lengths above, a power of two
        unit: R,
    }
}

impl<R: Real> SphericalSegment<R> {
    /// Prepares for the segment from `a` to `a + edge`, with `a` relative to the point; both in one unit of length.
    #[inline(always)]
    pub fn new(a: Vec3<R>, edge: Vec3<R>) -> Self {
        let (a, edge, scale) = common_scale(a, edge);
        let b = a + edge;
        let (normal, area) = a.cross(edge).unit_and_length();
        let ((from, from_distance), (to, to_distance)) = (a.unit_and_length(), b.unit_and_length());
        Self::between([from, to], [from_distance, to_distance], normal, area, R::lit(1.0) / scale)
    }
    #[inline(always)]
    fn between(ends: [Vec3<R>; 2], distances: [R; 2], normal: Vec3<R>, area: R, unit: R) -> Self {
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
    fn at(&self, theta: R, rest: R) -> DirectionSample<R> {
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
    fn between_ends(&self, w: Vec3<R>) -> R::Mask {
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
    fn angles(&self, w: Vec3<R>) -> (R, R) {
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

lanewise! {
    /// One end of a [`ProjectedSegment`], with the coefficients of the irradiance ∫p up to the angle x from it.
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
    /// surfaces. In one dimension, as [`SphericalSegment`].
    ///
    /// Call `ProjectedSegment::new(a, edge, normal)` with `a` relative to the point, then `sample_direction`. A point on the
    /// line of the segment, or a segment below the horizon, gives pdf 0.
    ///
    /// A thin cylinder of constant radiance gives the irradiance cosθ sinγ ds/r² per unit of its width, with θ from the
    /// surface's normal and γ from the line. In terms of the angle x at the point, that is sinγ cosθ dx over the distance of
    /// the point from the line: a product of two sines.
    ///
    /// - Formula: from the first end, p(x) = sinγ cosθ = p₀ + ½p₀' sin 2x − c sin²x; ∫p = p₀x + ½p₀' sin²x − ½c(x − sinx cosx),
    ///   with p₀ = sinγ₀ cosθ₀ and c = p₀ + cosγ₀ ∂cosθ/∂x. Each half counts from its own end. Three steps of Laguerre's method
    ///   for cubic polynomials (four in double precision) solve ∫p = u(A+B), where A and B are the integrals over the two
    ///   halves; they leave 7e−10 of α.
    /// - Domain: u in [0, 1); any segment, with a normal of any length. The segment is first clipped to the horizon, where its
    ///   end follows from the normals of both planes.
    /// - Density: the pdf is sinγ cosθ/∫p per radian, in the plane of point and segment, between the ends and above the horizon
    ///   (and within 4 ulp beyond), 0 elsewhere. A direction off that plane counts as its projection onto it.
    /// - Degenerate input: the point on the line of the segment, the whole segment at or below the horizon, or a length of 0
    ///   gives pdf 0.
    /// - Greatest error: direction 4e−7, besides 4 steps of 2⁻²⁴ in u; ∫p 1.1e−6 relative, over the lesser sine of the angles
    ///   between the line and the directions of its ends, and 2e−14 over the sine of the higher end's elevation.
    /// - Source: Peters, "BRDF Importance Sampling for Linear Lights", HPG 2021, for the density; the integral from an end and
    ///   its inverse are derived here.
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
        let (a, edge, scale) = common_scale(a, edge);
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
