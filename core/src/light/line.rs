//! Line lights.

pub(super) mod angle;
pub(super) mod projected;

use super::bound::{LightBound, power, wide};
use super::direction::{DirectionSample, to_unit};
use super::sample::{LightSample, direction_to, solid_angle_pdf};
use super::sampler::LightSampler;
use crate::lanewise::lanewise;
use crate::math::quotient;
use crate::real::{Mask, Real, unit_interval};
use crate::vector::{Vec2, Vec3};
use angle::SphericalSegment;
use core::f64::consts::PI;
use projected::ProjectedSegment;

lanewise! {
    /// A line light: a cylinder so thin that only its width times its radiance counts, which emits in all directions.
    ///
    /// Its samplers use `u.x` alone. Their pdf is in the measure sinγ ds/r² (γ from the line, s along it: steradians per unit of width), so
    /// that the estimator is `f · L · width · cosθ · weight()`; it compares techniques of this light with each other. No other technique
    /// can hit the line, so `delta` holds and [`hit`](LightSampler::hit) always misses. A line of length 0, or a point on the line,
    /// gives pdf 0. Surface coordinates: the part of the length, and 0.
    ///
    /// The pdf of a sample is accurate to 1e−6 relative; that of a direction to 1.9e−6/sinγ, since a rounded
    /// direction determines the point no better.
    pub struct Line {
        /// One end, in the coordinates of the scene.
        pub start: Vec3<R>,
        /// From there to the other end.
        pub edge: Vec3<R>,
    }
}

impl<R: Real> Line<R> {
    /// The line from `start` to `start + edge`.
    #[inline(always)]
    pub fn new(start: Vec3<R>, edge: Vec3<R>) -> Self {
        Self { start, edge }
    }
    /// Uniform over the length, seen from the point `p`: density 1/length per unit of length, pdf r²/(length · sinγ).
    #[inline(always)]
    pub fn by_length(&self, p: Vec3<R>) -> LineByLength<R> {
        LineByLength { line: PlacedLine::new(self.start - p, self.edge) }
    }
    /// Uniform over the angle α that the line subtends at the point `p`: better than by length wherever the point is
    /// near. Density 1/α per radian, pdf r/α.
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
    #[inline(always)]
    pub fn by_angle(&self, p: Vec3<R>) -> LineByAngle<R> {
        LineByAngle {
            line: PlacedLine::new(self.start - p, self.edge),
            arc: SphericalSegment::new(self.start - p, self.edge),
        }
    }
    /// By projected solid angle above the horizon of the unit normal `n` at the point `p`: on an unoccluded diffuse
    /// surface every sample has the same value. pdf 0 where nothing of the line is above the horizon.
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
    #[inline(always)]
    pub fn by_projected_solid_angle(&self, p: Vec3<R>, n: Vec3<R>) -> LineByProjectedSolidAngle<R> {
        let arc = ProjectedSegment::new(self.start - p, self.edge, n);
        LineByProjectedSolidAngle { line: PlacedLine::new(self.start - p, self.edge), arc }
    }
}

impl<R: Real<Scalar = R>> Line<R> {
    /// What it can contribute with this product of radiance and width, in the unit of its length.
    #[must_use]
    pub fn bound(&self, radiance_times_width: R) -> LightBound {
        let edge = wide(self.edge);
        let bound = LightBound::around(wide(self.start), &[Vec3::default(), edge], edge * 0.5);
        LightBound { power: power(edge.length() * PI * PI * radiance_times_width.lane_f64(0)), ..bound }
    }
}

lanewise! {
    /// A line relative to the shading point.
    struct PlacedLine {
        end: Vec3<R>,
        edge: Vec3<R>,
        /// Unit vector at right angles from the shading point to the line, and the distance along it.
        foot: Vec3<R>,
        height: R,
        length: R,
    }
}

