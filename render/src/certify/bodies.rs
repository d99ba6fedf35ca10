//! Closed convex parts of meshes, such as boxes: each is one blocker instead of many triangles.

use super::blockers::crosses;
use super::hull::{Hull, V64, unit, wide};
use super::shaft::Shaft;
use crate::bvh::{Bvh, NOTHING};
use crate::occlusion::{Edge, Polyhedron};
use etendue::Vec3;
use std::collections::HashMap;
use std::f64::consts::SQRT_2;

/// Greatest number of triangles of a mesh that is searched for bodies. To search so many takes 15 ms in a height field, and 76 ms if all of
/// them are boxes, by `cargo test --release -p etendue-render time_per_search -- --ignored --nocapture`.
const SEARCHED: usize = 65_536;
/// Greatest number of triangles, and of faces, of a body.
const TRIANGLES: usize = 28;
const FACES: usize = 16;

/// The parts of a polyhedron, as the core takes them.
#[derive(Debug)]
struct Parts<S> {
    center: Vec3<S>,
    faces: Vec<[Vec3<S>; 2]>,
    edges: Vec<Edge<S>>,
}

impl<S> Parts<S> {
    fn polyhedron(&self) -> Polyhedron<'_, S>
    where
        S: Copy,
    {
        Polyhedron { center: self.center, faces: &self.faces, edges: &self.edges }
    }
}

/// A closed convex polyhedron.
#[derive(Debug)]
struct Body {
    single: Parts<f32>,
    double: Parts<f64>,
    corners: Vec<V64>,
    /// Unit normal and n·x of the plane of each face; the body has n·x below it.
    planes: Vec<(V64, f64)>,
    /// Greatest distance of a corner from the center.
    extent: f64,
    /// How far the triangles are from those of a convex polyhedron, in scene units: its outline is displaced by no more.
    deviation: f64,
}

/// The bodies of a scene.
#[derive(Debug, Default)]
pub struct Bodies {
    bodies: Vec<Body>,
    /// The body of each triangle in tree order, or [`NOTHING`]; empty without bodies.
    of_places: Vec<u32>,
}

