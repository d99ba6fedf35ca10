//! Convex polygons by solid angle.

use super::corners::PlacedCorners;
use crate::lanewise::lanewise_by_map;
use crate::light::direction::DirectionSample;
use crate::light::seen::SphericalShape;
use crate::light::triangle::solid_angle::{Planes, SphericalTriangle};
use crate::real::{Mask, Real, unit_interval};
use crate::vector::double_word::{cross_sums, height_dw};
use crate::vector::{Vec2, Vec3};
use crate::warp::Warp;

/// Directions from a point to a convex polygon of N corners, 3 ≤ N ≤ 8, uniform in solid angle.
///
/// [`Polygon::by_solid_angle`](crate::Polygon::by_solid_angle) says how.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct SphericalPolygon<R, const N: usize> {
    /// The N − 2 triangles; the last two entries are unused.
    fan: [SphericalTriangle<R>; N],
    solid_angle: R,
}

impl<R, const N: usize> SphericalPolygon<R, N> {
    /// Replaces each number x by `f(x)`.
    #[inline(always)]
    pub fn map<S>(self, mut f: impl FnMut(R) -> S) -> SphericalPolygon<S, N> {
        SphericalPolygon { fan: self.fan.map(|triangle| triangle.map(&mut f)), solid_angle: f(self.solid_angle) }
    }
}

lanewise_by_map!(SphericalPolygon, N);

impl<R: Real, const N: usize> SphericalPolygon<R, N> {
    const TRIANGLES: usize = {
        assert!(N >= 3 && N <= 8, "a polygon has 3 to 8 corners");
        N - 2
    };
    /// Prepares for corners and the point `p`, in any common coordinates.
    ///
    /// Take this for a small and far polygon: corners relative to the point are rounded, and would lose its shape.
    #[inline(always)]
    pub fn seen_from(corners: [Vec3<R>; N], p: Vec3<R>) -> Self {
        let placed = PlacedCorners::new(corners, p);
        let mut fan = [SphericalTriangle::default(); N];
        let mut solid_angle = R::lit(0.0);
        for (i, triangle) in fan[..Self::TRIANGLES].iter_mut().enumerate() {
            *triangle = Self::triangle(&placed, i + 1, i + 2);
            solid_angle += triangle.solid_angle();
        }
        Self { fan, solid_angle }
    }
    /// The triangle of the fan that sweeps about the first corner from one corner to another.
    #[inline(always)]
    fn triangle(placed: &PlacedCorners<R, N>, from: usize, to: usize) -> SphericalTriangle<R> {
        let PlacedCorners { corners, edges, spokes, scale } = placed;
        let [[a, rest], [p, _], [b, _]] = [from, 0, to].map(|k| corners[k]);
        // about a corner between neighbours, since the shorter edges are rounded less
        let side = placed.side(from, to);
        let normal = cross_sums(edges[from].map(|e| -e), side);
        let [sum, more] = height_dw(a, normal);
        let volume = sum + (more + rest.dot(normal[0]));
        let (n01, n12) = (spokes[from].map(|n| -n), spokes[to]);
        // a×b = a×(b−a): the difference has the shape of a small polygon, and the corner the place of one that is near
        let n02 = cross_sums(corners[from], side);
        let [n01, n02, n12, normal] = [n01, n02, n12, normal].map(|[n, rest]| n + rest);
        let planes = Planes { n01, n02, n12, normal, volume, edge: edges[to][0] };
        SphericalTriangle::prepare([a, p, b], planes, || n12, *scale)
    }
    /// The triangle for `u`, the `u` within it, and 1−u₀ there, each computed from the nearer end of the fan.
    #[inline(always)]
    fn branch(&self, u: Vec2<R>) -> (SphericalTriangle<R>, Vec2<R>, R) {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let (swept, left) = (u.x * self.solid_angle, (one - u.x) * self.solid_angle);
        // solid angles of all later triangles
        let mut behind = [zero; N];
        for i in (1..Self::TRIANGLES).rev() {
            behind[i - 1] = behind[i] + self.fan[i].solid_angle();
        }
        let mut chosen = self.fan[0];
        let (mut before, mut after, mut sum) = (zero, behind[0], self.fan[0].solid_angle());
        for (i, triangle) in self.fan[..Self::TRIANGLES].iter().enumerate().skip(1) {
            let later = swept.ge(sum) & triangle.solid_angle().gt(zero);
            chosen = SphericalTriangle::blend(later, *triangle, chosen);
            before = R::blend(later, sum, before);
            after = R::blend(later, behind[i], after);
            sum += triangle.solid_angle();
        }
        let whole = chosen.solid_angle();
        let inverse = one / R::blend(whole.gt(zero), whole, one);
        let late = u.x.gt(R::lit(0.5));
        let (from, to) = ((swept - before) * inverse, (left - after) * inverse);
        let x = unit_interval(R::blend(late, one - to, from));
        (chosen, Vec2::new(x, u.y), R::blend(late, to, one - from).clamped(zero, one))
    }
}

