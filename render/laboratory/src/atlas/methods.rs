//! The techniques for each kind of shape: those of the library, and textbook formulas.

use super::pose::{Pose, Shape, ShapeKind};
use super::sample::{Draw, Sample};
use etendue::light::Polygon;
use etendue::light::shapes::{
    DirectionSample, ProjectedCap, ProjectedPolygon, ProjectedSegment, ProjectedTriangle, SphericalCap, SphericalDisk,
    SphericalParallelogram, SphericalPolygon, SphericalRectangle, SphericalSegment, SphericalTriangle,
};
use etendue::{Disk, LightSample, LightSampler, Line, Parallelogram, Sphere, Triangle, Vec2, Vec3, Warp};
use etendue_judge::lights::sampler::Sampler;
use etendue_judge::textbook::{self, Excess, add};

impl Draw<'_> {
    /// Draws samples by projected solid angle; the weight is the pdf at the cosine to the given normal.
    fn projected(&mut self, warp: &impl Warp<f32, Point = Vec3<f32>>, density: impl Fn(f32) -> f32, normal: Vec3<f32>) {
        self.each(|u, invert| {
            let w = warp.sample(Vec2::new(u[0], u[1]));
            let inverse = invert.then(|| warp.invert(w)).map(|u| [u.x, u.y]);
            let weight = density(w.dot(normal));
            Sample { weight, ..Sample::new([w.x, w.y, w.z], warp.pdf(w), inverse) }
        });
    }
    fn warp(&mut self, warp: &impl Warp<f32, Point = Vec3<f32>>) {
        self.each(|u, invert| {
            let w = warp.sample(Vec2::new(u[0], u[1]));
            let inverse = invert.then(|| warp.invert(w)).map(|u| [u.x, u.y]);
            Sample::new([w.x, w.y, w.z], warp.pdf(w), inverse)
        });
    }
    /// Draws samples along a line with the weight of its light; the second random number is unused.
    fn line(
        &mut self,
        sample: impl Fn(f32) -> Vec3<f32>,
        pdf: impl Fn(Vec3<f32>) -> f32,
        inverse: impl Fn(Vec3<f32>) -> f32,
        weight: impl Fn(f32) -> f32,
    ) {
        self.each(|u, invert| {
            let w = sample(u[0]);
            let inverse = invert.then(|| [inverse(w), u[1]]);
            Sample { weight: weight(u[0]), ..Sample::new([w.x, w.y, w.z], pdf(w), inverse) }
        });
    }
    /// Draws our directions with another pdf: `density`, times the cosine to a normal if given.
    fn with_density(&mut self, warp: &impl Warp<f32, Point = Vec3<f32>>, density: f32, normal: Option<Vec3<f32>>) {
        self.each(|u, _| {
            let w = warp.sample(Vec2::new(u[0], u[1]));
            let cos = normal.map_or(1.0, |n| w.dot(n).max(0.0));
            Sample::new([w.x, w.y, w.z], cos * density, None)
        });
    }
    fn textbook(&mut self, sampler: &dyn Sampler, by_area: bool) {
        self.each(|u, invert| {
            let (w, pdf) = sampler.sample(u).map_or(([0.0; 3], 0.0), |s| (s.direction, s.pdf));
            let inverse = if invert { sampler.invert(w) } else { None };
            Sample { by_area, ..Sample::new(w, pdf, inverse) }
        });
    }
    /// A sampler that is by area where it has no inverse.
    fn with_thresholds(&mut self, sampler: &dyn Sampler) {
        self.textbook(sampler, sampler.invert([0.0, 0.0, 1.0]).is_none());
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
    /// Short name.
    pub name: &'static str,
    /// Whether it belongs to the library; otherwise it is a baseline.
    pub ours: bool,
    /// Prepares for a pose and draws samples.
    pub run: Run,
}

