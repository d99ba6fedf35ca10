//! Convex shapes: lights, and what may hide them.

use crate::hull::{FACES_OF_BOX, Hull, V64, corner_of_box, edges, magnitude, unit};
use crate::polyhedron::{Edge, Polyhedron};
use alloc::sync::Arc;

/// A patch that is nowhere higher over the plane of an occluder, as a fraction of the distance of its farthest point, is flush with it. The
/// rounding of heights is some 1e−6 of that distance.
const FLUSH: f64 = 1e-2;

/// A convex shape, as a light or as what may hide one. Coordinates in scene units.
///
/// What is computed in single precision rounds them: where they are not single precision themselves, stated errors count from there.
#[derive(Clone, Debug, PartialEq)]
pub enum Solid {
    /// A flat convex polygon.
    Polygon {
        /// The corners in order around. A triangle has three of them; the fourth is ignored.
        corners: [V64; 4],
        /// Number of corners: 3 or 4.
        count: usize,
        /// How far it is from flat, in scene units: 0, unless two triangles were merged that share the edge from the first corner to the
        /// third.
        deviation: f64,
    },
    /// The parallelogram `corner + s edges[0] + t edges[1]` for s, t in \[0, 1\], as [`Parallelogram`](etendue::Parallelogram) has it: however
    /// small it is for its coordinates, its edges are not rounded.
    Parallelogram {
        /// One corner.
        corner: V64,
        /// The two edges from that corner.
        edges: [V64; 2],
    },
    /// A sphere: its surface, not what is inside.
    Sphere {
        /// Centre.
        center: V64,
        /// Radius.
        radius: f64,
    },
    /// A closed polyhedron. From inside it hides everything.
    Polyhedron(Arc<Polyhedron>),
}

