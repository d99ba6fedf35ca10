//! The shapes of lights and blockers.

use etendue::Vec3;

/// A convex shape: a light or a blocker.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Convex<S> {
    /// A flat convex polygon.
    Polygon {
        /// The corners in order around. A triangle has three of them; the fourth is ignored.
        corners: [Vec3<S>; 4],
        /// Number of corners: 3 or 4.
        count: usize,
    },
    /// The parallelogram `corner + s edges[0] + t edges[1]` for s, t in \[0, 1\], as [`Parallelogram`](etendue::Parallelogram) has it: however
    /// small it is for its coordinates, its edges are not rounded.
    Parallelogram {
        /// One corner.
        corner: Vec3<S>,
        /// The two edges from that corner.
        edges: [Vec3<S>; 2],
    },
    /// A sphere.
    Sphere {
        /// Centre.
        center: Vec3<S>,
        /// Radius.
        radius: S,
    },
}

impl<S: Copy> Convex<S> {
    /// Replaces each number x by `f(x)`.
    #[inline]
    pub fn map<T>(self, mut f: impl FnMut(S) -> T) -> Convex<T> {
        match self {
            Self::Polygon { corners, count } => {
                Convex::Polygon { corners: corners.map(|corner| corner.map(&mut f)), count }
            }
            Self::Parallelogram { corner, edges } => {
                Convex::Parallelogram { corner: corner.map(&mut f), edges: edges.map(|edge| edge.map(&mut f)) }
            }
            Self::Sphere { center, radius } => Convex::Sphere { center: center.map(&mut f), radius: f(radius) },
        }
    }
}

/// A closed convex polyhedron, such as a box: one blocker instead of a dozen triangles. From inside it hides everything.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polyhedron<'a, S> {
    /// A point well inside.
    pub center: Vec3<S>,
    /// The planes of its faces, at most 16: a normal that points outwards, of any length, and a point.
    pub faces: &'a [[Vec3<S>; 2]],
    /// Its edges. At most 12 of them may lie on the outlines of the polyhedron from the points of a packet.
    pub edges: &'a [Edge<S>],
}

/// An edge of a [`Polyhedron`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge<S> {
    /// The two ends.
    pub ends: [Vec3<S>; 2],
    /// Indices of the two faces that meet there.
    pub faces: [usize; 2],
}
