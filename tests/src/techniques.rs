//! Lights by one technique each, and the properties of their samples.

use crate::oracle::{V3, cross, dot, length, sub, wide};
use crate::properties::{Coordinates, lanes_of, squares_of, vectors_of};
use crate::tolerances::ULP;
use core::f64::consts::{PI, TAU};
use core::fmt::Debug;
use etendue::light::{BilinearPatch, Line, Polygon};
use etendue::spherical::{
    ProjectedCap, ProjectedPolygon, ProjectedTriangle, SphericalCap, SphericalDisk, SphericalParallelogram,
    SphericalPolygon, SphericalRectangle, SphericalTriangle,
};
use etendue::{
    Cylinder, Disk, LightSample, Mask, Parallelogram, Real, Rectangle, Sphere, Triangle, Vec2, Vec3, Warp, f32x4, f32x8,
};

/// A light with its parameters, seen from a point, and one way of sampling it.
pub trait Technique: Copy + Debug {
    /// A sample; lane `i` from `lanes[i % lanes.len()]`.
    fn draw<R: Real>(lanes: &[Self], u: Vec2<R>) -> LightSample<R>;
    /// The density as it is evaluated for a direction, where that is done without the sample.
    fn evaluate<R: Real>(_lanes: &[Self], _w: Vec3<R>) -> Option<R> {
        None
    }
    /// To what part of itself an evaluated density is known in the direction `w`.
    fn evaluated_to(&self, _w: V3) -> f64 {
        4.0 * ULP
    }
    /// How far from 1 the length of a direction may be.
    fn unit_to(&self) -> f64 {
        12.0 * ULP
    }
    /// Truth: density per steradian of a point of the light in the direction `w` at `distance`, and to what part of itself it is known
    /// for a rounded direction.
    fn truth(&self, _w: V3, _distance: f64) -> Option<(f64, f64)> {
        None
    }
    /// All lengths times a power of two.
    #[must_use]
    fn scaled(&self, _factor: f32) -> Self {
        *self
    }
    /// Measure what the density is multiplied then: lines have one per unit of width.
    fn density_scaled(&self, _factor: f32) -> f32 {
        1.0
    }
}

/// All numbers of one lane.
fn figures<R: Real>(s: &LightSample<R>, i: usize) -> [f64; 7] {
    let [x, y, z] = s.direction.at(i);
    let truth = |m: R::Mask| f64::from(u8::from(m.lane(i)));
    [x, y, z, s.distance.lane_f64(i), s.pdf.lane_f64(i), truth(s.emits), truth(s.delta)]
}

/// **Total** and **lane-identical**: finite; pdf and distance ≥ 0; a unit vector where the pdf is not 0; the same bits at every width.
pub fn any_bits<T: Technique>(lights: &[T; 8], us: &[[f32; 2]; 8]) {
    let eight = T::draw::<f32x8>(lights, squares_of(us));
    let four = T::draw::<f32x4>(&lights[..4], squares_of(&us[..4]));
    for i in 0..8 {
        let (light, u) = (lights[i], us[i]);
        let alone = T::draw::<f32>(&[light], squares_of(&[u]));
        let one = figures(&alone, 0);
        let [x, y, z, distance, pdf, ..] = one;
        assert!(one.iter().all(|x| x.is_finite()), "not finite: {light:?} at {u:?}: {alone:?}");
        assert!(pdf >= 0.0 && distance >= 0.0, "negative: {light:?} at {u:?}: {alone:?}");
        let off = (length([x, y, z]) - 1.0).abs();
        assert!(
            pdf == 0.0 || off <= light.unit_to(),
            "not a unit vector, off by {off:e}: {light:?} at {u:?}: {alone:?}"
        );
        for (width, packet) in [(8, figures(&eight, i)), (4, if i < 4 { figures(&four, i) } else { one })] {
            assert_eq!(
                one.map(f64::to_bits),
                packet.map(f64::to_bits),
                "{width} lanes, lane {i}: {light:?} at {u:?}:\n{one:?}\n{packet:?}"
            );
        }
        let wide = figures(&T::draw::<f64>(&[light], squares_of(&[u])), 0);
        assert!(wide.iter().all(|x| x.is_finite()) && wide[4] >= 0.0, "f64: {light:?} at {u:?}: {wide:?}");
    }
}