impl<R: Real> PlacedLine<R> {
    #[inline(always)]
    fn new(end: Vec3<R>, edge: Vec3<R>) -> Self {
        let ([a, e], scale) = to_unit([end, edge]);
        let (along, length) = e.unit_and_length();
        let (across, area) = a.cross(e).unit_and_length();
        let height = quotient(area, length) / scale;
        Self { end, edge, foot: along.cross(across), height, length: length / scale }
    }
    /// Distance to the line in a direction of the plane through it.
    #[inline(always)]
    fn reach(&self, w: Vec3<R>) -> R {
        quotient(self.height, w.dot(self.foot)).greater(R::lit(0.0))
    }
    #[inline(always)]
    fn sample(&self, DirectionSample { direction, distance }: DirectionSample<R>, pdf: R) -> LightSample<R> {
        let offset = (direction * distance - self.end).dot(self.edge * (R::lit(1.0) / self.scale()));
        let along = quotient(offset, self.length * (self.length / self.scale()));
        LightSample {
            direction,
            distance,
            pdf,
            normal: -self.foot,
            uv: Vec2::new(along.clamped(R::lit(0.0), R::lit(1.0)), R::lit(0.0)),
            emits: pdf.gt(R::lit(0.0)),
            delta: R::Mask::splat(true),
        }
    }
    #[inline(always)]
    fn scale(&self) -> R {
        R::lit(1.0) / self.length.pow2_scale()
    }
}

/// A pdf where it is finite, 0 elsewhere.
#[inline(always)]
fn finite<R: Real>(pdf: R) -> R {
    pdf.keep(pdf.lt(R::lit(1e37)))
}

macro_rules! line_sampler {
    ($(#[$doc:meta])* $name:ident $({ $arc:ident: $kind:ident })?, |$this:ident, $u:ident| $draw:expr, |$self:ident, $w:ident, $reach:ident| $pdf:expr, $invert:expr) => {
        lanewise! {
            $(#[$doc])*
            pub struct $name {
                line: PlacedLine<R>,
                $($arc: $kind<R>,)?
            }
        }
        impl<R: Real> LightSampler<R> for $name<R> {
            #[inline(always)]
            fn sample(&self, u: Vec2<R>) -> LightSample<R> {
                let ($this, $u) = (self, u.x);
                let drawn: DirectionSample<R> = $draw;
                let ($self, $w, $reach) = (self, drawn.direction, drawn.distance);
                self.line.sample(drawn, finite($pdf)).drawn_from(Vec2::new(u.x, u.x))
            }
            #[inline(always)]
            fn pdf(&self, w: Vec3<R>) -> R {
                let ($self, $w, $reach) = (self, w, self.line.reach(w));
                finite($pdf)
            }
            #[inline(always)]
            fn invert(&self, w: Vec3<R>) -> Vec2<R> {
                let ($self, $w) = (self, w);
                Vec2::new(unit_interval($invert), R::lit(0.0))
            }
            #[inline(always)]
            fn hit(&self, w: Vec3<R>) -> LightSample<R> {
                LightSample::miss(w)
            }
        }
    };
}
line_sampler!(
    /// A [`Line`] sampled by length from a point.
    LineByLength,
    |s, u| direction_to(s.line.edge.mul_add(u, s.line.end)),
    |s, w, distance| solid_angle_pdf(distance, w.dot(s.line.foot) * s.line.length),
    s.line.sample(DirectionSample { direction: w, distance: s.line.reach(w) }, R::lit(0.0)).uv.x
);
line_sampler!(
    /// A [`Line`] sampled by angle from a point.
    LineByAngle { arc: SphericalSegment },
    |s, u| s.arc.sample_direction(u),
    |s, w, distance| s.arc.pdf(w) * distance,
    s.arc.invert(w)
);
line_sampler!(
    /// A [`Line`] sampled by projected solid angle from a point on a surface.
    LineByProjectedSolidAngle { arc: ProjectedSegment },
    |s, u| s.arc.sample_direction(u),
    |s, w, distance| s.arc.pdf(w) * distance,
    s.arc.invert(w)
);

impl<R: Real> LineByAngle<R> {
    /// The angle α that the line subtends, in radians.
    #[inline(always)]
    pub fn angle(&self) -> R {
        self.arc.angle()
    }
}
