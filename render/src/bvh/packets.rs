//! Packet traversal: a group moves through the tree as one frustum, or a packet on its own.

use super::interleaved::{Later, TOGETHER, Walk};
use super::stream::Visit;
use super::tree::{DEPTH, Node, Primitives, Tree};
use super::{Frustum, Hits, Rays, WIDTH};
use crate::packet::{M8, X8, max, min};
use etendue::{Mask, Real, u32x8};

/// Stack size: each level of the tree leaves at most seven children on the stack.
pub(super) const STACK: usize = 7 * DEPTH + 8;

/// Distances at which the rays enter a child's box, and the lanes that enter it before their limit.
#[inline(always)]
pub(super) fn slabs<const COMMON: bool>(node: &Node, slot: usize, rays: &Rays, sign: [bool; 3], limit: X8) -> (X8, M8) {
    let axis = |k: usize, inverse: X8, below: X8, above: X8| {
        let a = X8::splat(node.planes[0][k][slot]).mul_add(inverse, below);
        let b = X8::splat(node.planes[1][k][slot]).mul_add(inverse, above);
        if !COMMON {
            (min(a, b), max(a, b))
        } else if sign[k] {
            (b, a)
        } else {
            (a, b)
        }
    };
    let (nx, fx) = axis(0, rays.inverse.x, rays.offset[0].x, rays.offset[1].x);
    let (ny, fy) = axis(1, rays.inverse.y, rays.offset[0].y, rays.offset[1].y);
    let (nz, fz) = axis(2, rays.inverse.z, rays.offset[0].z, rays.offset[1].z);
    let near = max(max(nx, ny), max(nz, X8::lit(0.0)));
    let far = min(min(fx, fy), min(fz, limit));
    (near, near.le(far))
}

/// Scratch memory for traversals, to be reused.
#[derive(Debug)]
pub struct Scratch {
    pub(super) pending: Box<[Pending; STACK]>,
    pub(super) visits: Box<[Visit; STACK]>,
    pub(super) walks: [Walk; TOGETHER],
    pub(super) later: Later,
}

impl Default for Scratch {
    fn default() -> Self {
        Self {
            pending: Box::new([Pending::default(); STACK]),
            visits: Box::new([Visit::default(); STACK]),
            walks: Default::default(),
            later: Later::default(),
        }
    }
}

/// A child to visit.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pending {
    /// Index of the parent node. (For occlusion, index of the node itself.)
    pub(super) parent: u32,
    /// Slot of the child in its parent.
    pub(super) slot: u32,
    /// Lower bound of the entry distance.
    pub(super) near: f32,
}

