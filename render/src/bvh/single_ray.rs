//! Single-ray traversal: tests all children of a node at once, and all triangles of a leaf at once.

use super::node::{Node, Stack, push_in_order};
use super::rays::{Hits, Nearest, Rays, by_octant, each_bit};
use super::tree::Tree;
use crate::packet::{M8, V8, X8, max, min};
use etendue::{Mask, Real, Vec3};
use std::ops::Range;

/// One ray of a packet, in every lane, with the same numbers as in the packet, so that its hits are the same, bit for bit.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct SingleRay {
    pub(super) origin: V8,
    pub(super) direction: V8,
    pub(super) frame: [V8; 2],
    pub(super) inverse: V8,
    pub(super) offset: [V8; 2],
    /// Bit k is set if the ray runs towards − along axis k.
    octant: usize,
}

impl SingleRay {
    #[inline(always)]
    pub(super) fn new(rays: &Rays, lane: usize) -> Self {
        let spread = |v: &V8| {
            let at = |x: &X8| X8::splat(x.as_array()[lane & 7]);
            Vec3::new(at(&v.x), at(&v.y), at(&v.z))
        };
        let d = rays.inverse;
        let negative = [d.x, d.y, d.z].map(|x| x.as_array()[lane & 7] < 0.0);
        Self {
            origin: spread(&rays.origin),
            direction: spread(&rays.direction),
            frame: [spread(&rays.frame[0]), spread(&rays.frame[1])],
            inverse: spread(&rays.inverse),
            offset: [spread(&rays.offset[0]), spread(&rays.offset[1])],
            octant: (0..3).fold(0, |octant, k| octant | usize::from(negative[k]) << k),
        }
    }

    /// Entry distances of the children's boxes, and the children entered before the limit. The ray's octant is `OCTANT`, or 8 to
    /// read it at run time.
    #[inline(always)]
    pub(super) fn enter<const OCTANT: usize>(&self, node: &Node, limit: X8) -> (X8, M8) {
        let octant = if OCTANT < 8 { OCTANT } else { self.octant };
        let side = |last: bool, k: usize| usize::from((octant >> k & 1 == 1) != last);
        let plane = |last: bool, k: usize, inverse: X8| {
            let Vec3 { x, y, z } = self.offset[side(last, k)];
            X8::from(node.planes[side(last, k)][k]).mul_add(inverse, [x, y, z][k])
        };
        let Vec3 { x, y, z } = self.inverse;
        let near = max(max(plane(false, 0, x), plane(false, 1, y)), max(plane(false, 2, z), X8::lit(0.0)));
        let far = min(min(plane(true, 0, x), plane(true, 1, y)), min(plane(true, 2, z), limit));
        (near, near.le(far))
    }
}

/// A child to visit, and the distance at which the ray enters it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Child {
    pub(super) first: u32,
    /// Number of primitives of a leaf; 0 for an inner node.
    pub(super) count: u32,
    pub(super) near: f32,
}

/// Primitives that test one ray against a whole leaf at once.
pub(super) trait Leaves {
    /// Updates `nearest` by a nearer hit of one ray in a leaf, whose box it enters at `near`.
    fn closest_of_leaf(&self, leaf: Range<usize>, ray: &SingleRay, near: X8, nearest: &mut Nearest);
    /// Prefetches a leaf.
    fn prefetch(&self, leaf: Range<usize>);
    /// Whether a primitive of a leaf occludes one ray before `limit`.
    fn leaf_hides(&self, leaf: Range<usize>, ray: &SingleRay, near: X8, limit: f32) -> bool;
}

impl<P: Leaves> Tree<P> {
    /// Finds the nearest hits of all rays one by one, if nearer than those in `hits`.
    pub(super) fn closest_one_by_one(&self, rays: &[Rays], active: &[M8], hits: &mut [Hits], stack: &mut Stack<Child>) {
        for ((rays, active), hits) in rays.iter().zip(active).zip(hits) {
            each_bit(active.bits(), |lane| {
                let mut nearest = hits.nearest(lane);
                self.closest_single(0, &SingleRay::new(rays, lane), &mut nearest, stack);
                hits.put(lane, &nearest);
            });
        }
    }

