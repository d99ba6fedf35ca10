//! The surfaces of lights relative to the shading point, which is the origin of all coordinates here.

use crate::lanewise::{lanewise, lanewise_by_map};
use crate::real::{Real, unit_interval};
use crate::spherical::{compensated_dot, compensated_height, cross_dw, to_unit};
use crate::vector::{Frame, Vec2, Vec3};
use crate::warp::{AreaTriangle, ConcentricDisk, UniformSphere, Warp};
use core::f64::consts::PI;

/// Angle in radians by which a direction may leave a shape through rounding: 12 ulp of a component near 1.
pub(super) const SLACK: f64 = 12.0 / 16_777_216.0;

/// Where a direction meets a surface.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceHit<R> {
    /// Distance from the shading point.
    pub distance: R,
    /// Unit normal on the side that emits.
    pub normal: Vec3<R>,
    /// Surface coordinates in [0, 1]².
    pub uv: Vec2<R>,
}

/// A point drawn on a surface.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint<R> {
    /// The point relative to the shading point.
    pub position: Vec3<R>,
    /// Unit normal on the side that emits.
    pub normal: Vec3<R>,
    /// Surface coordinates in [0, 1]².
    pub uv: Vec2<R>,
    /// 1/pdf per unit area there; 0 where there is no sample.
    pub inverse_pdf: R,
}

/// The surface of a light, placed relative to a shading point.
pub trait Surface<R: Real>: Copy {
    /// The nearest point in the unit direction `w`. Only meaningful where `w` hits the surface; finite everywhere.
    fn at(&self, w: Vec3<R>) -> SurfaceHit<R>;
}

/// A surface that can be sampled by area.
pub trait AreaSurface<R: Real>: Surface<R> {
    /// True where the normal is constant, so that a direction determines the density as well as the point does.
    const FLAT: bool;
    /// A point for `u` in [0, 1)².
    fn draw(&self, u: Vec2<R>) -> SurfacePoint<R>;
    /// 1/pdf per unit area at surface coordinates.
    fn inverse_pdf(&self, uv: Vec2<R>) -> R;
    /// True where the unit direction `w` hits the surface, to within the rounding of the direction.
    fn contains(&self, w: Vec3<R>) -> R::Mask;
    /// The `u` that [`draw`](Self::draw) maps to the nearest point in the direction `w`.
    fn invert(&self, w: Vec3<R>) -> Vec2<R>;
    /// Surface area.
    fn area(&self) -> R;
}

/// a/b, or 0 where b is 0 or the quotient would not be finite.
#[inline(always)]
pub(super) fn quotient<R: Real>(a: R, b: R) -> R {
    quotient_if_any(a, b).0
}

/// The same, and whether there is a quotient: 0 may as well be one.
#[inline(always)]
pub(super) fn quotient_if_any<R: Real>(a: R, b: R) -> (R, R::Mask) {
    let some = b.abs().gt(R::lit(1e-37));
    let most = R::lit(1e37);
    ((a / R::blend(some, b, R::lit(1.0))).keep(some).clamped(-most, most), some)
}

lanewise! {
    /// The plane of a flat light with its affine coordinates: origin + x·first + y·second.
    ///
    /// Lengths are in units of `unit`, so that no product under- or overflows.
    pub(crate) struct AffinePlane {
        origin: Vec3<R>,
        first: Vec3<R>,
        second: Vec3<R>,
        /// first × second, its unit vector and its length.
        cross: Vec3<R>,
        normal: Vec3<R>,
        length: R,
        /// Distance of the shading point to the plane, negative on the side of the normal.
        height: R,
        /// Normals of the planes through the shading point and the edges: origin × first and origin × second.
        along_first: Vec3<R>,
        along_second: Vec3<R>,
        unit: R,
    }
}

