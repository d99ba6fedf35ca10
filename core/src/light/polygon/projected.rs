//! Convex polygons by projected solid angle.

use super::corners::PlacedCorners;
use crate::lanewise::lanewise_by_map;
use crate::light::direction::{DirectionSample, to_unit};
use crate::light::seen::ProjectedShape;
use crate::light::triangle::projected::found::{after, edge};
use crate::light::triangle::projected::piece::narrowest;
use crate::light::triangle::projected::sector::Sector;
use crate::light::triangle::projected::zenith::{Search, Side, drop_narrow, sectors, surrounds};
use crate::light::triangle::projected::{Given, LEAST_HEIGHT, ProjectedTriangle, ahead, area, lack, with_rest, within};
use crate::math::ratio;
use crate::real::{Blend, Mask, Real, unit_interval};
use crate::vector::double_word::{cross_dw, cross_sums, dot_dw, sum_dw, unit_normal};
use crate::vector::{Vec2, Vec3};
use crate::warp::Warp;

/// Directions from a point to a convex polygon of N corners, 3 ≤ N ≤ 8, above the horizon of a surface, by projected solid
/// angle (pdf ∝ cosine to the normal): for diffuse surfaces where a ray costs more than a sample.
///
/// [`Polygon::by_projected_solid_angle`](crate::Polygon::by_projected_solid_angle) says how.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct ProjectedPolygon<R, const N: usize, const ROOM: usize = N> {
    /// The N − 2 triangles; further entries are unused.
    fan: [ProjectedTriangle<R>; ROOM],
    /// Sums over the triangles: normals, V₀·normal, and Ω⊥
    plane: Vec3<R>,
    volume: R,
    projected: R,
    /// 1 if the polygon contains the zenith and its triangles have the sectors about it, else 0
    central: R,
}

/// A parallelogram: a polygon of two triangles.
pub type ProjectedParallelogram<R> = ProjectedPolygon<R, 4, 2>;

impl<R: Real, const N: usize, const ROOM: usize> Default for ProjectedPolygon<R, N, ROOM> {
    #[inline(always)]
    fn default() -> Self {
        let zero = R::lit(0.0);
        let fan = [ProjectedTriangle::default(); ROOM];
        Self { fan, plane: Vec3::default(), volume: zero, projected: zero, central: zero }
    }
}

impl<R, const N: usize, const ROOM: usize> ProjectedPolygon<R, N, ROOM> {
    /// Replaces each number x by `f(x)`.
    #[inline(always)]
    pub fn map<S>(self, mut f: impl FnMut(R) -> S) -> ProjectedPolygon<S, N, ROOM> {
        ProjectedPolygon {
            fan: self.fan.map(|triangle| triangle.map(&mut f)),
            plane: self.plane.map(&mut f),
            volume: f(self.volume),
            projected: f(self.projected),
            central: f(self.central),
        }
    }
}

lanewise_by_map!(ProjectedPolygon, N, ROOM);

impl<R: Real> ProjectedParallelogram<R> {
    /// Prepares for a parallelogram with the corner `p` relative to the point and the edges `u` and `v` (in one unit of length), on a surface
    /// with the normal `normal` (of any length). The edges give its shape, however small and far it is. It must be empty before.
    #[inline(always)]
    pub(in crate::light) fn prepare_parallelogram(&mut self, p: Vec3<R>, [u, v]: [Vec3<R>; 2], normal: Vec3<R>) {
        let none = Vec3::default();
        let ([p, u, v, a, b, c], scale) = to_unit([p, u, v, p + u, p + v, p + u + v]);
        let both = sum_dw([u, none], [v, none]);
        let (at_a, at_b, at_c) = (lack(a, p, [u, none]), lack(b, p, [v, none]), lack(c, p, both));
        let sides = [[u, none], [v, none], both.map(|e| -e)];
        self.fan[0].prepare_sides([p, a, c], [at_a, at_c], sides, [u, v], normal, scale);
        let sides = [both, [-u, none], [-v, none]];
        self.fan[1].prepare_sides([p, c, b], [at_c, at_b], sides, [u, v], normal, scale);
        let of = |v: Vec3<R>, rest: Vec3<R>, e: Vec3<R>| with_rest(cross_dw(v, e), rest, e);
        let zero = Vec3::default();
        // each from the end of the edge whose rounding error is exact: not from c
        let ends = [[p, zero], [a, at_a], [b, at_b], [p, zero]];
        let [e0, e1, e2, e3] = [u, v, -u, -v];
        let products = [of(p, zero, e0), of(a, at_a, e1), of(b, at_b, e2), of(p, zero, e3)];
        self.join(&[p, a, c, b], &[zero, at_a, at_c, at_b], &ends, &products, normal);
    }
}

