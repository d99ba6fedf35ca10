//! Triangles and parallelograms.

use crate::domain::Random;
use crate::double_double::Dd3;
use crate::laws::{Subject, vectors_of};
use crate::oracle::{V3, along, cross, dot, exact_sum, length, sub, triangle_solid_angle, unit, wide};
use crate::tolerances::{self, Tolerance};
use core::f64::consts::PI;
use core::fmt::{self, Debug, Formatter};
use etendue::seen::{Sighting, SphericalParallelogram, SphericalPolygon, SphericalRectangle, SphericalTriangle};
use etendue::{Real, Vec2, Vec3, warp};

macro_rules! by_area {
    ($name:ident, $smooth:expr) => {
        #[doc = concat!("`warp::", stringify!($name), "`.")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;
        impl Subject for $name {
            type Warp<R: Real> = warp::$name;
            type Point<R: Real> = Vec2<R>;
            fn prepare<R: Real>(_: &[Self]) -> Self::Warp<R> {
                warp::$name
            }
            fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
                warp
            }
            fn tolerance(&self) -> Tolerance {
                tolerances::AREA_TRIANGLE
            }
            fn density(&self, _: V3) -> f64 {
                2.0
            }
            fn chart(&self, s: f64, t: f64) -> (V3, f64) {
                ([(1.0 - s) * t, (1.0 - s) * (1.0 - t), 0.0], 1.0 - s)
            }
            fn locate(&self, b: V3) -> [f64; 2] {
                let sum = b[0] + b[1];
                [1.0 - sum, if sum > 0.0 { b[0] / sum } else { 0.0 }]
            }
            fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
                let t = random.unit_f64();
                Some(match random.word() % 3 {
                    0 => [-margin, t, 0.0],
                    1 => [t, -margin, 0.0],
                    _ => [t + margin, 1.0 - t, 0.0],
                })
            }
            fn extent(&self) -> [f64; 2] {
                [1.0, 0.7]
            }
            fn smooth(&self, u: [f64; 2]) -> bool {
                let smooth: fn([f64; 2]) -> bool = $smooth;
                smooth(u)
            }
        }
    };
}
by_area!(AreaTriangle, |_| true);
// folded over the diagonal
by_area!(LowDistortionTriangle, |u| (u[0] - u[1]).abs() > 0.01);

/// A triangle in f64, and its vertices without rounding.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flat {
    pub(super) v0: V3,
    pub(super) e1: V3,
    pub(super) e2: V3,
    pub(super) exact: [Dd3; 3],
}
impl Flat {
    pub(super) fn vertices(&self) -> [V3; 3] {
        [self.v0, along(self.v0, self.e1, 1.0), along(self.v0, self.e2, 1.0)]
    }
    /// Point of the plane at (b1, b2) as a direction, and steradians per unit of (b1, b2).
    pub(super) fn at(&self, b1: f64, b2: f64) -> (V3, f64) {
        let point = along(along(self.v0, self.e1, b1), self.e2, b2);
        let d = length(point);
        let w = point.map(|x| x / d);
        (w, dot(w, cross(self.e1, self.e2)).abs() / (d * d))
    }
    /// Barycentric coordinates of a direction.
    pub(super) fn barycentrics(&self, w: V3) -> [f64; 3] {
        let [_, v1, _] = self.vertices();
        let edge = sub(self.e2, self.e1);
        let b = [dot(w, cross(v1, edge)), dot(w, cross(self.e2, self.v0)), dot(w, cross(self.v0, self.e1))];
        let sum = b[0] + b[1] + b[2];
        b.map(|b| b / sum)
    }
    pub(super) fn reach(&self) -> f64 {
        self.vertices().into_iter().map(length).fold(0.0, f64::max)
    }
    pub(super) fn known(&self) -> Known {
        let v = self.vertices();
        let [v0, v1, v2] = v;
        let mut extent = [0.0_f64, 2.0_f64];
        for i in 0..3 {
            let (a, b, c) = (v[i], v[(i + 1) % 3], v[(i + 2) % 3]);
            extent[0] = extent[0].max(length(sub(unit(a), unit(b))));
            let n = unit(cross(a, sub(b, a)));
            extent[1] = extent[1].min(dot(n, sub(c, a)).abs() / length(c));
        }
        let mut opposite = 1.0_f64;
        for (a, b) in [(v[0], v[1]), (v[1], v[2]), (v[2], v[0])] {
            if dot(a, b) < 0.0 {
                opposite = opposite.max(length(a) * length(b) / length(cross(a, b)));
            }
        }
        let solid_angle = triangle_solid_angle(self.exact);
        let normal = cross(self.e1, self.e2);
        let nearest = length(v0).min(length(v1)).min(length(v2));
        let elevation = dot(v0, normal).abs() / (nearest * length(normal));
        let (a, b, c) = (unit(v0), unit(v1), unit(v2));
        let under = 1.0 + dot(a, b) + dot(b, c) + dot(c, a);
        let over = dot(v0, normal).abs() / (length(v0) * length(v1) * length(v2));
        let slope = solid_angle.sin().abs() / elevation + 4.0 * over / (over * over + under * under);
        Known { solid_angle, condition: 1.0 + slope / solid_angle, extent, opposite }
    }
}

