//! Line segments. Their directions lie in a plane; times 1 + u₁ they fill a ring sector of it, so that the laws of the square hold.

use crate::domain::Random;
use crate::double_double::{Dd, Dd3, dot as dd_dot};
use crate::laws::{Subject, vectors_of};
use crate::oracle::{V3, along, cross, dot, exact_sum, gauss_legendre, length, unit, wide};
use crate::tolerances::{self, Tolerance};
use core::f64::consts::PI;
use core::fmt::{self, Debug, Formatter};
use etendue::seen::{self, Sighting};
use etendue::{Real, Vec2, Vec3, Warp};

/// `arc.sample(u.x)` times 1 + u.y.
#[derive(Clone, Copy, Debug)]
pub struct Fan<A>(pub A);

/// What a map from numbers to the directions of a plane has.
pub trait Directions<R: Real> {
    /// The direction for `u`.
    fn sample(&self, u: R) -> Vec3<R>;
    /// Per radian.
    fn pdf(&self, w: Vec3<R>) -> R;
    /// The `u` of a direction.
    fn invert(&self, w: Vec3<R>) -> R;
}
macro_rules! directions {
    ($name:ident) => {
        impl<R: Real> Directions<R> for seen::$name<R> {
            fn sample(&self, u: R) -> Vec3<R> {
                self.sample(u)
            }
            fn pdf(&self, w: Vec3<R>) -> R {
                self.pdf(w)
            }
            fn invert(&self, w: Vec3<R>) -> R {
                self.invert(w)
            }
        }
    };
}
directions!(SphericalSegment);
directions!(ProjectedSegment);

fn direction_and_length<R: Real>(p: Vec3<R>) -> (Vec3<R>, R) {
    let length = p.length();
    (p * (R::lit(1.0) / length.max(R::lit(1e-18))), length)
}
impl<R: Real, A: Directions<R>> Warp<R> for Fan<A> {
    type Point = Vec3<R>;
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        self.0.sample(u.x) * (R::lit(1.0) + u.y)
    }
    fn pdf(&self, p: Vec3<R>) -> R {
        let (w, radius) = direction_and_length(p);
        self.0.pdf(w) / radius.max(R::lit(0.5))
    }
    fn invert(&self, p: Vec3<R>) -> Vec2<R> {
        let (w, radius) = direction_and_length(p);
        Vec2::new(self.0.invert(w), (radius - R::lit(1.0)).clamp(R::lit(0.0), R::below_one()))
    }
}