impl<R: Real, const N: usize> ProjectedPolygon<R, N> {
    /// Prepares for corners on a surface with the normal `normal` (of any length). It must be empty before.
    #[inline(always)]
    pub(in crate::light) fn prepare_corners(&mut self, placed: &PlacedCorners<R, N>, normal: Vec3<R>) {
        let PlacedCorners { corners, edges, spokes, scale } = placed;
        let last = N - 1;
        let sides: [_; N] = core::array::from_fn(|i| placed.side(i, (i + 1) % N));
        let products = core::array::from_fn(|i| match i {
            0 => spokes[1],
            _ if i == last => spokes[last].map(|n| -n),
            _ => cross_sums(corners[i], sides[i]),
        });
        for i in 0..Self::TRIANGLES {
            let (from, to) = (i + 1, i + 2);
            let three = [corners[0], corners[from], corners[to]];
            let given = Given {
                vertices: three.map(|[v, _]| v),
                rests: three.map(|[_, rest]| Some(rest)),
                edges: [edges[from][0], sides[from][0], -edges[to][0]],
                products: [spokes[from], products[from], spokes[to].map(|n| -n)],
                plane: placed.normal(from, to),
            };
            self.fan[i].prepare(&given, normal, *scale);
        }
        let ends = core::array::from_fn(|i| corners[i % last]);
        self.join(&corners.map(|[v, _]| v), &corners.map(|[_, rest]| rest), &ends, &products, normal);
    }
}

