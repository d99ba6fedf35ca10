//! A tree of boxes with eight children a node, built by obvhs and traversed by groups of packets. The one file that names obvhs.

use super::{Hits, M8, Rays, Shaft, WIDTH, X8, max, min};
use etendue::{Mask, Real, u32x8};
use glam::Vec3A;
use obvhs::{BvhBuildParams, aabb::Aabb, bvh2::Bvh2, bvh2::builder::build_bvh2};
use std::ops::Range;
use std::time::Duration;

/// Deepest binary tree that is taken from obvhs.
const DEPTH: usize = 96;
/// A node leaves at most seven of its children on the stack.
const STACK: usize = 7 * DEPTH + 8;
/// A leaf holds no more than this.
const LEAF: usize = 4;
/// A packet tests a triangle in about the time in which it tests a node's boxes: small leaves.
const PARAMETERS: BvhBuildParams =
    BvhBuildParams { max_prims_per_leaf: LEAF as u32, collapse_traversal_cost: 1.0, ..BvhBuildParams::medium_build() };

/// What lies in the leaves, in leaf order.
pub(super) trait Primitives {
    /// Takes nearer hits among the primitives of `range` into `hits`.
    fn closest(&self, range: Range<usize>, rays: &Rays, active: M8, hits: &mut Hits);
    /// Lanes in which one of them lies before `limit`, other than the one that has the id `skip`.
    fn occluded(&self, range: Range<usize>, rays: &Rays, active: M8, limit: X8, skip: u32x8) -> M8;
    /// Bytes held.
    fn bytes(&self) -> usize;
}

/// Why a tree could not be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuildError {
    /// Number of primitives, of which there may be at most 2³¹ − 1.
    pub count: usize,
}

impl std::fmt::Display for BuildError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} primitives are more than a tree can index (2147483647)", self.count)
    }
}

impl std::error::Error for BuildError {}

/// An inner node: boxes of up to eight children, coordinate by coordinate.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Node {
    /// Lower and upper planes of each axis; an absent child has an empty box.
    pub(super) lower: [[f32; WIDTH]; 3],
    pub(super) upper: [[f32; WIDTH]; 3],
    /// Per child: index of an inner node, or of the first primitive.
    first: [u32; WIDTH],
    /// Per child: number of primitives, 0 for an inner node.
    count: [u8; WIDTH],
    /// Number of children.
    children: u32,
}

impl Default for Node {
    fn default() -> Self {
        Self {
            lower: [[f32::INFINITY; WIDTH]; 3],
            upper: [[f32::NEG_INFINITY; WIDTH]; 3],
            first: [0; WIDTH],
            count: [0; WIDTH],
            children: 0,
        }
    }
}

impl Node {
    fn push(&mut self, bounds: &Bounds, first: u32, count: usize) {
        let slot = self.children as usize;
        let [low, high] = bounds;
        for k in 0..3 {
            (self.lower[k][slot], self.upper[k][slot]) = (low[k], high[k]);
        }
        (self.first[slot], self.count[slot]) = (first, count as u8);
        self.children += 1;
    }
}

/// A tree over primitives of one kind.
#[derive(Debug)]
pub(crate) struct Tree<P> {
    nodes: Vec<Node>,
    primitives: P,
    count: usize,
}

type Bounds = [[f32; 3]; 2];

fn union(a: Bounds, b: Bounds) -> Bounds {
    [std::array::from_fn(|k| a[0][k].min(b[0][k])), std::array::from_fn(|k| a[1][k].max(b[1][k]))]
}

impl<P> Tree<P> {
    pub(super) fn build(
        count: usize,
        bounds: impl Fn(usize) -> Bounds,
        arrange: impl FnOnce(&[u32]) -> P,
    ) -> Result<Self, BuildError> {
        if count >= 1 << 31 {
            return Err(BuildError { count });
        }
        let all: Vec<Bounds> = (0..count).map(bounds).collect();
        let (nodes, order) = match built_by_obvhs(&all) {
            Some(tree) => tree,
            None => balanced(&all),
        };
        Ok(Self { nodes, primitives: arrange(&order), count })
    }
    pub(super) fn primitives(&self) -> &P {
        &self.primitives
    }
}

