//! Convex polygons by area.

use crate::lanewise::lanewise_by_map;
use crate::light::plane::AffinePlane;
use crate::light::sample::direction_to;
use crate::light::surface::{AreaSurface, Surface, SurfaceHit, SurfacePoint};
use crate::real::{Real, unit_interval};
use crate::vector::double_word::compensated_dot;
use crate::vector::{Vec2, Vec3};
use crate::warp::{AreaTriangle, Warp};

/// A convex polygon relative to the shading point. Its surface coordinates are the parts of the edges from the first corner to the
/// second and to the last, clamped to [0, 1].
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct PlacedPolygon<R, const N: usize> {
    origin: Vec3<R>,
    /// From the first corner to each.
    edges: [Vec3<R>; N],
    plane: AffinePlane<R>,
    /// Twice the areas of the triangles of the fan about the first corner, in a unit in which they neither over- nor underflow.
    sizes: [R; N],
    total: R,
    normal: Vec3<R>,
    area: R,
}

impl<R, const N: usize> PlacedPolygon<R, N> {
    /// Replaces each number x by `f(x)`.
    #[inline(always)]
    pub fn map<S>(self, mut f: impl FnMut(R) -> S) -> PlacedPolygon<S, N> {
        PlacedPolygon {
            origin: self.origin.map(&mut f),
            edges: self.edges.map(|edge| edge.map(&mut f)),
            plane: self.plane.map(&mut f),
            sizes: self.sizes.map(&mut f),
            total: f(self.total),
            normal: self.normal.map(&mut f),
            area: f(self.area),
        }
    }
}

lanewise_by_map!(PlacedPolygon, N);

impl<R: Real, const N: usize> PlacedPolygon<R, N> {
    #[inline(always)]
    pub(in crate::light) fn new(corners: [Vec3<R>; N], origin: Vec3<R>) -> Self {
        let (zero, first) = (R::lit(0.0), corners[0]);
        let edges = corners.map(|c| c - first);
        let scale = edges.iter().fold(zero, |most, e| most.greater(e.max_abs())).pow2_scale();
        let (mut sizes, mut total, mut whole) = ([zero; N], zero, Vec3::default());
        for i in 1..N - 1 {
            let twice = (edges[i] * scale).cross(edges[i + 1] * scale);
            whole += twice;
            sizes[i] = twice.length();
            total += sizes[i];
        }
        let origin = first - origin;
        let infinity = R::lit(f64::INFINITY);
        let finite = origin.is_within(infinity) & whole.is_within(infinity);
        let (normal, length) = whole.keep(finite).unit_and_length();
        let mut plane = AffinePlane::new(origin, edges[1], edges[N - 1]);
        // the first three corners may be in line
        plane.normal = normal;
        plane.height = compensated_dot(origin.keep(finite) * (R::lit(1.0) / plane.unit), normal);
        let (origin, edges) = (origin.keep(finite), edges.map(|e| e.keep(finite)));
        Self { origin, edges, plane, sizes, total, normal, area: length * R::lit(0.5) / scale / scale }
    }
}

impl<R: Real, const N: usize> Surface<R> for PlacedPolygon<R, N> {
    #[inline(always)]
    fn at(&self, w: Vec3<R>) -> SurfaceHit<R> {
        self.plane.at(w)
    }
}
impl<R: Real, const N: usize> AreaSurface<R> for PlacedPolygon<R, N> {
    const FLAT: bool = true;
    #[inline(always)]
    fn draw(&self, u: Vec2<R>) -> SurfacePoint<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let place = u.x * self.total;
        let (mut before, mut sum) = (zero, zero);
        let (mut first, mut second, mut width) = (self.edges[1], self.edges[2], zero);
        for i in 1..N - 1 {
            let size = self.sizes[i];
            // the first triangle that has an area, and each one that begins before the place
            let here = size.gt(zero) & (place.ge(sum) | width.le(zero));
            first = Vec3::blend(here, self.edges[i], first);
            second = Vec3::blend(here, self.edges[i + 1], second);
            before = R::blend(here, sum, before);
            width = R::blend(here, size, width);
            sum += size;
        }
        let x = unit_interval((place - before) / R::blend(width.gt(zero), width, one));
        let b: Vec2<R> = AreaTriangle.sample(Vec2::new(x, u.y));
        let position = first.mul_add(b.x, second.mul_add(b.y, self.origin));
        let uv = self.plane.at(direction_to(position).direction).uv;
        SurfacePoint { position, normal: self.normal, uv, inverse_pdf: self.area }
    }
    #[inline(always)]
    fn inverse_pdf(&self, _: Vec2<R>) -> R {
        self.area
    }
    #[inline(always)]
    fn contains(&self, w: Vec3<R>) -> R::Mask {
        let scale = R::lit(1.0) / self.plane.unit;
        let mut inside = self.plane.ahead(w);
        for i in 0..N {
            let (from, to) = (self.edges[i], self.edges[(i + 1) % N]);
            let (a, b) = ((self.origin + from) * scale, (self.origin + to) * scale);
            let plane = a.cross((to - from) * scale);
            inside = inside & self.plane.inside(w, plane, plane.length(), [a, b]);
        }
        inside
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let scale = one / self.plane.unit;
        let origin = self.origin * scale;
        let (mut before, mut sum) = (zero, zero);
        let (mut first, mut second, mut width) = (self.edges[1], self.edges[2], zero);
        for i in 1..N - 1 {
            let size = self.sizes[i];
            let beyond = self.plane.inwards(w.dot(origin.cross(self.edges[i] * scale))).ge(zero);
            let here = size.gt(zero) & (beyond | width.le(zero));
            first = Vec3::blend(here, self.edges[i], first);
            second = Vec3::blend(here, self.edges[i + 1], second);
            before = R::blend(here, sum, before);
            width = R::blend(here, size, width);
            sum += size;
        }
        let Vec2 { x, y } = AffinePlane::new(self.origin, first, second).coordinates(w);
        let u: Vec2<R> = AreaTriangle.invert(Vec2::new(x.clamped(zero, one), y.clamped(zero, one)));
        let x = u.x.mul_add(width, before) / R::blend(self.total.gt(zero), self.total, one);
        Vec2::new(unit_interval(x), u.y)
    }
    #[inline(always)]
    fn area(&self) -> R {
        self.area
    }
}
