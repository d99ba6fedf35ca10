//! Corners of convex polygons relative to a point.

use crate::real::Real;
use crate::vector::Vec3;
use crate::vector::double_word::{cross_sums, sum_dw};

/// The corners of a convex polygon relative to a point, and what follows from them, as unevaluated sums in units in which no coordinate
/// exceeds 2.
///
/// A difference of rounded corners would lose the shape of a small polygon that is far from the point, and a sum of rounded edges the place
/// of a corner that is near it.
pub(in crate::light) struct PlacedCorners<R, const N: usize> {
    /// The corners, rounded, with their rounding errors.
    pub(in crate::light) corners: [[Vec3<R>; 2]; N],
    /// From the first corner to each.
    pub(in crate::light) edges: [[Vec3<R>; 2]; N],
    /// Cross products of the first corner with each.
    pub(in crate::light) spokes: [[Vec3<R>; 2]; N],
    /// Such a unit over that of the coordinates, a power of two.
    pub(in crate::light) scale: R,
}

impl<R: Real, const N: usize> PlacedCorners<R, N> {
    /// Takes corners and a point in common coordinates.
    #[inline(always)]
    pub(in crate::light) fn new(corners: [Vec3<R>; N], p: Vec3<R>) -> Self {
        let from = |p: Vec3<R>| move |c: Vec3<R>| sum_dw([c, Vec3::default()], [-p, Vec3::default()]);
        Self::with_edges(from(p)(corners[0]), corners.map(from(corners[0])))
    }
    /// Takes the first corner relative to the point, and the edges from it to each corner. All results are 0 where a coordinate is no number
    /// or exceeds half of the largest one, since its rounding error might overflow.
    #[inline(always)]
    pub(in crate::light) fn with_edges(first: [Vec3<R>; 2], edges: [[Vec3<R>; 2]; N]) -> Self {
        let corners = edges.map(|edge| sum_dw(first, edge));
        let reach = corners.iter().chain(&edges).fold(R::lit(0.0), |most, [v, _]| most.greater(v.max_abs()));
        let most = R::lit(0.5 * if R::DOUBLE { f64::MAX } else { f64::from(f32::MAX) });
        let finite = corners.iter().fold(reach.lt(most), |finite, [v, _]| finite & v.is_within(most));
        let scale = reach.pow2_scale();
        let scaled = |pair: [Vec3<R>; 2]| pair.map(|v| v.keep(finite) * scale);
        let (corners, edges) = (corners.map(|pair| rounded(scaled(pair))), edges.map(scaled));
        let spokes = edges.map(|edge| cross_sums(corners[0], edge));
        Self { corners, edges, spokes, scale }
    }
    /// The cross product of the edges from the first corner to two others.
    #[inline(always)]
    pub(in crate::light) fn normal(&self, i: usize, j: usize) -> [Vec3<R>; 2] {
        cross_sums(self.edges[i], self.edges[j])
    }
    /// From a corner to another.
    #[inline(always)]
    pub(in crate::light) fn side(&self, i: usize, j: usize) -> [Vec3<R>; 2] {
        rounded(sum_dw(self.edges[j], self.edges[i].map(|e| -e)))
    }
}

/// The same sum, the first part of which is the sum rounded.
#[inline(always)]
fn rounded<R: Real>([v, rest]: [Vec3<R>; 2]) -> [Vec3<R>; 2] {
    let sum = v + rest;
    [sum, (v - sum) + rest]
}
