//! The techniques of each kind of shape: ours, and the textbook's.

use super::pose::{Kind, Pose, Shape};
use super::textbook::{self, Excess};
use etendue::seen::{
    ProjectedCap, SphereCap, SphericalParallelogram, SphericalPolygon, SphericalRectangle, SphericalTriangle,
};
use etendue::{LightSample, Parallelogram, Sphere, Triangle, Vec2, Vec3, Warp};

/// What a technique says for one `u`.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Unit direction.
    pub direction: [f32; 3],
    /// Density per steradian, evaluated for the direction.
    pub pdf: f32,
    /// Inverse of the direction, where there is one.
    pub inverse: Option<[f32; 2]>,
    /// Was it drawn by area?
    pub by_area: bool,
    /// Is it of the side that emits?
    pub emits: bool,
}
impl Sample {
    /// By solid angle.
    #[must_use]
    pub fn new(direction: [f32; 3], pdf: f32, inverse: Option<[f32; 2]>) -> Self {
        Self { direction, pdf, inverse, by_area: false, emits: true }
    }
    /// Is all of it finite?
    #[must_use]
    pub fn finite(&self) -> bool {
        let inverse = self.inverse.unwrap_or_default();
        self.direction.iter().chain(&inverse).chain(&[self.pdf]).all(|x| x.is_finite())
    }
}

/// What to draw, and where to put it.
#[derive(Debug)]
pub struct Draw<'a> {
    /// Points of the square.
    pub us: &'a [[f32; 2]],
    /// Is the inverse wanted too?
    pub invert: bool,
    /// The samples.
    pub out: &'a mut Vec<Sample>,
}
impl Draw<'_> {
    /// One sample for each point.
    pub(super) fn each(&mut self, f: impl Fn([f32; 2], bool) -> Sample) {
        self.out.extend(self.us.iter().map(|&u| f(u, self.invert)));
    }
    fn warp(&mut self, warp: &impl Warp<f32, Point = Vec3<f32>>) {
        self.each(|u, invert| {
            let w = warp.sample(Vec2::new(u[0], u[1]));
            let inverse = invert.then(|| warp.invert(w)).map(|u| [u.x, u.y]);
            Sample::new([w.x, w.y, w.z], warp.pdf(w), inverse)
        });
    }
    fn light(&mut self, sample: impl Fn(Vec2<f32>) -> LightSample<f32>) {
        self.each(|u, _| {
            let LightSample { direction: w, pdf, emits, .. } = sample(Vec2::new(u[0], u[1]));
            Sample { by_area: true, emits, ..Sample::new([w.x, w.y, w.z], pdf, None) }
        });
    }
}