/// Inserts `child` into a stack of this `height`, below the nearer items above `floor`.
#[inline(always)]
pub(super) fn push_in_order<T: Copy>(
    stack: &mut [T],
    height: &mut usize,
    floor: usize,
    child: T,
    near: impl Fn(&T) -> f32,
) {
    let mut at = *height;
    while at > floor && near(&stack[at - 1]) < near(&child) {
        stack[at] = stack[at - 1];
        at -= 1;
    }
    stack[at] = child;
    *height += 1;
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
    /// The bit set of the children that may be entered within `reach`, and with `ORDER` their entry distances: lower bounds for a
    /// frustum, otherwise those of the packet's leading lane.
    #[inline(always)]
    fn enter<const ORDER: bool>(&self, node: &Node, limit: X8, active: M8, reach: f32) -> (u32, [f32; WIDTH]) {
        if let Some(frustum) = self.frustum {
            let (near, mask) = frustum.enter(node, reach);
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

    /// The entry distances of a packet into a leaf, and the lanes that enter it.
    #[inline(always)]
    fn lanes(&self, node: &Node, slot: usize, p: usize, limit: X8, active: M8) -> (X8, M8) {
        let (near, entered) = slabs::<COMMON>(node, slot, &self.rays[p], self.sign, limit);
        (near, entered & active)
    }
}

/// Calls `f` with the index of each set bit.
#[inline(always)]
pub(super) fn each_bit(mut bits: u32, mut f: impl FnMut(usize)) {
    while bits != 0 {
        f(bits.trailing_zeros() as usize);
        bits &= bits - 1;
    }
}

impl<P: Primitives> Tree<P> {
    /// Size of nodes and primitives in bytes.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + self.primitives.bytes()
    }

    /// Finds the nearest hits of a group of packets, if nearer than those in `hits`.
    pub(super) fn closest(
        &self,
        rays: &[Rays],
        active: &[M8],
        frustum: Option<&Frustum>,
        hits: &mut [Hits],
        scratch: &mut Scratch,
    ) {
        if self.count == 0 {
            return;
        }
        let lead = active[0].bits().trailing_zeros() as usize & 7;
        match common_sign(rays) {
            Some(sign) => self.closest_with(&Packets::<true> { rays, sign, frustum, lead }, active, hits, scratch),
            None => {
                self.closest_with(&Packets::<false> { rays, sign: [false; 3], frustum, lead }, active, hits, scratch)
            }
        }
    }

    fn closest_with<const COMMON: bool>(
        &self,
        packets: &Packets<'_, COMMON>,
        active: &[M8],
        hits: &mut [Hits],
        scratch: &mut Scratch,
    ) {
        let stack = &mut *scratch.pending;
        let mut height = 0;
        // the greatest remaining search distance of any ray
        let mut reach = farthest(hits, active);
        let mut place = 0_usize;
        loop {
            let node = &self.nodes[place];
            let (bits, near) = packets.enter::<true>(node, hits[0].distance, active[0], reach);
            // the nearest child goes to the top of the stack
            let floor = height;
            each_bit(bits, |slot| {
                let child = Pending { parent: place as u32, slot: slot as u32, near: near[slot] };
                push_in_order(&mut stack[..], &mut height, floor, child, |c| c.near);
            });
            place = loop {
                if height == 0 {
                    return;
                }
                height -= 1;
                let Pending { parent, slot, near } = stack[height];
                // without a frustum, `near` bounds only the leading lane, and leaves are tested again below
                if packets.frustum.is_some() && near > reach {
                    continue;
                }
                let (node, slot) = (&self.nodes[parent as usize], slot as usize);
                let (first, count) = (node.first[slot] as usize, usize::from(node.count[slot]));
                if count == 0 {
                    break first;
                }
                let mut visited = false;
                for (p, rays) in packets.rays.iter().enumerate() {
                    let (near, entered) = packets.lanes(node, slot, p, hits[p].distance, active[p]);
                    if entered.any() {
                        self.primitives.closest(first..first + count, rays, near, entered, &mut hits[p]);
                        visited = true;
                    }
                }
                if visited {
                    reach = farthest(hits, active);
                }
            };
        }
    }

    /// Clears the lanes of `active` that something other than `skip` occludes before `limit`.
    pub(super) fn occluded(
        &self,
        rays: &[Rays],
        active: &mut [M8],
        limit: &[X8],
        skip: &[u32x8],
        frustum: Option<&Frustum>,
        scratch: &mut Scratch,
    ) {
        if self.count == 0 {
            return;
        }
        let lead = active[0].bits().trailing_zeros() as usize & 7;
        match common_sign(rays) {
            Some(sign) => {
                self.occluded_with(&Packets::<true> { rays, sign, frustum, lead }, active, limit, skip, scratch)
            }
            None => {
                self.occluded_with(
                    &Packets::<false> { rays, sign: [false; 3], frustum, lead },
                    active,
                    limit,
                    skip,
                    scratch,
                );
            }
        }
    }

    fn occluded_with<const COMMON: bool>(
        &self,
        packets: &Packets<'_, COMMON>,
        active: &mut [M8],
        limit: &[X8],
        skip: &[u32x8],
        scratch: &mut Scratch,
    ) {
        let stack = &mut *scratch.pending;
        let reach = limit.iter().zip(&*active).fold(X8::lit(0.0), |m, (&l, &a)| max(m, l.keep(a)));
        let reach = reach.to_array().into_iter().fold(0.0, f32::max);
        let mut height = 0;
        let mut place = 0_u32;
        loop {
            let node = &self.nodes[place as usize];
            let (mut bits, _) = packets.enter::<false>(node, limit[0], active[0], reach);
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
                for (p, rays) in packets.rays.iter().enumerate() {
                    let (near, entered) = packets.lanes(node, slot, p, limit[p], active[p]);
                    if entered.any() {
                        let hidden = self.primitives.occluded(range.clone(), rays, near, entered, limit[p], skip[p]);
                        active[p] = active[p] & !hidden;
                        closed |= !active[p].any();
                    }
                }
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

/// The greatest remaining search distance of an active ray.
#[inline]
fn farthest(hits: &[Hits], active: &[M8]) -> f32 {
    let most = hits.iter().zip(active).fold(X8::lit(0.0), |m, (h, &a)| max(m, h.distance.keep(a)));
    most.to_array().into_iter().fold(0.0, f32::max)
}

/// The signs of direction that all rays of a group share, if they do.
#[inline]
pub(super) fn common_sign(rays: &[Rays]) -> Option<[bool; 3]> {
    let sign = rays[0].common_sign?;
    rays[1..].iter().all(|r| r.common_sign == Some(sign)).then_some(sign)
}