impl<R: Real, const N: usize> SphericalShape<R> for SphericalPolygon<R, N> {
    #[inline(always)]
    fn sample_point(&self, u: Vec2<R>) -> (DirectionSample<R>, Option<Vec2<R>>) {
        let (triangle, u, rest) = self.branch(u);
        (triangle.sample_point_from(u, rest).0, None)
    }
    #[inline(always)]
    fn solid_angle(&self) -> R {
        self.solid_angle
    }
    #[inline(always)]
    fn in_front(&self) -> R::Mask {
        // each triangle runs the other way round; skip those without area
        let mut front = R::Mask::splat(false);
        for triangle in &self.fan[..Self::TRIANGLES] {
            front = front | (!triangle.in_front() & triangle.solid_angle().gt(R::lit(0.0)));
        }
        front
    }
}

impl<R: Real, const N: usize> Warp<R> for SphericalPolygon<R, N> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        let (triangle, u, rest) = self.branch(u);
        triangle.sample_from(u, rest)
    }
    /// The pdf per steradian; 0 for a direction that misses the polygon.
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        let mut inside = R::Mask::splat(true);
        // the sides at the first corner belong to the first and the last triangle with an area
        let (mut begun, mut last) = (R::Mask::splat(false), R::Mask::splat(true));
        for triangle in &self.fan[..Self::TRIANGLES] {
            let some = triangle.solid_angle().gt(R::lit(0.0));
            let first = begun | triangle.within_v0_v1(w);
            inside = inside & (!some | (first & triangle.within_v2_v0(w) & triangle.ahead(w)));
            last = (some & triangle.within_v1_v2(w)) | (!some & last);
            begun = begun | some;
        }
        self.uniform_pdf().keep(inside & last)
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let zero = R::lit(0.0);
        let mut chosen = self.fan[0];
        let (mut before, mut sum) = (zero, self.fan[0].solid_angle());
        // next to an outer edge, a direction may seem to be on the other side of one within, if both lie in one plane
        let (start, end) = (self.fan[0].beside_v0(w), self.fan[Self::TRIANGLES - 1].beside_v2(w));
        for triangle in &self.fan[1..Self::TRIANGLES] {
            let some = triangle.solid_angle().gt(zero);
            let away = triangle.away_from_v0(w);
            let later = some & ((!triangle.beyond_v0_v1(w) & !(start & away)) | (end & away) | sum.le(zero));
            chosen = SphericalTriangle::blend(later, *triangle, chosen);
            before = R::blend(later, sum, before);
            sum += triangle.solid_angle();
        }
        let (u, moved) = chosen.locate(w);
        let some = sum.gt(zero);
        let swept = u.x.mul_add(chosen.solid_angle(), before);
        let inverse = R::lit(1.0) / R::blend(some, sum, R::lit(1.0));
        let x = unit_interval(swept * inverse);
        // rounding may move u₀ into the next triangle
        let mut steep = R::Mask::splat(false);
        for triangle in &self.fan[..Self::TRIANGLES] {
            steep = steep | triangle.steep(sum);
        }
        R::where_any(steep, Vec2::new(x, u.y), || {
            let (triangle, at, rest) = self.branch(Vec2::new(x, u.y));
            let x = unit_interval(triangle.area_beyond(at.x, rest, w, sum) * inverse + x);
            let (triangle, at, rest) = self.branch(Vec2::new(x, u.y));
            Vec2::new(x, triangle.share_of_arc(at.x, rest, moved))
        })
    }
}