impl Bodies {
    /// Finds the bodies among the triangles of a mesh that share corners, bit for bit. Finds none in large meshes.
    pub fn new(bvh: &Bvh) -> Self {
        let count = bvh.count();
        let mut found = Self::default();
        if count > SEARCHED {
            return found;
        }
        // triangles that are connected by common corners have the same root
        let mut roots: Vec<usize> = (0..count).collect();
        fn root(roots: &mut [usize], mut i: usize) -> usize {
            while roots[i] != i {
                roots[i] = roots[roots[i]];
                i = roots[i];
            }
            i
        }
        let mut first_with = HashMap::new();
        for place in 0..count {
            for corner in corners(bvh, place as u32) {
                let other = *first_with.entry(bits(corner)).or_insert(place);
                let (a, b) = (root(&mut roots, place), root(&mut roots, other));
                roots[a] = b;
            }
        }
        let mut parts: HashMap<usize, Vec<u32>> = HashMap::new();
        for place in 0..count {
            parts.entry(root(&mut roots, place)).or_default().push(place as u32);
        }
        let mut parts: Vec<_> = parts.into_values().filter(|part| (4..=TRIANGLES).contains(&part.len())).collect();
        parts.sort_unstable();
        for part in parts {
            if part.iter().any(|&place| bvh.is_cut_out(place)) {
                continue;
            }
            let triangles: Vec<_> = part.iter().map(|&place| corners(bvh, place)).collect();
            if let Some(body) = Body::new(&triangles) {
                found.of_places.resize(count, NOTHING);
                for place in part {
                    found.of_places[place as usize] = found.bodies.len() as u32;
                }
                found.bodies.push(body);
            }
        }
        found
    }
    /// Index of the body to which a primitive belongs.
    pub fn of(&self, place: u32) -> Option<u32> {
        self.of_places.get(place as usize).copied().filter(|&body| body != NOTHING)
    }
    /// Can the body stand for its triangles in a shaft from the primitive at `place`?
    ///
    /// From inside it hides every light that is outside, so a segment from inside must end outside by more than rounding. All of it must lie
    /// before the light. Shading points on the body itself are inside or outside by rounding alone.
    pub(super) fn serves(&self, body: u32, place: u32, shaft: &Shaft) -> bool {
        if self.of(place) == Some(body) {
            return false;
        }
        let body = &self.bodies[body as usize];
        let margin = shaft.light.radius + 2.0 * shaft.epsilon;
        let is_outside = |&(n, offset): &(V64, f64)| shaft.light.range(n)[0] - margin - offset > 2.0 * shaft.ends;
        body.planes.iter().any(is_outside) && !crosses(&body.corners, 0.0, shaft)
    }
    /// Is every segment of the shaft known to meet the body?
    ///
    /// The points from which a convex body hides a point form a convex set, and so do the points that it hides. If it hides all corners of
    /// one hull from all corners of the other, it therefore hides all of one from all of the other. Here it is smaller by the inflation of
    /// the hulls.
    pub(super) fn covers(&self, body: u32, shaft: &Shaft) -> bool {
        let planes = &self.bodies[body as usize].planes;
        let margin = shaft.patch.radius.max(shaft.light.radius) + 4.0 * shaft.epsilon;
        let meets = |p: V64, y: V64| {
            let (mut enters, mut leaves, mut beyond) = (0.0_f64, 1.0_f64, f64::INFINITY);
            for &(n, offset) in planes {
                let (a, b) = (n.dot(p) - offset + margin, n.dot(y) - offset + margin);
                if !(a <= 0.0 || b <= 0.0) {
                    return false;
                }
                if a > 0.0 {
                    enters = enters.max(a / (a - b));
                } else if b > 0.0 && a / (a - b) < leaves {
                    (leaves, beyond) = (a / (a - b), b);
                }
            }
            // where it leaves, it ends beyond the face by more than rounding
            enters + 1e-9 < leaves && leaves < 1.0 && beyond > margin + 2.0 * shaft.ends
        };
        shaft.patch.corners().iter().all(|&p| shaft.light.corners().iter().all(|&y| meets(p, y)))
    }
    /// The angle in radians by which the outline of the body may be displaced as seen from a patch: next to the body, from most of the patch.
    pub(super) fn displacement(&self, body: u32, patch: &Hull) -> f64 {
        let Body { double, extent, deviation, .. } = &self.bodies[body as usize];
        let gap = (double.center - patch.center).length() - extent - patch.extent;
        if *deviation > 0.0 { deviation / gap.max(patch.extent) } else { 0.0 }
    }
    /// See [`Hull::stretch`].
    pub(super) fn stretch(&self, body: u32, patch: &Hull) -> f64 {
        let Body { double, extent, .. } = &self.bodies[body as usize];
        // the spheres about edges, which are chords of a sphere, end at √2 of its radius
        if (double.center - patch.center).length() - patch.extent > SQRT_2 * extent {
            return 1.0;
        }
        patch.stretch(double.edges.iter().map(|edge| (edge.ends[0], edge.ends[1])))
    }
    /// The body as a blocker.
    pub fn polyhedron(&self, body: u32) -> Polyhedron<'_, f32> {
        self.bodies[body as usize].single.polyhedron()
    }
    /// The same body in double precision.
    pub fn exact_polyhedron(&self, body: u32) -> Polyhedron<'_, f64> {
        self.bodies[body as usize].double.polyhedron()
    }
    /// Number of bodies.
    pub fn len(&self) -> usize {
        self.bodies.len()
    }
    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.bodies.is_empty()
    }
}

fn corners(bvh: &Bvh, place: u32) -> [[f32; 3]; 3] {
    let c = bvh.corners(place);
    [[c[0], c[1], c[2]], [c[3], c[4], c[5]], [c[6], c[7], c[8]]]
}

fn bits(corner: [f32; 3]) -> [u32; 3] {
    // −0 is 0
    corner.map(|x| (x + 0.0).to_bits())
}

