//! Closed convex polyhedra, such as boxes: each is one occluder instead of many triangles.

use crate::hull::{Hull, V64, unit};
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use core::f64::consts::SQRT_2;

/// Greatest number of faces.
pub(crate) const FACES: usize = 16;

/// An edge of a [`Polyhedron`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// The two ends.
    pub ends: [V64; 2],
    /// Indices of the two faces that meet there.
    pub faces: [usize; 2],
}

/// A closed convex polyhedron, of at most 16 faces. From inside it hides everything.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyhedron {
    pub(crate) center: V64,
    /// The planes of its faces: a normal that points outwards, and a point.
    pub(crate) faces: Vec<[V64; 2]>,
    /// At most 12 of them may lie on the outlines from the points of a packet.
    pub(crate) edges: Vec<Edge>,
    /// Each once.
    pub(crate) corners: Vec<V64>,
    /// Unit normal and n·x of the plane of each face; the polyhedron has n·x below it.
    pub(crate) planes: Vec<(V64, f64)>,
    /// Greatest distance of a corner from the center.
    pub(crate) extent: f64,
    /// See [`Self::deviation`].
    pub(crate) deviation: f64,
}

/// Equal points have equal bits.
fn bits(p: V64) -> [u64; 3] {
    // −0 is 0
    [p.x, p.y, p.z].map(|x| (x + 0.0).to_bits())
}