impl Solid {
    /// A triangle.
    #[must_use]
    pub const fn triangle([a, b, c]: [V64; 3]) -> Self {
        Self::Polygon { corners: [a, b, c, c], count: 3, deviation: 0.0 }
    }
    /// A convex quadrilateral, whose corners have one plane.
    #[must_use]
    pub const fn quadrilateral(corners: [V64; 4]) -> Self {
        Self::Polygon { corners, count: 4, deviation: 0.0 }
    }
    /// A closed convex polyhedron; see [`Polyhedron::new`].
    #[must_use]
    pub fn polyhedron(triangles: &[[V64; 3]]) -> Option<Self> {
        Some(Self::Polyhedron(Arc::new(Polyhedron::new(triangles)?)))
    }
    /// A rectangular box between two corners whose sides are parallel to the axes; `None` if it has no volume.
    #[must_use]
    pub fn block(low: V64, high: V64) -> Option<Self> {
        let corner = |k: usize| corner_of_box([low, high], k);
        let mut triangles = [[V64::default(); 3]; 12];
        for (pair, [a, b, c, d]) in triangles.chunks_exact_mut(2).zip(FACES_OF_BOX) {
            pair.copy_from_slice(&[[a, b, c].map(corner), [a, c, d].map(corner)]);
        }
        Self::polyhedron(&triangles)
    }
    /// The same in another unit of length: all lengths times a positive factor.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        match self {
            Self::Polygon { corners, count, deviation } => {
                Self::Polygon { corners: corners.map(|p| p * factor), count: *count, deviation: deviation * factor }
            }
            Self::Parallelogram { corner, edges } => {
                Self::Parallelogram { corner: *corner * factor, edges: edges.map(|edge| edge * factor) }
            }
            Self::Sphere { center, radius } => Self::Sphere { center: *center * factor, radius: radius * factor },
            Self::Polyhedron(body) => {
                let faces = body.faces.iter().map(|&[normal, on]| [normal, on * factor]).collect();
                let edge = |edge: &Edge| Edge { ends: edge.ends.map(|end| end * factor), ..*edge };
                let edges = body.edges.iter().map(edge).collect();
                Self::Polyhedron(Arc::new(Polyhedron::from_parts(body.center * factor, faces, edges)))
            }
        }
    }
    /// The corners of a flat shape, and their number.
    #[must_use]
    pub fn outline(&self) -> Option<([V64; 4], usize)> {
        match *self {
            Self::Polygon { corners, count, .. } => Some((corners, count.clamp(3, 4))),
            Self::Parallelogram { corner: a, edges: [u, v] } => Some(([a, a + u, a + u + v, a + v], 4)),
            Self::Sphere { .. } | Self::Polyhedron(_) => None,
        }
    }
    /// Whether it is a sphere.
    #[must_use]
    pub const fn is_sphere(&self) -> bool {
        matches!(self, Self::Sphere { .. })
    }
    /// Whether both are one polyhedron in memory.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        matches!((self, other), (Self::Polyhedron(a), Self::Polyhedron(b)) if Arc::ptr_eq(a, b))
    }

    /// The convex quadrilateral of two triangles that share an edge and a plane.
    pub(crate) fn merged(&self, other: &Self) -> Option<Self> {
        let corners = |of: &Self| match *of {
            Self::Polygon { corners: [a, b, c, _], count: 3, .. } => Some([a, b, c]),
            _ => None,
        };
        let (one, two) = (corners(self)?, corners(other)?);
        let bits = |p: V64| [p.x, p.y, p.z].map(f64::to_bits);
        let is_shared = |p: V64, of: &[V64; 3]| of.iter().any(|&q| bits(q) == bits(p));
        let i = (0..3).find(|&i| !is_shared(one[i], &two))?;
        let (s, t) = (one[(i + 1) % 3], one[(i + 2) % 3]);
        if bits(s) == bits(t) || !is_shared(s, &two) || !is_shared(t, &two) {
            return None;
        }
        let apex = *two.iter().find(|&&q| bits(q) != bits(s) && bits(q) != bits(t))?;
        let corners = [s, apex, t, one[i]];
        let [a, b, c, d] = corners;
        let normal = unit((c - d).cross(a - d));
        // A triangle as narrow as the rounding of its corners is next to any plane: the normals must agree, too, as far as the corners extend.
        let fold = normal.cross(unit((b - a).cross(c - a))).length();
        let extent = (c - a).length() + (b - d).length();
        let deviation = normal.dot(b - a).abs() + fold * extent;
        let flat = deviation <= 8.0 * magnitude(&corners) * f64::from(f32::EPSILON);
        let turns = |p: V64, q: V64, r: V64| normal.dot((q - p).cross(r - q));
        let turns = [turns(a, b, c), turns(b, c, d), turns(c, d, a), turns(d, a, b)];
        let convex = turns.iter().all(|&x| x > 0.0) || turns.iter().all(|&x| x < 0.0);
        (flat && convex).then_some(Self::Polygon { corners, count: 4, deviation })
    }
    /// The angle in radians by which its outline may be displaced as seen from a patch: next to it, from points that are farther from it than
    /// the size of the patch. See [`Polyhedron::displacement`].
    pub(crate) fn displacement(&self, patch: &Hull) -> f64 {
        let (center, extent, deviation) = match self {
            Self::Polygon { corners, count, deviation } if *deviation > 0.0 => {
                let hull = Hull::new(&corners[..*count], 0.0);
                (hull.center, hull.extent, *deviation)
            }
            Self::Polyhedron(body) if body.deviation > 0.0 => (body.center, body.extent, body.displacement(patch)),
            _ => return 0.0,
        };
        deviation / ((center - patch.center).length() - extent - patch.extent).max(patch.extent)
    }
    /// See [`Hull::stretch`].
    pub(crate) fn stretch(&self, patch: &Hull) -> f64 {
        match self {
            Self::Sphere { .. } => 1.0,
            Self::Polyhedron(body) => body.stretch(patch),
            _ => self.outline().map_or(1.0, |(corners, count)| patch.stretch(edges(&corners[..count]))),
        }
    }
    /// May a point of the patch be over or on a flat shape, so near to its plane that single precision does not tell on which side? Where
    /// that concerns only one point in 10⁴, by the rounding of a height, it does not count.
    pub(crate) fn is_flush(&self, patch: &Hull) -> bool {
        let Some((corners, count)) = self.outline() else { return false };
        let corners = &corners[..count];
        let normal = unit((corners[1] - corners[0]).cross(corners[2] - corners[0]));
        let [least, most] = patch.range(normal).map(|x| x - normal.dot(corners[0]));
        let far = corners.iter().map(|&p| (p - patch.center).length()).fold(0.0, f64::max) + patch.extent;
        most.max(-least) <= FLUSH * far && self.touches(patch, FLUSH * far)
    }
    /// May the shape meet a ball? Not asked of polyhedra.
    pub(crate) fn touches(&self, ball: &Hull, epsilon: f64) -> bool {
        match self {
            Self::Sphere { center, radius } => {
                let apart = (*center - ball.center).length() > *radius + ball.extent + epsilon;
                !apart
            }
            _ => {
                let Some(([a, b, c, d], count)) = self.outline() else { return true };
                let is_far = |a, b, c| (nearest([a, b, c], ball.center) - ball.center).length() > ball.extent + epsilon;
                !(is_far(a, b, c) && (count == 3 || is_far(a, c, d)))
            }
        }
    }
}

