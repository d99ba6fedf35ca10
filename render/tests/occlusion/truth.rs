//! The truth about scenes.

use etendue::Vec3;
use etendue_judge::occlusion::Scene;
use etendue_oracle::visible::{Shape, Visible, spared, visible};
use etendue_oracle::{V3, along, basis, cross, dot, length, narrow, sub, unit, wide};
use etendue_visible::{Polyhedron, Solid, V64};

/// What is so near to the plane of a flat light does not occlude it, relative to the greatest coordinate of the point and the light, as
/// documented.
pub(crate) const ENDS: f64 = 1.0 / 2_097_152.0;

/// The exact value of a point.
pub(crate) fn exact(v: Vec3<f32>) -> V64 {
    v.map(f64::from)
}

/// A polygon whose corners are rounded to single precision.
pub(crate) fn polygon(corners: &[V3]) -> Solid {
    let corner = |i: usize| exact(Vec3::from(narrow(corners[i.min(corners.len() - 1)])));
    Solid::Polygon { corners: core::array::from_fn(corner), count: corners.len(), deviation: 0.0 }
}

/// A sphere, rounded to single precision.
pub(crate) fn sphere(center: V3, radius: f64) -> Solid {
    Solid::Sphere { center: exact(narrow(center).into()), radius: f64::from(radius as f32) }
}

/// The corners of each face of a polyhedron, in order around.
fn outlines(body: &Polyhedron) -> impl Iterator<Item = Vec<V3>> {
    body.faces().iter().enumerate().map(|(face, [normal, _])| {
        let (s, t) = basis(unit((*normal).into()));
        let edges = body.edges().iter().filter(|edge| edge.faces.contains(&face));
        let mut corners: Vec<V3> = edges.flat_map(|edge| edge.ends).map(V3::from).collect();
        let middle = corners.iter().fold([0.0; 3], |sum, v| along(sum, *v, 1.0 / corners.len() as f64));
        let angle = |v: &V3| dot(sub(*v, middle), t).atan2(dot(sub(*v, middle), s));
        corners.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
        corners.dedup();
        corners
    })
}

/// The surface of a shape relative to a point: a shape, or the faces of a polyhedron.
pub(crate) fn from_point(shape: &Solid, point: V3) -> Vec<Shape> {
    let relative = |v: V3| sub(v, point);
    let flat = |corners: &[V3]| Shape::Polygon(corners.iter().map(|&v| relative(v)).collect());
    match shape {
        Solid::Polygon { corners, count, .. } => vec![flat(&corners.map(V3::from)[..*count])],
        Solid::Parallelogram { corner, edges: [u, v] } => {
            vec![flat(&[*corner, *corner + *u, *corner + *u + *v, *corner + *v].map(V3::from))]
        }
        Solid::Sphere { center, radius } => vec![Shape::Sphere(relative((*center).into()), *radius)],
        Solid::Polyhedron(body) => outlines(body).map(|face| flat(&face)).collect(),
    }
}

/// How far a point is at least from the plane of a face of a polyhedron.
pub(crate) fn depth(body: &Polyhedron, point: V3) -> f64 {
    let depth = |&[normal, on]: &[V64; 2]| dot(unit(normal.into()), sub(on.into(), point));
    body.faces().iter().map(depth).fold(f64::INFINITY, f64::min).abs()
}

/// The least and the greatest distance of the edges of a polyhedron from a point.
fn distances(body: &Polyhedron, point: V3) -> [f64; 2] {
    body.edges().iter().fold([f64::INFINITY, 0.0], |[least, most], edge| {
        let [a, b] = edge.ends.map(|end| sub(end.into(), point));
        let d = sub(b, a);
        let nearest = along(a, d, (-dot(a, d) / dot(d, d)).clamp(0.0, 1.0));
        [least.min(length(nearest)), most.max(length(a)).max(length(b))]
    })
}

/// The truth about a scene.
pub(crate) trait Truth {
    /// What the least sine of an edge seen under more than a right angle divides, and the least cosine of a sphere's half-angle.
    fn condition(&self, lane: usize) -> f64;
    /// Whether the point lies within a flat occluder, nearer to its plane than single precision tells, which then hides one half of the
    /// directions or the other. The same holds for points on the surface of a polyhedron.
    fn surrounded(&self, lane: usize) -> bool;
    /// The deviation that a polyhedron states, which is rounding of its corners, over the least distance of an edge.
    fn unevenness(&self, lane: usize) -> f64;
    /// The truth for a lane, with a limit in front of the light that is a fifth nearer and farther.
    fn truth(&self, lane: usize) -> Option<[Visible; 2]>;
}

impl Truth for Scene {
    fn condition(&self, lane: usize) -> f64 {
        let sine = |shape: Shape| match shape {
            Shape::Polygon(corners) => (0..corners.len())
                .map(|i| (corners[i], corners[(i + 1) % corners.len()]))
                .filter(|(a, b)| dot(*a, *b) < 0.0)
                .map(|(a, b)| length(cross(unit(a), unit(b))))
                .fold(1.0, f64::min),
            Shape::Sphere(center, radius) => (1.0 - (radius / length(center)).powi(2)).max(0.0).sqrt(),
        };
        let shapes = self.occluders.iter().chain([&self.light]);
        shapes.flat_map(|shape| from_point(shape, wide(self.points[lane]))).map(sine).fold(1.0, f64::min)
    }
    fn surrounded(&self, lane: usize) -> bool {
        self.occluders.iter().any(|occluder| {
            if let Solid::Polyhedron(body) = occluder {
                let point = wide(self.points[lane]);
                return depth(body, point) < 1e-6 * distances(body, point)[1];
            }
            let [Shape::Polygon(c)] = &from_point(occluder, wide(self.points[lane]))[..] else { return false };
            let last = c[c.len() - 1];
            let across = unit(cross(sub(c[1], c[0]), sub(last, c[0])));
            let size = c.iter().map(|c| length(*c)).fold(0.0, f64::max);
            let angle = |i: usize| dot(unit(c[i]), unit(c[(i + 1) % c.len()])).clamp(-1.0, 1.0).acos();
            dot(across, c[0]).abs() < 1e-6 * size && (0..c.len()).map(angle).sum::<f64>() > 5.0
        })
    }
    fn unevenness(&self, lane: usize) -> f64 {
        let of = |solid: &Solid| match solid {
            Solid::Polyhedron(body) => body.deviation() / distances(body, wide(self.points[lane]))[0],
            _ => 0.0,
        };
        self.occluders.iter().map(of).fold(0.0, f64::max)
    }
    fn truth(&self, lane: usize) -> Option<[Visible; 2]> {
        let point = wide(self.points[lane]);
        let light = from_point(&self.light, point).swap_remove(0);
        let each: Vec<Vec<Shape>> = self.occluders.iter().map(|occluder| from_point(occluder, point)).collect();
        let at = |share: f64| {
            let spared = share * spared(&light, point, ENDS);
            let seen = |occluders: &[Shape]| visible(&light, occluders, wide(self.normals[lane]), spared);
            let mut found = seen(&each.concat())?;
            // a polyhedron is one occluder
            for faces in each.iter().filter(|faces| faces.len() > 1) {
                let hiding = faces.iter().filter_map(|face| seen(std::slice::from_ref(face))).map(|one| one.occluders);
                found.occluders = 1 + found.occluders - hiding.sum::<usize>().max(1);
            }
            Some(found)
        };
        Some([at(0.8)?, at(1.2)?])
    }
}
