//! Packet traversal: a group moves through the tree as one frustum, or a packet on its own.

use super::node::{INNER, Node, Stack, WIDTH, greater, push_in_order, slabs};
use super::rays::{Hits, Rays, any, common_sign};
use super::tree::{Primitives, View};
use crate::packet::{M8, V8, X8, first_lane};
use etendue::{Mask, Real};

/// A frustum that contains all rays of a group. All rays run the same way along one axis; across it, they are bounded by their least
/// and greatest slopes. One test finds the children of a node that any ray of the group can enter.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frustum {
    axis: usize,
    negative: bool,
    /// Least and greatest origin, widened.
    origin: [[f32; 3]; 2],
    /// Least and greatest slope: change of a coordinate per unit along the axis, in the direction of the rays.
    slope: [[f32; 3]; 2],
    /// Greatest step along the axis per unit of distance.
    along: f32,
}

/// Groups whose slopes differ by more than this share too few leaves: they are faster as a stream.
const SPREAD: f32 = 0.02;

impl Frustum {
    /// The frustum of the active rays; `None` if they share no axis or spread too far.
    pub(super) fn new(rays: &[Rays], active: &[M8]) -> Option<Self> {
        let first = active.iter().position(|a| a.any())?;
        let lane = first_lane(active[first]);
        let direction = <[f32; 3]>::from(rays[first].direction.lane(lane));
        let axis = (0..3).max_by(|&a, &b| direction[a].abs().total_cmp(&direction[b].abs()))?;
        let negative = direction[axis] < 0.0;
        let infinite = X8::lit(f64::INFINITY);
        let mut least = [infinite; 7];
        let mut most = [-infinite; 7];
        let mut pad = 0.0_f32;
        for (r, &a) in rays.iter().zip(active) {
            let d = [r.direction.x, r.direction.y, r.direction.z][axis].negate_where(M8::splat(negative));
            let slope = r.direction * (X8::lit(1.0) / d);
            if Self::wide(slope, a) {
                return None;
            }
            let values = [r.origin.x, r.origin.y, r.origin.z, slope.x, slope.y, slope.z, d];
            for (k, value) in values.into_iter().enumerate() {
                least[k] = least[k].lesser(Real::blend(a, value, infinite));
                most[k] = most[k].greater(Real::blend(a, value, -infinite));
            }
            pad = pad.max(r.pad);
        }
        let low = least.map(|x| x.to_array().into_iter().fold(f32::INFINITY, f32::min));
        let high = most.map(|x| x.to_array().into_iter().fold(f32::NEG_INFINITY, f32::max));
        // a NaN or an infinity among the slopes fails the comparison
        let narrow = (3..6).all(|k| high[k] - low[k] <= SPREAD);
        (low[6] > 0.0 && narrow).then(|| Self {
            axis,
            negative,
            origin: [std::array::from_fn(|k| low[k] - pad), std::array::from_fn(|k| high[k] + pad)],
            slope: [[low[3], low[4], low[5]], [high[3], high[4], high[5]]],
            along: high[6],
        })
    }

    /// Whether this packet alone spreads too far.
    #[inline(always)]
    fn wide(slope: V8, active: M8) -> bool {
        let lead = slope.lane(first_lane(active));
        let apart = slope - V8::splat(lead);
        // a NaN fails the comparison, too
        let near = apart.x.abs().greater(apart.y.abs()).greater(apart.z.abs()).le(X8::splat(SPREAD));
        (active & !near).any()
    }

    /// The children of a node that a ray of the group may enter within `reach`, and lower bounds of their entry distances.
    #[inline(always)]
    pub(super) fn enter(&self, node: &Node, reach: f32) -> (X8, M8) {
        let k = self.axis;
        let [low, high] = self.origin;
        let (lower, upper) = (X8::from(node.planes[0][k]), X8::from(node.planes[1][k]));
        let (near, far) = if self.negative {
            (X8::splat(low[k]) - upper, X8::splat(high[k]) - lower)
        } else {
            (lower - X8::splat(high[k]), upper - X8::splat(low[k]))
        };
        let near = near.greater(X8::lit(0.0));
        let far = far.lesser(X8::splat(reach * self.along));
        let across = |i: usize| {
            let (least, greatest) = (self.slope[0][i], self.slope[1][i]);
            let from = if least < 0.0 { far } else { near };
            let to = if greatest < 0.0 { near } else { far };
            let from = X8::splat(least).mul_add(from, X8::splat(low[i]));
            let to = X8::splat(greatest).mul_add(to, X8::splat(high[i]));
            from.le(X8::from(node.planes[1][i])) & to.ge(X8::from(node.planes[0][i]))
        };
        let mask = near.le(far) & across((k + 1) % 3) & across((k + 2) % 3);
        // a distance is at least the step along the axis
        (near, mask)
    }
}

/// A child to visit.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pending {
    /// Index of the inner node, or of the leaf's parent.
    node: u32,
    /// Slot of the leaf, or [`INNER`] for an inner node.
    slot: u32,
    /// Lower bound of the entry distance.
    near: f32,
}

/// A group of packets that traverses a tree: as one frustum around all of them, or as a single packet.
struct Packets<'a, const COMMON: bool> {
    rays: &'a [Rays],
    sign: [bool; 3],
    frustum: Option<&'a Frustum>,
    /// Index of an active lane of the first packet.
    lead: usize,
}

