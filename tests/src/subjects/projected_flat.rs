//! Flat shapes by projected solid angle.

use super::flat::{Flat, beyond};
use crate::domain::Random;
use crate::double_double::Dd3;
use crate::laws::{Subject, vectors_of};
use crate::oracle::{V3, above_horizon, along, cross, dot, exact_sum, lambert, length, sub, unit, wide};
use crate::tolerances::{self, Tolerance};
use core::fmt::{self, Debug, Formatter};
use etendue::seen::{self, Sighting};
use etendue::{Real, Vec2, Vec3, Warp};

/// What the horizon leaves of a convex polygon of up to five corners.
#[derive(Clone, Copy, Debug)]
struct Truth {
    /// A fan about the first corner that is above.
    fan: [Flat; 4],
    triangles: usize,
    /// The corners, as given.
    corners: [V3; 5],
    count: usize,
    /// Unit normal of the surface, and of the plane.
    normal: V3,
    plane: V3,
    projected: f64,
    condition: f64,
    extent: [f64; 2],
    opposite: f64,
}
impl Truth {
    fn new(exact: &[Dd3], normal: [f32; 3]) -> Self {
        let rounded = |v: Dd3| v.map(|x| x.to_f64());
        let none = Flat { v0: [0.0; 3], e1: [0.0; 3], e2: [0.0; 3], exact: [exact[0]; 3] };
        let n = exact_sum(wide(normal), &[]);
        let above = above_horizon(exact, n);
        let (mut fan, mut triangles) = ([none; 4], 0);
        let difference = |a: Dd3, b: Dd3| core::array::from_fn(|i| (a[i] - b[i]).to_f64());
        for i in 2..above.len() {
            let exact = [above[0], above[i - 1], above[i]];
            let (e1, e2) = (difference(exact[1], exact[0]), difference(exact[2], exact[0]));
            let flat = Flat { v0: rounded(exact[0]), e1, e2, exact };
            // not one that the horizon has left as a line
            if length(cross(e1, e2)) > 1e-14 * length(e1) * length(e2) && triangles < fan.len() {
                fan[triangles] = flat;
                triangles += 1;
            }
        }
        let known: Vec<_> = fan[..triangles].iter().map(Flat::known).collect();
        let most = |f: fn(&super::flat::Known) -> f64| known.iter().map(f).fold(1.0, f64::max);
        let solid_angle: f64 = known.iter().map(|k| k.solid_angle).sum();
        let projected = if triangles > 0 { lambert(&above, n) } else { 0.0 };
        let corners = core::array::from_fn(|i| rounded(exact[i % exact.len()]));
        let edge = |k: usize| difference(exact[k], exact[0]);
        Self {
            fan,
            triangles,
            corners,
            count: exact.len(),
            normal: unit(wide(normal)),
            plane: unit(cross(edge(1), edge(2))),
            projected,
            // a normal that is turned by a unit changes the integral of the cosine by Ω of them
            condition: most(|k| k.condition) + solid_angle / projected,
            extent: [
                known.iter().map(|k| k.extent[0]).fold(0.0, f64::max),
                known.iter().map(|k| k.extent[1]).fold(2.0, f64::min),
            ],
            opposite: most(|k| k.opposite),
        }
    }
    fn tolerance(&self) -> Tolerance {
        let all = tolerances::PROJECTED_POLYGON;
        let aspect = (self.extent[0] / self.extent[1].max(1e-300)).max(1.0);
        let before = if self.count > 3 { 2.0 * self.condition * self.extent[0] } else { 0.0 };
        Tolerance {
            point: all.point * self.opposite,
            distance: all.distance * self.opposite,
            // where the next triangle of a polygon begins is known as well as the areas before are
            round_trip: all.round_trip * (self.opposite * aspect + before),
            ..all
        }
    }
    /// From the first corner outwards, in halves of the rest of the square for each triangle but the last.
    fn chart(&self, s: f64, t: f64) -> (V3, f64) {
        let (mut low, mut width) = (0.0, 1.0);
        for (i, flat) in self.fan[..self.triangles].iter().enumerate() {
            if i + 1 < self.triangles {
                width *= 0.5;
            }
            if t < low + width || i + 1 == self.triangles {
                let part = (t - low) / width;
                let (w, measure) = flat.at(s * part, s * (1.0 - part));
                return (w, measure * s / width);
            }
            low += width;
        }
        ([0.0; 3], 0.0)
    }
    fn locate(&self, w: V3) -> [f64; 2] {
        let mut best = (f64::NEG_INFINITY, [0.0; 2]);
        let (mut low, mut width) = (0.0, 1.0);
        for (i, flat) in self.fan[..self.triangles].iter().enumerate() {
            if i + 1 < self.triangles {
                width *= 0.5;
            }
            let b = flat.barycentrics(w);
            let least = b.into_iter().fold(f64::INFINITY, f64::min);
            if least > best.0 {
                let part = (b[1] / (b[1] + b[2])).clamp(0.0, 1.0 - 1e-9);
                best = (least, [(1.0 - b[0]).clamp(0.0, 1.0), low + width * part]);
            }
            low += width;
        }
        best.1
    }
    /// Sweeps by azimuth begin and end in corners, and where the horizon cuts a diagonal: there the next `u` of the grid may belong
    /// to another sweep. Where that begins is known to the rounding of a few areas, hence not within 2⁻¹⁸ of the whole.
    fn reachable(&self, w: V3) -> bool {
        let corners = self.fan[..self.triangles].iter().flat_map(|flat| flat.vertices());
        let first = self.corners[0];
        let cuts = self.corners[2..self.count].iter().filter_map(|&c| {
            let (a, b) = (dot(first, self.normal), dot(c, self.normal));
            ((a < 0.0) != (b < 0.0)).then(|| along(first, sub(c, first), a / (a - b)))
        });
        corners.chain(cuts).all(|corner| {
            let corner = unit(corner);
            let off = length(sub(w, corner));
            0.5 * off * off * (dot(corner, self.normal).max(0.0) + off) > 64.0 * tolerances::ULP * self.projected
        })
    }
    fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
        let v = &self.corners[..self.count];
        let n = v.len();
        let i = random.word() as usize % n;
        let (a, b, t) = (v[i], v[(i + 1) % n], random.unit_f64());
        let w = beyond(a, b, v[(i + 2) % n], margin * self.opposite, t);
        // a point of the horizon, and straight down
        let (ha, hb) = (dot(a, self.normal), dot(b, self.normal));
        if (ha < 0.0) != (hb < 0.0) {
            let on = along(a, sub(b, a), ha / (ha - hb));
            let on = unit(along(on, self.normal, -dot(on, self.normal)));
            return Some(unit(along(on, self.normal, -margin)));
        }
        Some(w)
    }
}