/// **One density**: that of a sample is that which is evaluated for its direction.
pub fn one_pdf<T: Technique>(light: &T, u: [f32; 2]) {
    let s = T::draw::<f32>(&[*light], squares_of(&[u]));
    if let (Some(evaluated), true) = (T::evaluate::<f32>(&[*light], s.direction), s.pdf > 0.0) {
        let off = (f64::from(evaluated) / f64::from(s.pdf) - 1.0).abs();
        assert!(
            off <= light.evaluated_to(s.direction.at(0)),
            "two densities: {evaluated} evaluated, {} sampled: {light:?} at {u:?}",
            s.pdf
        );
    }
}

/// The density is the truth for the point that was drawn.
pub fn measure<T: Technique>(light: &T, u: [f32; 2]) {
    let s = T::draw::<f32>(&[*light], squares_of(&[u]));
    let Some((truth, known)) = light.truth(s.direction.at(0), f64::from(s.distance)) else { return };
    // what is next to a number's end, or known to less than a tenth, tells nothing
    let fair = (1e-15..1e15).contains(&s.distance) && (1e-30..1e30).contains(&truth);
    if s.pdf > 0.0 && known < 0.1 && fair {
        let off = (f64::from(s.pdf) / truth - 1.0).abs();
        assert!(off <= known, "pdf {} for {truth}: off by {off:e}, allowed {known:e}: {light:?} at {u:?}", s.pdf);
    }
}