    /// Clears the lanes of `active` that are occluded before `limit`, one by one.
    pub(super) fn occluded_one_by_one(&self, rays: &[Rays], active: &mut [M8], limit: &[X8], stack: &mut Stack<Child>) {
        for ((rays, active), limit) in rays.iter().zip(active).zip(limit) {
            let mut open = active.bits();
            each_bit(open, |lane| {
                let hidden = self.hides_single(0, &SingleRay::new(rays, lane), limit.as_array()[lane], stack);
                open &= !(u32::from(hidden) << lane);
            });
            *active = M8::from_bits(open);
        }
    }

    /// Finds the nearest hit of one ray below a node, if nearer than `nearest`.
    #[inline]
    pub(super) fn closest_single(&self, from: u32, ray: &SingleRay, nearest: &mut Nearest, stack: &mut Stack<Child>) {
        if self.count != 0 {
            by_octant!(ray.octant, else 7, self.closest_in_octant(from as usize, ray, nearest, stack));
        }
    }

    fn closest_in_octant<const OCTANT: usize>(
        &self,
        from: usize,
        ray: &SingleRay,
        nearest: &mut Nearest,
        stack: &mut Stack<Child>,
    ) {
        let stack = &mut *stack.0;
        let mut height = 0;
        let mut place = from;
        loop {
            let node = &self.nodes[place];
            let (near, mask) = ray.enter::<OCTANT>(node, X8::splat(nearest.distance));
            let near = near.to_array();
            let child =
                |slot: usize| Child { first: node.first[slot], count: u32::from(node.count[slot]), near: near[slot] };
            let mut bits = mask.bits();
            if bits != 0 {
                let mut next = child(bits.trailing_zeros() as usize & 7);
                bits &= bits - 1;
                // the nearest child is visited next; the others go to the stack, nearer ones on top
                let floor = height;
                while bits != 0 {
                    let mut other = child(bits.trailing_zeros() as usize & 7);
                    bits &= bits - 1;
                    if other.near < next.near {
                        (next, other) = (other, next);
                    }
                    push_in_order(&mut stack[..], &mut height, floor, other, |c| c.near);
                }
                if next.count == 0 {
                    place = next.first as usize;
                    continue;
                }
                let first = next.first as usize;
                self.primitives.closest_of_leaf(first..first + next.count as usize, ray, X8::splat(next.near), nearest);
            }
            place = loop {
                if height == 0 {
                    return;
                }
                height -= 1;
                let Child { first, count, near } = stack[height];
                if near > nearest.distance {
                    continue;
                }
                let first = first as usize;
                if count == 0 {
                    break first;
                }
                self.primitives.closest_of_leaf(first..first + count as usize, ray, X8::splat(near), nearest);
            };
        }
    }

    /// Whether something below a node occludes one ray before `limit`.
    #[inline]
    pub(super) fn hides_single(&self, from: u32, ray: &SingleRay, limit: f32, stack: &mut Stack<Child>) -> bool {
        self.count != 0 && by_octant!(ray.octant, else 7, self.hides_in_octant(from, ray, limit, stack))
    }

    fn hides_in_octant<const OCTANT: usize>(
        &self,
        from: u32,
        ray: &SingleRay,
        limit: f32,
        stack: &mut Stack<Child>,
    ) -> bool {
        let stack = &mut *stack.0;
        let mut height = 0;
        let mut place = from;
        let reach = X8::splat(limit);
        loop {
            let node = &self.nodes[place as usize];
            let (near, mask) = ray.enter::<OCTANT>(node, reach);
            let mut bits = mask.bits();
            while bits != 0 {
                let slot = bits.trailing_zeros() as usize & 7;
                bits &= bits - 1;
                let (first, count) = (node.first[slot], usize::from(node.count[slot]));
                if count == 0 {
                    stack[height].first = first;
                    height += 1;
                    continue;
                }
                let near = X8::splat(near.as_array()[slot]);
                if self.primitives.leaf_hides(first as usize..first as usize + count, ray, near, limit) {
                    return true;
                }
            }
            if height == 0 {
                return false;
            }
            height -= 1;
            place = stack[height].first;
        }
    }
}