impl<R: Real> AffinePlane<R> {
    #[inline(always)]
    pub(super) fn new(origin: Vec3<R>, first: Vec3<R>, second: Vec3<R>) -> Self {
        let ([origin, first, second], scale) = to_unit([origin, first, second]);
        // each edge in a unit of its own, however different their lengths are; the height over a plane that the point nearly touches is
        // a small difference
        let (unit_first, unit_second) = (first.max_abs().pow2_scale(), second.max_abs().pow2_scale());
        let exact = cross_dw(first * unit_first, second * unit_second);
        let (normal, sine) = (exact[0] + exact[1]).unit_and_length();
        let height = quotient(compensated_height(origin, exact), sine);
        let length = sine / unit_first / unit_second;
        let cross = normal * length;
        Self {
            origin,
            first,
            second,
            cross,
            normal,
            length,
            height,
            along_first: origin.cross(first),
            along_second: origin.cross(second),
            unit: R::lit(1.0) / scale,
        }
    }
    /// Area of the parallelogram of both edges.
    #[inline(always)]
    fn parallelogram_area(&self) -> R {
        (self.length * self.unit) * self.unit
    }
    #[inline(always)]
    fn distance(&self, w: Vec3<R>) -> R {
        let distance = quotient(self.height, w.dot(self.normal)).greater(R::lit(0.0)) * self.unit;
        distance.lesser(R::lit(f64::from(f32::MAX)))
    }
    /// Affine coordinates of the point in the direction `w`.
    #[inline(always)]
    fn coordinates(&self, w: Vec3<R>) -> Vec2<R> {
        let along = w.dot(self.cross);
        Vec2::new(quotient(-w.dot(self.along_second), along), quotient(w.dot(self.along_first), along))
    }
    #[inline(always)]
    fn at(&self, w: Vec3<R>) -> SurfaceHit<R> {
        let uv = self.coordinates(w);
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let uv = Vec2::new(uv.x.clamped(zero, one), uv.y.clamped(zero, one));
        SurfaceHit { distance: self.distance(w), normal: self.normal, uv }
    }
    /// The sign that turns w·(a × b) positive for directions inside the edge from a to b, counterclockwise about the normal.
    #[inline(always)]
    fn inwards(&self, side: R) -> R {
        side.negate_where(self.height.lt(R::lit(0.0)))
    }
    /// True where `w` points towards the plane.
    #[inline(always)]
    fn ahead(&self, w: Vec3<R>) -> R::Mask {
        let slack = R::lit(SLACK);
        self.inwards(w.dot(self.normal)).ge(-slack) & self.height.abs().gt(R::lit(0.0))
    }
    /// True where `w` is inside an edge between the points a and b, given the plane a × b and the size of what it is a sum of.
    #[inline(always)]
    fn inside(&self, w: Vec3<R>, plane: Vec3<R>, size: R, [a, b]: [Vec3<R>; 2]) -> R::Mask {
        // the plane of points that are nearly opposite as seen from here is known only to −cos : sin of the angle between them
        let slack = size.greater(-a.dot(b)) * R::lit(SLACK);
        self.inwards(w.dot(plane)).ge(-slack)
    }
    /// True where `w` hits the triangle or, with `all`, the parallelogram.
    #[inline(always)]
    fn contains(&self, w: Vec3<R>, all: bool) -> R::Mask {
        let (o, a, b) = (self.origin, self.along_first, self.along_second);
        let (corner, other) = (o + self.first, o + self.second);
        let size = |m: Vec3<R>| m.length();
        let near = self.inside(w, a, size(a), [o, corner]) & self.inside(w, -b, size(b), [o, other]) & self.ahead(w);
        if all {
            let opposite = corner + self.second;
            near & self.inside(w, self.cross + b, size(b) + self.length, [corner, opposite])
                & self.inside(w, self.cross - a, size(a) + self.length, [other, opposite])
        } else {
            let diagonal = o.cross(self.second - self.first);
            near & self.inside(w, diagonal + self.cross, size(diagonal) + self.length, [corner, other])
        }
    }
}