/// The map of `S` has one slope from the left and the right: no corner's azimuth near.
fn straight<S: Subject>(s: &S, u: [f64; 2]) -> bool
where
    for<'a> S::Warp<f64>: Warp<f64, Point = S::Point<f64>>,
{
    use crate::laws::Coordinates;
    let warp = S::prepare::<f64>(&[*s]);
    let h = 1e-3;
    let at = |k: f64| warp.sample(Vec2::new(u[0] + k * h, u[1])).at(0);
    let slope = |side: f64| {
        let (p, q, r) = (at(0.0), at(side), at(2.0 * side));
        core::array::from_fn::<f64, 3, _>(|i| side * (4.0 * q[i] - 3.0 * p[i] - r[i]))
    };
    let (left, right) = (slope(-1.0), slope(1.0));
    length(sub(left, right)) < 1e-4 * length(right)
}

/// From `u` less to `u` more by `step` in the first coordinate.
fn jump<S: Subject>(s: &S, u: [f64; 2], step: f64) -> f64
where
    for<'a> S::Warp<f64>: Warp<f64, Point = S::Point<f64>>,
{
    use crate::laws::Coordinates;
    let warp = S::prepare::<f64>(&[*s]);
    let at = |x: f64| warp.sample(Vec2::new(x.clamp(0.0, 1.0 - tolerances::ULP), u[1])).at(0);
    length(sub(at(u[0] + step), at(u[0] - step)))
}