impl<R: Real, const N: usize, const ROOM: usize> ProjectedPolygon<R, N, ROOM> {
    const TRIANGLES: usize = {
        assert!(N >= 3 && N <= 8, "a polygon has 3 to 8 corners");
        assert!(ROOM >= N - 2, "a polygon consists of two triangles less than it has corners");
        N - 2
    };
    /// Joins the triangles of the fan, given the corners with their rounding errors, and for each edge from a corner to the next an
    /// end with its rounding error, and the cross product of both ends.
    #[inline(always)]
    fn join(
        &mut self,
        corners: &[Vec3<R>; N],
        rests: &[Vec3<R>; N],
        ends: &[[Vec3<R>; 2]; N],
        products: &[[Vec3<R>; 2]; N],
        normal: Vec3<R>,
    ) {
        for triangle in &self.fan[..Self::TRIANGLES] {
            self.plane += triangle.plane;
            self.volume += triangle.volume;
            self.projected += triangle.projected;
        }
        // rounding decides the side of a triangle with collinear corners
        let front = self.in_front();
        for triangle in &mut self.fan[..Self::TRIANGLES] {
            triangle.face(front);
        }
        self.about_zenith(corners, rests, ends, products, normal);
        let least = narrowest::<R>() * self.projected;
        for triangle in &mut self.fan[..Self::TRIANGLES] {
            triangle.projected = triangle.projected.keep(triangle.projected.gt(least));
        }
    }
    /// Where the polygon contains the zenith, replaces the sectors of the fan by sectors about the zenith: an edge between two triangles
    /// that passes the zenith closely would bound two slivers in which rounding decides.
    #[inline(always)]
    fn about_zenith(
        &mut self,
        corners: &[Vec3<R>; N],
        rests: &[Vec3<R>; N],
        ends: &[[Vec3<R>; 2]; N],
        products: &[[Vec3<R>; 2]; N],
        normal: Vec3<R>,
    ) {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let (unit, long, shrink) = unit_normal(normal);
        let turn = one.negate_where(self.volume.lt(zero));
        // a quick look, with rounded normals: most polygons do not contain the zenith
        let mut near = R::Mask::splat(true);
        for (i, triangle) in self.fan[..Self::TRIANGLES].iter().enumerate() {
            let inside = |pole: Vec3<R>| within(unit.dot(pole));
            near = near & inside(triangle.pole1);
            if i == 0 {
                near = near & inside(triangle.pole0);
            }
            if i + 1 == Self::TRIANGLES {
                near = near & inside(triangle.pole2);
            }
        }
        let rounded = |[x, rest]: [R; 2]| (x + rest) * shrink;
        let areas = || core::array::from_fn(|i| rounded(area(long, ends[i], products[i])));
        let areas: [R; N] = R::where_any(near, [zero; N], areas);
        let central = near & surrounds(&areas, turn) & self.volume.abs().gt(zero);
        let some = |this: &Self| {
            let heights: [R; N] = core::array::from_fn(|i| {
                let [z, more] = dot_dw(corners[i], long);
                let z = rounded([z, more + rests[i].dot(long)]);
                z.keep(z.abs().gt(R::lit(LEAST_HEIGHT)))
            });
            let sides: [Side<R>; N] = core::array::from_fn(|i| {
                let next = (i + 1) % N;
                Side {
                    a: corners[i],
                    b: corners[next],
                    product: products[i][0] + products[i][1],
                    area: areas[i],
                    heights: [heights[i], heights[next]],
                }
            });
            let (plane, volume) = this.largest();
            (sides, plane, volume, this.projected)
        };
        R::take_any(central, self, some, |this, central, (sides, plane, volume, whole)| {
            let mut sum = zero;
            for (i, triangle) in this.fan[..Self::TRIANGLES].iter_mut().enumerate() {
                let mut pieces = sectors(sides, i, unit, turn);
                drop_narrow(&mut pieces, *whole);
                let [first, second] = &pieces;
                triangle.first.take(central, first);
                triangle.second.take(central, second);
                triangle.central.take(central, &zero);
                let area = first.area + second.area;
                triangle.projected.take(central, &area);
                triangle.plane.take(central, plane);
                triangle.volume.take(central, volume);
                sum += area;
            }
            this.projected.take(central, &sum);
            this.central.take(central, &one);
        });
    }
    /// The plane and the volume of the largest triangle: a sector about the zenith reaches beyond its own, which may even have no area.
    #[inline(always)]
    fn largest(&self) -> (Vec3<R>, R) {
        let (mut plane, mut volume, mut most) = (self.fan[0].plane, self.fan[0].volume, R::lit(0.0));
        for triangle in &self.fan[..Self::TRIANGLES] {
            let size = triangle.plane.length_squared();
            let larger = size.gt(most);
            plane = Vec3::blend(larger, triangle.plane, plane);
            volume = R::blend(larger, triangle.volume, volume);
            most = R::blend(larger, size, most);
        }
        (plane, volume)
    }
    /// The sector for u₀, the share of it before the azimuth, counted from its apex, and the number of its triangle.
    #[inline(always)]
    fn sector_at(&self, x: R) -> (Sector<R>, R, R) {
        let zero = R::lit(0.0);
        let (swept, left) = (x * self.projected, (R::lit(1.0) - x) * self.projected);
        // areas of all later triangles
        let mut behind = [zero; N];
        for i in (1..Self::TRIANGLES).rev() {
            behind[i - 1] = behind[i] + self.fan[i].projected;
        }
        let (mut sector, mut share) = self.fan[0].choose(swept, left - behind[0]);
        let mut chosen = R::lit(0.0);
        let mut sum = self.fan[0].projected;
        for (i, triangle) in self.fan[..Self::TRIANGLES].iter().enumerate().skip(1) {
            let later = triangle.projected.gt(zero) & (swept.ge(sum) | sum.le(zero));
            (sector, share, chosen) = R::where_any(later, (sector, share, chosen), || {
                let (other, rest) = triangle.choose(swept - sum, left - behind[i]);
                (other, rest, R::lit(i as f64))
            });
            sum += triangle.projected;
        }
        (sector, share, chosen)
    }
    #[inline]
    fn draw(&self, u: Vec2<R>, far: bool) -> (Vec3<R>, R) {
        let (sector, share, chosen) = self.sector_at(u.x);
        let mut distance = R::lit(0.0);
        let w = sector.direction(self.fan[0].normal, sector.sweep(share), u.y);
        if far {
            for (i, triangle) in self.fan[..Self::TRIANGLES].iter().enumerate() {
                let here = chosen.ge(R::lit(i as f64 - 0.5)) & chosen.lt(R::lit(i as f64 + 0.5));
                distance = R::blend(here, triangle.distance(w), distance);
            }
        }
        (w, distance)
    }
}