/// What is known of a flat shape.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known {
    pub(super) solid_angle: f64,
    /// The condition of Ω: of the height over the plane, through the derivative of the arc tangent, and of the sum below the line.
    pub(super) condition: f64,
    /// Longest side; least distance of a vertex from the opposite side's plane.
    pub(super) extent: [f64; 2],
    /// Greatest 1/sin of an obtuse angle between two vertices.
    pub(super) opposite: f64,
}
impl Known {
    /// The tolerance of this shape. A great circle through nearly opposite vertices is known no better than 1/sin of their angle;
    /// an inverse is known no better than how much longer than wide the shape is seen.
    fn widened(&self, tolerance: Tolerance) -> Tolerance {
        let aspect = self.extent[0] / self.extent[1].max(1e-300);
        Tolerance {
            point: tolerance.point * self.opposite,
            steps: if self.solid_angle > PI { tolerances::NEAR_HEMISPHERE_STEPS } else { 0.0 },
            distance: tolerance.distance * self.opposite,
            round_trip: tolerance.round_trip * aspect.max(1.0) * self.opposite,
            ..tolerance
        }
    }
}

/// `seen::SphericalTriangle`, prepared from vertices or from a vertex and edges.
#[derive(Clone, Copy)]
pub struct Triangle {
    v0: [f32; 3],
    a: [f32; 3],
    b: [f32; 3],
    by_edges: bool,
    flat: Flat,
    known: Known,
}
impl Debug for Triangle {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let how = if self.by_edges { "by_edges" } else { "by_vertices" };
        write!(f, "Triangle::{how}({:?}, {:?}, {:?})", self.v0, self.a, self.b)
    }
}
impl Triangle {
    /// For `SphericalTriangle::new`.
    #[must_use]
    pub fn by_vertices(v0: [f32; 3], v1: [f32; 3], v2: [f32; 3]) -> Self {
        let exact = [v0, v1, v2].map(|v| exact_sum(wide(v), &[]));
        let edge = |v: [f32; 3]| sub(wide(v), wide(v0));
        let flat = Flat { v0: wide(v0), e1: edge(v1), e2: edge(v2), exact };
        Self { v0, a: v1, b: v2, by_edges: false, flat, known: flat.known() }
    }
    /// First vertex and edges.
    pub(crate) fn edges(&self) -> [V3; 3] {
        let (v0, a, b) = (wide(self.v0), wide(self.a), wide(self.b));
        if self.by_edges { [v0, a, b] } else { [v0, sub(a, v0), sub(b, v0)] }
    }
    /// For `SphericalTriangle::with_edges`: the other vertices are the rounded sums.
    #[must_use]
    pub fn by_edges(v0: [f32; 3], e1: [f32; 3], e2: [f32; 3]) -> Self {
        let (v, a, b) = (wide(v0), wide(e1), wide(e2));
        let exact = [exact_sum(v, &[]), exact_sum(v, &[a]), exact_sum(v, &[b])];
        let flat = Flat { v0: v, e1: a, e2: b, exact };
        Self { v0, a: e1, b: e2, by_edges: true, flat, known: flat.known() }
    }
}