/// Prepares for a pose and draws samples.
type Run = fn(&Pose, &mut Draw<'_>);

type V = [f32; 3];

fn vector(v: V) -> Vec3<f32> {
    Vec3::new(v[0], v[1], v[2])
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
fn disk(pose: &Pose) -> (V, V, f32) {
    match pose.shape {
        Shape::Disk { center, normal, radius } => (center, normal, radius),
        _ => ([0.0; 3], [0.0; 3], 0.0),
    }
}
fn segment(pose: &Pose) -> (V, V) {
    match pose.shape {
        Shape::Segment { a, edge } => (a, edge),
        _ => ([0.0; 3], [0.0; 3]),
    }
}
fn line(pose: &Pose) -> Line<f32> {
    let (a, edge) = segment(pose);
    Line { start: vector(a), edge: vector(edge) }
}
fn corners(pose: &Pose) -> [V; 6] {
    match pose.shape {
        Shape::Corners(corners) => corners,
        _ => [[0.0; 3]; 6],
    }
}
/// The two triangles of a parallelogram, in the order of the library: about the first corner.
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

fn ours(name: &'static str, run: Run) -> Method {
    Method { name, ours: true, run }
}
fn textbook(name: &'static str, run: Run) -> Method {
    Method { name, ours: false, run }
}

/// The techniques for a kind of shape: by (projected) solid angle, then by area, then textbook formulas.
#[must_use]
pub fn methods(kind: ShapeKind) -> Vec<Method> {
    let textbooks = if kind.projected() { textbooks_projected(kind) } else { textbooks(kind) };
    [own(kind), ours("by area", by_area(kind))].into_iter().chain(textbooks).collect()
}

/// Samples uniform over the area, or over the length of a line.
fn by_area(kind: ShapeKind) -> Run {
    match kind {
        ShapeKind::Sphere | ShapeKind::ProjectedSphere => |pose, draw| {
            let (center, radius, _) = sphere(pose);
            let light = Sphere { center: vector(center), radius };
            draw.light(|u| light.by_area(ORIGIN).sample(u));
        },
        ShapeKind::Parallelogram | ShapeKind::Rectangle | ShapeKind::ProjectedParallelogram => |pose, draw| {
            let (p, u, v) = flat(pose);
            let light = Parallelogram { corner: vector(p), edge_s: vector(u), edge_t: vector(v) };
            draw.light(|u| light.by_area(ORIGIN).sample(u));
        },
        ShapeKind::Triangle | ShapeKind::ProjectedTriangle => |pose, draw| {
            let (p, u, v) = flat(pose);
            let light = Triangle { v0: vector(p), e1: vector(u), e2: vector(v) };
            draw.light(|u| light.by_area(ORIGIN).sample(u));
        },
        ShapeKind::Polygon | ShapeKind::ProjectedPolygon => |pose, draw| {
            let light = Polygon { corners: corners(pose).map(vector) };
            draw.light(|u| light.by_area(ORIGIN).sample(u));
        },
        ShapeKind::Segment | ShapeKind::ProjectedSegment => |pose, draw| {
            let light = line(pose);
            draw.each(|u, _| {
                let LightSample { direction: w, distance, pdf, .. } =
                    light.by_length(ORIGIN).sample(Vec2::new(u[0], 0.0));
                // per radian in the plane of point and line
                let density = if pdf > 0.0 { pdf / distance } else { 0.0 };
                Sample { by_area: true, weight: pdf, ..Sample::new([w.x, w.y, w.z], density, None) }
            });
        },
        ShapeKind::Disk => |pose, draw| {
            let (center, normal, radius) = disk(pose);
            let light = Disk { center: vector(center), normal: vector(normal), radius };
            draw.light(|u| light.by_area(ORIGIN).sample(u));
        },
    }
}

/// The technique of the library by (projected) solid angle.
fn own(kind: ShapeKind) -> Method {
    match kind {
        ShapeKind::Sphere => ours("SphericalCap", |pose, draw| {
            let (center, radius, _) = sphere(pose);
            draw.warp(&SphericalCap::new(vector(center), radius));
        }),
        ShapeKind::ProjectedSphere => ours("ProjectedCap", |pose, draw| {
            let (center, radius, normal) = sphere(pose);
            let map = ProjectedCap::new(vector(center), radius, vector(normal));
            draw.projected(&map, |cos| map.pdf_at_cosine(cos), vector(normal));
        }),
        ShapeKind::Triangle => ours("SphericalTriangle", |pose, draw| {
            let (p, u, v) = flat(pose);
            let (p, u, v) = (vector(p), vector(u), vector(v));
            draw.warp(&SphericalTriangle::with_edges(p, p + u, p + v, u, v));
        }),
        ShapeKind::Parallelogram => ours("SphericalParallelogram", |pose, draw| {
            let (p, u, v) = flat(pose);
            draw.warp(&SphericalParallelogram::new(vector(p), vector(u), vector(v)));
        }),
        ShapeKind::Rectangle => ours("SphericalRectangle", |pose, draw| {
            let (p, u, v) = flat(pose);
            draw.warp(&SphericalRectangle::new(vector(p), vector(u), vector(v)));
        }),
        ShapeKind::Polygon => ours("SphericalPolygon", |pose, draw| {
            draw.warp(&SphericalPolygon::new(corners(pose).map(vector)));
        }),
        ShapeKind::Disk => ours("SphericalDisk", |pose, draw| {
            let (center, normal, radius) = disk(pose);
            draw.warp(&SphericalDisk::new(vector(center), vector(normal), radius));
        }),
        ShapeKind::Segment => ours("SphericalSegment", |pose, draw| {
            let (a, edge) = segment(pose);
            let map = SphericalSegment::new(vector(a), vector(edge));
            let weight = |u| line(pose).by_angle(ORIGIN).sample(Vec2::new(u, 0.0)).pdf;
            draw.line(|u| map.sample(u), |w| map.pdf(w), |w| map.invert(w), weight);
        }),
        ShapeKind::ProjectedTriangle => ours("ProjectedTriangle", |pose, draw| {
            let (p, u, v) = flat(pose);
            let (p, u, v, n) = (vector(p), vector(u), vector(v), vector(pose.normal));
            let map = ProjectedTriangle::with_edges(p, p + u, p + v, u, v, n);
            draw.projected(&map, |cos| map.pdf_at_cosine(cos), n);
        }),
        ShapeKind::ProjectedParallelogram => ours("ProjectedPolygon of 4", |pose, draw| {
            let (p, u, v) = flat(pose);
            let n = vector(pose.normal);
            let map = ProjectedPolygon::parallelogram(vector(p), vector(u), vector(v), n);
            draw.projected(&map, |cos| map.pdf_at_cosine(cos), n);
        }),
        ShapeKind::ProjectedPolygon => ours("ProjectedPolygon of 6", |pose, draw| {
            let n = vector(pose.normal);
            let map = ProjectedPolygon::new(corners(pose).map(vector), n);
            draw.projected(&map, |cos| map.pdf_at_cosine(cos), n);
        }),
        ShapeKind::ProjectedSegment => ours("ProjectedSegment", |pose, draw| {
            let (a, edge) = segment(pose);
            let map = ProjectedSegment::new(vector(a), vector(edge), vector(pose.normal));
            let weight =
                |u| line(pose).by_projected_solid_angle(ORIGIN, vector(pose.normal)).sample(Vec2::new(u, 0.0)).pdf;
            draw.line(|u| map.sample(u), |w| map.pdf(w), |w| map.invert(w), weight);
        }),
    }
}

/// Formulas for sampling by solid angle.
fn textbooks(kind: ShapeKind) -> Vec<Method> {
    match kind {
        ShapeKind::Sphere => vec![
            textbook("cone, 1-cos naive", |pose, draw| {
                let (center, radius, _) = sphere(pose);
                draw.textbook(&textbook::Cone::new(center, radius, false), false);
            }),
            textbook("cone, series below 1.5°", |pose, draw| {
                let (center, radius, _) = sphere(pose);
                draw.textbook(&textbook::Cone::new(center, radius, true), false);
            }),
        ],
        ShapeKind::Triangle => vec![
            textbook("Arvo, angle excess", |pose, draw| {
                let (p, u, v) = flat(pose);
                draw.textbook(&textbook::Fan::new(&[[p, add(p, u), add(p, v)]], Excess::Angles), false);
            }),
            textbook("Van Oosterom, unit vectors", |pose, draw| {
                let (p, u, v) = flat(pose);
                draw.textbook(&textbook::Fan::new(&[[p, add(p, u), add(p, v)]], Excess::Oosterom), false);
            }),
            textbook("by area outside 3e-4 to 6.22 sr", |pose, draw| {
                let (p, u, v) = flat(pose);
                draw.with_thresholds(&*textbook::triangle_with_thresholds([p, u, v]));
            }),
        ],
        ShapeKind::Parallelogram => vec![
            textbook("Arvo ×2, angle excess", |pose, draw| {
                draw.textbook(&textbook::Fan::new(&halves(pose), Excess::Angles), false)
            }),
            textbook("Van Oosterom ×2", |pose, draw| {
                draw.textbook(&textbook::Fan::new(&halves(pose), Excess::Oosterom), false)
            }),
        ],
        ShapeKind::Rectangle => vec![
            textbook("Ureña 2013 as published", |pose, draw| {
                let (p, u, v) = flat(pose);
                draw.textbook(&textbook::Urena::new([p, u, v]), false);
            }),
            textbook("by area outside 3e-4 to 6.22 sr", |pose, draw| {
                let (p, u, v) = flat(pose);
                draw.with_thresholds(&*textbook::rectangle_with_thresholds([p, u, v]));
            }),
        ],
        ShapeKind::Polygon => vec![
            textbook("Arvo ×4, angle excess", |pose, draw| {
                draw.textbook(&textbook::Fan::new(&hexagon(pose), Excess::Angles), false)
            }),
            textbook("Van Oosterom ×4", |pose, draw| {
                draw.textbook(&textbook::Fan::new(&hexagon(pose), Excess::Oosterom), false)
            }),
        ],
        ShapeKind::Disk => vec![textbook("Ω by arc cosines of the cone", |pose, draw| {
            let (center, normal, radius) = disk(pose);
            let map = SphericalDisk::new(vector(center), vector(normal), radius);
            draw.with_density(&map, 1.0 / textbook::disk(center, normal, radius), None);
        })],
        ShapeKind::Segment => vec![textbook("equiangular, by arc tangents", |pose, draw| {
            let (a, edge) = segment(pose);
            let map = textbook::Equiangular::new(a, edge);
            let back = |v: Vec3<f32>| [v.x, v.y, v.z];
            let weight = |u| map.pdf() * map.distance(u);
            draw.line(|u| vector(map.sample(u)), |_| map.pdf(), |w| map.invert(back(w)), weight);
        })],
        _ => Vec::new(),
    }
}

/// Formulas for sampling by projected solid angle.
fn textbooks_projected(kind: ShapeKind) -> Vec<Method> {
    match kind {
        ShapeKind::ProjectedSphere => vec![textbook("closed form of the pdf", |pose, draw| {
            let (center, radius, normal) = sphere(pose);
            let projected = textbook::projected_cap(center, radius, normal);
            let cap = ProjectedCap::new(vector(center), radius, vector(normal));
            draw.each(|u, _| {
                let w = cap.sample(Vec2::new(u[0], u[1]));
                let cos = w.dot(vector(normal)).max(0.0);
                Sample::new([w.x, w.y, w.z], cos / projected, None)
            });
        })],
        ShapeKind::ProjectedTriangle => vec![textbook("Lambert by arc cosines", |pose, draw| {
            let (p, u, v) = flat(pose);
            let corners = [p, add(p, u), add(p, v)];
            let (p, u, v, n) = (vector(p), vector(u), vector(v), vector(pose.normal));
            let map = ProjectedTriangle::with_edges(p, p + u, p + v, u, v, n);
            draw.with_density(&map, 1.0 / textbook::lambert(&corners, pose.normal), Some(n));
        })],
        ShapeKind::ProjectedParallelogram => vec![textbook("Lambert by arc cosines", |pose, draw| {
            let (p, u, v) = flat(pose);
            let corners = [p, add(p, u), add(add(p, u), v), add(p, v)];
            let n = vector(pose.normal);
            let map = ProjectedPolygon::parallelogram(vector(p), vector(u), vector(v), n);
            draw.with_density(&map, 1.0 / textbook::lambert(&corners, pose.normal), Some(n));
        })],
        ShapeKind::ProjectedPolygon => vec![textbook("Lambert by arc cosines", |pose, draw| {
            let n = vector(pose.normal);
            let map = ProjectedPolygon::new(corners(pose).map(vector), n);
            draw.with_density(&map, 1.0 / textbook::lambert(&corners(pose), pose.normal), Some(n));
        })],
        ShapeKind::ProjectedSegment => vec![textbook("pdf by closed-form integral", |pose, draw| {
            let (a, edge) = segment(pose);
            let map = ProjectedSegment::new(vector(a), vector(edge), vector(pose.normal));
            let whole = textbook::projected_segment(a, edge, pose.normal);
            let (along, n) = (vector(edge), vector(pose.normal));
            let along = along * (1.0 / along.length());
            let pdf = |w: Vec3<f32>| {
                let cos = w.dot(along);
                (1.0 - cos * cos).max(0.0).sqrt() * w.dot(n).max(0.0) / whole
            };
            draw.each(|u, _| {
                let DirectionSample { direction: w, distance } = map.sample_direction(u[0]);
                let pdf = pdf(w);
                Sample { weight: pdf * distance, ..Sample::new([w.x, w.y, w.z], pdf, None) }
            });
        })],
        _ => Vec::new(),
    }
}