impl<const COMMON: bool> Packets<'_, COMMON> {
    /// The bit set of the children that may be entered within `reach`. For closest hits also their entry distances: lower bounds for a
    /// frustum, otherwise those of the packet's leading lane.
    #[inline(always)]
    fn enter<const ANY: bool>(&self, node: &Node, limit: X8, active: M8, reach: f32) -> (u32, [f32; WIDTH]) {
        if let Some(frustum) = self.frustum {
            let (near, mask) = frustum.enter(node, reach);
            return (mask.bits(), if ANY { [0.0; WIDTH] } else { near.to_array() });
        }
        let mut bits = 0;
        let mut nearest = [0.0; WIDTH];
        for (slot, nearest) in nearest.iter_mut().enumerate().take(node.children as usize) {
            let (near, hit) = slabs::<COMMON>(node, slot, &self.rays[0], self.sign, limit);
            bits |= u32::from((hit & active).any()) << slot;
            if !ANY {
                *nearest = near.as_array()[self.lead];
            }
        }
        (bits, nearest)
    }
}

/// Finds the nearest hits of a group of packets, if nearer than those in `hits`. With `ANY`, clears the lanes of `active` that hit
/// something instead.
pub(super) fn packets<const ANY: bool>(
    tree: &View<'_, impl Primitives>,
    rays: &[Rays],
    active: &mut [M8],
    frustum: Option<&Frustum>,
    hits: &mut [Hits],
    stack: &mut Stack<Pending>,
) {
    if tree.count == 0 {
        return;
    }
    let lead = first_lane(active[0]);
    match common_sign(rays) {
        Some(sign) => {
            packets_with::<ANY, true>(tree, &Packets { rays, sign, frustum, lead }, active, hits, stack);
        }
        None => {
            let sign = [false; 3];
            packets_with::<ANY, false>(tree, &Packets { rays, sign, frustum, lead }, active, hits, stack);
        }
    }
}

fn packets_with<const ANY: bool, const COMMON: bool>(
    tree: &View<'_, impl Primitives>,
    packets: &Packets<'_, COMMON>,
    active: &mut [M8],
    hits: &mut [Hits],
    stack: &mut Stack<Pending>,
) {
    let stack = &mut stack.0[..];
    let mut height = 0;
    // the greatest remaining search distance of any ray
    let mut reach = farthest(hits, active);
    let mut changed = false;
    let mut place = 0_u32;
    loop {
        let node = &tree.nodes[place as usize];
        let (mut bits, near) = packets.enter::<ANY>(node, hits[0].distance, active[0], reach);
        // the nearest child goes to the top of the stack
        let floor = height;
        while bits != 0 {
            let slot = bits.trailing_zeros() as usize & 7;
            bits &= bits - 1;
            let inner = node.count[slot] == 0;
            if ANY && !inner {
                if visit_leaf::<ANY, COMMON>(tree, packets, node, slot, active, hits) && !any(active) {
                    return;
                }
                continue;
            }
            let (to, leaf) = if inner { (node.first[slot], INNER) } else { (place, slot as u32) };
            let child = Pending { node: to, slot: leaf, near: near[slot] };
            push_in_order(stack, &mut height, floor, child, |c| c.near);
        }
        place = loop {
            if height == 0 {
                return;
            }
            height -= 1;
            let Pending { node, slot, near } = stack[height];
            // a leaf tests the rays against its box anyway
            if slot == INNER && changed {
                (reach, changed) = (farthest(hits, active), false);
            }
            // without a frustum, `near` bounds only the leading lane
            if !ANY && packets.frustum.is_some() && near > reach {
                continue;
            }
            if slot == INNER {
                break node;
            }
            let node = &tree.nodes[node as usize];
            changed |= visit_leaf::<ANY, COMMON>(tree, packets, node, slot as usize & 7, active, hits);
        };
    }
}

/// Tests the rays that enter a leaf. Returns whether there are any; with `ANY`, whether a packet has no active rays any more.
#[inline(always)]
fn visit_leaf<const ANY: bool, const COMMON: bool>(
    tree: &View<'_, impl Primitives>,
    packets: &Packets<'_, COMMON>,
    node: &Node,
    slot: usize,
    active: &mut [M8],
    hits: &mut [Hits],
) -> bool {
    let leaf = node.leaf(slot);
    let mut changed = false;
    for ((rays, active), hits) in packets.rays.iter().zip(active).zip(hits) {
        let (near, entered) = slabs::<COMMON>(node, slot, rays, packets.sign, hits.distance);
        let entered = entered & *active;
        if entered.any() {
            let hidden = tree.primitives.test_packet::<ANY>(leaf.clone(), rays, near, entered, hits);
            *active = *active & !hidden;
            changed |= !ANY || !active.any();
        }
    }
    changed
}

/// The greatest remaining search distance of an active ray.
#[inline]
fn farthest(hits: &[Hits], active: &[M8]) -> f32 {
    let most = hits.iter().zip(active).fold(X8::lit(0.0), |m, (h, &a)| m.greater(h.distance.keep(a)));
    let [a, b, c, d, e, f, g, h] = most.to_array();
    greater(greater(greater(a, b), greater(c, d)), greater(greater(e, f), greater(g, h)))
}
