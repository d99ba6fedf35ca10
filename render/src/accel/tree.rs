//! A binary tree of boxes, built by obvhs and traversed by packets. The one file that names obvhs.

use super::{Hits, M8, Rays, X8, max, min, select};
use etendue::{Mask, Real, u32x8};
use glam::Vec3A;
use obvhs::{BvhBuildParams, aabb::Aabb, bvh2::Bvh2, bvh2::builder::build_bvh2};
use std::ops::Range;
use std::time::Duration;

/// Deepest tree that is traversed: the stack holds one entry a level.
const DEPTH: usize = 96;
/// A leaf holds no more than this.
const LEAF: usize = 8;

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

/// Both children of an inner node: one cache line.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(64))]
struct Node {
    /// Per child, lower and upper corner.
    bounds: [[[f32; 3]; 2]; 2],
    /// Per child: index of an inner node, or of the first primitive.
    first: [u32; 2],
    /// Per child: number of primitives, 0 for an inner node.
    count: [u32; 2],
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

/// A subtree while the nodes are written.
#[derive(Clone, Copy)]
struct Child {
    bounds: Bounds,
    first: u32,
    count: u32,
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

/// obvhs's tree in our layout, or nothing if it would be too deep (many primitives in one place).
fn built_by_obvhs(all: &[Bounds]) -> Option<(Vec<Node>, Vec<u32>)> {
    if all.len() <= LEAF || crowded(all) {
        return None;
    }
    let boxes: Vec<Aabb> =
        all.iter().map(|[lo, hi]| Aabb::new(Vec3A::from_array(*lo), Vec3A::from_array(*hi))).collect();
    let bvh = build_bvh2(&boxes, BvhBuildParams::medium_build(), &mut Duration::default());
    let mut nodes = Vec::with_capacity(bvh.nodes.len() / 2);
    let mut order = Vec::with_capacity(all.len());
    nodes.push(Node::default());
    // (obvhs index of the first child, our index of the node, depth), depth first so that subtrees are contiguous
    let mut pending = vec![(bvh.nodes[0].first_index as usize, 0_usize, 1_usize)];
    if bvh.nodes[0].is_leaf() {
        return None;
    }
    while let Some((first, place, depth)) = pending.pop() {
        if depth >= DEPTH {
            return None;
        }
        for side in [1, 0] {
            let child = convert(&bvh, first + side, &mut order, &mut nodes);
            let node = &mut nodes[place];
            (node.bounds[side], node.first[side], node.count[side]) = (child.bounds, child.first, child.count);
            if child.count == 0 {
                pending.push((bvh.nodes[first + side].first_index as usize, child.first as usize, depth + 1));
            }
        }
    }
    Some((nodes, order))
}

/// One of obvhs's nodes: a leaf's primitives go to `order`, an inner node gets a place in `nodes`.
fn convert(bvh: &Bvh2, index: usize, order: &mut Vec<u32>, nodes: &mut Vec<Node>) -> Child {
    let node = &bvh.nodes[index];
    let bounds = [node.aabb().min.to_array(), node.aabb().max.to_array()];
    if node.is_leaf() {
        let first = order.len() as u32;
        let range = node.first_index as usize..(node.first_index + node.prim_count) as usize;
        order.extend_from_slice(&bvh.primitive_indices[range]);
        Child { bounds, first, count: node.prim_count }
    } else {
        nodes.push(Node::default());
        Child { bounds, first: nodes.len() as u32 - 1, count: 0 }
    }
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
    // an empty or small set is one leaf, beside an empty one
    let empty = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
    nodes[0].bounds = [empty, empty];
    nodes[0].count = [1, 1];
    nodes[0].first = [0, 0];
    if all.len() <= LEAF {
        if !all.is_empty() {
            nodes[0].bounds[0] = all.iter().fold(empty, |a, b| union(a, *b));
            nodes[0].count[0] = all.len() as u32;
        }
        return (nodes, order);
    }
    let mut pending = vec![(0..all.len(), 0_usize)];
    while let Some((range, place)) = pending.pop() {
        let part = &mut order[range.clone()];
        let center = |i: u32, axis: usize| all[i as usize][0][axis] + all[i as usize][1][axis];
        let extent = |axis: usize| {
            let (lo, hi) = part.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(lo, hi), &i| {
                (lo.min(center(i, axis)), hi.max(center(i, axis)))
            });
            hi - lo
        };
        let axis = (0..3).max_by(|&a, &b| extent(a).total_cmp(&extent(b))).unwrap_or(0);
        let middle = part.len() / 2;
        part.select_nth_unstable_by(middle, |&a, &b| center(a, axis).total_cmp(&center(b, axis)).then(a.cmp(&b)));
        for (side, half) in [range.start..range.start + middle, range.start + middle..range.end].into_iter().enumerate()
        {
            nodes[place].bounds[side] = order[half.clone()].iter().fold(empty, |a, &i| union(a, all[i as usize]));
            if half.len() <= LEAF {
                nodes[place].first[side] = half.start as u32;
                nodes[place].count[side] = half.len() as u32;
            } else {
                nodes.push(Node::default());
                nodes[place].first[side] = nodes.len() as u32 - 1;
                nodes[place].count[side] = 0;
                pending.push((half, nodes.len() - 1));
            }
        }
    }
    (nodes, order)
}

/// Where the rays enter and leave a box.
#[inline(always)]
fn slabs<const COMMON: bool>(bounds: &Bounds, rays: &Rays, sign: [bool; 3], limit: X8) -> (X8, M8) {
    let lower = |k: usize| match k {
        0 => X8::splat(bounds[0][0]).mul_add(rays.inverse.x, rays.lower.x),
        1 => X8::splat(bounds[0][1]).mul_add(rays.inverse.y, rays.lower.y),
        _ => X8::splat(bounds[0][2]).mul_add(rays.inverse.z, rays.lower.z),
    };
    let upper = |k: usize| match k {
        0 => X8::splat(bounds[1][0]).mul_add(rays.inverse.x, rays.upper.x),
        1 => X8::splat(bounds[1][1]).mul_add(rays.inverse.y, rays.upper.y),
        _ => X8::splat(bounds[1][2]).mul_add(rays.inverse.z, rays.upper.z),
    };
    let axis = |k: usize| {
        let (a, b) = (lower(k), upper(k));
        if COMMON { if sign[k] { (b, a) } else { (a, b) } } else { (min(a, b), max(a, b)) }
    };
    let ((nx, fx), (ny, fy), (nz, fz)) = (axis(0), axis(1), axis(2));
    let near = max(max(nx, ny), max(nz, X8::lit(0.0)));
    let far = min(min(fx, fy), min(fz, limit));
    (near, near.le(far))
}

/// A subtree or a leaf that is still to be visited, and where the rays enter it.
#[derive(Clone, Copy)]
struct Pending {
    near: X8,
    first: u32,
    count: u32,
}

impl<P: Primitives> Tree<P> {
    /// Bytes held by nodes and primitives.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + self.primitives.bytes()
    }

