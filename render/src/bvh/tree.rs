//! A tree of bounding boxes with up to eight children per node.

use super::build::Costs;
use super::node::{Bounded, BuildError, Node, WIDTH, slabs};
use super::parallel_build::build_parts;
use super::rays::{Hits, Rays};
use crate::packet::{M8, X8};
use etendue::Real;
use std::ops::Range;

/// Primitives in leaf order.
pub(super) trait Primitives {
    /// Updates `hits` by nearer hits in a leaf, whose box the rays enter at `near`. With `ANY`, returns the lanes that have one
    /// instead, and does not test the shape at `hits.place`; without, returns no lanes.
    fn test_packet<const ANY: bool>(
        &self,
        leaf: Range<usize>,
        rays: &Rays,
        near: X8,
        active: M8,
        hits: &mut Hits,
    ) -> M8;
    /// Size in bytes.
    fn bytes(&self) -> usize;
}

/// A tree over primitives of one kind.
#[derive(Debug)]
pub(crate) struct Tree<P> {
    pub(super) nodes: Vec<Node>,
    pub(super) primitives: P,
    pub(super) count: usize,
}

impl<P> Tree<P> {
    /// Builds a tree over `items`. Calls `leaf` with the items of each leaf, then `primitives` with all items in leaf order, their
    /// original indices and the nodes.
    pub(super) fn build<T: Bounded>(
        mut items: Vec<T>,
        costs: Costs,
        leaf: impl Fn(&mut [T]) + Sync,
        primitives: impl FnOnce(Vec<T>, Vec<u32>, &[Node]) -> P,
    ) -> Result<Self, BuildError> {
        let count = items.len();
        if count >= 1 << 31 {
            return Err(BuildError { count, most: (1 << 31) - 1 });
        }
        let mut ids: Vec<u32> = (0..count as u32).collect();
        let nodes = build_parts(&mut items, &mut ids, costs, &leaf);
        Ok(Self { primitives: primitives(items, ids, &nodes), nodes, count })
    }
    /// Greatest magnitude of a coordinate of the tree's box.
    pub(super) fn reach(&self) -> f32 {
        let planes = self.nodes[0].planes.as_flattened().as_flattened();
        planes.iter().map(|x| x.abs()).filter(|x| x.is_finite()).fold(0.0, f32::max)
    }
    /// Number of primitives.
    pub(super) fn count(&self) -> usize {
        self.count
    }
    pub(super) fn primitives(&self) -> &P {
        &self.primitives
    }
}

impl<P: Primitives> Tree<P> {
    /// Size of nodes and primitives in bytes.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + self.primitives.bytes()
    }
    /// Finds the nearest hits of packets, or with `ANY` clears the lanes of `active` that hit something, by a test of every leaf,
    /// regardless of other hits and without the tree above it.
    pub(super) fn every_leaf<const ANY: bool>(&self, rays: &[Rays], active: &mut [M8], hits: &mut [Hits]) {
        for node in &self.nodes {
            for slot in (0..WIDTH).filter(|&slot| node.count[slot] != 0) {
                for ((rays, active), hits) in rays.iter().zip(&mut *active).zip(&mut *hits) {
                    let (near, entered) = slabs::<false>(node, slot, rays, [false; 3], X8::lit(f64::INFINITY));
                    let lanes = *active & entered;
                    *active = *active & !self.primitives.test_packet::<ANY>(node.leaf(slot), rays, near, lanes, hits);
                }
            }
        }
    }
}
