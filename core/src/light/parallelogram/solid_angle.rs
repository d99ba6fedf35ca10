//! Parallelograms by solid angle.

use crate::lanewise::lanewise_by_map;
use crate::light::direction::{DirectionSample, to_unit};
use crate::light::seen::SphericalShape;
use crate::light::triangle::solid_angle::{Planes, SphericalTriangle};
use crate::real::{Real, unit_interval};
use crate::vector::double_word::{compensated_height, cross_dw, sum_dw};
use crate::vector::{Vec2, Vec3};
use crate::warp::Warp;

/// Directions from a point to a parallelogram, uniform in solid angle: for quads; cheaper than
/// [`Rectangle::by_solid_angle`](crate::Rectangle::by_solid_angle), whose strata follow the edges.
///
/// [`Parallelogram::by_solid_angle`](crate::Parallelogram::by_solid_angle) says how.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub struct SphericalParallelogram<R> {
    first: SphericalTriangle<R>,
    second: SphericalTriangle<R>,
}

impl<R> SphericalParallelogram<R> {
    /// Replaces each number x by `f(x)`.
    #[inline(always)]
    pub fn map<S>(self, mut f: impl FnMut(R) -> S) -> SphericalParallelogram<S> {
        SphericalParallelogram { first: self.first.map(&mut f), second: self.second.map(&mut f) }
    }
}

lanewise_by_map!(SphericalParallelogram);

impl<R: Real> SphericalParallelogram<R> {
    /// Prepares for the corners p, p+u, p+u+v, p+v, with p relative to the point; all in one unit of length.
    #[inline(always)]
    pub fn new(p: Vec3<R>, u: Vec3<R>, v: Vec3<R>) -> Self {
        let ([p, u, v, a, b, c], scale) = to_unit([p, u, v, p + u, p + u + v, p + v]);
        // p is exact, the other corners are rounded sums: form the planes from p, u and v
        let (pu, pv, normal) = (cross_dw(p, u), cross_dw(p, v), cross_dw(v, u));
        let volume = compensated_height(p, normal);
        let rounded = |[n, rest]: [Vec3<R>; 2]| n + rest;
        let diagonal = rounded(sum_dw(pu, pv));
        let against = normal.map(|n| -n);
        // (p+u)×v and u×(p+v)
        let (far_u, far_v) = (sum_dw(pv, against), sum_dw(pu.map(|n| -n), against));
        let normal = rounded(normal);
        let first = Planes { n01: -rounded(pu), n02: rounded(far_u), n12: diagonal, normal, volume, edge: u + v };
        let second = Planes { n01: -diagonal, n02: rounded(far_v), n12: rounded(pv), normal, volume, edge: v };
        let first = SphericalTriangle::prepare([a, p, b], first, || first.n12, scale);
        let second = SphericalTriangle::prepare([b, p, c], second, || second.n12, scale);
        // neither alone has the density of both
        let both = first.solid_angle().gt(R::lit(0.0)) & second.solid_angle().gt(R::lit(0.0));
        Self { first: first.keep(both), second: second.keep(both) }
    }
    /// The triangle for `u`, the `u` within it, 1−u₀ there, since the difference would have few digits near the end of the second, and
    /// whether it is the first.
    #[inline(always)]
    fn branch(&self, u: Vec2<R>) -> (SphericalTriangle<R>, Vec2<R>, R, R::Mask) {
        let (one, zero) = (R::lit(1.0), R::lit(0.0));
        let (a, b) = (self.first.solid_angle(), self.second.solid_angle());
        let (swept, left) = (u.x * (a + b), (one - u.x) * (a + b));
        let first = swept.lt(a);
        let whole = R::blend(first, a, b);
        let inverse = one / R::blend(whole.gt(zero), whole, one);
        let x = unit_interval(R::blend(first, swept, b - left) * inverse);
        let rest = (R::blend(first, a - swept, left) * inverse).clamped(zero, one);
        (SphericalTriangle::blend(first, self.first, self.second), Vec2::new(x, u.y), rest, first)
    }
}

impl<R: Real> SphericalShape<R> for SphericalParallelogram<R> {
    #[inline(always)]
    fn sample_point(&self, u: Vec2<R>) -> (DirectionSample<R>, Option<Vec2<R>>) {
        let (triangle, u, rest, first) = self.branch(u);
        let (sample, [b0, _, b2]) = triangle.sample_point_from(u, rest);
        // the corners are p+u, p, p+u+v or p+u+v, p, p+v
        let both = (b0 + b2).lesser(R::lit(1.0));
        (sample, Some(Vec2::new(R::blend(first, both, b0), R::blend(first, b2, both))))
    }
    #[inline(always)]
    fn solid_angle(&self) -> R {
        self.first.solid_angle() + self.second.solid_angle()
    }
    #[inline(always)]
    fn in_front(&self) -> R::Mask {
        // both triangles run p+u → p → p+u+v, the other way round
        !self.first.in_front()
    }
}

impl<R: Real> Warp<R> for SphericalParallelogram<R> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        let (triangle, u, rest, _) = self.branch(u);
        triangle.sample_from(u, rest)
    }
    /// The pdf per steradian; 0 for a direction that misses the parallelogram.
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        let (first, second) = (&self.first, &self.second);
        let inside = first.within_v0_v1(w) & first.within_v2_v0(w) & second.within_v2_v0(w) & second.within_v1_v2(w);
        self.uniform_pdf().keep(inside & first.ahead(w))
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let (a, b) = (self.first.solid_angle(), self.second.solid_angle());
        // next to an outer edge, a direction may seem to be on the other side of the diagonal, if all three lie in one plane
        let away = self.second.away_from_v0(w);
        let (start, end) = (self.first.beside_v0(w) & away, self.second.beside_v2(w) & away);
        let first = (self.second.beyond_v0_v1(w) | start) & !end;
        let ((u, moved), (v, _)) = (self.first.locate(w), self.second.locate(w));
        let swept = R::blend(first, u.x * a, v.x.mul_add(b, a));
        let sum = a + b;
        let inverse = R::lit(1.0) / R::blend(sum.gt(R::lit(0.0)), sum, R::lit(1.0));
        let (x, y) = (unit_interval(swept * inverse), R::blend(first, u.y, v.y));
        let steep = self.first.steep(sum) | self.second.steep(sum);
        R::where_any(steep, Vec2::new(x, y), || {
            let (triangle, at, rest, _) = self.branch(Vec2::new(x, y));
            let x = unit_interval(triangle.area_beyond(at.x, rest, w, sum) * inverse + x);
            let (triangle, at, rest, _) = self.branch(Vec2::new(x, y));
            Vec2::new(x, triangle.share_of_arc(at.x, rest, moved))
        })
    }
}