/// A technique.
#[derive(Clone, Copy, Debug)]
pub struct Method {
    /// Short.
    pub name: &'static str,
    /// Of the core, or a baseline?
    pub ours: bool,
    /// Prepares for a pose and draws.
    pub run: fn(&Pose, &mut Draw<'_>),
}

type V = [f32; 3];

fn vector(v: V) -> Vec3<f32> {
    Vec3::new(v[0], v[1], v[2])
}
fn add(a: V, b: V) -> V {
    core::array::from_fn(|i| a[i] + b[i])
}
fn sphere(pose: &Pose) -> (V, f32, V) {
    match pose.shape {
        Shape::Sphere { center, radius } => (center, radius, pose.normal),
        _ => ([0.0; 3], 0.0, pose.normal),
    }
}
fn flat(pose: &Pose) -> (V, V, V) {
    match pose.shape {
        Shape::Flat { p, u, v } => (p, u, v),
        _ => ([0.0; 3], [0.0; 3], [0.0; 3]),
    }
}
fn corners(pose: &Pose) -> [V; 6] {
    match pose.shape {
        Shape::Corners(corners) => corners,
        _ => [[0.0; 3]; 6],
    }
}
/// As the core orders them: about the first corner.
fn halves(pose: &Pose) -> [[V; 3]; 2] {
    let (p, u, v) = flat(pose);
    let (pu, puv, pv) = (add(p, u), add(add(p, u), v), add(p, v));
    [[pu, p, puv], [puv, p, pv]]
}
fn hexagon(pose: &Pose) -> [[V; 3]; 4] {
    let c = corners(pose);
    core::array::from_fn(|i| [c[i + 1], c[0], c[i + 2]])
}
const ORIGIN: Vec3<f32> = Vec3 { x: 0.0, y: 0.0, z: 0.0 };

/// Those of a kind of shape: by solid angle or projected solid angle first, then by area, then the textbook's.
#[must_use]
pub fn methods(kind: Kind) -> Vec<Method> {
    let ours = |name, run| Method { name, ours: true, run };
    let textbook = |name, run| Method { name, ours: false, run };
    let sphere_area = ours("by area", |pose, draw| {
        let (center, radius, _) = sphere(pose);
        let light = Sphere { center: vector(center), radius };
        draw.light(|u| light.by_area(ORIGIN, u));
    });
    let area = ours("by area", |pose, draw| {
        let (p, u, v) = flat(pose);
        let light = Parallelogram { p: vector(p), u: vector(u), v: vector(v) };
        draw.light(|u| light.by_area(ORIGIN, u));
    });
    match kind {
        Kind::Sphere => vec![
            ours("SphereCap", |pose, draw| {
                let (center, radius, _) = sphere(pose);
                draw.warp(&SphereCap::new(vector(center), radius));
            }),
            sphere_area,
            textbook("cone, 1-cos naive", |pose, draw| {
                let (center, radius, _) = sphere(pose);
                textbook::cone(center, radius, false, draw);
            }),
            textbook("cone, series below 1.5°", |pose, draw| {
                let (center, radius, _) = sphere(pose);
                textbook::cone(center, radius, true, draw);
            }),
        ],
        Kind::ProjectedSphere => vec![
            ours("ProjectedCap", |pose, draw| {
                let (center, radius, normal) = sphere(pose);
                draw.warp(&ProjectedCap::new(vector(center), radius, vector(normal)));
            }),
            sphere_area,
            textbook("closed form of the density", |pose, draw| {
                let (center, radius, normal) = sphere(pose);
                let projected = textbook::projected_cap(center, radius, normal);
                let cap = ProjectedCap::new(vector(center), radius, vector(normal));
                draw.each(|u, _| {
                    let w = cap.sample(Vec2::new(u[0], u[1]));
                    let cos = w.dot(vector(normal)).max(0.0);
                    Sample::new([w.x, w.y, w.z], cos / projected, None)
                });
            }),
        ],
        Kind::Triangle => vec![
            ours("SphericalTriangle", |pose, draw| {
                let (p, u, v) = flat(pose);
                let (p, u, v) = (vector(p), vector(u), vector(v));
                draw.warp(&SphericalTriangle::with_edges(p, p + u, p + v, u, v));
            }),
            ours("by area", |pose, draw| {
                let (p, u, v) = flat(pose);
                let light = Triangle { v0: vector(p), e1: vector(u), e2: vector(v) };
                draw.light(|u| light.by_area(ORIGIN, u));
            }),
            textbook("Arvo, angle excess", |pose, draw| {
                let (p, u, v) = flat(pose);
                textbook::fan([[p, add(p, u), add(p, v)]], Excess::Angles, draw);
            }),
            textbook("Van Oosterom, unit vectors", |pose, draw| {
                let (p, u, v) = flat(pose);
                textbook::fan([[p, add(p, u), add(p, v)]], Excess::Oosterom, draw);
            }),
            textbook("area outside 3e-4 to 6.22 sr", |pose, draw| {
                let (p, u, v) = flat(pose);
                textbook::triangle_with_thresholds(p, u, v, draw);
            }),
        ],
        Kind::Parallelogram => vec![
            ours("SphericalParallelogram", |pose, draw| {
                let (p, u, v) = flat(pose);
                draw.warp(&SphericalParallelogram::new(vector(p), vector(u), vector(v)));
            }),
            area,
            textbook("two of Arvo, angle excess", |pose, draw| textbook::fan(halves(pose), Excess::Angles, draw)),
            textbook("two of Van Oosterom", |pose, draw| textbook::fan(halves(pose), Excess::Oosterom, draw)),
        ],
        Kind::Rectangle => vec![
            ours("SphericalRectangle", |pose, draw| {
                let (p, u, v) = flat(pose);
                draw.warp(&SphericalRectangle::new(vector(p), vector(u), vector(v)));
            }),
            area,
            textbook("Ureña 2013 as published", |pose, draw| {
                let (p, u, v) = flat(pose);
                textbook::urena(p, u, v, draw);
            }),
            textbook("area outside 3e-4 to 6.22 sr", |pose, draw| {
                let (p, u, v) = flat(pose);
                textbook::rectangle_with_thresholds(p, u, v, draw);
            }),
        ],
        Kind::Polygon => vec![
            ours("SphericalPolygon", |pose, draw| {
                draw.warp(&SphericalPolygon::new(corners(pose).map(vector)));
            }),
            textbook("four of Arvo, angle excess", |pose, draw| textbook::fan(hexagon(pose), Excess::Angles, draw)),
            textbook("four of Van Oosterom", |pose, draw| textbook::fan(hexagon(pose), Excess::Oosterom, draw)),
        ],
    }
}
