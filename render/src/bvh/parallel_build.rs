//! Builds trees over many primitives: splits them into parts, builds each part on its own, in parallel, and a tree over the roots.
//!
//! The split depends on the primitives alone, so the tree does not depend on the number of threads. Besides the tree, a build needs
//! the memory of a few parts and of a second copy of the nodes.

use super::build::{Costs, build, halve};
use super::node::{Bounded, Bounds, DEPTH, EMPTY, Node, WIDTH, union};
use std::ops::Range;

/// Greatest number of primitives in a part: the builder's data for them fits into the L2 cache.
const PART: usize = 16_384;
/// Greatest depth of the binary tree over the parts; the parts may use the rest of [`DEPTH`].
const DEPTH_OVER_PARTS: usize = 32;
/// Number of levels that are split by SAH; deeper ones are halved.
const LEVELS: usize = 24;
/// Number of bins for the SAH.
const BINS: usize = 32;
/// Number of primitives sampled for the SAH.
const SAMPLE: usize = 4096;

/// A tree over some of the primitives, whose node indices are local.
struct Part {
    nodes: Vec<Node>,
}

impl Part {
    fn bounds(&self) -> Bounds {
        let [low, high] = &self.nodes[0].planes;
        [
            low.map(|planes| planes.into_iter().fold(f32::INFINITY, f32::min)),
            high.map(|planes| planes.into_iter().fold(f32::NEG_INFINITY, f32::max)),
        ]
    }
    /// Whether the part is a single leaf.
    fn is_leaf(&self) -> bool {
        let root = &self.nodes[0];
        root.children == 1 && root.count[0] != 0
    }
}

/// Builds the nodes of a tree, root first. Reorders primitives and their ids into leaf order, and calls `leaf` with those of each leaf.
pub(super) fn build_parts<T: Bounded>(
    items: &mut [T],
    ids: &mut [u32],
    costs: Costs,
    leaf: &(impl Fn(&mut [T]) + Sync),
) -> Vec<Node> {
    let mut parts = each_part(items, ids, 0, 0, costs, leaf);
    if parts.len() == 1 {
        return parts.swap_remove(0).nodes;
    }
    let roots: Vec<_> = parts.iter().map(Part::bounds).collect();
    let over = Costs { most: 1, leaf: 1.0, primitive: 0.0 };
    let (mut nodes, order) = build(&roots, over, DEPTH_OVER_PARTS);
    let mut next = nodes.len();
    let starts: Vec<_> = parts
        .iter()
        .map(|part| {
            let start = next;
            next += if part.is_leaf() { 0 } else { part.nodes.len() };
            start
        })
        .collect();
    for node in &mut nodes {
        for slot in (0..WIDTH).filter(|&slot| node.count[slot] != 0).collect::<Vec<_>>() {
            let part = order[node.first[slot] as usize] as usize;
            let root = &parts[part].nodes[0];
            (node.first[slot], node.count[slot]) =
                if parts[part].is_leaf() { (root.first[0], root.count[0]) } else { (starts[part] as u32, 0) };
            node.inner |= u32::from(node.count[slot] == 0) << slot;
        }
    }
    nodes.reserve_exact(next - nodes.len());
    for (mut part, start) in parts.into_iter().zip(starts) {
        if part.is_leaf() {
            continue;
        }
        for node in &mut part.nodes {
            for slot in 0..node.children as usize {
                if node.count[slot] == 0 {
                    node.first[slot] += start as u32;
                }
            }
        }
        nodes.append(&mut part.nodes);
    }
    nodes
}

/// Builds the parts of `items`, which start at index `first` of all items.
fn each_part<T: Bounded>(
    items: &mut [T],
    ids: &mut [u32],
    first: usize,
    level: usize,
    costs: Costs,
    leaf: &(impl Fn(&mut [T]) + Sync),
) -> Vec<Part> {
    if items.len() <= PART {
        return vec![part(items, ids, first, costs, leaf)];
    }
    let middle = divide(items, ids, level);
    let ((a, b), (ids_a, ids_b)) = (items.split_at_mut(middle), ids.split_at_mut(middle));
    let (mut parts, rest) = rayon::join(
        || each_part(a, ids_a, first, level + 1, costs, leaf),
        || each_part(b, ids_b, first + middle, level + 1, costs, leaf),
    );
    parts.extend(rest);
    parts
}