macro_rules! affine {
    ($(#[$doc:meta])* $name:ident, $share:literal, $all:literal, $sample:expr, $invert:expr) => {
        lanewise! {
            $(#[$doc])*
            pub struct $name {
                origin: Vec3<R>,
                first: Vec3<R>,
                second: Vec3<R>,
                plane: AffinePlane<R>,
            }
        }
        impl<R: Real> $name<R> {
            #[inline(always)]
            pub(super) fn new(origin: Vec3<R>, first: Vec3<R>, second: Vec3<R>) -> Self {
                Self { origin, first, second, plane: AffinePlane::new(origin, first, second) }
            }
        }
        impl<R: Real> Surface<R> for $name<R> {
            #[inline(always)]
            fn at(&self, w: Vec3<R>) -> SurfaceHit<R> {
                self.plane.at(w)
            }
        }
        impl<R: Real> AreaSurface<R> for $name<R> {
            const FLAT: bool = true;
            #[inline(always)]
            fn draw(&self, u: Vec2<R>) -> SurfacePoint<R> {
                let sample: fn(Vec2<R>) -> Vec2<R> = $sample;
                let uv = sample(u);
                let position = self.first.mul_add(uv.x, self.second.mul_add(uv.y, self.origin));
                SurfacePoint { position, normal: self.plane.normal, uv, inverse_pdf: self.area() }
            }
            #[inline(always)]
            fn inverse_pdf(&self, _: Vec2<R>) -> R {
                self.area()
            }
            #[inline(always)]
            fn contains(&self, w: Vec3<R>) -> R::Mask {
                self.plane.contains(w, $all)
            }
            #[inline(always)]
            fn invert(&self, w: Vec3<R>) -> Vec2<R> {
                let invert: fn(Vec2<R>) -> Vec2<R> = $invert;
                let Vec2 { x, y } = self.plane.coordinates(w);
                let (zero, one) = (R::lit(0.0), R::lit(1.0));
                invert(Vec2::new(x.clamped(zero, one), y.clamped(zero, one)))
            }
            #[inline(always)]
            fn area(&self) -> R {
                self.plane.parallelogram_area() * R::lit($share)
            }
        }
    };
}
affine!(
    /// A triangle relative to the shading point. Its surface coordinates are the barycentric coordinates of the second and the third
    /// vertex.
    PlacedTriangle, 0.5, false, |u| AreaTriangle.sample(u), |b| AreaTriangle.invert(b)
);
affine!(
    /// A parallelogram relative to the shading point. Its surface coordinates are the parts of both edges.
    PlacedParallelogram, 1.0, true, |u| u, |st| Vec2::new(unit_interval(st.x), unit_interval(st.y))
);

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
    pub(super) fn new(corners: [Vec3<R>; N], origin: Vec3<R>) -> Self {
        let (zero, first) = (R::lit(0.0), corners[0]);
        let edges = corners.map(|c| c - first);
        let scale = edges.iter().fold(zero, |most, e| most.greater(e.max_abs())).pow2_scale();
        let (mut sizes, mut total, mut whole) = ([zero; N], zero, Vec3::default());
        for i in 1..N - 1 {
            whole += edges[i].cross(edges[i + 1]);
            sizes[i] = (edges[i] * scale).cross(edges[i + 1] * scale).length();
            total += sizes[i];
        }
        let origin = first - origin;
        let below = |x: R| x.abs().lt(R::lit(f64::INFINITY));
        let finite = [origin, whole].map(|v| below(v.x) & below(v.y) & below(v.z));
        let finite = finite[0] & finite[1];
        let (normal, length) = whole.keep(finite).unit_and_length();
        let mut plane = AffinePlane::new(origin, edges[1], edges[N - 1]);
        // the first three corners may be in line
        plane.normal = normal;
        plane.height = compensated_dot(origin.keep(finite) * (R::lit(1.0) / plane.unit), normal);
        let (origin, edges) = (origin.keep(finite), edges.map(|e| e.keep(finite)));
        Self { origin, edges, plane, sizes, total, normal, area: length * R::lit(0.5) }
    }
    /// Repeats one polygon in every lane.
    #[inline(always)]
    pub fn splat(s: PlacedPolygon<R::Scalar, N>) -> Self {
        s.map(R::splat)
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
        let uv = self.plane.at(super::sample::direction_to(position).direction).uv;
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

lanewise! {
    /// A disk relative to the shading point. Its surface coordinates are (1 + q)/2 for the position q on the unit disk, along the axes of
    /// the [`Frame`] of its normal.
    pub struct PlacedDisk {
        center: Vec3<R>,
        frame: Frame<R>,
        radius: R,
        height: R,
    }
}
impl<R: Real> PlacedDisk<R> {
    #[inline(always)]
    pub(super) fn new(center: Vec3<R>, normal: Vec3<R>, radius: R) -> Self {
        let finite = center.max_abs().lt(R::lit(f64::INFINITY));
        let (center, radius) = (center.keep(finite), radius.keep(finite));
        Self { center, frame: Frame::new(normal), radius, height: compensated_dot(center, normal) }
    }
    /// Position on the unit disk, beyond it too.
    #[inline(always)]
    fn position(&self, w: Vec3<R>) -> Vec2<R> {
        let distance = quotient(self.height, w.dot(self.frame.n));
        let offset = w.mul_add(distance, -self.center);
        Vec2::new(quotient(offset.dot(self.frame.s), self.radius), quotient(offset.dot(self.frame.t), self.radius))
    }
    #[inline(always)]
    fn to_uv(q: Vec2<R>) -> Vec2<R> {
        let half = |x: R| x.mul_add(R::lit(0.5), R::lit(0.5)).clamped(R::lit(0.0), R::lit(1.0));
        Vec2::new(half(q.x), half(q.y))
    }
}
impl<R: Real> Surface<R> for PlacedDisk<R> {
    #[inline(always)]
    fn at(&self, w: Vec3<R>) -> SurfaceHit<R> {
        let distance = quotient(self.height, w.dot(self.frame.n)).greater(R::lit(0.0));
        SurfaceHit { distance, normal: self.frame.n, uv: Self::to_uv(self.position(w)) }
    }
}
impl<R: Real> AreaSurface<R> for PlacedDisk<R> {
    const FLAT: bool = true;
    #[inline(always)]
    fn draw(&self, u: Vec2<R>) -> SurfacePoint<R> {
        let q: Vec2<R> = ConcentricDisk.sample(u);
        let offset = self.frame.s * (q.x * self.radius) + self.frame.t * (q.y * self.radius);
        let (normal, uv) = (self.frame.n, Self::to_uv(q));
        SurfacePoint { position: self.center + offset, normal, uv, inverse_pdf: self.area() }
    }
    #[inline(always)]
    fn inverse_pdf(&self, _: Vec2<R>) -> R {
        self.area()
    }
    #[inline(always)]
    fn contains(&self, w: Vec3<R>) -> R::Mask {
        let zero = R::lit(0.0);
        // by how much the direction misses the centre within the plane, times the cosine, so that nothing is divided by it
        let scale = self.center.max_abs().greater(self.radius.abs()).pow2_scale();
        let (center, height, radius) = (self.center * scale, self.height * scale, self.radius * scale);
        let cos = w.dot(self.frame.n);
        let off = (w * height - center * cos).length();
        let slack = (center.length() + radius) * R::lit(SLACK);
        off.le(radius.mul_add(cos.abs(), slack)) & (cos * height).gt(zero) & radius.gt(zero)
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let q = self.position(w);
        let most = R::lit(1e15);
        let q = Vec2::new(q.x.clamped(-most, most), q.y.clamped(-most, most));
        ConcentricDisk.invert(q * (R::lit(1.0) / q.length().greater(R::lit(1.0))))
    }
    #[inline(always)]
    fn area(&self) -> R {
        self.radius * self.radius * R::lit(PI)
    }
}

lanewise! {
    /// A sphere relative to the shading point. Its surface coordinates are those that [`UniformSphere`] maps to the normal: height and
    /// azimuth.
    pub struct PlacedSphere {
        center: Vec3<R>,
        radius: R,
    }
}
impl<R: Real> PlacedSphere<R> {
    #[inline(always)]
    pub(super) fn new(center: Vec3<R>, radius: R) -> Self {
        Self { center, radius }
    }
}
impl<R: Real> Surface<R> for PlacedSphere<R> {
    #[inline(always)]
    fn at(&self, w: Vec3<R>) -> SurfaceHit<R> {
        let zero = R::lit(0.0);
        let ([center, Vec3 { x: radius, .. }], scale) = to_unit([self.center, Vec3::new(self.radius, zero, zero)]);
        let power = center.length_squared_minus_square(radius);
        let along = w.dot(center);
        let across = w.mul_add(-along, center);
        let root = radius.mul_add(radius, -across.length_squared()).greater(zero).sqrt();
        let outside = power.ge(zero);
        // the root that is a sum, and the other one by their product
        let sum = root + along.abs();
        let near = quotient(power.abs(), sum);
        let distance = R::blend(!outside & along.ge(zero), sum, near);
        let normal = w.mul_add(distance, -center).normalize();
        let distance = (distance / scale).lesser(R::lit(f64::from(f32::MAX)));
        SurfaceHit { distance, normal, uv: UniformSphere.invert(normal) }
    }
}
impl<R: Real> AreaSurface<R> for PlacedSphere<R> {
    const FLAT: bool = false;
    #[inline(always)]
    fn draw(&self, u: Vec2<R>) -> SurfacePoint<R> {
        let normal: Vec3<R> = UniformSphere.sample(u);
        SurfacePoint { position: self.center + normal * self.radius, normal, uv: u, inverse_pdf: self.area() }
    }
    #[inline(always)]
    fn inverse_pdf(&self, _: Vec2<R>) -> R {
        self.area()
    }
    #[inline(always)]
    fn contains(&self, w: Vec3<R>) -> R::Mask {
        let zero = R::lit(0.0);
        let ([center, Vec3 { x: radius, .. }], _) = to_unit([self.center, Vec3::new(self.radius, zero, zero)]);
        let along = w.dot(center);
        let reach = center.length().mul_add(R::lit(SLACK), radius);
        let outside = center.length_squared_minus_square(radius).ge(zero);
        let hit = w.mul_add(-along, center).length().le(reach) & along.gt(zero);
        (hit | !outside) & radius.gt(zero)
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        self.at(w).uv
    }
    #[inline(always)]
    fn area(&self) -> R {
        self.radius * self.radius * R::lit(4.0 * PI)
    }
}
