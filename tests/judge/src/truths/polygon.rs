//! Convex polygons as they are seen from the origin: whole, or what a horizon leaves of them.

use crate::fixture::Truth;
use crate::fixture::sample_at;
use crate::random::Random;
use crate::tolerances::{self, NEAR_HEMISPHERE_STEPS, Tolerance, ULP};
use core::f64::consts::PI;
use etendue::LightSampler;
use etendue_oracle::double_double::Dd3;
use etendue_oracle::{
    V3, above_horizon, along, cross, dd, dot, lambert, length, sub, triangle_solid_angle, unit, wide,
};

fn rounded(v: Dd3) -> V3 {
    v.map(|x| x.to_f64())
}
fn difference(a: Dd3, b: Dd3) -> V3 {
    core::array::from_fn(|i| (a[i] - b[i]).to_f64())
}

/// A triangle in f64, with its vertices unrounded.
#[derive(Clone, Debug)]
struct Triangle {
    v0: V3,
    e1: V3,
    e2: V3,
    exact: [Dd3; 3],
}
impl Triangle {
    fn new(exact: [Dd3; 3]) -> Self {
        Self { v0: rounded(exact[0]), e1: difference(exact[1], exact[0]), e2: difference(exact[2], exact[0]), exact }
    }
    fn vertices(&self) -> [V3; 3] {
        [self.v0, along(self.v0, self.e1, 1.0), along(self.v0, self.e2, 1.0)]
    }
    /// The direction of the point at (b1, b2) in the plane, and steradians per unit of (b1, b2).
    fn at(&self, b1: f64, b2: f64) -> (V3, f64) {
        let point = along(along(self.v0, self.e1, b1), self.e2, b2);
        let d = length(point);
        let w = point.map(|x| x / d);
        (w, dot(w, cross(self.e1, self.e2)).abs() / (d * d))
    }
    /// Barycentric coordinates of the point in a direction.
    fn barycentrics(&self, w: V3) -> [f64; 3] {
        let [_, v1, _] = self.vertices();
        let edge = sub(self.e2, self.e1);
        let b = [dot(w, cross(v1, edge)), dot(w, cross(self.e2, self.v0)), dot(w, cross(self.v0, self.e1))];
        let sum = b[0] + b[1] + b[2];
        b.map(|b| b / sum)
    }
    fn known(&self) -> Known {
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

/// Derived quantities of a triangle, or the worst of several.
#[derive(Clone, Copy, Debug)]
struct Known {
    solid_angle: f64,
    /// Condition number of Ω, from the derivatives of the arc tangent with respect to the height over the plane and to the denominator.
    condition: f64,
    /// Longest side, and least distance of a vertex from the plane of the opposite side, both between directions.
    extent: [f64; 2],
    /// Greatest 1/sin of an obtuse angle between two vertices.
    opposite: f64,
}

/// A direction beyond the side a → b by `margin`, on the side away from `inner`.
fn beyond(a: V3, b: V3, inner: V3, margin: f64, t: f64) -> V3 {
    let edge = sub(b, a);
    let n = unit(cross(a, edge));
    let sign = if dot(n, sub(inner, a)) > 0.0 { -1.0 } else { 1.0 };
    unit(along(unit(along(a, edge, t)), n, sign * margin))
}

/// The map whose errors are judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Arvo's map of a triangle.
    Triangle,
    /// Two triangles, one after the other.
    Parallelogram,
    /// Ureña's map of a rectangle.
    Rectangle,
    /// A fan of triangles, one after the other.
    Fan,
    /// By azimuth about the normal of a surface: it jumps between the triangles of a fan, and between the parts that the horizon leaves. The
    /// areas before a direction are as uncertain in the inverse as they are in the sample.
    Azimuth,
}

/// A convex polygon, or the part of it above a horizon.
#[derive(Clone, Debug)]
pub struct Polygon {
    way: Way,
    /// The corners before the cut.
    corners: Vec<V3>,
    /// Triangles in a fan about the first corner that is left.
    fan: Vec<Triangle>,
    /// Their parts in the solid angle, cumulative.
    shares: Vec<f64>,
    /// Unit normal of the polygon's plane.
    plane: V3,
    /// Normal of the receiver, of nearly unit length: densities are proportional to the product with it.
    horizon: Option<V3>,
    all: Known,
    /// Solid angle, or projected solid angle, in steradians.
    pub measure: f64,
}
impl Polygon {
    /// By solid angle, or by projected solid angle where there is a receiver's normal.
    #[must_use]
    pub fn new(exact: &[Dd3], way: Way, normal: Option<[f32; 3]>) -> Self {
        let Some(normal) = normal else { return Self::of(exact, exact, way, None) };
        let n = dd(wide(normal));
        let above = above_horizon(exact, n);
        let mut this = Self::of(exact, &above, way, Some(wide(normal)));
        this.measure = if this.fan.is_empty() { 0.0 } else { lambert(&above, n) };
        // turning the normal by ε changes the integral of the cosine by at most Ω ε
        this.all.condition += this.all.solid_angle / this.measure;
        this
    }
    fn of(exact: &[Dd3], left: &[Dd3], way: Way, horizon: Option<V3>) -> Self {
        let (mut fan, mut shares) = (Vec::new(), Vec::new());
        let mut all = Known { solid_angle: 0.0, condition: 1.0, extent: [0.0, 2.0], opposite: 1.0 };
        for i in 2..left.len() {
            let one = Triangle::new([left[0], left[i - 1], left[i]]);
            // skip a triangle that the cut has reduced to a line
            let is_line = length(cross(one.e1, one.e2)) <= 1e-14 * length(one.e1) * length(one.e2);
            if is_line && horizon.is_some() {
                continue;
            }
            let known = one.known();
            all.solid_angle += known.solid_angle;
            all.condition = all.condition.max(known.condition);
            all.extent = [all.extent[0].max(known.extent[0]), all.extent[1].min(known.extent[1])];
            all.opposite = all.opposite.max(known.opposite);
            fan.push(one);
            shares.push(all.solid_angle);
        }
        let edge = |k: usize| difference(exact[k], exact[0]);
        Self {
            way,
            corners: exact.iter().copied().map(rounded).collect(),
            fan,
            shares: shares.into_iter().map(|sum| sum / all.solid_angle).collect(),
            plane: unit(cross(edge(1), edge(2))),
            horizon,
            all,
            measure: all.solid_angle,
        }
    }
    /// A great circle through nearly opposite vertices is ill-conditioned by 1/sin of their angle, an inverse by the shape's aspect from the
    /// viewpoint.
    fn widened(&self, tolerance: Tolerance) -> Tolerance {
        let Known { extent, opposite, condition, solid_angle } = self.all;
        let aspect = (extent[0] / extent[1].max(1e-300)).max(1.0);
        // over a horizon, the boundary between two triangles is as uncertain as the areas before it
        let before = if self.horizon.is_some() && self.corners.len() > 3 { 2.0 * condition * extent[0] } else { 0.0 };
        let near = self.horizon.is_none() && solid_angle > PI;
        Tolerance {
            point: tolerance.point * opposite,
            steps: tolerance.steps + if near { NEAR_HEMISPHERE_STEPS } else { 0.0 },
            distance: tolerance.distance * opposite,
            round_trip: tolerance.round_trip * (aspect * opposite + before),
            ..tolerance
        }
    }
    /// Whether the map's slopes from the left and from the right agree, so that no corner's azimuth is near.
    fn straight(map: &dyn LightSampler<f64>, u: [f64; 2]) -> bool {
        let at = |x: f64| sample_at(map, [u[0] + x, u[1]]);
        // a slope by three points cannot see a bend at two thirds of its step: the other step sees it
        [1e-3, 1.3e-3].into_iter().all(|h| {
            let slope = |side: f64| {
                let (p, q, r) = (at(0.0), at(side * h), at(2.0 * side * h));
                core::array::from_fn::<f64, 3, _>(|i| side * (4.0 * q[i] - 3.0 * p[i] - r[i]))
            };
            let (left, right) = (slope(-1.0), slope(1.0));
            length(sub(left, right)) < 1e-4 * length(right)
        })
    }
    /// The triangles, with the begin and the width of the strip of the square that each of them has: all but the last take half of the rest.
    fn strips(&self) -> impl Iterator<Item = (&Triangle, [f64; 2])> {
        let strip = |i: usize| {
            let begin = 1.0 - 0.5_f64.powi(i as i32);
            [begin, if i + 1 < self.fan.len() { 0.5 * (1.0 - begin) } else { 1.0 - begin }]
        };
        self.fan.iter().enumerate().map(move |(i, flat)| (flat, strip(i)))
    }
}

impl Truth for Polygon {
    fn tolerance(&self) -> Tolerance {
        match self.way {
            Way::Triangle => self.widened(tolerances::TRIANGLE),
            Way::Parallelogram => {
                let all = self.widened(tolerances::PARALLELOGRAM);
                // the boundary between the two triangles is as uncertain as their solid angles
                Tolerance { steps: all.steps + 0.5 * self.all.condition, ..all }
            }
            Way::Rectangle => Tolerance { steps: tolerances::RECTANGLE.steps, ..self.widened(tolerances::RECTANGLE) },
            Way::Fan => {
                let all = self.widened(tolerances::POLYGON);
                // the boundaries between the triangles are as uncertain as their solid angles
                Tolerance { steps: all.steps.max(2.0 * all.pdf * self.all.condition), ..all }
            }
            Way::Azimuth => self.widened(tolerances::PROJECTED_POLYGON),
        }
    }
    fn whole(&self) -> f64 {
        self.horizon.map_or(1.0, length)
    }
    fn is_seen(&self) -> bool {
        self.measure > 0.0
    }
    fn inverse_steps(&self) -> f64 {
        if self.way == Way::Azimuth { self.tolerance().steps } else { 2.0 }
    }
    fn torn(&self, map: &dyn LightSampler<f64>, u: [f64; 2], step: f64) -> bool {
        let at = |x: f64| sample_at(map, [x.clamp(0.0, 1.0 - ULP), u[1]]);
        let jump = || length(sub(at(u[0] + step), at(u[0] - step)));
        self.way == Way::Azimuth && jump() > 0.05 * self.all.extent[0]
    }
    fn smooth(&self, map: &dyn LightSampler<f64>, u: [f64; 2]) -> bool {
        match self.way {
            Way::Triangle | Way::Rectangle => true,
            // not at the boundary between two triangles
            Way::Parallelogram | Way::Fan => self.shares.iter().all(|share| (u[0] - share).abs() > 0.01),
            Way::Azimuth => Self::straight(map, u),
        }
    }
    fn pdf(&self, w: V3) -> f64 {
        self.horizon.map_or(1.0, |n| dot(w, n).max(0.0)) / self.measure
    }
    /// Outwards from the fan's corner.
    fn chart(&self, s: f64, t: f64) -> (V3, f64) {
        let at = self.strips().take_while(|(_, [begin, _])| t >= *begin).last();
        at.map_or(([0.0; 3], 0.0), |(flat, [begin, width])| {
            let part = (t - begin) / width;
            let (w, measure) = flat.at(s * part, s * (1.0 - part));
            (w, measure * s / width)
        })
    }
    fn locate(&self, w: V3) -> [f64; 2] {
        let mut best = (f64::NEG_INFINITY, [0.0; 2]);
        for (flat, [begin, width]) in self.strips() {
            let b = flat.barycentrics(w);
            let least = b.into_iter().fold(f64::INFINITY, f64::min);
            if least > best.0 {
                let part = (b[1] / (b[1] + b[2])).clamp(0.0, 1.0 - 1e-9);
                best = (least, [(1.0 - b[0]).clamp(0.0, 1.0), begin + width * part]);
            }
        }
        best.1
    }
    fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
        let (v, n) = (&self.corners, self.corners.len());
        let i = random.below(n);
        let (a, b, t) = (v[i], v[(i + 1) % n], random.unit_f64());
        if let Some(up) = self.horizon {
            let (ha, hb) = (dot(a, up), dot(b, up));
            if (ha < 0.0) != (hb < 0.0) {
                // a point on the horizon, moved straight down
                let on = along(a, sub(b, a), ha / (ha - hb));
                let on = unit(along(on, up, -dot(on, up)));
                return Some(unit(along(on, up, -margin)));
            }
        }
        Some(beyond(a, b, v[(i + 2) % n], margin * self.all.opposite, t))
    }
    fn extent(&self) -> [f64; 2] {
        self.all.extent
    }
    /// Sweeps by azimuth begin and end at corners and where the horizon cuts a diagonal. There the next `u` of the grid may belong to
    /// another sweep, whose beginning is known to the rounding of a few areas, so 2⁻¹⁸ of the whole is excluded.
    fn reachable(&self, w: V3) -> bool {
        let Some(up) = self.horizon else { return true };
        let corners = self.fan.iter().flat_map(Triangle::vertices);
        let first = self.corners[0];
        let cuts = self.corners[2..].iter().filter_map(|&c| {
            let (a, b) = (dot(first, up), dot(c, up));
            ((a < 0.0) != (b < 0.0)).then(|| along(first, sub(c, first), a / (a - b)))
        });
        corners.chain(cuts).all(|corner| {
            let corner = unit(corner);
            let off = length(sub(w, corner));
            0.5 * off * off * (dot(corner, up).max(0.0) + off) > 64.0 * ULP * self.measure
        })
    }
    /// By solid angle, the extent of a shape on the z axis; 1 for others.
    fn granularity(&self) -> f64 {
        let tangent = |v: &V3| if v[2] > 0.0 { v[0].abs().max(v[1].abs()) / v[2] } else { 1.0 };
        let most = self.corners.iter().map(tangent).fold(0.0, f64::max);
        if self.horizon.is_none() && most < 1e-2 { most } else { 1.0 }
    }
    fn reach(&self) -> f64 {
        self.corners.iter().copied().map(length).fold(0.0, f64::max)
    }
    fn farthest(&self) -> f64 {
        if self.horizon.is_none() { self.reach() } else { 0.0 }
    }
    fn slant(&self, w: V3) -> f64 {
        1.0 / dot(w, self.plane).abs()
    }
    fn condition(&self) -> f64 {
        self.all.condition
    }
    fn gradient(&self) -> f64 {
        if self.horizon.is_some() { 1.0 / self.measure } else { 0.0 }
    }
    fn quadrature(&self) -> f64 {
        if self.horizon.is_some() { 1e-8 } else { 1e-9 }
    }
}