fn part<T: Bounded>(items: &mut [T], ids: &mut [u32], first: usize, costs: Costs, leaf: &impl Fn(&mut [T])) -> Part {
    let (mut nodes, order) = build(items, costs, DEPTH - DEPTH_OVER_PARTS);
    arrange(items, ids, &order);
    for node in &mut nodes {
        for slot in 0..node.children as usize {
            if node.count[slot] != 0 {
                leaf(&mut items[node.leaf(slot)]);
                node.first[slot] += first as u32;
            }
        }
    }
    nodes.shrink_to_fit();
    Part { nodes }
}

/// Moves item `order[i]` to index i.
fn arrange<T: Copy>(items: &mut [T], ids: &mut [u32], order: &[u32]) {
    fn gather<U: Copy>(to: &mut [U], order: &[u32]) {
        let from = to.to_vec();
        to.iter_mut().zip(order).for_each(|(to, &i)| *to = from[i as usize]);
    }
    gather(items, order);
    gather(ids, order);
}

/// Splits the items in two, and returns the size of the first half.
fn divide<T: Bounded>(items: &mut [T], ids: &mut [u32], level: usize) -> usize {
    if level < LEVELS
        && let Some(plane) = Plane::best(items)
    {
        return partition(items, ids, |item| plane.is_below(item));
    }
    let all: Vec<_> = items.iter().map(Bounded::bounds).collect();
    let mut order: Vec<_> = (0..items.len() as u32).collect();
    halve(&all, &mut order);
    arrange(items, ids, &order);
    items.len() / 2
}

/// Moves the items for which `first` holds to the front, and returns their number.
fn partition<T>(items: &mut [T], ids: &mut [u32], first: impl Fn(&T) -> bool) -> usize {
    let Range { mut start, mut end } = 0..items.len();
    loop {
        while start < end && first(&items[start]) {
            start += 1;
        }
        while start < end && !first(&items[end - 1]) {
            end -= 1;
        }
        if start == end {
            return start;
        }
        items.swap(start, end - 1);
        ids.swap(start, end - 1);
        start += 1;
        end -= 1;
    }
}

fn half_area([low, high]: &Bounds) -> f32 {
    let [x, y, z]: [f32; 3] = std::array::from_fn(|k| high[k] - low[k]);
    x * y + y * z + z * x
}

/// A splitting plane between two of [`BINS`] equal intervals of the centres along an axis.
#[derive(Clone, Copy)]
struct Plane {
    axis: usize,
    least: f32,
    scale: f32,
    /// Number of bins below the plane.
    below: usize,
}

impl Plane {
    /// The plane of least SAH cost for a sample of the set; `None` if all centres coincide.
    fn best<T: Bounded>(items: &[T]) -> Option<Self> {
        let sample: Vec<_> = items.iter().step_by(items.len().div_ceil(SAMPLE)).map(Bounded::bounds).collect();
        let [low, high] = sample.iter().fold(EMPTY, |all, bounds| {
            let center = std::array::from_fn(|k| bounds.middle(k));
            union(all, [center, center])
        });
        let best = (0..3).map(|axis| {
            let mut plane = Self { axis, least: low[axis], scale: BINS as f32 / (high[axis] - low[axis]), below: 0 };
            let cost = plane.choose(&sample);
            (cost, plane)
        });
        let (cost, plane) = best.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (cost < f32::INFINITY).then_some(plane)
    }
    /// Moves the plane to the bin of least SAH cost and returns that cost.
    fn choose(&mut self, sample: &[Bounds]) -> f32 {
        let mut bins = [(0, EMPTY); BINS];
        for bounds in sample {
            let (count, all) = &mut bins[self.bin(bounds)];
            (*count, *all) = (*count + 1, union(*all, *bounds));
        }
        let cost =
            |count: u32, bounds: &Bounds| if count == 0 { f32::INFINITY } else { count as f32 * half_area(bounds) };
        let mut above = [0.0; BINS];
        let (mut count, mut bounds) = (0, EMPTY);
        for i in (1..BINS).rev() {
            (count, bounds) = (count + bins[i].0, union(bounds, bins[i].1));
            above[i] = cost(count, &bounds);
        }
        let (mut count, mut bounds, mut least) = (0, EMPTY, f32::INFINITY);
        for i in 1..BINS {
            (count, bounds) = (count + bins[i - 1].0, union(bounds, bins[i - 1].1));
            let cost = cost(count, &bounds) + above[i];
            if cost < least {
                (least, self.below) = (cost, i);
            }
        }
        least
    }
    #[inline]
    fn bin(&self, item: &impl Bounded) -> usize {
        // a NaN becomes 0
        (((item.middle(self.axis) - self.least) * self.scale) as usize).min(BINS - 1)
    }
    #[inline]
    fn is_below(&self, item: &impl Bounded) -> bool {
        self.bin(item) < self.below
    }
}