impl Body {
    /// `None` if the triangles do not form a closed convex surface, or if it has too many faces.
    ///
    /// Triangles form one face if the rounding of their corners allows it, unless that displaces the outline by more than the rounding: a face
    /// that is as narrow can have any normal. Then only triangles with the same plane do.
    fn new(triangles: &[[[f32; 3]; 3]]) -> Option<Self> {
        let reach = triangles.iter().flatten().flatten().fold(0.0_f32, |most, x| most.max(x.abs()));
        let tolerance = 4.0 * f64::from(reach) * f64::from(f32::EPSILON);
        let merged = Self::with(triangles, tolerance, tolerance);
        if merged.as_ref().is_some_and(|body| body.deviation <= tolerance) {
            return merged;
        }
        let split = Self::with(triangles, tolerance, 1e-12 * f64::from(reach));
        [merged, split].into_iter().flatten().min_by(|a, b| a.deviation.total_cmp(&b.deviation))
    }
    /// The body whose corners may be beyond a face by `tolerance`, and whose faces consist of triangles with corners within `flat` of a plane.
    fn with(triangles: &[[[f32; 3]; 3]], tolerance: f64, flat: f64) -> Option<Self> {
        let corners: Vec<V64> = triangles.iter().flatten().map(|&corner| wide(corner)).collect();
        let center = corners.iter().fold(V64::default(), |sum, &p| sum + p) * (1.0 / corners.len() as f64);
        let mut planes: Vec<(V64, f64)> = Vec::new();
        let mut faces = Vec::new();
        let mut sides: HashMap<[[u32; 3]; 2], Vec<(usize, bool)>> = HashMap::new();
        for triangle in triangles {
            let [a, b, c] = triangle.map(wide);
            let normal = unit((b - a).cross(c - a));
            let turned = normal.dot(center - a) > 0.0;
            let normal = if turned { -normal } else { normal };
            let offset = normal.dot(a);
            let is_outermost = corners.iter().all(|&p| normal.dot(p) - offset <= tolerance);
            if !(is_outermost && normal.dot(center) < offset - 4.0 * tolerance) {
                return None;
            }
            let known =
                planes.iter().position(|&(n, offset)| [a, b, c].iter().all(|&p| (n.dot(p) - offset).abs() <= flat));
            let face = known.unwrap_or_else(|| {
                planes.push((normal, offset));
                faces.push([normal, a]);
                planes.len() - 1
            });
            for (k, &from) in triangle.iter().enumerate() {
                let ends = [bits(from), bits(triangle[(k + 1) % 3])];
                let forwards = ends[0] < ends[1];
                let ends = if forwards { ends } else { [ends[1], ends[0]] };
                sides.entry(ends).or_default().push((face, forwards != turned));
            }
        }
        let mut edges = Vec::new();
        for (ends, faces) in sides {
            // Two triangles that turn outwards pass their common side in opposite directions. If all do, they cover each part of the hull
            // equally often, so no face is missing.
            let &[(i, one), (j, other)] = &faces[..] else { return None };
            if one == other {
                return None;
            }
            if i != j {
                edges.push((ends, Edge { ends: ends.map(|end| wide(end.map(f32::from_bits))), faces: [i, j] }));
            }
        }
        edges.sort_unstable_by_key(|(ends, _)| *ends);
        let edges = edges.into_iter().map(|(_, edge)| edge).collect();
        let double = Parts { center, faces, edges };
        let deviation = deviation(&corners, &planes, &double.edges);
        let extent = corners.iter().map(|&p| (p - center).length()).fold(0.0, f64::max);
        let narrow = |v: V64| v.map(|x| x as f32);
        let single = Parts {
            center: narrow(center),
            faces: double.faces.iter().map(|face| face.map(narrow)).collect(),
            edges: double.edges.iter().map(|edge| Edge { ends: edge.ends.map(narrow), faces: edge.faces }).collect(),
        };
        (planes.len() <= FACES).then_some(Self { single, double, corners, planes, extent, deviation })
    }
}

/// How far the outline of a body may be displaced.
///
/// The plane through a point and an edge of the outline has all corners on one side if the planes of the two faces there have, and if they
/// contain the edge. A corner may be beyond them by rounding, and a plane that does not contain the edge is off by the distance of the
/// corners from the edge, times the sine of the angle between edge and plane.
fn deviation(corners: &[V64], planes: &[(V64, f64)], edges: &[Edge<f64>]) -> f64 {
    let beyond = |&(normal, offset): &(V64, f64)| corners.iter().map(|&p| normal.dot(p) - offset).fold(0.0, f64::max);
    let faces = planes.iter().map(beyond).fold(0.0, f64::max);
    let turned = |edge: &Edge<f64>| {
        let [a, b] = edge.ends;
        let along = unit(b - a);
        let farthest = corners.iter().map(|&p| along.cross(p - a).length()).fold(0.0, f64::max);
        let most = |face: usize| {
            let (normal, offset) = planes[face];
            normal.dot(along).abs() * farthest + (normal.dot(a) - offset).abs()
        };
        edge.faces.map(most).into_iter().fold(0.0, f64::max)
    };
    edges.iter().map(turned).fold(faces, f64::max)
}

#[cfg(test)]
mod tests;
