//! Primitives that may meet a convex region.

use super::node::{Node, WIDTH};
use super::tree::View;
use crate::geometry::Affine;
use crate::packet::{M8, V8, X8};
use etendue::{Mask, Real};
use std::ops::Range;

/// Greatest number of half-spaces of a region.
const MOST: usize = 40;

/// Points x with n·x ≤ c.
#[derive(Clone, Copy, Debug, Default)]
struct HalfSpace {
    normal: [f32; 3],
    limit: f32,
}

/// An intersection of half-spaces, each moved outwards by more than the rounding of the tests in single precision.
#[derive(Debug)]
pub struct Region {
    spaces: [HalfSpace; MOST],
    count: usize,
    reach: f32,
}

impl Region {
    /// All of space, for scenes whose coordinates have magnitudes up to `reach`.
    pub fn new(reach: f32) -> Self {
        Self { spaces: [HalfSpace::default(); MOST], count: 0, reach }
    }
    /// Forgets the half-spaces.
    pub fn clear(&mut self) {
        self.count = 0;
    }
    /// Intersects the region with n·x ≤ `limit`, where n has at most unit length. Beyond 40 half-spaces, and with NaNs, the region
    /// stays larger.
    pub fn push(&mut self, normal: [f64; 3], limit: f64) {
        if let Some(space) = self.spaces.get_mut(self.count) {
            // The normal, three products and sums, and the corners of a box are rounded: together less than 11 · 2⁻²⁴ of the coordinates.
            let margin = f64::from(self.reach).max(limit.abs()) / 524_288.0;
            *space = HalfSpace { normal: normal.map(|x| x as f32), limit: (limit + margin) as f32 };
            self.count += 1;
        }
    }
    /// The region in a space from which a map leads here, for triangles whose coordinates there have magnitudes up to `reach`.
    pub(super) fn in_space(&self, to_here: &Affine, reach: f32) -> Self {
        let mut own = Self::new(reach);
        for space in &self.spaces[..self.count] {
            let row = |k: usize| f64::from(space.normal[k]);
            let column = |j: usize| (0..3).map(|k| row(k) * f64::from(to_here.0[k][j])).sum::<f64>();
            let normal = [0, 1, 2].map(column);
            // the corners were moved here and rounded: as far as the margin that the half-space has already
            let limit = f64::from(space.limit) - column(3);
            let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
            own.push(normal.map(|x| x / length), limit / length);
        }
        own
    }
    /// The lanes where some half-space has none of a convex hull, whose least n·x is `least(n)`. A NaN proves nothing.
    #[inline(always)]
    fn outside(&self, least: impl Fn([f32; 3]) -> X8) -> M8 {
        let mut outside = M8::splat(false);
        for space in &self.spaces[..self.count] {
            outside = outside | least(space.normal).gt(X8::splat(space.limit));
        }
        outside
    }
    /// The children of a node whose boxes may meet the region.
    #[inline(always)]
    fn children(&self, node: &Node) -> u32 {
        let outside = self.outside(|n| {
            let near = |k: usize| X8::from(node.planes[usize::from(n[k] < 0.0)][k]);
            let [x, y, z] = n.map(X8::splat);
            near(0).mul_add(x, near(1).mul_add(y, near(2) * z))
        });
        !outside.bits() & ((1 << node.children) - 1)
    }
    /// The lanes whose triangles may meet the region.
    #[inline(always)]
    pub(super) fn triangles(&self, corners: &[V8; 3]) -> u32 {
        let outside = self.outside(|n| {
            let [a, b, c] = corners.map(|corner| corner.dot(n.into()));
            a.lesser(b).lesser(c)
        });
        !outside.bits() & 0xff
    }
}

/// Primitives of which some may be known to lie outside of a region.
pub(super) trait Placed {
    /// A bit for each primitive of a leaf that may meet the region.
    fn meeting(&self, leaf: &Range<usize>, region: &Region) -> u32;
}

/// Calls `visit` with the index of each primitive that may meet the region, until it returns false or `budget` nodes have been visited;
/// returns whether the search was completed.
pub(super) fn search(
    tree: &View<'_, impl Placed>,
    region: &Region,
    stack: &mut Vec<u32>,
    budget: &mut usize,
    mut visit: impl FnMut(usize) -> bool,
) -> bool {
    stack.clear();
    if tree.count != 0 {
        stack.push(0);
    }
    while let Some(place) = stack.pop() {
        if *budget == 0 {
            return false;
        }
        *budget -= 1;
        let node = &tree.nodes[place as usize];
        let met = region.children(node);
        for slot in (0..WIDTH).filter(|slot| met >> slot & 1 != 0) {
            if node.count[slot] == 0 {
                stack.push(node.first[slot]);
                continue;
            }
            let leaf = node.leaf(slot);
            let some = tree.primitives.meeting(&leaf, region);
            for at in leaf.clone().filter(|at| some >> (at - leaf.start) & 1 != 0) {
                if !visit(at) {
                    return false;
                }
            }
        }
    }
    true
}
