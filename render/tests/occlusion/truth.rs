//! The truth about scenes.

use super::scene::{Faceted, Scene, exact};
use etendue::Vec3;
use etendue_oracle::visible::{Shape, Visible, visible};
use etendue_oracle::{V3, along, cross, dot, length, narrow, sub, unit, wide};
use etendue_visible::Solid;

/// What is so near to the plane of a flat light does not occlude it, relative to the greatest coordinate of the point and the light, as
/// documented.
pub(crate) const ENDS: f64 = 1.0 / 2_097_152.0;

/// The same as a fraction of the way from a point to the plane of a light that is given relative to the point; 0 for a sphere.
pub(crate) fn spared(light: &Shape, point: V3) -> f64 {
    let Shape::Polygon(corners) = light else { return 0.0 };
    let normal = unit(cross(sub(corners[1], corners[0]), sub(corners[2], corners[0])));
    let absolute = corners.iter().map(|&corner| along(corner, point, 1.0)).chain([point]);
    let greatest = absolute.flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    (ENDS * greatest / dot(normal, corners[0]).abs()).min(1.0)
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

/// The shape relative to a point.
pub(crate) fn from_point(shape: &Solid, point: [f32; 3]) -> Shape {
    match *shape {
        Solid::Polygon { corners, count, .. } => {
            Shape::Polygon(corners[..count].iter().map(|&c| sub(c.into(), wide(point))).collect())
        }
        Solid::Parallelogram { corner, edges: [u, v] } => {
            let (a, u, v): (V3, V3, V3) = (sub(corner.into(), wide(point)), u.into(), v.into());
            Shape::Polygon(vec![a, along(a, u, 1.0), along(along(a, u, 1.0), v, 1.0), along(a, v, 1.0)])
        }
        Solid::Sphere { center, radius } => Shape::Sphere(sub(center.into(), wide(point)), radius),
        Solid::Polyhedron(_) => unreachable!("scenes have polyhedra apart"),
    }
}

/// The faces of a polyhedron relative to a point.
fn faces_from_point(solid: &Faceted, point: [f32; 3]) -> Vec<Shape> {
    let corner = |v: &Vec3<f32>| sub(wide((*v).into()), wide(point));
    solid.outlines.iter().map(|outline| Shape::Polygon(outline.iter().map(corner).collect())).collect()
}

/// The truth about a scene.
pub(crate) trait Truth {
    /// What the least sine of an edge seen under more than a right angle divides, and the least cosine of a sphere's half-angle.
    fn condition(&self, lane: usize) -> f64;
    /// Whether the point lies within a flat occluder, nearer to its plane than single precision tells, which then hides one half of the
    /// directions or the other. The same holds for points on the surface of a polyhedron.
    fn surrounded(&self, lane: usize) -> bool;
    /// The greatest distance of a corner of a polyhedron from the plane of its face, or beyond that of another, which is rounding, over
    /// the least distance of an edge.
    fn unevenness(&self, lane: usize) -> f64;
    /// The truth for a lane, with a limit in front of the light that is a fifth nearer and farther.
    fn truth(&self, lane: usize) -> Option<[Visible; 2]>;
}

impl Truth for Scene {
    fn condition(&self, lane: usize) -> f64 {
        let sine = |shape: &Solid| match from_point(shape, self.points[lane]) {
            Shape::Polygon(corners) => (0..corners.len())
                .map(|i| (corners[i], corners[(i + 1) % corners.len()]))
                .filter(|(a, b)| dot(*a, *b) < 0.0)
                .map(|(a, b)| length(cross(unit(a), unit(b))))
                .fold(1.0, f64::min),
            Shape::Sphere(center, radius) => (1.0 - (radius / length(center)).powi(2)).max(0.0).sqrt(),
        };
        let solids = self.solids.iter().flat_map(|solid| &solid.edges).map(|edge| {
            let [a, b] = edge.0.map(|end| sub(wide(end.into()), wide(self.points[lane])));
            if dot(a, b) < 0.0 { length(cross(unit(a), unit(b))) } else { 1.0 }
        });
        self.occluders.iter().map(sine).chain(solids).fold(sine(&self.light), f64::min)
    }
    fn surrounded(&self, lane: usize) -> bool {
        let on_solid = self.solids.iter().any(|solid| {
            let from_point = |v: Vec3<f32>| sub(wide(v.into()), wide(self.points[lane]));
            let corners = solid.edges.iter().flat_map(|edge| edge.0).map(from_point);
            let size = corners.map(length).fold(0.0, f64::max);
            let depths = solid.faces.iter().map(|&[normal, on]| dot(wide(normal.into()), from_point(on)));
            depths.fold(f64::INFINITY, f64::min).abs() < 1e-6 * size
        });
        on_solid
            || self.occluders.iter().any(|occluder| {
                let Shape::Polygon(c) = from_point(occluder, self.points[lane]) else { return false };
                let last = c[c.len() - 1];
                let across = unit(cross(sub(c[1], c[0]), sub(last, c[0])));
                let size = c.iter().map(|c| length(*c)).fold(0.0, f64::max);
                let angle = |i: usize| dot(unit(c[i]), unit(c[(i + 1) % c.len()])).clamp(-1.0, 1.0).acos();
                dot(across, c[0]).abs() < 1e-6 * size && (0..c.len()).map(angle).sum::<f64>() > 5.0
            })
    }
    fn unevenness(&self, lane: usize) -> f64 {
        let from_point = |v: Vec3<f32>| sub(wide(v.into()), wide(self.points[lane]));
        let of = |solid: &Faceted| {
            let mut most = 0.0_f64;
            for (i, &[normal, on]) in solid.faces.iter().enumerate() {
                for (j, outline) in solid.outlines.iter().enumerate() {
                    for &v in outline {
                        let height = dot(wide(normal.into()), sub(from_point(v), from_point(on)));
                        most = most.max(if i == j { height.abs() } else { height });
                    }
                }
            }
            let distance = |ends: [Vec3<f32>; 2]| {
                let [a, b] = ends.map(from_point);
                let d = sub(b, a);
                length(along(a, d, (-dot(a, d) / dot(d, d)).clamp(0.0, 1.0)))
            };
            most / solid.edges.iter().map(|edge| distance(edge.0)).fold(f64::INFINITY, f64::min)
        };
        self.solids.iter().map(of).fold(0.0, f64::max)
    }
    fn truth(&self, lane: usize) -> Option<[Visible; 2]> {
        let point = self.points[lane];
        let light = from_point(&self.light, point);
        let occluders: Vec<_> = self.occluders.iter().map(|b| from_point(b, point)).collect();
        let solids: Vec<_> = self.solids.iter().map(|solid| faces_from_point(solid, point)).collect();
        let all = [&occluders[..], &solids.concat()].concat();
        let at = |share: f64| {
            let spared = share * spared(&light, wide(point));
            let seen = |occluders: &[Shape]| visible(&light, occluders, wide(self.normals[lane]), spared);
            let mut found = seen(&all)?;
            // a polyhedron is one occluder
            if !solids.is_empty() {
                let whole = |solid: &Vec<Shape>| seen(solid).map_or(0, |alone| alone.occluders.min(1));
                found.occluders = seen(&occluders)?.occluders + solids.iter().map(whole).sum::<usize>();
            }
            Some(found)
        };
        Some([at(0.8)?, at(1.2)?])
    }
}