/// What both have in common: the part of the segment that is seen, by the angle from its first end.
#[derive(Clone, Copy, Debug)]
struct Arc {
    from: V3,
    turn: V3,
    angle: f64,
    /// Sine of the angle to the line, at both ends; height of the point over it; greatest distance.
    sines: [f64; 2],
    reach: f64,
}
impl Arc {
    /// From a to b, both without rounding, with the normal a×e of their plane.
    fn new(a: Dd3, b: Dd3, normal: V3, edge: V3) -> Self {
        let [la, lb] = [a, b].map(|v| dd_dot(v, v).sqrt().to_f64());
        let area = length(cross_dd(a, b));
        let angle = area.atan2(dd_dot(a, b).to_f64());
        let from = unit(a.map(Dd::to_f64));
        let height = length(normal) / length(edge);
        Self {
            from,
            turn: unit(cross(unit(normal), from)),
            angle,
            sines: [(height / la).min(1.0), (height / lb).min(1.0)],
            reach: la.max(lb),
        }
    }
    fn at(&self, theta: f64) -> V3 {
        along(self.from.map(|x| x * theta.cos()), self.turn, theta.sin())
    }
    fn theta(&self, w: V3) -> f64 {
        dot(w, self.turn).atan2(dot(w, self.from))
    }
    /// A quantity that is linear in the point, from its values in the directions of the ends.
    fn blend(&self, ends: [f64; 2], theta: f64) -> f64 {
        (ends[0] * (self.angle - theta).sin() + ends[1] * theta.sin()) / self.angle.sin()
    }
    fn chart(&self, s: f64, t: f64) -> (V3, f64) {
        (self.at(s * self.angle).map(|x| x * (1.0 + t)), self.angle * (1.0 + t))
    }
    fn locate(&self, p: V3) -> [f64; 2] {
        [(self.theta(p) / self.angle).clamp(0.0, 1.0), (length(p) - 1.0).clamp(0.0, 1.0)]
    }
    fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
        // radius 2 doubles the margin between points; a direction is what counts
        let theta = if random.word().is_multiple_of(2) { -margin } else { self.angle + margin };
        (self.angle + 2.0 * margin < 2.0 * PI).then(|| self.at(theta).map(|x| x * 1.5))
    }
    fn extent(&self) -> [f64; 2] {
        [self.angle.max(1.0), self.angle.min(1.0)]
    }
}
fn cross_dd(a: Dd3, b: Dd3) -> V3 {
    let minor = |i: usize, j: usize| (a[i] * b[j] - a[j] * b[i]).to_f64();
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

macro_rules! common {
    ($seen:ident) => {
        type Warp<R: Real> = Fan<seen::$seen<R>>;
        type Point<R: Real> = Vec3<R>;
        fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
            Fan(seen::$seen::splat(warp.0))
        }
        fn chart(&self, s: f64, t: f64) -> (V3, f64) {
            self.arc.chart(s, t)
        }
        fn locate(&self, p: V3) -> [f64; 2] {
            self.arc.locate(p)
        }
        fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
            self.arc.outside(margin, random)
        }
        fn extent(&self) -> [f64; 2] {
            self.arc.extent()
        }
        fn radius(&self) -> f64 {
            2.0
        }
        /// The density varies with the radius, and is rounded.
        fn quadrature(&self) -> f64 {
            1e-6
        }
        fn gradient(&self) -> f64 {
            1.0 / self.arc.angle
        }
        fn slant(&self, w: V3) -> f64 {
            1.0 / (dot(unit(w), self.foot).abs()).max(1e-30)
        }
        fn reach(&self) -> f64 {
            self.arc.reach
        }
        fn sight<R: Real>(warp: &Self::Warp<R>, u: Vec2<R>) -> Option<Sighting<R>> {
            Some(warp.0.sight(u.x))
        }
    };
}

/// `seen::SphericalSegment`.
#[derive(Clone, Copy)]
pub struct Segment {
    a: [f32; 3],
    edge: [f32; 3],
    arc: Arc,
    foot: V3,
}
impl Debug for Segment {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "Segment::new({:?}, {:?})", self.a, self.edge)
    }
}
impl Segment {
    /// One end, relative to the viewpoint, and from there to the other.
    #[must_use]
    pub fn new(a: [f32; 3], edge: [f32; 3]) -> Self {
        let (p, e) = (wide(a), wide(edge));
        let normal = cross_dd(exact_sum(p, &[]), exact_sum(e, &[]));
        let arc = Arc::new(exact_sum(p, &[]), exact_sum(p, &[e]), normal, e);
        Self { a, edge, arc, foot: unit(cross(unit(e), unit(normal))) }
    }
}
impl Subject for Segment {
    common!(SphericalSegment);
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
        let of = |i: usize| lanes[i % lanes.len()];
        Fan(seen::SphericalSegment::new(vectors_of(|i| of(i).a), vectors_of(|i| of(i).edge)))
    }
    fn tolerance(&self) -> Tolerance {
        tolerances::SEGMENT
    }
    fn scaled(&self, factor: f32) -> Self {
        Self { a: self.a.map(|x| x * factor), edge: self.edge.map(|x| x * factor), ..*self }
    }
    fn density(&self, p: V3) -> f64 {
        1.0 / (self.arc.angle * length(p))
    }
}