/// A direction beyond the side a → b by a margin, on the other side than `inner`.
pub(super) fn beyond(a: V3, b: V3, inner: V3, margin: f64, t: f64) -> V3 {
    let edge = sub(b, a);
    let n = unit(cross(a, edge));
    let sign = if dot(n, sub(inner, a)) > 0.0 { -1.0 } else { 1.0 };
    unit(along(unit(along(a, edge, t)), n, sign * margin))
}
/// How far off the z axis, for what lies about it.
fn about_the_axis(vertices: &[V3]) -> f64 {
    let tangent = |v: &V3| if v[2] > 0.0 { v[0].abs().max(v[1].abs()) / v[2] } else { 1.0 };
    let most = vertices.iter().map(tangent).fold(0.0, f64::max);
    if most < 1e-2 { most } else { 1.0 }
}

impl Subject for Triangle {
    fn kin(&self, other: &Self) -> bool {
        self.by_edges == other.by_edges
    }
    type Warp<R: Real> = SphericalTriangle<R>;
    type Point<R: Real> = Vec3<R>;
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
        let of = |i: usize| lanes[i % lanes.len()];
        let (v0, a, b) = (vectors_of(|i| of(i).v0), vectors_of(|i| of(i).a), vectors_of(|i| of(i).b));
        if lanes[0].by_edges {
            SphericalTriangle::with_edges(v0, v0 + a, v0 + b, a, b)
        } else {
            SphericalTriangle::new(v0, a, b)
        }
    }
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
        SphericalTriangle::splat(warp)
    }
    fn tolerance(&self) -> Tolerance {
        self.known.widened(tolerances::TRIANGLE)
    }
    fn scaled(&self, factor: f32) -> Self {
        let times = |v: [f32; 3]| v.map(|x| x * factor);
        Self { v0: times(self.v0), a: times(self.a), b: times(self.b), ..*self }
    }
    fn density(&self, _: V3) -> f64 {
        1.0 / self.known.solid_angle
    }
    fn chart(&self, s: f64, t: f64) -> (V3, f64) {
        let (w, measure) = self.flat.at((1.0 - s) * t, (1.0 - s) * (1.0 - t));
        (w, measure * (1.0 - s))
    }
    fn locate(&self, w: V3) -> [f64; 2] {
        let [b0, b1, b2] = self.flat.barycentrics(w);
        [b0.clamp(0.0, 1.0), (b1 / (b1 + b2)).clamp(0.0, 1.0)]
    }
    fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
        let v = self.flat.vertices();
        let i = (random.word() % 3) as usize;
        Some(beyond(v[i], v[(i + 1) % 3], v[(i + 2) % 3], margin * self.known.opposite, random.unit_f64()))
    }
    fn extent(&self) -> [f64; 2] {
        self.known.extent
    }
    fn granularity(&self) -> f64 {
        about_the_axis(&self.flat.vertices())
    }
    fn condition(&self) -> f64 {
        self.known.condition
    }
    fn reach(&self) -> f64 {
        self.flat.reach()
    }
    fn farthest(&self) -> f64 {
        self.flat.reach()
    }
    fn slant(&self, w: V3) -> f64 {
        1.0 / dot(w, unit(cross(self.flat.e1, self.flat.e2))).abs()
    }
    fn sight<R: Real>(warp: &Self::Warp<R>, u: Vec2<R>) -> Option<Sighting<R>> {
        Some(warp.sight(u))
    }
}