macro_rules! subject {
    ($name:ident, $warp:ty, |$of:ident| $prepare:expr, |$one:ident, $times:ident| $scaled:expr) => {
        impl Subject for $name {
            type Warp<R: Real> = $warp;
            type Point<R: Real> = Vec3<R>;
            fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
                let $of = |i: usize| lanes[i % lanes.len()];
                $prepare
            }
            fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
                <$warp>::splat(warp)
            }
            fn kin(&self, other: &Self) -> bool {
                self.kind() == other.kind()
            }
            fn tolerance(&self) -> Tolerance {
                self.truth.tolerance()
            }
            fn scaled(&self, factor: f32) -> Self {
                let $times = |v: [f32; 3]| v.map(|x| x * factor);
                let $one = *self;
                $scaled
            }
            fn density(&self, w: V3) -> f64 {
                dot(w, self.truth.normal).max(0.0) / self.truth.projected
            }
            fn chart(&self, s: f64, t: f64) -> (V3, f64) {
                self.truth.chart(s, t)
            }
            fn locate(&self, w: V3) -> [f64; 2] {
                self.truth.locate(w)
            }
            fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
                self.truth.outside(margin, random)
            }
            fn extent(&self) -> [f64; 2] {
                self.truth.extent
            }
            fn condition(&self) -> f64 {
                self.truth.condition
            }
            // areas before a direction are known as those are by which it is drawn
            fn inverse_steps(&self) -> f64 {
                self.tolerance().steps
            }
            fn gradient(&self) -> f64 {
                1.0 / self.truth.projected
            }
            fn quadrature(&self) -> f64 {
                1e-8
            }
            fn reachable(&self, w: V3) -> bool {
                self.truth.reachable(w)
            }
            fn smooth(&self, u: [f64; 2]) -> bool {
                straight(self, u)
            }
            fn torn(&self, u: [f64; 2], step: f64) -> bool {
                // the triangles of a fan, or of what the horizon has cut, do not continue each other
                jump(self, u, step) > 0.05 * self.truth.extent[0]
            }
            fn reach(&self) -> f64 {
                self.truth.corners.into_iter().map(length).fold(0.0, f64::max)
            }
            fn slant(&self, w: V3) -> f64 {
                1.0 / dot(w, self.truth.plane).abs()
            }
            fn sight<R: Real>(warp: &Self::Warp<R>, u: Vec2<R>) -> Option<Sighting<R>> {
                Some(warp.sight(u))
            }
        }
        impl $name {
            /// Projected solid angle, by Lambert's form in 106 bits.
            #[must_use]
            pub fn projected_solid_angle(&self) -> f64 {
                self.truth.projected
            }
            /// Its condition.
            #[must_use]
            pub fn conditioned(&self) -> f64 {
                self.truth.condition
            }
        }
    };
}

