//! Every light of the core's list by every technique.

mod tolerated;

use crate::fixture::{Fixture, Truth};
use crate::packets::{lanes_of, vectors_of};
use crate::random::Random;
use crate::tolerances::ULP;
use crate::truths::{self, Round, Way};
use core::f64::consts::{PI, TAU};
use core::fmt::Debug;
use etendue::{
    BilinearPatch, DirectionalLight, Disk, Lanewise, LightSampler, Line, Parallelogram, PointLight, Polygon, Real,
    Rectangle, Sphere, SpotLight, Sun, Triangle, Vec3,
};
use etendue_oracle::double_double::Dd3;
use etendue_oracle::{V3, along, cross, dot, exact_sum, length, sub, wide};
use std::sync::LazyLock;

/// A function of its own for each technique: a compiler takes several times as long for one with all of them.
#[inline(never)]
fn boxed<R: Real, S: LightSampler<R> + 'static>(prepare: impl FnOnce() -> S) -> Box<dyn LightSampler<R>> {
    Box::new(prepare())
}

/// What is sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightShape {
    /// About `a`, of the radius.
    Sphere,
    /// `a`, and edges `b` and `c`.
    Triangle,
    /// `a`, and edges `b` and `c`.
    Parallelogram,
    /// `a`, and edges `b` and `c`.
    Rectangle,
    /// About `a`, with normal `b`, of the radius.
    Disk,
    /// `a`, `a` + `b`, `a` + `b` + `c`, `a` + `c`.
    Polygon,
    /// `a`, and from there `b`, `c` and, to the opposite corner, `n`.
    Patch,
    /// From `a` along `b`.
    Line,
    /// Towards `b`, with the radius as 1 − cos of its angle.
    Sun,
    /// At `a`.
    PointLight,
    /// At `a`, with axis `b`; 1 − cos of its inner angle is the first number of `c`, and of its outer angle the radius.
    SpotLight,
    /// Towards `b`.
    DirectionalLight,
}
impl LightShape {
    /// Whether `b` is a unit normal.
    #[must_use]
    pub fn has_normal(self) -> bool {
        self == Self::Disk
    }
}
/// How.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Uniform by area; by length of a line.
    Area,
    /// Uniform by solid angle; by angle of a line.
    SolidAngle,
    /// Uniform by solid angle projected on `n` as a normal.
    ProjectedSolidAngle,
    /// One direction.
    Delta,
    /// Anything else.
    Other,
}

/// Any light with a surface.
#[derive(Clone, Copy, Debug)]
pub struct AreaLight {
    /// What.
    pub shape: LightShape,
    /// How.
    pub by: Measure,
    /// The shading point.
    pub p: [f32; 3],
    /// Corner or centre.
    pub a: [f32; 3],
    /// Edge, normal or axis.
    pub b: [f32; 3],
    /// Edge.
    pub c: [f32; 3],
    /// Unit normal at the shading point; a patch's third edge.
    pub n: [f32; 3],
    /// Radius.
    pub radius: f32,
}