/// `seen::SphericalParallelogram`.
#[derive(Clone, Copy)]
pub struct Parallelogram {
    p: [f32; 3],
    u: [f32; 3],
    v: [f32; 3],
    flat: Flat,
    known: Known,
    /// The part of the solid angle that the map takes first: p, p+u, p+u+v.
    first: f64,
}
impl Debug for Parallelogram {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "Parallelogram::new({:?}, {:?}, {:?})", self.p, self.u, self.v)
    }
}
impl Parallelogram {
    /// Corner, relative to the viewpoint, and edges.
    #[must_use]
    pub fn new(corner: [f32; 3], side_u: [f32; 3], side_v: [f32; 3]) -> Self {
        let (p, u, v) = (wide(corner), wide(side_u), wide(side_v));
        let corners = [exact_sum(p, &[]), exact_sum(p, &[u]), exact_sum(p, &[u, v]), exact_sum(p, &[v])];
        let half = |i: usize| {
            let exact = [corners[i], corners[0], corners[i + 1]];
            let (e1, e2) = if i == 1 { (u.map(|x| -x), v) } else { (sub(u.map(|x| -x), v), u.map(|x| -x)) };
            Flat { v0: exact[0].map(|x| x.to_f64()), e1, e2, exact }.known()
        };
        let (first, second) = (half(1), half(2));
        let known = Known {
            solid_angle: first.solid_angle + second.solid_angle,
            condition: first.condition.max(second.condition),
            opposite: first.opposite.max(second.opposite),
            extent: [first.extent[0].max(second.extent[0]), first.extent[1].min(second.extent[1])],
        };
        let flat = Flat { v0: p, e1: u, e2: v, exact: [corners[0], corners[1], corners[3]] };
        Self { p: corner, u: side_u, v: side_v, flat, known, first: first.solid_angle }
    }
    fn corners(&self) -> [V3; 4] {
        let Flat { v0: p, e1: u, e2: v, .. } = self.flat;
        [p, along(p, u, 1.0), along(along(p, u, 1.0), v, 1.0), along(p, v, 1.0)]
    }
}
impl Subject for Parallelogram {
    type Warp<R: Real> = SphericalParallelogram<R>;
    type Point<R: Real> = Vec3<R>;
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
        let of = |i: usize| lanes[i % lanes.len()];
        SphericalParallelogram::new(vectors_of(|i| of(i).p), vectors_of(|i| of(i).u), vectors_of(|i| of(i).v))
    }
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
        SphericalParallelogram::splat(warp)
    }
    fn tolerance(&self) -> Tolerance {
        let all = self.known.widened(tolerances::PARALLELOGRAM);
        // where the second triangle begins is known as the solid angles are
        Tolerance { steps: all.steps + 0.5 * self.known.condition, ..all }
    }
    fn scaled(&self, factor: f32) -> Self {
        let times = |v: [f32; 3]| v.map(|x| x * factor);
        Self { p: times(self.p), u: times(self.u), v: times(self.v), ..*self }
    }
    fn density(&self, _: V3) -> f64 {
        1.0 / self.known.solid_angle
    }
    fn chart(&self, s: f64, t: f64) -> (V3, f64) {
        self.flat.at(s, t)
    }
    fn locate(&self, w: V3) -> [f64; 2] {
        let [_, s, t] = self.flat.barycentrics(w);
        [s.clamp(0.0, 1.0), t.clamp(0.0, 1.0)]
    }
    fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
        let v = self.corners();
        let i = (random.word() % 4) as usize;
        Some(beyond(v[i], v[(i + 1) % 4], v[(i + 2) % 4], margin * self.known.opposite, random.unit_f64()))
    }
    fn extent(&self) -> [f64; 2] {
        self.known.extent
    }
    fn granularity(&self) -> f64 {
        about_the_axis(&self.corners())
    }
    fn condition(&self) -> f64 {
        self.known.condition
    }
    fn smooth(&self, u: [f64; 2]) -> bool {
        (u[0] - self.first / self.known.solid_angle).abs() > 0.01
    }
    fn reach(&self) -> f64 {
        self.flat.reach()
    }
    fn farthest(&self) -> f64 {
        self.corners().into_iter().map(length).fold(0.0, f64::max)
    }
    fn slant(&self, w: V3) -> f64 {
        1.0 / dot(w, unit(cross(self.flat.e1, self.flat.e2))).abs()
    }
    fn sight<R: Real>(warp: &Self::Warp<R>, u: Vec2<R>) -> Option<Sighting<R>> {
        Some(warp.sight(u))
    }
}

