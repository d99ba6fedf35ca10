//! Builds trees: collapses obvhs's binary tree into nodes of eight children. No other file uses obvhs.

use super::node::{Bounded, Bounds, EMPTY, Node, WIDTH, union};
use crate::packet::X8;
use etendue::Real;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};
use obvhs::{Boundable, aabb::Aabb, bvh2::Bvh2, bvh2::node::Bvh2Node, bvh2::reinsertion::ReinsertionOptimizer};

/// Limit on leaf size, and costs of visiting leaves relative to visiting an inner node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Costs {
    /// Greatest number of primitives in a leaf, at most 15.
    pub(super) most: usize,
    /// Fixed cost of a leaf.
    pub(super) leaf: f32,
    /// Additional cost of each primitive in a leaf.
    pub(super) primitive: f32,
}

/// The nodes of a tree, root first, and the indices of the primitives in leaf order.
pub(super) type Built = (Vec<Node>, Vec<u32>);

/// Fraction of the nodes that obvhs tries to reinsert at a better place.
const REINSERTED: f32 = 0.1;

struct Boxed<'a, T>(&'a T);

impl<T: Bounded> Boundable for Boxed<'_, T> {
    fn aabb(&self) -> Aabb {
        let [low, high] = self.0.bounds();
        Aabb::new(low.into(), high.into())
    }
}

/// Builds a tree: with obvhs, or balanced if one leaf suffices, if obvhs's tree would be deeper than `depth` (many primitives in one
/// place), or if SAH costs would overflow.
pub(super) fn build<T: Bounded>(all: &[T], costs: Costs, depth: usize) -> Built {
    optimized(all, costs, depth).unwrap_or_else(|| balanced(all, costs.most))
}

fn optimized<T: Bounded>(all: &[T], costs: Costs, depth: usize) -> Option<Built> {
    if all.len() <= costs.most || crowded(all) || overflows(all, costs) {
        return None;
    }
    let boxes: Vec<_> = all.iter().map(Boxed).collect();
    let indices = (0..all.len() as u32).collect();
    let mut bvh =
        PlocBuilder::with_capacity(all.len()).build(PlocSearchDistance::Low, &boxes, indices, SortPrecision::U64, 0);
    ReinsertionOptimizer::default().run(&mut bvh, REINSERTED, None);
    Some(Collapse::new(&bvh, costs, depth)?.nodes())
}

/// Number of equal boxes from which on obvhs is not used: its builder merges only one pair of them per round.
const ALIKE: usize = 64;

/// Whether there are that many equal boxes.
fn crowded<T: Bounded>(all: &[T]) -> bool {
    let mut keys = all.iter().map(|item| {
        let mix = |h: u64, x: &f32| (h ^ u64::from(x.to_bits())).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29);
        item.bounds().as_flattened().iter().fold(0, mix)
    });
    // with as many slots as primitives, no slot gets near that number by chance
    let bits = usize::BITS - all.len().leading_zeros();
    let mut slots = vec![0_u8; 1 << bits];
    keys.any(|key| {
        let slot = &mut slots[(key.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (64 - bits)) as usize];
        *slot += 1;
        usize::from(*slot) == ALIKE
    })
}

/// Whether SAH costs might not be finite: no cost exceeds that of leaves and nodes as large as everything.
fn overflows<T: Bounded>(all: &[T], costs: Costs) -> bool {
    let [low, high] = all.iter().fold(EMPTY, |bounds, item| union(bounds, item.bounds()));
    let most = Aabb::new(low.into(), high.into()).half_area() * (costs.leaf + costs.primitive + 1.0);
    !(most * all.len() as f32).is_finite()
}

/// Least costs of representing a subtree by at most 1, 2, … 7 children of one node.
type Least = [f32; WIDTH - 1];

/// Chooses nodes and leaves of least SAH cost by dynamic programming over the binary tree.
/// (Ylitie, Karras and Laine 2017, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", section 3.1.)
struct Collapse<'a> {
    bvh: &'a Bvh2,
    costs: Costs,
    /// Least costs of each inner node, indexed by its pair of children.
    least: Vec<Least>,
    /// Number of primitives below each inner node, indexed likewise.
    sizes: Vec<u32>,
}

/// Index of an inner node's pair of children: obvhs stores children in pairs, the first pair at 1.
fn pair(node: &Bvh2Node) -> usize {
    node.first_index as usize / 2
}