/// The shape of a light of the core's list.
macro_rules! shape {
    (BilinearPatch) => {
        LightShape::Patch
    };
    ($light:ident) => {
        LightShape::$light
    };
}
/// The measure of a method of the core's list.
const fn measure(by: &str) -> Measure {
    match by.as_bytes() {
        b"by_area" | b"by_length" => Measure::Area,
        b"by_solid_angle" | b"by_angle" => Measure::SolidAngle,
        b"by_projected_solid_angle" => Measure::ProjectedSolidAngle,
        b"by_delta" => Measure::Delta,
        _ => Measure::Other,
    }
}
/// What is there for the rows of the core's list whose arguments an [`AreaLight`] has.
macro_rules! row {
    ((p, reflection), ($shape:expr, $by:expr)) => {
        None
    };
    ($place:tt, ($shape:expr, $by:expr)) => {
        Some(($shape, $by))
    };
    ((p, reflection), $done:expr) => {};
    ($place:tt, $done:expr) => {
        $done
    };
}
macro_rules! techniques {
    ($(
        $(#[$light_doc:meta])* $light:ident $([$corners:literal])? = $light_c:ident, $columns_c:ident { $($fields:tt)* } by $default:literal {
            $(
                $(#[$doc:meta])* $technique:ident, $name:ident -> $sampler:ident $([$n:literal])? $(= $sampler_c:ident[$size:literal])?: $by:ident $place:tt $($measure:ident)?;
            )+
        }
    )+) => {
        /// All rows of the core's list, in its order, but for lobes, which have fixtures of their own.
        const ROWS: &[Option<(LightShape, Measure)>] = &[$($(row!($place, (shape!($light), measure(stringify!($by)))),)+)+];
        /// The light of a shape, by a technique.
        fn prepare<R: Real>(shape: LightShape, by: Measure, (v, radius): &([Vec3<R>; 9], R)) -> Box<dyn LightSampler<R>> {
            $($(row!($place, if (shape, by) == const { (shape!($light), measure(stringify!($by))) } {
                return boxed(|| etendue::prepared!($light::placed(v, *radius), $by $place, p: v[0], n: v[4]));
            });)+)+
            panic!("the core's list has no {shape:?} by {by:?}");
        }
        /// The same, prepared in scalars and then in every lane.
        fn splat<R: Real>(shape: LightShape, by: Measure, (v, radius): &([Vec3<R::Scalar>; 9], R::Scalar)) -> Box<dyn LightSampler<R>> {
            $($(row!($place, if (shape, by) == const { (shape!($light), measure(stringify!($by))) } {
                return boxed(|| etendue::prepared!($light::placed(v, *radius), $by $place, p: v[0], n: v[4]).splat::<R>());
            });)+)+
            panic!("the core's list has no {shape:?} by {by:?}");
        }
        /// The numbers of the light of a shape, in the order of its fields.
        fn numbers(shape: LightShape, (v, radius): &([Vec3<f32>; 9], f32)) -> Vec<f32> {
            let mut all = Vec::new();
            $(if shape == shape!($light) {
                $light::placed(v, *radius).map(|x| all.push(x));
            })+
            all
        }
    };
}
etendue::techniques!(techniques! {});

/// A light from the shading point, the vectors a, b, c and n of an [`AreaLight`], the rounded corners of a polygon, and the radius.
trait Placed<R> {
    fn placed(vectors: &[Vec3<R>; 9], radius: R) -> Self;
}
macro_rules! placed {
    ($($light:ident $(<$n:literal>)?: |$v:ident, $radius:pat_param| $value:expr;)+) => {$(
        impl<R: Real> Placed<R> for $light<R $(, $n)?> {
            fn placed($v: &[Vec3<R>; 9], $radius: R) -> Self {
                $value
            }
        }
    )+};
}
placed! {
    Sphere: |v, radius| Self::new(v[1], radius);
    Triangle: |v, _| Self { v0: v[1], e1: v[2], e2: v[3] };
    Parallelogram: |v, _| Self::new(v[1], v[2], v[3]);
    Rectangle: |v, _| Self::new(v[1], v[2], v[3]);
    Disk: |v, radius| Self::new(v[1], v[2], radius);
    Polygon<4>: |v, _| Self::new([v[5], v[6], v[7], v[8]]);
    BilinearPatch: |v, _| Self::new(v[1], v[2], v[3], v[4]);
    Line: |v, _| Self::new(v[1], v[2]);
    Sun: |v, radius| Self::new(v[2], radius);
    PointLight: |v, _| Self::new(v[1]);
    SpotLight: |v, radius| Self { position: v[1], axis: v[2], one_minus_cos_inner: v[3].x, one_minus_cos_outer: radius };
    DirectionalLight: |v, _| Self::new(v[2]);
}

impl AreaLight {
    /// Corners of a polygon, rounded.
    #[must_use]
    pub fn corners(&self) -> [[f32; 3]; 4] {
        let plus = |v: [f32; 3], e: [f32; 3]| core::array::from_fn(|k| v[k] + e[k]);
        [self.a, plus(self.a, self.b), plus(plus(self.a, self.b), self.c), plus(self.a, self.c)]
    }
    /// All shapes with a surface by all techniques: all of the core's list but the sun and the delta lights, which are last.
    #[must_use]
    pub fn kinds() -> &'static [(LightShape, Measure)] {
        static KINDS: LazyLock<Vec<(LightShape, Measure)>> =
            LazyLock::new(|| ROWS.iter().flatten().copied().take_while(|row| row.0 != LightShape::Sun).collect());
        &KINDS
    }
    /// A light of a kind, at the scale of rooms or small, far, large or near its own plane.
    #[must_use]
    pub fn any(kind: usize, round: u32, random: &mut Random) -> Self {
        let (shape, by) = Self::kinds()[kind];
        let mut unit = || random.direction().map(|x| x as f32);
        let (mut b, mut c, n, towards) = (unit(), unit(), unit(), unit());
        if shape == LightShape::Rectangle {
            let along = dot(wide(b), wide(c));
            c = core::array::from_fn(|k| (f64::from(c[k]) - along * f64::from(b[k])) as f32);
        }
        let size = [1.0, 1e-3, 1e-6, 30.0][round as usize % 4];
        if !shape.has_normal() {
            b = b.map(|x| x * size);
        }
        c = c.map(|x| x * size);
        // the fourth corner of a patch: nearly opposite
        let n = if shape == LightShape::Patch { core::array::from_fn(|k| b[k] + c[k] + 0.2 * size * n[k]) } else { n };
        let mut a = towards.map(|x| x * (0.1 + random.unit()) * if size > 1.0 { 10.0 } else { 1.0 });
        if round % 5 == 4 {
            // nearly in its plane
            let normal = cross(wide(b), wide(c));
            let lift = dot(wide(a), normal) / dot(normal, normal) * 0.999;
            a = core::array::from_fn(|k| (f64::from(a[k]) - lift * normal[k]) as f32);
        }
        Self { shape, by, p: [0.0; 3], a, b, c, n, radius: size * 0.3 }
    }
    pub(crate) fn vectors<R: Real>(lanes: &[Self]) -> ([Vec3<R>; 9], R) {
        let vectors = |light: &Self| {
            let (Self { p, a, b, c, n, .. }, [d, e, f, g]) = (*light, light.corners());
            [p, a, b, c, n, d, e, f, g]
        };
        let all: Vec<_> = lanes.iter().map(vectors).collect();
        let of = |k: usize| vectors_of(|i| all[i % all.len()][k]);
        (core::array::from_fn(of), lanes_of(|i| f64::from(lanes[i % lanes.len()].radius)))
    }
    /// The numbers of the light itself, in the order of the fields of its type in the core.
    #[must_use]
    pub fn numbers(&self) -> Vec<f32> {
        numbers(self.shape, &Self::vectors(&[*self]))
    }
    /// The point of a patch at surface coordinates, relative to the shading point.
    #[must_use]
    pub fn on_patch(&self, [s, t]: [f64; 2]) -> V3 {
        let (u, v, w) = (wide(self.b), wide(self.c), wide(self.n));
        along(along(along(self.offset(), u, s), v, t), sub(sub(w, u), v), s * t)
    }
    /// A normal, of any length, of the point in the direction `w` at `distance`, the area, and how far a rounded point turns the normal. None
    /// where no density by area is known: of a patch, and of a polygon, whose corners are rounded.
    fn surface(&self, w: V3, distance: f64) -> Option<(V3, f64, f64)> {
        let (b, c, r) = (wide(self.b), wide(self.c), f64::from(self.radius));
        Some(match self.shape {
            LightShape::Sphere => {
                let normal = sub(w.map(|x| x * distance), self.offset());
                (normal, 2.0 * TAU * r * r, distance / r.abs())
            }
            LightShape::Triangle => (cross(b, c), 0.5 * length(cross(b, c)), 0.0),
            LightShape::Parallelogram | LightShape::Rectangle => (cross(b, c), length(cross(b, c)), 0.0),
            LightShape::Disk => (b, PI * r * r, 0.0),
            // what is across the direction
            LightShape::Line => (cross(b, cross(w, b)), length(b), 0.0),
            LightShape::Polygon
            | LightShape::Patch
            | LightShape::Sun
            | LightShape::PointLight
            | LightShape::SpotLight
            | LightShape::DirectionalLight => return None,
        })
    }
    /// Coordinates of a point relative to `a`, rounded as the shape's own are.
    fn offset(&self) -> V3 {
        wide(core::array::from_fn(|k| self.a[k] - self.p[k]))
    }
    /// Corners relative to the shading point, in order, unrounded.
    pub(crate) fn exact_corners(&self) -> Vec<Dd3> {
        let [p, a, b, c] = [self.p, self.a, self.b, self.c].map(wide);
        let back = p.map(|x| -x);
        let corner = |edges: &[V3]| exact_sum(a, &[edges, &[back]].concat());
        match self.shape {
            LightShape::Triangle => vec![corner(&[]), corner(&[b]), corner(&[c])],
            LightShape::Polygon => self.corners().map(|corner| exact_sum(wide(corner), &[back])).to_vec(),
            _ => vec![corner(&[]), corner(&[b]), corner(&[b, c]), corner(&[c])],
        }
    }
    /// A light seen from the origin, above whose horizon there is a normal.
    #[must_use]
    pub fn seen(shape: LightShape, by: Measure, [a, b, c]: [[f32; 3]; 3], n: [f32; 3]) -> Self {
        Self { shape, by, p: [0.0; 3], a, b, c, n, radius: 0.0 }
    }
}