/// `seen::SphericalRectangle`: known as the parallelogram is.
#[derive(Clone, Copy)]
pub struct Rectangle(Parallelogram);
impl Debug for Rectangle {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "Rectangle::new({:?}, {:?}, {:?})", self.0.p, self.0.u, self.0.v)
    }
}
impl Rectangle {
    /// Corner, relative to the viewpoint, and edges.
    #[must_use]
    pub fn new(corner: [f32; 3], side_u: [f32; 3], side_v: [f32; 3]) -> Self {
        Self(Parallelogram::new(corner, side_u, side_v))
    }
}
impl Subject for Rectangle {
    type Warp<R: Real> = SphericalRectangle<R>;
    type Point<R: Real> = Vec3<R>;
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
        let of = |i: usize| lanes[i % lanes.len()].0;
        SphericalRectangle::new(vectors_of(|i| of(i).p), vectors_of(|i| of(i).u), vectors_of(|i| of(i).v))
    }
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
        SphericalRectangle::splat(warp)
    }
    fn tolerance(&self) -> Tolerance {
        let steps = tolerances::RECTANGLE.steps;
        Tolerance { steps, ..self.0.known.widened(tolerances::RECTANGLE) }
    }
    fn scaled(&self, factor: f32) -> Self {
        Self(self.0.scaled(factor))
    }
    fn density(&self, w: V3) -> f64 {
        self.0.density(w)
    }
    fn chart(&self, s: f64, t: f64) -> (V3, f64) {
        self.0.chart(s, t)
    }
    fn locate(&self, w: V3) -> [f64; 2] {
        self.0.locate(w)
    }
    fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
        self.0.outside(margin, random)
    }
    fn extent(&self) -> [f64; 2] {
        self.0.extent()
    }
    fn granularity(&self) -> f64 {
        self.0.granularity()
    }
    fn condition(&self) -> f64 {
        self.0.condition()
    }
    fn reach(&self) -> f64 {
        self.0.reach()
    }
    fn farthest(&self) -> f64 {
        self.0.farthest()
    }
    fn slant(&self, w: V3) -> f64 {
        self.0.slant(w)
    }
    fn sight<R: Real>(warp: &Self::Warp<R>, u: Vec2<R>) -> Option<Sighting<R>> {
        Some(warp.sight(u))
    }
}