/// **Threshold-free**: lengths times a power of two change no bit of a direction, and none of a density, but for its exponent.
pub fn scale<T: Technique>(light: &T, u: [f32; 2]) {
    let one = T::draw::<f32>(&[*light], squares_of(&[u]));
    for power in [-20, -7, 1, 20] {
        let factor = 2.0_f32.powi(power);
        let other = T::draw::<f32>(&[light.scaled(factor)], squares_of(&[u]));
        let (mut expected, other) = (figures(&one, 0), figures(&other, 0));
        expected[3] *= f64::from(factor);
        expected[4] *= f64::from(light.density_scaled(factor));
        assert_eq!(
            expected.map(f64::to_bits),
            other.map(f64::to_bits),
            "scaled by 2^{power}: {light:?} at {u:?}:\n{expected:?}\n{other:?}"
        );
    }
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
    /// From `a` along `b`, of the radius.
    Cylinder,
    /// `a`, `a` + `b`, `a` + `b` + `c`, `a` + `c`.
    Polygon,
    /// `a`, and from there `b`, `c` and, to the opposite corner, `n`.
    Patch,
    /// From `a` along `b`.
    Line,
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
    /// Measure solid angle, warped towards the cosine to `n`.
    CosineWarp,
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

impl AreaLight {
    /// All shapes by all techniques.
    pub const KINDS: [(LightShape, Measure); 23] = [
        (LightShape::Sphere, Measure::Area),
        (LightShape::Sphere, Measure::SolidAngle),
        (LightShape::Sphere, Measure::ProjectedSolidAngle),
        (LightShape::Triangle, Measure::Area),
        (LightShape::Triangle, Measure::SolidAngle),
        (LightShape::Triangle, Measure::ProjectedSolidAngle),
        (LightShape::Triangle, Measure::CosineWarp),
        (LightShape::Parallelogram, Measure::Area),
        (LightShape::Parallelogram, Measure::SolidAngle),
        (LightShape::Parallelogram, Measure::ProjectedSolidAngle),
        (LightShape::Rectangle, Measure::Area),
        (LightShape::Rectangle, Measure::SolidAngle),
        (LightShape::Rectangle, Measure::CosineWarp),
        (LightShape::Disk, Measure::Area),
        (LightShape::Disk, Measure::SolidAngle),
        (LightShape::Cylinder, Measure::Area),
        (LightShape::Polygon, Measure::Area),
        (LightShape::Polygon, Measure::SolidAngle),
        (LightShape::Polygon, Measure::ProjectedSolidAngle),
        (LightShape::Patch, Measure::Area),
        (LightShape::Line, Measure::Area),
        (LightShape::Line, Measure::SolidAngle),
        (LightShape::Line, Measure::ProjectedSolidAngle),
    ];
    fn vectors<R: Real>(lanes: &[Self]) -> ([Vec3<R>; 5], R) {
        let of = |i: usize| lanes[i % lanes.len()];
        let vectors = [
            vectors_of(|i| of(i).p),
            vectors_of(|i| of(i).a),
            vectors_of(|i| of(i).b),
            vectors_of(|i| of(i).c),
            vectors_of(|i| of(i).n),
        ];
        (vectors, lanes_of(|i| f64::from(of(i).radius)))
    }
    /// Coordinates of a point relative to `a`, rounded as the shape's own are.
    fn offset(&self) -> V3 {
        wide(core::array::from_fn(|k| self.a[k] - self.p[k]))
    }
}

impl Technique for AreaLight {
    fn draw<R: Real>(lanes: &[Self], u: Vec2<R>) -> LightSample<R> {
        let ([p, a, b, c, n], radius) = Self::vectors::<R>(lanes);
        let sphere = Sphere { center: a, radius };
        let triangle = Triangle { v0: a, e1: b, e2: c };
        let parallelogram = Parallelogram { p: a, u: b, v: c };
        let rectangle = Rectangle { p: a, u: b, v: c };
        let disk = Disk { center: a, normal: b, radius };
        let polygon = Polygon { corners: [a, a + b, a + b + c, a + c] };
        let line = Line { p: a, edge: b };
        match (lanes[0].shape, lanes[0].by) {
            (LightShape::Sphere, Measure::SolidAngle) => sphere.by_solid_angle(p, u),
            (LightShape::Sphere, Measure::ProjectedSolidAngle) => sphere.by_projected_solid_angle(p, n, u),
            (LightShape::Sphere, _) => sphere.by_area(p, u),
            (LightShape::Triangle, Measure::SolidAngle) => triangle.by_solid_angle(p, u),
            (LightShape::Triangle, Measure::ProjectedSolidAngle) => triangle.by_projected_solid_angle(p, n, u),
            (LightShape::Triangle, Measure::CosineWarp) => triangle.by_cosine_warp(p, n, u),
            (LightShape::Triangle, Measure::Area) => triangle.by_area(p, u),
            (LightShape::Parallelogram, Measure::SolidAngle) => parallelogram.by_solid_angle(p, u),
            (LightShape::Parallelogram, Measure::ProjectedSolidAngle) => {
                parallelogram.by_projected_solid_angle(p, n, u)
            }
            (LightShape::Parallelogram, _) => parallelogram.by_area(p, u),
            (LightShape::Rectangle, Measure::SolidAngle) => rectangle.by_solid_angle(p, u),
            (LightShape::Rectangle, Measure::CosineWarp) => rectangle.by_cosine_warp(p, n, u),
            (LightShape::Rectangle, _) => rectangle.by_area(p, u),
            (LightShape::Disk, Measure::SolidAngle) => disk.by_solid_angle(p, u),
            (LightShape::Disk, _) => disk.by_area(p, u),
            (LightShape::Cylinder, _) => Cylinder { p: a, axis: b, radius }.by_area(p, u),
            (LightShape::Polygon, Measure::SolidAngle) => polygon.by_solid_angle(p, u),
            (LightShape::Polygon, Measure::ProjectedSolidAngle) => polygon.by_projected_solid_angle(p, n, u),
            (LightShape::Polygon, _) => polygon.by_area(p, u),
            (LightShape::Patch, _) => BilinearPatch { p: a, u: b, v: c, w: n }.by_area(p, u),
            (LightShape::Line, Measure::SolidAngle) => line.by_angle(p, u.x),
            (LightShape::Line, Measure::ProjectedSolidAngle) => line.by_projected_solid_angle(p, n, u.x),
            (LightShape::Line, _) => line.by_length(p, u.x),
        }
    }
    fn evaluate<R: Real>(lanes: &[Self], w: Vec3<R>) -> Option<R> {
        let ([p, a, b, c, n], radius) = Self::vectors::<R>(lanes);
        let v = a - p;
        let corners = || [v, (a + b) - p, (a + b + c) - p, (a + c) - p];
        match (lanes[0].shape, lanes[0].by) {
            (LightShape::Sphere, Measure::SolidAngle) => Some(SphericalCap::new(v, radius).pdf(w)),
            (LightShape::Sphere, Measure::ProjectedSolidAngle) => Some(ProjectedCap::new(v, radius, n).pdf(w)),
            (LightShape::Triangle, Measure::SolidAngle) => {
                Some(SphericalTriangle::with_edges(v, v + b, v + c, b, c).pdf(w))
            }
            (LightShape::Triangle, Measure::ProjectedSolidAngle) => {
                Some(ProjectedTriangle::with_edges(v, v + b, v + c, b, c, n).pdf(w))
            }
            (LightShape::Parallelogram, Measure::SolidAngle) => Some(SphericalParallelogram::new(v, b, c).pdf(w)),
            (LightShape::Parallelogram, Measure::ProjectedSolidAngle) => {
                Some(ProjectedPolygon::parallelogram(v, b, c, n).pdf(w))
            }
            (LightShape::Rectangle, Measure::SolidAngle) => Some(SphericalRectangle::new(v, b, c).pdf(w)),
            (LightShape::Disk, Measure::SolidAngle) => Some(SphericalDisk::new(v, b, radius).pdf(w)),
            (LightShape::Polygon, Measure::SolidAngle) => Some(SphericalPolygon::new(corners()).pdf(w)),
            (LightShape::Polygon, Measure::ProjectedSolidAngle) => Some(ProjectedPolygon::new(corners(), n).pdf(w)),
            _ => None,
        }
    }
    fn truth(&self, w: V3, distance: f64) -> Option<(f64, f64)> {
        // of a patch no density is known, and the corners of a polygon are rounded
        if self.by != Measure::Area || matches!(self.shape, LightShape::Patch | LightShape::Polygon) {
            return None;
        }
        let (a, b, c, r) = (self.offset(), wide(self.b), wide(self.c), f64::from(self.radius));
        let from = |center: V3| sub(w.map(|x| x * distance), center);
        // normal, not of unit length, and the area; what a rounded point does to the normal
        let (normal, area, turned) = match self.shape {
            LightShape::Sphere => (from(a), 2.0 * TAU * r * r, distance / r.abs()),
            LightShape::Triangle => (cross(b, c), 0.5 * length(cross(b, c)), 0.0),
            LightShape::Parallelogram | LightShape::Rectangle => (cross(b, c), length(cross(b, c)), 0.0),
            LightShape::Disk => (b, PI * r * r, 0.0),
            LightShape::Cylinder => {
                let x = from(a);
                let along = dot(x, b) / dot(b, b);
                (core::array::from_fn(|k| x[k] - b[k] * along), TAU * r.abs() * length(b), distance / r.abs())
            }
            // what is across the direction
            LightShape::Line => (cross(b, cross(w, b)), length(b), 0.0),
            LightShape::Polygon | LightShape::Patch => return None,
        };
        // what is subnormal has few digits
        if !(1e-36..1e36).contains(&area) {
            return None;
        }
        let cos = dot(w, normal).abs() / length(normal);
        // a product that cancels is known no better than its factors
        let sine = length(cross(b, c)) / (length(b) * length(c));
        let flat = matches!(self.shape, LightShape::Triangle | LightShape::Parallelogram | LightShape::Rectangle);
        let slim = if flat { 8.0 / sine } else { 0.0 };
        Some((distance * distance / (cos * area), (16.0 + slim + (12.0 + slim + 4.0 * turned) / cos) * ULP))
    }
    /// The cosine is a sum of rounded products; a direction on the horizon may be moved onto it.
    fn evaluated_to(&self, w: V3) -> f64 {
        let cos = dot(w, wide(self.n)).abs();
        if self.by == Measure::ProjectedSolidAngle { (4.0 + 512.0 / cos) * ULP } else { 4.0 * ULP }
    }
    /// Flat shapes by projected solid angle, seen from their own plane or a corner but for rounding, have directions of any length up to 1.
    fn unit_to(&self) -> f64 {
        let (v, normal) = (self.offset(), cross(wide(self.b), wide(self.c)));
        let flat = matches!(self.shape, LightShape::Triangle | LightShape::Parallelogram | LightShape::Polygon);
        let size = length(wide(self.b)) + length(wide(self.c));
        let edge_on = !(dot(v, normal).abs() > 1e-4 * length(v) * length(normal) && length(v) > 1e-4 * size);
        // what is subnormal has few digits
        let touched = self.shape == LightShape::Line && length(v) < 1e-4 * size || length(v) < 1e-37;
        let coarse = flat && edge_on && self.by == Measure::ProjectedSolidAngle || touched;
        if coarse { 1.0 } else { 12.0 * ULP }
    }
    fn density_scaled(&self, factor: f32) -> f32 {
        if self.shape == LightShape::Line { factor } else { 1.0 }
    }
    fn scaled(&self, factor: f32) -> Self {
        let times = |v: [f32; 3]| v.map(|x| x * factor);
        // directions stay
        let b = if self.shape == LightShape::Disk { self.b } else { times(self.b) };
        let n = if self.shape == LightShape::Patch { times(self.n) } else { self.n };
        Self { p: times(self.p), a: times(self.a), b, c: times(self.c), n, radius: self.radius * factor, ..*self }
    }
}