impl Fixture for AreaLight {
    fn prepare<R: Real>(lanes: &[Self]) -> Box<dyn LightSampler<R>> {
        prepare(lanes[0].shape, lanes[0].by, &Self::vectors::<R>(lanes))
    }
    fn splat<R: Real>(&self) -> Box<dyn LightSampler<R>> {
        splat::<R>(self.shape, self.by, &Self::vectors(&[*self]))
    }
    fn truth(&self) -> Box<dyn Truth> {
        let normal = (self.by == Measure::ProjectedSolidAngle).then_some(self.n);
        let center = self.offset().map(|x| x as f32);
        let way = match (self.shape, normal) {
            (LightShape::Sphere, None) => return Box::new(Round::sphere(center, self.radius)),
            (LightShape::Sphere, Some(n)) => return Box::new(Round::above(center, self.radius, n)),
            (LightShape::Disk, _) => return Box::new(truths::Disk::new(center, self.b, self.radius)),
            (LightShape::Line, _) => panic!("of lines, segments know"),
            (_, Some(_)) => Way::Azimuth,
            (LightShape::Triangle, None) => Way::Triangle,
            (LightShape::Parallelogram, None) => Way::Parallelogram,
            (LightShape::Rectangle, None) => Way::Rectangle,
            (_, None) => Way::Fan,
        };
        Box::new(truths::Polygon::new(&self.exact_corners(), way, normal))
    }
    fn lengths(&self) -> [f64; 2] {
        let unit_to = self.unit_to();
        [1.0 - unit_to, 1.0 + if self.by == Measure::Area { 12.0 } else { 8.0 } * ULP]
    }
    fn pdf_scaled(&self, factor: f32) -> f32 {
        if self.shape == LightShape::Line { factor } else { 1.0 }
    }
    fn scaled(&self, factor: f32) -> Self {
        let times = |v: [f32; 3]| v.map(|x| x * factor);
        // directions stay
        let b = if self.shape.has_normal() { self.b } else { times(self.b) };
        let n = if self.shape == LightShape::Patch { times(self.n) } else { self.n };
        Self { p: times(self.p), a: times(self.a), b, c: times(self.c), n, radius: self.radius * factor, ..*self }
    }
}