/// `seen::SphericalPolygon` of six corners.
#[derive(Clone, Copy)]
pub struct Hexagon {
    corners: [[f32; 3]; 6],
    fan: [Flat; 4],
    known: Known,
    /// Shares of the triangles, cumulative.
    shares: [f64; 4],
}
impl Debug for Hexagon {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "Hexagon::new({:?})", self.corners)
    }
}
impl Hexagon {
    /// Corners, relative to the viewpoint.
    #[must_use]
    pub fn new(corners: [[f32; 3]; 6]) -> Self {
        let fan = core::array::from_fn(|i| {
            let [a, p, b] = [corners[i + 1], corners[0], corners[i + 2]].map(wide);
            Flat { v0: a, e1: sub(p, a), e2: sub(b, a), exact: [a, p, b].map(|v| exact_sum(v, &[])) }
        });
        let all = fan.map(|flat: Flat| flat.known());
        let solid_angle = all.iter().map(|k| k.solid_angle).sum::<f64>();
        let fold = |f: fn(&Known) -> f64, pick: fn(f64, f64) -> f64| all.iter().map(f).reduce(pick).unwrap_or(1.0);
        let known = Known {
            solid_angle,
            condition: fold(|k| k.condition, f64::max),
            opposite: fold(|k| k.opposite, f64::max),
            extent: [fold(|k| k.extent[0], f64::max), fold(|k| k.extent[1], f64::min)],
        };
        let mut sum = 0.0;
        let shares = all.map(|k| {
            sum += k.solid_angle / solid_angle;
            sum
        });
        Self { corners, fan, known, shares }
    }
    fn corners(&self) -> [V3; 6] {
        self.corners.map(wide)
    }
}
impl Subject for Hexagon {
    type Warp<R: Real> = SphericalPolygon<R, 6>;
    type Point<R: Real> = Vec3<R>;
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
        SphericalPolygon::new(core::array::from_fn(|k| vectors_of(|i| lanes[i % lanes.len()].corners[k])))
    }
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
        SphericalPolygon::splat(warp)
    }
    fn tolerance(&self) -> Tolerance {
        let widened = self.known.widened(tolerances::POLYGON);
        // where one triangle ends and the next begins is known as well as their solid angles are
        let steps = widened.steps.max(2.0 * widened.density * self.known.condition);
        Tolerance { steps, ..widened }
    }
    fn scaled(&self, factor: f32) -> Self {
        Self { corners: self.corners.map(|v| v.map(|x| x * factor)), ..*self }
    }
    fn density(&self, _: V3) -> f64 {
        1.0 / self.known.solid_angle
    }
    /// Quarters of the square are the triangles.
    fn chart(&self, s: f64, t: f64) -> (V3, f64) {
        let i = ((t * 4.0) as usize).min(3);
        let part = t * 4.0 - i as f64;
        // from the first corner (b1) outwards, between the two others
        let (w, measure) = self.fan[i].at(1.0 - s, s * part);
        (w, measure * s * 4.0)
    }
    fn locate(&self, w: V3) -> [f64; 2] {
        let mut best = (f64::NEG_INFINITY, [0.0; 2]);
        for (i, flat) in self.fan.iter().enumerate() {
            let b = flat.barycentrics(w);
            let least = b.into_iter().fold(f64::INFINITY, f64::min);
            if least > best.0 {
                let part = (b[2] / (b[0] + b[2])).clamp(0.0, 1.0 - 1e-9);
                best = (least, [(1.0 - b[1]).clamp(0.0, 1.0), (i as f64 + part) / 4.0]);
            }
        }
        best.1
    }
    fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
        let v = self.corners();
        let i = (random.word() % 6) as usize;
        Some(beyond(v[i], v[(i + 1) % 6], v[(i + 2) % 6], margin * self.known.opposite, random.unit_f64()))
    }
    fn extent(&self) -> [f64; 2] {
        self.known.extent
    }
    fn granularity(&self) -> f64 {
        about_the_axis(&self.corners())
    }
    fn condition(&self) -> f64 {
        self.known.condition
    }
    fn smooth(&self, u: [f64; 2]) -> bool {
        self.shares.iter().all(|share| (u[0] - share).abs() > 0.01)
    }
    fn reach(&self) -> f64 {
        self.corners().into_iter().map(length).fold(0.0, f64::max)
    }
    fn farthest(&self) -> f64 {
        self.reach()
    }
    fn slant(&self, w: V3) -> f64 {
        1.0 / dot(w, unit(cross(self.fan[0].e1, self.fan[0].e2))).abs()
    }
    fn sight<R: Real>(warp: &Self::Warp<R>, u: Vec2<R>) -> Option<Sighting<R>> {
        Some(warp.sight(u))
    }
}