/// `seen::ProjectedSegment`.
#[derive(Clone, Copy)]
pub struct ProjectedSegment {
    a: [f32; 3],
    edge: [f32; 3],
    normal: [f32; 3],
    arc: Arc,
    foot: V3,
    up: V3,
    /// Cosines to the normal in the directions of the ends.
    cosines: [f64; 2],
    whole: f64,
}
impl Debug for ProjectedSegment {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "ProjectedSegment::new({:?}, {:?}, {:?})", self.a, self.edge, self.normal)
    }
}
impl ProjectedSegment {
    /// One end, relative to the viewpoint, from there to the other, and the normal.
    #[must_use]
    pub fn new(a: [f32; 3], edge: [f32; 3], normal: [f32; 3]) -> Self {
        let (p, e, n) = (wide(a), wide(edge), wide(normal));
        let [exact_p, exact_e, exact_n, exact_b] =
            [exact_sum(p, &[]), exact_sum(e, &[]), exact_sum(n, &[]), exact_sum(p, &[e])];
        let plane = cross_dd(exact_p, exact_e);
        let heights = [exact_p, exact_b].map(|v| dd_dot(v, exact_n));
        let level = |from: usize| {
            let t = heights[from] / (heights[from] - heights[1 - from]);
            let (v, w) = if from == 0 { (exact_p, exact_b) } else { (exact_b, exact_p) };
            core::array::from_fn(|i| v[i] + t * (w[i] - v[i]))
        };
        let below = heights.map(|h| h.to_f64() < 0.0);
        let ends = [if below[0] { level(0) } else { exact_p }, if below[1] { level(1) } else { exact_b }];
        let arc = Arc::new(ends[0], ends[1], plane, e);
        let cosine = |i: usize| {
            let l = dd_dot(ends[i], ends[i]).sqrt() * dd_dot(exact_n, exact_n).sqrt();
            if below[i] { 0.0 } else { (heights[i] / l).to_f64() }
        };
        let mut this = Self {
            a,
            edge,
            normal,
            arc,
            foot: unit(cross(unit(e), unit(plane))),
            up: unit(n),
            cosines: [cosine(0), cosine(1)],
            whole: 0.0,
        };
        if below[0] && below[1] {
            return this;
        }
        let (panels, nodes) = (16, gauss_legendre::<16>());
        for panel in 0..panels {
            for (x, weight) in nodes {
                let theta = (f64::from(panel) + x) / f64::from(panels) * arc.angle;
                this.whole += weight * arc.angle / f64::from(panels) * this.value(theta);
            }
        }
        this
    }
    /// Is any of it?
    #[must_use]
    pub fn seen(&self) -> bool {
        self.whole > 0.0
    }
    fn value(&self, theta: f64) -> f64 {
        if self.arc.angle > 3.0 {
            let w = self.arc.at(theta);
            return dot(w, self.foot).max(0.0) * dot(w, self.up).max(0.0);
        }
        self.arc.blend(self.arc.sines, theta).max(0.0) * self.arc.blend(self.cosines, theta).max(0.0)
    }
}
impl Subject for ProjectedSegment {
    common!(ProjectedSegment);
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
        let of = |i: usize| lanes[i % lanes.len()];
        Fan(seen::ProjectedSegment::new(
            vectors_of(|i| of(i).a),
            vectors_of(|i| of(i).edge),
            vectors_of(|i| of(i).normal),
        ))
    }
    fn tolerance(&self) -> Tolerance {
        tolerances::PROJECTED_SEGMENT
    }
    fn scaled(&self, factor: f32) -> Self {
        Self { a: self.a.map(|x| x * factor), edge: self.edge.map(|x| x * factor), ..*self }
    }
    fn density(&self, p: V3) -> f64 {
        self.value(self.arc.theta(p)) / (self.whole * length(p))
    }
    /// Two sines, each known to the rounding of a direction.
    fn density_slack(&self, p: V3) -> f64 {
        let w = unit(p);
        (dot(w, self.foot).abs() + dot(w, self.up).abs()) / self.whole
    }
}
