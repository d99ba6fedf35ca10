//! A tree of bounding boxes with up to eight children per node.

use super::build::Costs;
use super::node::{Bounded, Bounds, BuildError, Node, WIDTH, greater, lesser, slabs};
use super::parallel_build::build_parts;
use super::rays::{Hits, Rays};
use crate::packet::{M8, X8};
use etendue::Real;
use std::ops::Range;

/// Primitives in leaf order.
pub(super) trait Primitives {
    /// Updates `hits` by nearer hits in a leaf, whose box the rays enter at `near`. With `ANY`, returns the lanes that have one
    /// instead, and does not test the shape at `hits.primitives`; without, returns no lanes.
    fn test_packet<const ANY: bool>(
        &self,
        leaf: Range<usize>,
        rays: &Rays,
        near: X8,
        active: M8,
        hits: &mut Hits,
    ) -> M8;
}

/// A tree over primitives of one kind.
#[derive(Debug)]
pub(crate) struct Tree<P> {
    nodes: Vec<Node>,
    primitives: P,
    count: usize,
}

/// A tree over primitives, which need not own its nodes.
#[derive(Debug)]
pub(super) struct View<'a, P> {
    pub(super) nodes: &'a [Node],
    pub(super) primitives: &'a P,
    pub(super) count: usize,
}

impl<P> Tree<P> {
    pub(super) fn view(&self) -> View<'_, P> {
        self.over(&self.primitives)
    }
    /// The nodes of this tree over other primitives, as many and in the same order.
    pub(super) fn over<'a, Q>(&'a self, primitives: &'a Q) -> View<'a, Q> {
        View { nodes: &self.nodes, primitives, count: self.count }
    }
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
    /// The tree's box.
    pub(super) fn bounds(&self) -> Bounds {
        let [low, high] = &self.nodes[0].planes;
        [
            low.map(|planes| planes.into_iter().fold(f32::INFINITY, lesser)),
            high.map(|planes| planes.into_iter().fold(f32::NEG_INFINITY, greater)),
        ]
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
    /// Size of the nodes in bytes.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..])
    }
    pub(super) fn primitives(&self) -> &P {
        &self.primitives
    }
    pub(super) fn primitives_mut(&mut self) -> &mut P {
        &mut self.primitives
    }
}

impl<P: Primitives> View<'_, P> {
    /// Finds the nearest hits of packets, or with `ANY` clears the lanes of `active` that hit something, by a test of every leaf,
    /// regardless of other hits and without the tree above it.
    pub(super) fn every_leaf<const ANY: bool>(&self, rays: &[Rays], active: &mut [M8], hits: &mut [Hits]) {
        for node in self.nodes {
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