    #[inline]
    pub(super) fn closest(&self, rays: &Rays, active: M8, hits: &mut Hits) {
        if self.count == 0 {
            return;
        }
        match rays.common_sign {
            Some(sign) => self.closest_with::<true>(rays, active, hits, sign),
            None => self.closest_with::<false>(rays, active, hits, [false; 3]),
        }
    }

    fn closest_with<const COMMON: bool>(&self, rays: &Rays, active: M8, hits: &mut Hits, sign: [bool; 3]) {
        let zero = X8::lit(0.0);
        let mut stack = [Pending { near: zero, first: 0, count: 0 }; DEPTH + 1];
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let Pending { near, mut first, mut count } = stack[height];
            if !(near.le(hits.distance) & active).any() {
                continue;
            }
            while count == 0 {
                let node = &self.nodes[first as usize];
                let (near0, hit0) = slabs::<COMMON>(&node.bounds[0], rays, sign, hits.distance);
                let (near1, hit1) = slabs::<COMMON>(&node.bounds[1], rays, sign, hits.distance);
                let (hit0, hit1) = (hit0 & active, hit1 & active);
                match (hit0.any(), hit1.any()) {
                    (false, false) => break,
                    (true, false) => (first, count) = (node.first[0], node.count[0]),
                    (false, true) => (first, count) = (node.first[1], node.count[1]),
                    (true, true) => {
                        // the side that most rays enter first
                        let votes = (near0.le(near1) & hit0).bits().count_ones();
                        let others = (near1.lt(near0) & hit1).bits().count_ones();
                        let (this, other) = if votes >= others { (0, 1) } else { (1, 0) };
                        let near = if other == 0 {
                            select(hit0, near0, X8::lit(f64::INFINITY))
                        } else {
                            select(hit1, near1, X8::lit(f64::INFINITY))
                        };
                        stack[height] = Pending { near, first: node.first[other], count: node.count[other] };
                        height += 1;
                        (first, count) = (node.first[this], node.count[this]);
                    }
                }
            }
            if count > 0 {
                let first = first as usize;
                self.primitives.closest(first..first + count as usize, rays, active, hits);
            }
        }
    }

    #[inline]
    pub(super) fn occluded(&self, rays: &Rays, active: M8, limit: X8, skip: u32x8) -> M8 {
        if self.count == 0 {
            return M8::splat(false);
        }
        match rays.common_sign {
            Some(sign) => self.occluded_with::<true>(rays, active, limit, skip, sign),
            None => self.occluded_with::<false>(rays, active, limit, skip, [false; 3]),
        }
    }

    fn occluded_with<const COMMON: bool>(
        &self,
        rays: &Rays,
        mut active: M8,
        limit: X8,
        skip: u32x8,
        sign: [bool; 3],
    ) -> M8 {
        let mut stack = [(0_u32, 0_u32); DEPTH + 1];
        let mut height = 1;
        let mut hidden = M8::splat(false);
        while height > 0 {
            height -= 1;
            let (mut first, mut count) = stack[height];
            while count == 0 {
                let node = &self.nodes[first as usize];
                let (near0, hit0) = slabs::<COMMON>(&node.bounds[0], rays, sign, limit);
                let (near1, hit1) = slabs::<COMMON>(&node.bounds[1], rays, sign, limit);
                let (hit0, hit1) = (hit0 & active, hit1 & active);
                match (hit0.any(), hit1.any()) {
                    (false, false) => break,
                    (true, false) => (first, count) = (node.first[0], node.count[0]),
                    (false, true) => (first, count) = (node.first[1], node.count[1]),
                    (true, true) => {
                        let votes = (near0.le(near1) & hit0).bits().count_ones();
                        let others = (near1.lt(near0) & hit1).bits().count_ones();
                        let (this, other) = if votes >= others { (0, 1) } else { (1, 0) };
                        stack[height] = (node.first[other], node.count[other]);
                        height += 1;
                        (first, count) = (node.first[this], node.count[this]);
                    }
                }
            }
            if count > 0 {
                let first = first as usize;
                let more = self.primitives.occluded(first..first + count as usize, rays, active, limit, skip);
                hidden = hidden | more;
                active = active & !more;
                if !active.any() {
                    return hidden;
                }
            }
        }
        hidden
    }
}