/// `seen::ProjectedTriangle`, prepared from vertices or from a vertex and edges.
#[derive(Clone, Copy)]
pub struct ProjectedTriangle {
    v0: [f32; 3],
    a: [f32; 3],
    b: [f32; 3],
    normal: [f32; 3],
    by_edges: bool,
    truth: Truth,
}
impl Debug for ProjectedTriangle {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let how = if self.by_edges { "by_edges" } else { "by_vertices" };
        write!(f, "ProjectedTriangle::{how}({:?}, {:?}, {:?}, {:?})", self.v0, self.a, self.b, self.normal)
    }
}
impl ProjectedTriangle {
    /// For `ProjectedTriangle::new`.
    #[must_use]
    pub fn by_vertices(v0: [f32; 3], a: [f32; 3], b: [f32; 3], normal: [f32; 3]) -> Self {
        let truth = Truth::new(&[v0, a, b].map(|v| exact_sum(wide(v), &[])), normal);
        Self { v0, a, b, normal, by_edges: false, truth }
    }
    /// For `ProjectedTriangle::with_edges`: the other vertices are the rounded sums.
    #[must_use]
    pub fn by_edges(v0: [f32; 3], a: [f32; 3], b: [f32; 3], normal: [f32; 3]) -> Self {
        let sum = |e: &[V3]| exact_sum(wide(v0), e);
        let truth = Truth::new(&[sum(&[]), sum(&[wide(a)]), sum(&[wide(b)])], normal);
        Self { v0, a, b, normal, by_edges: true, truth }
    }
    fn kind(&self) -> bool {
        self.by_edges
    }
}
subject!(
    ProjectedTriangle,
    seen::ProjectedTriangle<R>,
    |of| {
        let (v0, a, b) = (vectors_of(|i| of(i).v0), vectors_of(|i| of(i).a), vectors_of(|i| of(i).b));
        let normal = vectors_of(|i| of(i).normal);
        if of(0).by_edges {
            seen::ProjectedTriangle::with_edges(v0, v0 + a, v0 + b, a, b, normal)
        } else {
            seen::ProjectedTriangle::new(v0, a, b, normal)
        }
    },
    |s, times| Self { v0: times(s.v0), a: times(s.a), b: times(s.b), ..s }
);

/// `seen::ProjectedPolygon::parallelogram`.
#[derive(Clone, Copy)]
pub struct ProjectedParallelogram {
    p: [f32; 3],
    u: [f32; 3],
    v: [f32; 3],
    normal: [f32; 3],
    truth: Truth,
}
impl Debug for ProjectedParallelogram {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "ProjectedParallelogram::new({:?}, {:?}, {:?}, {:?})", self.p, self.u, self.v, self.normal)
    }
}
impl ProjectedParallelogram {
    /// Corner, relative to the viewpoint, edges, and normal of the surface.
    #[must_use]
    pub fn new(p: [f32; 3], u: [f32; 3], v: [f32; 3], normal: [f32; 3]) -> Self {
        let sum = |e: &[V3]| exact_sum(wide(p), e);
        let (a, b) = (wide(u), wide(v));
        let truth = Truth::new(&[sum(&[]), sum(&[a]), sum(&[a, b]), sum(&[b])], normal);
        Self { p, u, v, normal, truth }
    }
    fn kind(&self) -> bool {
        true
    }
}
subject!(
    ProjectedParallelogram,
    seen::ProjectedPolygon<R, 4>,
    |of| {
        let normal = vectors_of(|i| of(i).normal);
        let (p, u, v) = (vectors_of(|i| of(i).p), vectors_of(|i| of(i).u), vectors_of(|i| of(i).v));
        seen::ProjectedPolygon::parallelogram(p, u, v, normal)
    },
    |s, times| Self { p: times(s.p), u: times(s.u), v: times(s.v), ..s }
);

/// `seen::ProjectedPolygon` of five corners.
#[derive(Clone, Copy)]
pub struct ProjectedPentagon {
    corners: [[f32; 3]; 5],
    normal: [f32; 3],
    truth: Truth,
}
impl Debug for ProjectedPentagon {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "ProjectedPentagon::new({:?}, {:?})", self.corners, self.normal)
    }
}
impl ProjectedPentagon {
    /// Corners, relative to the viewpoint, and normal of the surface.
    #[must_use]
    pub fn new(corners: [[f32; 3]; 5], normal: [f32; 3]) -> Self {
        let truth = Truth::new(&corners.map(|v| exact_sum(wide(v), &[])), normal);
        Self { corners, normal, truth }
    }
    fn kind(&self) -> bool {
        true
    }
}
subject!(
    ProjectedPentagon,
    seen::ProjectedPolygon<R, 5>,
    |of| {
        let normal = vectors_of(|i| of(i).normal);
        seen::ProjectedPolygon::new(core::array::from_fn(|k| vectors_of(|i| of(i).corners[k])), normal)
    },
    |s, times| Self { corners: s.corners.map(times), ..s }
);