impl Polyhedron {
    /// The polyhedron of these triangles, in any order and orientation, which share corners bit for bit. `None` if they do not form a closed
    /// convex surface, or if it has more than 16 faces. Coordinates count as rounded to single precision.
    ///
    /// Triangles form one face if the rounding of their corners allows it, unless that displaces the outline by more than the rounding: a face
    /// that is as narrow can have any normal. Then only triangles with the same plane do.
    #[must_use]
    pub fn new(triangles: &[[V64; 3]]) -> Option<Self> {
        let reach = triangles.iter().flatten().fold(0.0_f64, |most, p| most.max(p.max_abs()));
        let tolerance = 4.0 * reach * f64::from(f32::EPSILON);
        let merged = Self::with(triangles, tolerance, tolerance);
        if merged.as_ref().is_some_and(|body| body.deviation <= tolerance) {
            return merged;
        }
        let split = Self::with(triangles, tolerance, 1e-12 * reach);
        [merged, split].into_iter().flatten().min_by(|a, b| a.deviation.total_cmp(&b.deviation))
    }
    /// The polyhedron with a point well inside, a normal of any length and a point for each face, and edges. Nothing of it is checked.
    #[must_use]
    pub fn from_parts(center: V64, faces: Vec<[V64; 2]>, edges: Vec<Edge>) -> Self {
        let plane = |&[normal, on]: &[V64; 2]| {
            let normal = unit(normal);
            (normal, normal.dot(on))
        };
        let planes = faces.iter().map(plane).collect();
        let corners = edges.iter().flat_map(|edge| edge.ends).collect();
        Self::assemble(center, faces, edges, corners, planes)
    }
    fn assemble(
        center: V64,
        faces: Vec<[V64; 2]>,
        edges: Vec<Edge>,
        mut corners: Vec<V64>,
        planes: Vec<(V64, f64)>,
    ) -> Self {
        corners.sort_unstable_by_key(|&corner| bits(corner));
        corners.dedup();
        let deviation = deviation(&corners, &planes, &edges);
        let extent = corners.iter().map(|&p| (p - center).length()).fold(0.0, f64::max);
        Self { center, faces, edges, corners, planes, extent, deviation }
    }
    /// The polyhedron whose corners may be beyond a face by `tolerance`, and whose faces consist of triangles with corners within `flat` of a
    /// plane.
    fn with(triangles: &[[V64; 3]], tolerance: f64, flat: f64) -> Option<Self> {
        let corners: Vec<V64> = triangles.iter().flatten().copied().collect();
        let center = corners.iter().fold(V64::default(), |sum, &p| sum + p) * (1.0 / corners.len() as f64);
        let mut planes: Vec<(V64, f64)> = Vec::new();
        let mut faces = Vec::new();
        let mut sides: BTreeMap<[[u64; 3]; 2], Vec<(usize, bool)>> = BTreeMap::new();
        for &triangle in triangles {
            let [a, b, c] = triangle;
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
                edges.push(Edge { ends: ends.map(|end| end.map(f64::from_bits).into()), faces: [i, j] });
            }
        }
        (planes.len() <= FACES).then(|| Self::assemble(center, faces, edges, corners, planes))
    }
    /// A point well inside.
    #[must_use]
    pub const fn center(&self) -> V64 {
        self.center
    }
    /// A normal that points outwards and a point, of each face.
    #[must_use]
    pub fn faces(&self) -> &[[V64; 2]] {
        &self.faces
    }
    /// The edges.
    #[must_use]
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }
    /// How far the triangles are from those of a convex polyhedron, in scene units. Its outline is displaced by no more than √2 times this over
    /// the sine of the angle between an edge of the outline and the direction from the point to the farther end of that edge: near the line
    /// of a short edge, the plane of a face that does not quite contain the edge is farther from it than the corners are. Measured by
    /// `cargo test -p etendue-render-tests outlines_of_polyhedra -- --nocapture`: 0.85 times this over the sine.
    #[must_use]
    pub const fn deviation(&self) -> f64 {
        self.deviation
    }
    /// By how much its outline may be displaced as seen from a patch, in scene units.
    ///
    /// That is the [deviation](Self::deviation), and more only from points between an edge and the plane of a face that does not quite
    /// contain it. Where fewer than one point of the patch in 10⁴ are, they do not count, nor do those that are nearer to the line of the edge
    /// than 1e−2 of the size of the patch.
    pub(crate) fn displacement(&self, patch: &Hull) -> f64 {
        let of_edge = |edge: &Edge| {
            let [a, b] = edge.ends;
            let (along, from) = (unit(b - a), patch.center - a);
            let far = from.length().max((patch.center - b).length()) + patch.extent;
            let is_between = |face: usize| {
                let (normal, offset) = self.planes[face];
                let gap = (normal.dot(a) - offset).abs() + normal.dot(along).abs() * far;
                let is_near = (normal.dot(patch.center) - offset).abs() <= gap + patch.extent;
                is_near && {
                    let [least, most] = patch.range(normal).map(|x| x - offset);
                    least <= gap && most >= -gap && 2.0 * gap > 1e-4 * (most - least)
                }
            };
            if !edge.faces.into_iter().any(is_between) {
                return 1.0;
            }
            let apart = along.cross(from).length() - patch.extent;
            SQRT_2 * far / apart.max(1e-2 * patch.extent)
        };
        self.deviation * self.edges.iter().map(of_edge).fold(1.0, f64::max)
    }
    /// See [`Hull::stretch`].
    pub(crate) fn stretch(&self, patch: &Hull) -> f64 {
        // the spheres about edges, which are chords of a sphere, end at √2 of its radius
        if (self.center - patch.center).length() - patch.extent > SQRT_2 * self.extent {
            return 1.0;
        }
        patch.stretch(self.edges.iter().map(|edge| (edge.ends[0], edge.ends[1])))
    }
}

/// How far the outline of a polyhedron may be displaced, unless an edge of it is seen at a small angle.
///
/// The plane through a point and an edge of the outline has all corners on one side if the planes of the two faces there have, and if they
/// contain the edge. A corner may be beyond them by rounding. With the angle α between the plane of a face and the edge, a point between
/// the plane and the edge, s along the edge and w from its line, turns the plane through point and edge by s sin α / w: corners are beyond
/// it by their distance from the edge times that. What is returned is for s = w.
fn deviation(corners: &[V64], planes: &[(V64, f64)], edges: &[Edge]) -> f64 {
    let beyond = |&(normal, offset): &(V64, f64)| corners.iter().map(|&p| normal.dot(p) - offset).fold(0.0, f64::max);
    let faces = planes.iter().map(beyond).fold(0.0, f64::max);
    let turned = |edge: &Edge| {
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