/// The point of a triangle nearest to another point (Ericson 2005, "Real-Time Collision Detection", section 5.1.5).
fn nearest([a, b, c]: [V64; 3], p: V64) -> V64 {
    let on_edge = |a: V64, b: V64| {
        let edge = b - a;
        let t = (edge.dot(p - a) / edge.length_squared()).clamp(0.0, 1.0);
        // an edge without length
        if t.is_nan() { a } else { a + edge * t }
    };
    let normal = (b - a).cross(c - a);
    let inside = |a: V64, b: V64| normal.dot((b - a).cross(p - a)) >= 0.0;
    if normal.length_squared() > 0.0 && inside(a, b) && inside(b, c) && inside(c, a) {
        let n = unit(normal);
        return p + n * -n.dot(p - a);
    }
    let all = [on_edge(a, b), on_edge(b, c), on_edge(c, a)];
    let distance = |q: &V64| (*q - p).length();
    all.into_iter().min_by(|x, y| distance(x).total_cmp(&distance(y))).expect("three points")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(corners: [[f32; 3]; 3]) -> Solid {
        Solid::triangle(corners.map(|corner| corner.map(f64::from).into()))
    }

    /// Two triangles of a convex quadrilateral are merged in any order of their corners; nothing else is.
    #[test]
    fn coplanar_triangles_that_share_an_edge_are_merged() {
        let place = |x: f32, y: f32| [x, 0.25 * x + 0.5 * y + 3.0, y];
        let (a, b, c, d) = (place(0.0, 0.0), place(1.0, 0.0), place(1.5, 1.0), place(0.0, 2.0));
        for turn in 0..3 {
            for flip in [false, true] {
                let mut other = [a, c, d];
                other.rotate_left(turn);
                if flip {
                    other.swap(0, 1);
                }
                let merged = triangle([a, b, c]).merged(&triangle(other));
                let Some(Solid::Polygon { corners, count: 4, .. }) = merged else {
                    panic!("{turn}, {flip}: not merged");
                };
                let corners = corners.map(|v| [v.x, v.y, v.z].map(|x| x as f32));
                let start = corners.iter().position(|&v| v == a).unwrap();
                let around = [1, 2, 3].map(|k| corners[(start + k) % 4]);
                assert!(around == [b, c, d] || around == [d, c, b], "{corners:?}");
            }
        }
        let one = triangle([a, b, c]);
        let not = [
            ("the same triangle", [a, b, c]),
            ("another plane", [a, c, [0.0, 3.0, 2.0]]),
            ("one common corner", [a, d, place(-1.0, 1.0)]),
            ("on the same side of the edge", [a, c, place(1.0, 0.1)]),
            ("a reflex corner", [a, c, place(-4.0, -0.2)]),
            ("a degenerate triangle", [a, a, c]),
            // within the rounding of the plane, as any triangle that is as narrow
            ("a sliver with another normal", [a, c, [0.75 - 1e-6, 3.437_5 + 1e-6, 0.5 + 1e-6]]),
        ];
        for (what, corners) in not {
            assert!(one.merged(&triangle(corners)).is_none(), "{what}");
            assert!(triangle(corners).merged(&one).is_none(), "{what}");
        }
    }

    /// The nearest point of a triangle, against points of a fine grid.
    #[test]
    fn nearest_points_are_nearest() {
        let corners = [[0.0, 0.0, 0.0], [2.0, 0.1, 0.0], [0.3, 1.0, 0.5]].map(V64::from);
        let [a, b, c] = corners;
        for k in 0..200 {
            let p = V64::new(f64::from(k % 7) - 3.0, f64::from(k % 11) * 0.5 - 2.0, f64::from(k % 5) - 2.0);
            let found = (nearest(corners, p) - p).length();
            let grid = (0..=100).flat_map(|i| (0..=100 - i).map(move |j| (f64::from(i) / 100.0, f64::from(j) / 100.0)));
            let least = grid.map(|(s, t)| (a + (b - a) * s + (c - a) * t - p).length()).fold(f64::INFINITY, f64::min);
            assert!(found <= least + 1e-12 && found > least - 0.02, "{found}, {least}");
        }
    }
}
