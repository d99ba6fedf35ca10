//! A tree of bounding boxes with up to eight children per node.

use super::build::{Built, Costs};
use super::parallel_build::build_parts;
use super::{Hits, Rays, WIDTH};
use crate::packet::{M8, X8};
use etendue::u32x8;
use std::ops::Range;

/// Greatest accepted depth of a binary tree from obvhs.
pub(super) const DEPTH: usize = 96;

/// Primitives in leaf order.
pub(super) trait Primitives {
    /// Updates `hits` by nearer hits of the leaf `range`, whose box the rays enter at `near`.
    fn closest(&self, range: Range<usize>, rays: &Rays, near: X8, active: M8, hits: &mut Hits);
    /// Lanes that a primitive of the leaf `range` occludes before `limit`, other than the one with id `skip`.
    fn occluded(&self, range: Range<usize>, rays: &Rays, near: X8, active: M8, limit: X8, skip: u32x8) -> M8;
    /// Size in bytes.
    fn bytes(&self) -> usize;
}

/// Why a tree could not be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuildError {
    /// Number of primitives; at most 2³¹ − 1 are supported.
    pub count: usize,
}

impl std::fmt::Display for BuildError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} primitives: a tree can index at most 2147483647", self.count)
    }
}

impl std::error::Error for BuildError {}

/// An inner node: the boxes of up to eight children, in structure-of-arrays layout.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Node {
    /// Lower and upper planes of each axis; an absent child has an empty box.
    pub(super) planes: [[[f32; WIDTH]; 3]; 2],
    /// For each child, the index of an inner node, or of a leaf's first primitive.
    pub(super) first: [u32; WIDTH],
    /// For each child, the number of primitives of a leaf, or 0 for an inner node.
    pub(super) count: [u8; WIDTH],
    /// Number of children.
    pub(super) children: u32,
}

impl Default for Node {
    fn default() -> Self {
        Self {
            planes: [[[f32::INFINITY; WIDTH]; 3], [[f32::NEG_INFINITY; WIDTH]; 3]],
            first: [0; WIDTH],
            count: [0; WIDTH],
            children: 0,
        }
    }
}

impl Node {
    /// The primitives of a child that is a leaf.
    #[inline(always)]
    pub(super) fn leaf(&self, slot: usize) -> Range<usize> {
        let first = self.first[slot] as usize;
        first..first + usize::from(self.count[slot])
    }
    pub(super) fn push(&mut self, bounds: &Bounds, first: u32, count: usize) {
        let slot = self.children as usize;
        for (planes, bound) in self.planes.iter_mut().zip(bounds) {
            for (plane, coordinate) in planes.iter_mut().zip(bound) {
                plane[slot] = *coordinate;
            }
        }
        (self.first[slot], self.count[slot]) = (first, count as u8);
        self.children += 1;
    }
}

/// Prefetches items that will be read soon.
#[inline(always)]
pub(super) fn prefetch<T>(items: &[T]) {
    #[cfg(target_arch = "x86_64")]
    for line in (0..size_of_val(items)).step_by(64) {
        use core::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: prefetching is only a hint, and the address is within `items`
        unsafe { _mm_prefetch::<_MM_HINT_T0>(items.as_ptr().cast::<i8>().add(line)) };
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = items;
}

/// A tree over primitives of one kind.
#[derive(Debug)]
pub(crate) struct Tree<P> {
    pub(super) nodes: Vec<Node>,
    pub(super) primitives: P,
    pub(super) count: usize,
}

/// Least and greatest corner.
pub(super) type Bounds = [[f32; 3]; 2];

/// The empty box.
pub(super) const EMPTY: Bounds = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];

/// The lesser; `b` if either is NaN. (`f32::min` takes three times as long, to handle NaNs that do not occur here.)
#[inline(always)]
pub(super) fn lesser(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The greater; `b` if either is NaN.
#[inline(always)]
pub(super) fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

#[inline]
pub(super) fn union(a: Bounds, b: Bounds) -> Bounds {
    [std::array::from_fn(|k| lesser(a[0][k], b[0][k])), std::array::from_fn(|k| greater(a[1][k], b[1][k]))]
}

/// Items with a bounding box.
pub(super) trait Bounded: Copy + Send + Sync {
    fn bounds(&self) -> Bounds;
    /// The middle of the box along one axis.
    #[inline]
    fn middle(&self, axis: usize) -> f32 {
        let [low, high] = self.bounds();
        0.5 * low[axis] + 0.5 * high[axis]
    }
}

impl Bounded for Bounds {
    #[inline]
    fn bounds(&self) -> Bounds {
        *self
    }
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
            return Err(BuildError { count });
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
    /// Calls `f` with each leaf, its parent node and its slot there.
    pub(super) fn each_leaf(&self, mut f: impl FnMut(Range<usize>, &Node, usize)) {
        for node in &self.nodes {
            (0..WIDTH).filter(|&slot| node.count[slot] != 0).for_each(|slot| f(node.leaf(slot), node, slot));
        }
    }
    /// Number of primitives.
    pub(super) fn count(&self) -> usize {
        self.count
    }
    pub(super) fn primitives(&self) -> &P {
        &self.primitives
    }
}

/// Builds a tree by halving along the longest axis of the centres, with depth log₂ n for any input.
pub(super) fn balanced<T: Bounded>(all: &[T], most: usize) -> Built {
    let all: &[Bounds] = &all.iter().map(Bounded::bounds).collect::<Vec<_>>();
    let mut order: Vec<u32> = (0..all.len() as u32).collect();
    let mut nodes = vec![Node::default()];
    let mut pending = if all.is_empty() { vec![] } else { vec![(0..all.len(), 0_usize)] };
    while let Some((range, place)) = pending.pop() {
        let mut parts = vec![range];
        while parts.len() < WIDTH {
            let Some(largest) = (0..parts.len()).filter(|&i| parts[i].len() > most).max_by_key(|&i| parts[i].len())
            else {
                break;
            };
            let range = parts[largest].clone();
            let middle = range.start + range.len() / 2;
            halve(all, &mut order[range.clone()]);
            parts[largest] = range.start..middle;
            parts.push(middle..range.end);
        }
        for part in parts {
            let bounds = order[part.clone()].iter().fold(EMPTY, |a, &i| union(a, all[i as usize]));
            if part.len() <= most {
                nodes[place].push(&bounds, part.start as u32, part.len());
            } else {
                nodes.push(Node::default());
                let to = nodes.len() - 1;
                nodes[place].push(&bounds, to as u32, 0);
                pending.push((part, to));
            }
        }
    }
    (nodes, order)
}

/// Moves the lower half along the longest axis of the centres to the front.
pub(super) fn halve(all: &[Bounds], part: &mut [u32]) {
    let center = |i: u32, axis: usize| all[i as usize][0][axis] + all[i as usize][1][axis];
    let extent = |axis: usize| {
        let ends = part.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(lo, hi), &i| {
            (lo.min(center(i, axis)), hi.max(center(i, axis)))
        });
        ends.1 - ends.0
    };
    let axis = (0..3).max_by(|&a, &b| extent(a).total_cmp(&extent(b))).unwrap_or(0);
    let middle = part.len() / 2;
    part.select_nth_unstable_by(middle, |&a, &b| center(a, axis).total_cmp(&center(b, axis)).then(a.cmp(&b)));
}
