//! Flat shapes as seen from points, and their numbers without rounding.

use crate::hull::V64;
use crate::solid::Solid;
use etendue::{Real, Vec3};

/// A flat shape as seen from the points, in units of a power of two. Only directions matter, so that each shape can have its own unit.
///
/// The edges are those of the shape, not differences of rounded corners: the plane through a point and an edge is then as accurate as the
/// direction to it, however short the edge is.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Flat<R> {
    pub(super) corners: [Vec3<R>; 4],
    /// The corners from a point in the middle.
    pub(super) offsets: [Vec3<R>; 4],
    /// From the first corner to that point, in units of the shape.
    pub(super) middle: Vec3<R>,
    /// From each corner to the next.
    pub(super) edges: [Vec3<R>; 4],
    pub(super) count: usize,
    /// The reciprocal of the unit.
    pub(super) scale: R,
    /// Unit normal of the plane, and n·x on it.
    pub(super) normal: Vec3<R>,
    pub(super) height: R,
}

impl<R: Real> Flat<R> {
    /// Takes a flat shape relative to the points, in place, since it is large. What is not flat leaves it as it is.
    #[inline(always)]
    pub(super) fn take(&mut self, shape: &Solid, point: Vec3<R>) {
        let Self { corners, offsets, edges, .. } = self;
        let count = match *shape {
            Solid::Sphere { .. } | Solid::Polyhedron(_) => return,
            Solid::Polygon { corners: given, count, .. } => {
                let (given, count) = (given.map(rounded), count.clamp(3, 4));
                for i in 0..4 {
                    edges[i] = given[if i + 1 < count { i + 1 } else { 0 }] - given[i];
                    corners[i] = given[i] - point;
                    offsets[i] = given[i] - given[0];
                }
                count
            }
            Solid::Parallelogram { corner, edges: given } => {
                let (a, [u, v]) = (rounded(corner) - point, given.map(rounded));
                *corners = [a, a + u, a + u + v, a + v];
                *offsets = [Vec3::default(), u, u + v, v];
                *edges = [u, v, -u, -v];
                4
            }
        };
        // in units of the shape, so that it is the same in all lanes
        let share = R::lit(1.0 / count as f64);
        let middle = offsets[..count].iter().fold(Vec3::default(), |sum, &v| sum + v * share);
        let scale = corners[..count].iter().fold(R::lit(0.0), |most, v| most.greater(v.max_abs())).pow2_scale();
        for i in 0..4 {
            corners[i] = corners[i] * scale;
            offsets[i] = (offsets[i] - middle) * scale;
            edges[i] = edges[i] * scale;
        }
        let [d, e, f, _] = *edges;
        let area = if count > 3 { (d + e).cross(e + f) } else { d.cross(e) };
        (self.middle, self.count, self.scale) = (middle, count, scale);
        self.normal = area.unit_and_length().0;
        self.height = self.normal.dot(self.corners[0]);
    }
    #[inline(always)]
    pub(super) fn corners(&self) -> &[Vec3<R>] {
        &self.corners[..self.count]
    }
}

/// A corner of a flat shape without rounding.
#[inline(always)]
pub(super) fn corner(shape: &Solid, i: usize) -> V64 {
    match *shape {
        Solid::Polygon { corners, .. } => corners[i & 3],
        Solid::Parallelogram { corner: a, edges: [u, v] } => [a, a + u, a + u + v, a + v][i & 3],
        Solid::Sphere { .. } | Solid::Polyhedron(_) => V64::default(),
    }
}
/// A vector in every lane.
#[inline(always)]
pub(super) fn rounded<R: Real>(v: V64) -> Vec3<R> {
    v.map(R::lit)
}
/// A vector of one lane in double precision.
pub(super) fn exactly<S: Real>(v: Vec3<S>) -> Vec3<f64> {
    v.map(|x| x.lane_f64(0))
}
/// A vector as the sum of two that are rounded.
pub(super) fn two_words<R: Real>(v: Vec3<f64>) -> [Vec3<R>; 2] {
    let high = v.map(R::Scalar::lit);
    [Vec3::splat(high), (v - exactly(high)).map(R::lit)]
}