/// obvhs's binary tree, collapsed, or nothing if it would be too deep (many primitives in one place).
fn built_by_obvhs(all: &[Bounds]) -> Option<(Vec<Node>, Vec<u32>)> {
    if all.len() <= LEAF || crowded(all) {
        return None;
    }
    let boxes: Vec<Aabb> =
        all.iter().map(|[lo, hi]| Aabb::new(Vec3A::from_array(*lo), Vec3A::from_array(*hi))).collect();
    let bvh = build_bvh2(&boxes, PARAMETERS, &mut Duration::default());
    if bvh.nodes[0].is_leaf() {
        return None;
    }
    let mut nodes = vec![Node::default()];
    let mut order = Vec::with_capacity(all.len());
    // (obvhs's node, ours, depth), depth first so that subtrees are contiguous
    let mut pending = vec![(0_usize, 0_usize, 1_usize)];
    while let Some((index, place, depth)) = pending.pop() {
        if depth >= DEPTH {
            return None;
        }
        let (children, count) = open(&bvh, index);
        let mut inner = [(0, 0, 0); WIDTH];
        let mut inners = 0;
        for &child in &children[..count] {
            let node = &bvh.nodes[child];
            let bounds = [node.aabb().min.to_array(), node.aabb().max.to_array()];
            if node.is_leaf() {
                let first = order.len() as u32;
                let range = node.first_index as usize..(node.first_index + node.prim_count) as usize;
                order.extend_from_slice(&bvh.primitive_indices[range]);
                nodes[place].push(&bounds, first, node.prim_count as usize);
            } else {
                nodes.push(Node::default());
                let to = nodes.len() - 1;
                nodes[place].push(&bounds, to as u32, 0);
                inner[inners] = (child, to, depth + 1);
                inners += 1;
            }
        }
        pending.extend(inner[..inners].iter().rev());
    }
    Some((nodes, order))
}

/// Up to eight descendants that together stand for a node: the largest inner one is opened first.
fn open(bvh: &Bvh2, index: usize) -> ([usize; WIDTH], usize) {
    let first = bvh.nodes[index].first_index as usize;
    let mut children = [0; WIDTH];
    children[..2].copy_from_slice(&[first, first + 1]);
    let mut count = 2;
    while count < WIDTH {
        let inner = (0..count).filter(|&i| !bvh.nodes[children[i]].is_leaf());
        let area = |i: &usize| bvh.nodes[children[*i]].aabb().half_area();
        let Some(largest) = inner.max_by(|a, b| area(a).total_cmp(&area(b))) else { break };
        let first = bvh.nodes[children[largest]].first_index as usize;
        children[largest] = first;
        children[count] = first + 1;
        count += 1;
    }
    (children, count)
}

/// Are more than 64 primitives alike? obvhs's builder recurses once for each of those.
fn crowded(all: &[Bounds]) -> bool {
    let mut keys: Vec<u64> = all
        .iter()
        .map(|b| {
            b.as_flattened()
                .iter()
                .fold(0_u64, |h, x| (h ^ u64::from(x.to_bits())).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29))
        })
        .collect();
    keys.sort_unstable();
    keys.windows(64).any(|w| w[0] == w[63])
}