impl<'a> Collapse<'a> {
    fn new(bvh: &'a Bvh2, costs: Costs, deepest: usize) -> Option<Self> {
        let pairs = bvh.nodes.len() / 2;
        let mut this = Self { bvh, costs, least: vec![[0.0; WIDTH - 1]; pairs], sizes: vec![0; pairs] };
        // parents before their children
        let mut order = Vec::with_capacity(pairs);
        let mut pending = vec![(0_u32, 1)];
        while let Some((index, depth)) = pending.pop() {
            let node = &bvh.nodes[index as usize];
            if node.is_leaf() {
                continue;
            }
            if depth >= deepest {
                return None;
            }
            order.push(index);
            pending.extend([(node.first_index, depth + 1), (node.first_index + 1, depth + 1)]);
        }
        for &index in order.iter().rev() {
            let node = &bvh.nodes[index as usize];
            let children = [0, 1].map(|i| &bvh.nodes[node.first_index as usize + i]);
            let size = children.map(|c| this.size(c)).iter().sum();
            let [left, right] = children.map(|c| this.least(c));
            let area = node.aabb().half_area();
            // dealt[j − 2] is the least cost of distributing j children between the two subtrees
            let mut shifted = [f32::INFINITY; 2 * WIDTH];
            shifted[WIDTH..2 * WIDTH - 1].copy_from_slice(&right);
            let mut dealt = X8::lit(f64::INFINITY);
            for k in 1..WIDTH {
                let rest: [f32; WIDTH] = shifted[WIDTH + 1 - k..2 * WIDTH + 1 - k].try_into().expect("8 numbers");
                dealt = (X8::splat(left[k - 1]) + X8::from(rest)).lesser(dealt);
            }
            let dealt = dealt.to_array();
            let mut least = [0.0; WIDTH - 1];
            least[0] = (dealt[WIDTH - 2] + area).min(this.leaf_cost(area, size));
            for j in 2..WIDTH {
                least[j - 1] = dealt[j - 2].min(least[j - 2]);
            }
            (this.least[pair(node)], this.sizes[pair(node)]) = (least, size);
        }
        Some(this)
    }
    fn size(&self, node: &Bvh2Node) -> u32 {
        if node.is_leaf() { node.prim_count } else { self.sizes[pair(node)] }
    }
    fn least(&self, node: &Bvh2Node) -> Least {
        if node.is_leaf() {
            return [self.leaf_cost(node.aabb().half_area(), node.prim_count); WIDTH - 1];
        }
        self.least[pair(node)]
    }
    fn leaf_cost(&self, area: f32, size: u32) -> f32 {
        if size as usize > self.costs.most {
            return f32::INFINITY;
        }
        area * (self.costs.leaf + self.costs.primitive * size as f32)
    }
    fn becomes_leaf(&self, node: &Bvh2Node) -> bool {
        let size = self.size(node);
        node.is_leaf() || self.leaf_cost(node.aabb().half_area(), size) <= self.least(node)[0]
    }
    /// Adds the descendants that represent a node in up to `room` slots; with 1 slot, the node itself.
    fn deal(&self, index: usize, room: usize, chosen: &mut [usize; WIDTH], count: &mut usize) {
        let node = &self.bvh.nodes[index];
        let room = if node.is_leaf() { 1 } else { room };
        if room == 1 || room < WIDTH && self.least(node)[room - 1] == self.least(node)[room - 2] {
            if room > 1 {
                return self.deal(index, room - 1, chosen, count);
            }
            chosen[*count] = index;
            *count += 1;
            return;
        }
        let first = node.first_index as usize;
        let [left, right] = [first, first + 1].map(|i| self.least(&self.bvh.nodes[i]));
        let cost = |k: usize| left[k - 1] + right[room - k - 1];
        let best = (2..room).fold(1, |best, k| if cost(k) < cost(best) { k } else { best });
        self.deal(first, best, chosen, count);
        self.deal(first + 1, room - best, chosen, count);
    }
    fn nodes(&self) -> Built {
        let bvh = self.bvh;
        let mut nodes = vec![Node::default()];
        let mut order = Vec::with_capacity(bvh.primitive_indices.len());
        // (obvhs's node, ours), depth first so that subtrees are contiguous
        let mut pending = vec![(0_usize, 0_usize)];
        let mut below = Vec::new();
        while let Some((index, place)) = pending.pop() {
            let (mut children, mut count) = ([0; WIDTH], 0);
            self.deal(index, WIDTH, &mut children, &mut count);
            // cheap children go last, to the top of the stack, so that an occlusion test can exit early
            let cost = |child: usize| self.least(&bvh.nodes[child])[0] / bvh.nodes[child].aabb().half_area();
            children[..count].sort_unstable_by(|&a, &b| cost(b).total_cmp(&cost(a)).then(a.cmp(&b)));
            let mut inner = [(0, 0); WIDTH];
            let mut inners = 0;
            for &child in &children[..count] {
                let node = &bvh.nodes[child];
                let bounds = [node.aabb().min.to_array(), node.aabb().max.to_array()];
                if self.becomes_leaf(node) {
                    let first = order.len();
                    below.push(node);
                    while let Some(node) = below.pop() {
                        let first = node.first_index as usize;
                        if node.is_leaf() {
                            order.extend_from_slice(&bvh.primitive_indices[first..first + node.prim_count as usize]);
                        } else {
                            below.extend([&bvh.nodes[first + 1], &bvh.nodes[first]]);
                        }
                    }
                    nodes[place].push(&bounds, first as u32, order.len() - first);
                } else {
                    nodes.push(Node::default());
                    let to = nodes.len() - 1;
                    nodes[place].push(&bounds, to as u32, 0);
                    inner[inners] = (child, to);
                    inners += 1;
                }
            }
            pending.extend(inner[..inners].iter().rev());
        }
        (nodes, order)
    }
}

/// Builds a tree by halving along the longest axis of the centres, with depth log₂ n for any input.
fn balanced<T: Bounded>(all: &[T], most: usize) -> Built {
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