impl<R: Real, const N: usize, const ROOM: usize> ProjectedShape<R> for ProjectedPolygon<R, N, ROOM> {
    #[inline(always)]
    fn sample_direction(&self, u: Vec2<R>) -> DirectionSample<R> {
        let (direction, distance) = self.draw(u, true);
        DirectionSample { direction, distance }
    }
    #[inline(always)]
    fn projected_solid_angle(&self) -> R {
        self.projected
    }
    #[inline(always)]
    fn contains(&self, w: Vec3<R>) -> R::Mask {
        // only the outer sides: those between triangles meet in sharper corners than the polygon has, and allow more beside each
        let mut least = w.dot(self.fan[0].pole0).lesser(w.dot(self.fan[Self::TRIANGLES - 1].pole2));
        for triangle in &self.fan[..Self::TRIANGLES] {
            least = least.lesser(w.dot(triangle.pole1));
        }
        within(least) & ahead(w, self.plane, self.in_front())
    }
    #[inline(always)]
    fn in_front(&self) -> R::Mask {
        self.volume.lt(R::lit(0.0))
    }
}

impl<R: Real, const N: usize, const ROOM: usize> Warp<R> for ProjectedPolygon<R, N, ROOM> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        self.draw(u, false).0
    }
    /// The pdf per steradian; 0 for a direction that misses the polygon or lies below the horizon.
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        self.pdf_at_cosine(w.dot(self.fan[0].normal)).keep(self.contains(w))
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let zero = R::lit(0.0);
        let edge = edge(self.projected);
        let normal = self.fan[0].normal;
        let mut found = self.fan[0].find(w, edge);
        let mut sum = self.fan[0].projected;
        let mut narrow = self.fan[0].is_narrow(self.projected);
        for triangle in &self.fan[1..Self::TRIANGLES] {
            // on the far side of the edge with which this triangle begins
            let later = after([sum, triangle.projected], w.dot(triangle.pole0).ge(zero), edge);
            found = found.or(triangle.find(w, edge), later, [sum, triangle.projected, edge]);
            sum += triangle.projected;
            narrow = narrow | triangle.is_narrow(self.projected);
        }
        let found = R::where_any(self.central.gt(zero), found, || {
            let triangles = self.fan[..Self::TRIANGLES].iter();
            triangles.fold(Search::default(), |search, triangle| triangle.search(search, w, edge)).found
        });
        let found = found.place(normal, w);
        let x = unit_interval(ratio(found.x, self.projected));
        let [y] = R::where_any(narrow, [found.y], || {
            let (sector, share, _) = self.sector_at(x);
            [sector.at_share(normal, share, w, self.projected, found.y)]
        });
        Vec2 { x, y }
    }
}