/// A tree by halving along the longest axis of the centres: of depth log₂ n whatever the input.
fn balanced(all: &[Bounds]) -> (Vec<Node>, Vec<u32>) {
    let mut order: Vec<u32> = (0..all.len() as u32).collect();
    let mut nodes = vec![Node::default()];
    let empty = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
    let mut pending = if all.is_empty() { vec![] } else { vec![(0..all.len(), 0_usize)] };
    while let Some((range, place)) = pending.pop() {
        let mut parts = vec![range];
        while parts.len() < WIDTH {
            let Some(largest) = (0..parts.len()).filter(|&i| parts[i].len() > LEAF).max_by_key(|&i| parts[i].len())
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
            let bounds = order[part.clone()].iter().fold(empty, |a, &i| union(a, all[i as usize]));
            if part.len() <= LEAF {
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

/// Puts the lesser half along the longest axis of the centres first.
fn halve(all: &[Bounds], part: &mut [u32]) {
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

/// Where the rays enter a child's box, and in which lanes they do before their limit.
#[inline(always)]
fn slabs<const COMMON: bool>(node: &Node, slot: usize, rays: &Rays, sign: [bool; 3], limit: X8) -> (X8, M8) {
    let axis = |k: usize, inverse: X8, below: X8, above: X8| {
        let a = X8::splat(node.lower[k][slot]).mul_add(inverse, below);
        let b = X8::splat(node.upper[k][slot]).mul_add(inverse, above);
        if !COMMON {
            (min(a, b), max(a, b))
        } else if sign[k] {
            (b, a)
        } else {
            (a, b)
        }
    };
    let (nx, fx) = axis(0, rays.inverse.x, rays.lower.x, rays.upper.x);
    let (ny, fy) = axis(1, rays.inverse.y, rays.lower.y, rays.upper.y);
    let (nz, fz) = axis(2, rays.inverse.z, rays.lower.z, rays.upper.z);
    let near = max(max(nx, ny), max(nz, X8::lit(0.0)));
    let far = min(min(fx, fy), min(fz, limit));
    (near, near.le(far))
}

/// Room for a traversal, made once and used for many.
#[derive(Debug)]
pub struct Stack {
    pending: Box<[Pending; STACK]>,
}

impl Default for Stack {
    fn default() -> Self {
        Self { pending: Box::new([Pending::default(); STACK]) }
    }
}

/// A child that is still to be visited.
#[derive(Clone, Copy, Debug, Default)]
struct Pending {
    /// Index of the parent, and which of its children. (For occlusion: index of the node itself.)
    parent: u32,
    slot: u32,
    /// No ray enters it before this distance.
    near: f32,
}

/// A group of packets on its way through a tree: as one shaft that holds them all, or as the one packet that it is.
struct Traversal<'a, const COMMON: bool> {
    rays: &'a [Rays],
    sign: [bool; 3],
    shaft: Option<&'a Shaft>,
    /// An active lane of the first packet.
    lead: usize,
}

impl<const COMMON: bool> Traversal<'_, COMMON> {
    /// The children that may be entered within `reach`, as bits, and, if an order is wanted, roughly where: a lower bound for a
    /// shaft, the entry of the packet's first lane else.
    #[inline(always)]
    fn enter<const ORDER: bool>(&self, node: &Node, limit: X8, active: M8, reach: f32) -> (u32, [f32; WIDTH]) {
        if let Some(shaft) = self.shaft {
            let (near, mask) = shaft.enter(node, reach);
            return (mask.bits(), if ORDER { near.to_array() } else { [0.0; WIDTH] });
        }
        let mut bits = 0;
        let mut nearest = [0.0; WIDTH];
        for (slot, nearest) in nearest.iter_mut().enumerate().take(node.children as usize) {
            let (near, hit) = slabs::<COMMON>(node, slot, &self.rays[0], self.sign, limit);
            bits |= u32::from((hit & active).any()) << slot;
            if ORDER {
                *nearest = near.as_array()[self.lead];
            }
        }
        (bits, nearest)
    }

    /// The packets, as bits, that enter a leaf.
    #[inline(always)]
    fn packets(&self, node: &Node, slot: usize, limit: impl Fn(usize) -> X8, active: &[M8]) -> u32 {
        let test = |p: usize| (slabs::<COMMON>(node, slot, &self.rays[p], self.sign, limit(p)).1 & active[p]).any();
        (0..self.rays.len()).fold(0, |bits, p| bits | u32::from(test(p)) << p)
    }
}

/// Calls `f` with the index of each set bit.
#[inline(always)]
fn each_bit(mut bits: u32, mut f: impl FnMut(usize)) {
    while bits != 0 {
        f(bits.trailing_zeros() as usize);
        bits &= bits - 1;
    }
}

impl<P: Primitives> Tree<P> {
    /// Bytes held by nodes and primitives.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + self.primitives.bytes()
    }

    /// Nearest hits of a group of packets, nearer than those that `hits` holds.
    pub(super) fn closest(
        &self,
        rays: &[Rays],
        active: &[M8],
        shaft: Option<&Shaft>,
        hits: &mut [Hits],
        stack: &mut Stack,
    ) {
        if self.count == 0 {
            return;
        }
        let lead = active[0].bits().trailing_zeros() as usize & 7;
        match common_sign(rays) {
            Some(sign) => self.closest_with(&Traversal::<true> { rays, sign, shaft, lead }, active, hits, stack),
            None => self.closest_with(&Traversal::<false> { rays, sign: [false; 3], shaft, lead }, active, hits, stack),
        }
    }

    fn closest_with<const COMMON: bool>(
        &self,
        traversal: &Traversal<'_, COMMON>,
        active: &[M8],
        hits: &mut [Hits],
        stack: &mut Stack,
    ) {
        let stack = &mut *stack.pending;
        let mut height = 0;
        // how far the farthest ray still looks
        let mut reach = farthest(hits, active);
        let mut place = 0_usize;
        loop {
            let node = &self.nodes[place];
            let (bits, near) = traversal.enter::<true>(node, hits[0].distance, active[0], reach);
            // the nearest child goes to the top of the stack
            let floor = height;
            each_bit(bits, |slot| {
                let child = Pending { parent: place as u32, slot: slot as u32, near: near[slot] };
                let mut at = height;
                while at > floor && stack[at - 1].near < child.near {
                    stack[at] = stack[at - 1];
                    at -= 1;
                }
                stack[at] = child;
                height += 1;
            });
            place = loop {
                if height == 0 {
                    return;
                }
                height -= 1;
                let Pending { parent, slot, near } = stack[height];
                // a packet's entry bounds one lane alone: its leaves are tested again
                if traversal.shaft.is_some() && near > reach {
                    continue;
                }
                let (node, slot) = (&self.nodes[parent as usize], slot as usize);
                let (first, count) = (node.first[slot] as usize, usize::from(node.count[slot]));
                if count == 0 {
                    break first;
                }
                let entered = traversal.packets(node, slot, |p| hits[p].distance, active);
                each_bit(entered, |p| {
                    self.primitives.closest(first..first + count, &traversal.rays[p], active[p], &mut hits[p]);
                });
                if entered != 0 {
                    reach = farthest(hits, active);
                }
            };
        }
    }

    /// Takes out of `active` the lanes in which something other than `skip` lies before `limit`.
    pub(super) fn occluded(
        &self,
        rays: &[Rays],
        active: &mut [M8],
        limit: &[X8],
        skip: &[u32x8],
        shaft: Option<&Shaft>,
        stack: &mut Stack,
    ) {
        if self.count == 0 {
            return;
        }
        let lead = active[0].bits().trailing_zeros() as usize & 7;
        match common_sign(rays) {
            Some(sign) => {
                self.occluded_with(&Traversal::<true> { rays, sign, shaft, lead }, active, limit, skip, stack)
            }
            None => {
                self.occluded_with(
                    &Traversal::<false> { rays, sign: [false; 3], shaft, lead },
                    active,
                    limit,
                    skip,
                    stack,
                );
            }
        }
    }

    fn occluded_with<const COMMON: bool>(
        &self,
        traversal: &Traversal<'_, COMMON>,
        active: &mut [M8],
        limit: &[X8],
        skip: &[u32x8],
        stack: &mut Stack,
    ) {
        let stack = &mut *stack.pending;
        let reach = limit.iter().zip(&*active).fold(X8::lit(0.0), |m, (&l, &a)| max(m, l.keep(a)));
        let reach = reach.to_array().into_iter().fold(0.0, f32::max);
        let mut height = 0;
        let mut place = 0_u32;
        loop {
            let node = &self.nodes[place as usize];
            let (mut bits, _) = traversal.enter::<false>(node, limit[0], active[0], reach);
            let mut closed = false;
            while bits != 0 {
                let slot = bits.trailing_zeros() as usize & 7;
                bits &= bits - 1;
                let (first, count) = (node.first[slot], usize::from(node.count[slot]));
                if count == 0 {
                    stack[height].parent = first;
                    height += 1;
                    continue;
                }
                let range = first as usize..first as usize + count;
                // a single packet has just entered this very box
                let entered = match traversal.shaft {
                    None => 1,
                    Some(_) => traversal.packets(node, slot, |p| limit[p], active),
                };
                each_bit(entered, |p| {
                    let range = range.clone();
                    let hidden = self.primitives.occluded(range, &traversal.rays[p], active[p], limit[p], skip[p]);
                    active[p] = active[p] & !hidden;
                    closed |= !active[p].any();
                });
                if closed && !active.iter().any(|a| a.any()) {
                    return;
                }
            }
            if height == 0 {
                return;
            }
            height -= 1;
            place = stack[height].parent;
        }
    }
}

/// The greatest distance at which an active ray still looks for something.
#[inline]
fn farthest(hits: &[Hits], active: &[M8]) -> f32 {
    let most = hits.iter().zip(active).fold(X8::lit(0.0), |m, (h, &a)| max(m, h.distance.keep(a)));
    most.to_array().into_iter().fold(0.0, f32::max)
}

/// The signs that all rays of a group share, if they do.
#[inline]
fn common_sign(rays: &[Rays]) -> Option<[bool; 3]> {
    let sign = rays[0].common_sign?;
    rays[1..].iter().all(|r| r.common_sign == Some(sign)).then_some(sign)
}
