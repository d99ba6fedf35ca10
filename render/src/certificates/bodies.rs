//! Closed convex parts of meshes, such as boxes: each is one blocker instead of many triangles.

use super::blockers::crosses;
use super::hull::{V64, unit, wide};
use super::shaft::Shaft;
use crate::bvh::{Bvh, NOTHING};
use etendue::occlusion::{Edge, Polyhedron, SPARED};
use std::collections::HashMap;

/// Greatest number of triangles of a mesh that is searched for bodies. To search so many takes 15 ms in a height field, and 76 ms if all of
/// them are boxes, by `cargo test --release -p etendue-render --test certificates -- --ignored time_per_certificate --nocapture`.
const SEARCHED: usize = 65_536;
/// Greatest number of triangles, and of faces, of a body.
const TRIANGLES: usize = 28;
const FACES: usize = 16;

/// A closed convex polyhedron.
#[derive(Debug)]
struct Body {
    center: [f32; 3],
    faces: Vec<[etendue::Vec3<f32>; 2]>,
    edges: Vec<Edge<f32>>,
    corners: Vec<V64>,
    /// Unit normal and n·x of the plane of each face; the body has n·x below it.
    planes: Vec<(V64, f64)>,
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
        let count = bvh.order().len();
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
    /// From inside it hides every light that is outside, so a segment from inside must leave it before the spared part. All of it must lie
    /// before the light. Shading points on the body itself are inside or outside by rounding alone.
    pub(super) fn serves(&self, body: u32, place: u32, shaft: &Shaft) -> bool {
        if self.of(place) == Some(body) {
            return false;
        }
        let body = &self.bodies[body as usize];
        let margin = shaft.light.radius + 2.0 * shaft.epsilon;
        let is_outside = |&(n, offset): &(V64, f64)| {
            let deepest = offset - shaft.patch.range(n)[0] + shaft.patch.radius;
            shaft.light.range(n)[0] - margin - offset > 2.0 * SPARED * deepest.max(0.0)
        };
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
            let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
            for &(n, offset) in planes {
                let (a, b) = (n.dot(p) - offset + margin, n.dot(y) - offset + margin);
                if !(a <= 0.0 || b <= 0.0) {
                    return false;
                }
                if a > 0.0 {
                    enters = enters.max(a / (a - b));
                } else if b > 0.0 {
                    leaves = leaves.min(a / (a - b));
                }
            }
            enters + 1e-9 < leaves && leaves < 1.0 - 2.0 * SPARED
        };
        shaft.patch.corners().iter().all(|&p| shaft.light.corners().iter().all(|&y| meets(p, y)))
    }
    /// The body as a blocker.
    pub fn polyhedron(&self, body: u32) -> Polyhedron<'_, f32> {
        let Body { center, faces, edges, .. } = &self.bodies[body as usize];
        Polyhedron { center: (*center).into(), faces, edges }
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
    fn new(triangles: &[[[f32; 3]; 3]]) -> Option<Self> {
        let corners: Vec<V64> = triangles.iter().flatten().map(|&corner| wide(corner)).collect();
        let center = corners.iter().fold(V64::default(), |sum, &p| sum + p) * (1.0 / corners.len() as f64);
        let reach = corners.iter().fold(0.0_f64, |most, p| most.max(p.x.abs()).max(p.y.abs()).max(p.z.abs()));
        let tolerance = 4.0 * reach * f64::from(f32::EPSILON);
        let mut planes: Vec<(V64, f64)> = Vec::new();
        let mut faces = Vec::new();
        let mut face_of = Vec::new();
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
            let known = planes
                .iter()
                .position(|&(n, offset)| [a, b, c].iter().all(|&p| (n.dot(p) - offset).abs() <= tolerance));
            let face = known.unwrap_or_else(|| {
                planes.push((normal, offset));
                let narrow = |v: V64| etendue::Vec3::new(v.x as f32, v.y as f32, v.z as f32);
                faces.push([narrow(normal), triangle[0].into()]);
                planes.len() - 1
            });
            face_of.push(face);
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
                edges.push((ends, Edge { ends: ends.map(|end| end.map(f32::from_bits).into()), faces: [i, j] }));
            }
        }
        edges.sort_unstable_by_key(|(ends, _)| *ends);
        let edges = edges.into_iter().map(|(_, edge)| edge).collect();
        let center = [center.x as f32, center.y as f32, center.z as f32];
        (planes.len() <= FACES).then_some(Self { center, faces, edges, corners, planes })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bvh::ShapeSet;

    type Triangle = [[f32; 3]; 3];

    fn bodies(triangles: &[Triangle]) -> Bodies {
        Bodies::new(&Bvh::new(triangles, ShapeSet::new(std::iter::empty()).unwrap()).unwrap())
    }
    fn faces(corners: &[[f32; 3]], faces: &[&[usize]]) -> Vec<Triangle> {
        let fan = |face: &&[usize]| {
            (2..face.len()).map(|k| [face[0], face[k - 1], face[k]].map(|i| corners[i])).collect::<Vec<_>>()
        };
        faces.iter().flat_map(fan).collect()
    }
    /// A box, turned unless its sides are to be axis-aligned.
    fn block(low: [f32; 3], high: [f32; 3], turned: bool) -> Vec<Triangle> {
        let corner = |k: usize| {
            let [x, y, z] = [0, 1, 2].map(|axis| if k >> axis & 1 == 0 { low[axis] } else { high[axis] });
            if turned { [0.8 * x - 0.6 * z, y + 0.3 * x, 0.6 * x + 0.8 * z] } else { [x, y, z] }
        };
        let corners: Vec<_> = (0..8).map(corner).collect();
        faces(&corners, &[&[0, 1, 3, 2], &[4, 5, 7, 6], &[0, 1, 5, 4], &[2, 3, 7, 6], &[0, 2, 6, 4], &[1, 3, 7, 5]])
    }
    /// A prism over a regular polygon.
    fn prism(n: usize) -> Vec<Triangle> {
        let corner = |k: usize| {
            let (sin, cos) = ((k % n) as f32 / n as f32 * std::f32::consts::TAU).sin_cos();
            [cos, if k < n { 0.0 } else { 1.0 }, sin]
        };
        let corners: Vec<_> = (0..2 * n).map(corner).collect();
        let sides: Vec<_> = (0..n).map(|k| vec![k, (k + 1) % n, n + (k + 1) % n, n + k]).collect();
        let ends = [(0..n).collect::<Vec<_>>(), (n..2 * n).collect()];
        faces(&corners, &sides.iter().chain(&ends).map(Vec::as_slice).collect::<Vec<_>>())
    }
    /// Asserts that all triangles form one body with so many faces and edges.
    fn assert_found(triangles: &[Triangle], faces: usize, edges: usize) {
        let found = bodies(triangles);
        assert_eq!(found.len(), 1);
        let body = found.polyhedron(0);
        assert_eq!((body.faces.len(), body.edges.len()), (faces, edges));
        assert!((0..triangles.len() as u32).all(|place| found.of(place) == Some(0)));
        for [normal, on] in body.faces {
            assert!((*on - body.center).dot(*normal) > 0.0 && (normal.length() - 1.0).abs() < 1e-6);
        }
        for Edge { ends, faces: [i, j] } in body.edges {
            for (end, [normal, on]) in ends.iter().flat_map(|end| [(end, body.faces[*i]), (end, body.faces[*j])]) {
                assert!((*end - on).dot(normal).abs() < 1e-5);
            }
        }
    }

    /// Boxes are found in any order and orientation of their triangles and corners.
    #[test]
    fn boxes_are_bodies() {
        for turned in [false, true] {
            let mut triangles = block([1.0, -2.0, 0.5], [2.0, 3.0, 0.75], turned);
            let mut state = 1_usize;
            for _ in 0..200 {
                for k in (1..12).rev() {
                    state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                    triangles.swap(k, (state >> 33) % (k + 1));
                    triangles[k].rotate_left((state >> 40) % 3);
                    if state >> 50 & 1 == 1 {
                        triangles[k].swap(0, 1);
                    }
                }
                assert_found(&triangles, 6, 12);
            }
        }
        assert_found(&block([-1.0; 3], [-0.0, 1.0, 1e-4], true), 6, 12);
    }

    #[test]
    fn other_solids_are_bodies() {
        let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0; 3]];
        assert_found(&faces(&corners, &[&[0, 1, 2], &[0, 1, 3], &[1, 2, 3], &[0, 2, 3]]), 4, 6);
        for n in 3..=8 {
            assert_found(&prism(n), n + 2, 3 * n);
        }
    }

    /// Bodies are found among other triangles, and next to each other.
    #[test]
    fn bodies_are_told_apart() {
        let mut triangles = block([0.0; 3], [1.0; 3], false);
        triangles.extend(block([1.0, 0.125, 0.25], [2.0, 0.5, 0.75], false));
        triangles.push([[-9.0, 0.0, -9.0], [9.0, 0.0, -9.0], [0.0, 0.0, 9.0]]);
        let bvh = Bvh::new(&triangles, ShapeSet::new(std::iter::empty()).unwrap()).unwrap();
        let found = Bodies::new(&bvh);
        assert_eq!(found.len(), 2);
        let of = |id: u32| found.of(bvh.order().iter().position(|&other| other == id).unwrap() as u32);
        assert!((0..12).all(|id| of(id) == of(0)) && (12..24).all(|id| of(id) == of(12)));
        assert!(of(0).is_some() && of(12).is_some() && of(0) != of(12) && of(24).is_none());
        assert_eq!(found.of(crate::bvh::SHAPE), None);
    }

    #[test]
    fn other_meshes_are_no_bodies() {
        let unit = block([0.0; 3], [1.0; 3], false);
        let with = |more: &[Triangle]| [&unit, more].concat();
        let moved = |from: [f32; 3], to: [f32; 3]| {
            let place = |v: [f32; 3]| if v == from { to } else { v };
            unit.iter().map(|t| t.map(place)).collect::<Vec<_>>()
        };
        for missing in 0..12 {
            let open: Vec<_> = (0..12).filter(|&k| k != missing).map(|k| unit[k]).collect();
            assert!(bodies(&open).is_empty(), "without triangle {missing}");
        }
        let quad = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, z]| [x, 1.0, z]);
        let tent =
            [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.5, 1.0, 0.0], [0.5, 1.0, 1.0]];
        let ridge = [0.5, 1.0, 0.5];
        let not = [
            ("a triangle twice", with(&unit[3..4])),
            ("all triangles twice", with(&unit)),
            ("a triangle turned and twice", with(&[[unit[3][1], unit[3][0], unit[3][2]]])),
            ("a dent", moved([1.0; 3], [0.5; 3])),
            ("a face with a valley", moved([1.0; 3], [1.0, 0.999_99, 1.0])),
            ("boxes that share a corner", with(&block([1.0; 3], [2.0; 3], false))),
            ("boxes that share an edge", with(&block([1.0, 1.0, 0.0], [2.0, 2.0, 1.0], false))),
            ("boxes that share a face", with(&block([1.0, 0.0, 0.0], [2.0, 1.0, 1.0], false))),
            ("a triangle at a corner", with(&[[[1.0; 3], [2.0; 3], [2.0, 1.0, 2.0]]])),
            ("a cell within, at a corner", with(&block([0.0; 3], [0.5; 3], false))),
            ("a flat box", block([0.0; 3], [1.0, 0.0, 1.0], false)),
            ("a box thinner than its rounding", block([0.0, 1.0, 0.0], [1.0, 1.000_000_5, 1.0], false)),
            ("a quadrilateral cut both ways", faces(&quad, &[&[0, 1, 2, 3], &[1, 2, 3, 0]])),
            ("15 sides and two ends", prism(15)),
            ("too many triangles", prism(9)),
            ("a degenerate triangle", with(&[[unit[0][0], unit[0][1], unit[0][1]]])),
            // two sheets that both cover two sides of a roof, one with a corner on the ridge
            (
                "a folded sheet",
                [
                    faces(&tent, &[&[0, 2, 5, 4], &[1, 3, 5, 4]]),
                    [[0, 2], [1, 3]]
                        .map(|[i, k]| [tent[i], tent[k], ridge])
                        .into_iter()
                        .chain([[0, 4], [2, 5], [1, 4], [3, 5]].map(|[i, k]| [tent[i], tent[k], ridge]))
                        .collect(),
                ]
                .concat(),
            ),
        ];
        for (what, triangles) in not {
            assert!(bodies(&triangles).is_empty(), "{what}");
        }
        assert_found(&unit, 6, 12);
        assert_found(&moved([1.0; 3], [1.0, 1.01, 1.0]), 7, 13);
        assert_found(&moved([1.0; 3], [1.0, 0.999_999_9, 1.0]), 6, 12);
    }
}
