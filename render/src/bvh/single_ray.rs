//! Single-ray traversal: tests all children of a node at once, and all triangles of a leaf at once.

use super::node::{Node, Stack, prefetch, push_in_order};
use super::primitive::PrimitiveId;
use super::rays::{Hits, Nearest, Rays, by_octant};
use super::tree::View;
use crate::packet::{M8, V8, X8, each_bit};
use etendue::{Mask, Real, Vec3};
use std::ops::Range;

/// One ray of a packet, with the same numbers, so that its hits are the same, bit for bit.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct SingleRay {
    origin: [f32; 3],
    direction: [f32; 3],
    frame: [[f32; 3]; 2],
    inverse: [f32; 3],
    offset: [[f32; 3]; 2],
    /// Bit k is set if the ray runs towards − along axis k.
    octant: usize,
    /// The primitive on which the ray begins, or none.
    pub(super) from: PrimitiveId,
}

/// The same numbers in every lane.
#[inline(always)]
fn spread([x, y, z]: [f32; 3]) -> V8 {
    Vec3::new(X8::splat(x), X8::splat(y), X8::splat(z))
}

impl SingleRay {
    #[inline(always)]
    pub(super) fn new(rays: &Rays, lane: usize) -> Self {
        let of = |v: &V8| [&v.x, &v.y, &v.z].map(|x| x.as_array()[lane & 7]);
        let inverse = of(&rays.inverse);
        Self {
            origin: of(&rays.origin),
            direction: of(&rays.direction),
            frame: [of(&rays.frame[0]), of(&rays.frame[1])],
            inverse,
            offset: [of(&rays.offset[0]), of(&rays.offset[1])],
            octant: (0..3).fold(0, |octant, k| octant | usize::from(inverse[k] < 0.0) << k),
            from: rays.from.lane(lane & 7),
        }
    }
    #[inline(always)]
    pub(super) fn origin(&self) -> V8 {
        spread(self.origin)
    }
    #[inline(always)]
    pub(super) fn direction(&self) -> V8 {
        spread(self.direction)
    }
    #[inline(always)]
    pub(super) fn frame(&self) -> [V8; 2] {
        self.frame.map(spread)
    }

    /// Entry distances of the children's boxes, and the children entered before the limit. `OCTANT` is the ray's, or 8 to read it at run time.
    #[inline(always)]
    pub(super) fn enter<const OCTANT: usize>(&self, node: &Node, limit: X8) -> (X8, M8) {
        let octant = if OCTANT < 8 { OCTANT } else { self.octant };
        let plane = |last: usize, k: usize| {
            let side = (octant >> k & 1) ^ last;
            X8::from(node.planes[side][k]).mul_add(X8::splat(self.inverse[k]), X8::splat(self.offset[side][k]))
        };
        let near = plane(0, 0).greater(plane(0, 1)).greater(plane(0, 2).greater(X8::lit(0.0)));
        let far = plane(1, 0).lesser(plane(1, 1)).lesser(plane(1, 2).lesser(limit));
        (near, near.le(far))
    }
}

/// A child to visit, and the distance at which the ray enters it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Child {
    first: u32,
    /// Number of primitives of a leaf; 0 for an inner node.
    count: u32,
    near: f32,
}

/// Primitives that test one ray against a whole leaf at once.
pub(super) trait Leaves {
    /// Updates `nearest` by a nearer hit of one ray in a leaf, whose box it enters at `near`. With `ANY`, returns whether there is one
    /// instead.
    fn test_ray<const ANY: bool>(&self, leaf: Range<usize>, ray: &SingleRay, near: X8, nearest: &mut Nearest) -> bool;
    /// Asks for the memory of a leaf.
    fn prefetch(&self, leaf: Range<usize>);
}

/// Finds the nearest hits of all rays one by one, if nearer than those in `hits`. With `ANY`, clears the lanes of `active` that
/// hit something instead.
pub(super) fn one_by_one<const ANY: bool>(
    tree: &View<'_, impl Leaves>,
    rays: &[Rays],
    active: &mut [M8],
    hits: &mut [Hits],
    stack: &mut Stack<Child>,
) {
    for ((rays, active), hits) in rays.iter().zip(active).zip(hits) {
        let mut open = active.bits();
        each_bit(open, |lane| open &= !(u32::from(trace_lane::<ANY>(tree, 0, rays, lane, hits, stack)) << lane));
        *active = M8::from_bits(open);
    }
}

/// Traces one ray of a packet through the nodes below `from`. With `ANY`, returns whether it hits something, and leaves `hits` as
/// they are.
#[inline]
pub(super) fn trace_lane<const ANY: bool>(
    tree: &View<'_, impl Leaves>,
    from: u32,
    rays: &Rays,
    lane: usize,
    hits: &mut Hits,
    stack: &mut Stack<Child>,
) -> bool {
    if tree.count == 0 {
        return false;
    }
    let (ray, mut nearest) = (SingleRay::new(rays, lane), hits.nearest(lane));
    let hidden = by_octant!(ray.octant, else 7, single_ray::<ANY>(tree, from, &ray, &mut nearest, stack));
    if !ANY {
        hits.put(lane, &nearest);
    }
    hidden
}

/// Takes the lowest number out of a set of slots.
#[inline(always)]
fn take(slots: &mut u32) -> Option<usize> {
    let all = *slots;
    *slots &= all.wrapping_sub(1);
    (all != 0).then_some(all.trailing_zeros() as usize & 7)
}

fn single_ray<const ANY: bool, const OCTANT: usize>(
    tree: &View<'_, impl Leaves>,
    from: u32,
    ray: &SingleRay,
    nearest: &mut Nearest,
    stack: &mut Stack<Child>,
) -> bool {
    let stack = &mut stack.0[..];
    let fetch = |place: u32| prefetch(&tree.nodes[place as usize..=place as usize]);
    let (mut height, mut place) = (0, from);
    loop {
        let node = &tree.nodes[place as usize];
        let (near, mask) = ray.enter::<OCTANT>(node, X8::splat(nearest.distance));
        let near = near.to_array();
        let child = |slot: usize| {
            let child = Child { first: node.first[slot], count: u32::from(node.count[slot]), near: near[slot] };
            if !ANY && child.count == 0 {
                fetch(child.first);
            } else if !ANY {
                tree.primitives.prefetch(node.leaf(slot));
            }
            child
        };
        let mut entered = mask.bits();
        if ANY {
            let (mut leaves, mut inner) = (entered & !node.inner, entered & node.inner);
            while let Some(slot) = take(&mut leaves) {
                if test_leaf::<ANY>(tree, &child(slot), ray, nearest) {
                    return true;
                }
            }
            if let Some(slot) = take(&mut inner) {
                // the last child is visited next, without a way through the stack
                place = node.first[slot];
                while let Some(slot) = take(&mut inner) {
                    stack[height].first = place;
                    height += 1;
                    place = node.first[slot];
                    fetch(place);
                }
            } else if height == 0 {
                return false;
            } else {
                height -= 1;
                place = stack[height].first;
            }
            continue;
        }
        let mut next = if let Some(slot) = take(&mut entered) {
            // the nearest child is visited next; the others go to the stack, nearer ones on top
            let (mut next, floor) = (child(slot), height);
            while let Some(slot) = take(&mut entered) {
                let mut other = child(slot);
                if other.near < next.near {
                    (next, other) = (other, next);
                }
                push_in_order(stack, &mut height, floor, other, |c| c.near);
            }
            next
        } else if height == 0 {
            return false;
        } else {
            height -= 1;
            stack[height]
        };
        while next.count != 0 {
            test_leaf::<ANY>(tree, &next, ray, nearest);
            let Some(child) = pop_nearer(stack, &mut height, nearest.distance) else { return false };
            next = child;
        }
        place = next.first;
    }
}

/// Takes the first child from the stack that is no farther than a distance.
#[inline(always)]
fn pop_nearer(stack: &[Child], height: &mut usize, distance: f32) -> Option<Child> {
    while *height > 0 {
        *height -= 1;
        if stack[*height].near <= distance {
            return Some(stack[*height]);
        }
    }
    None
}

/// Tests one ray against a child that is a leaf, as [`Leaves::test_ray`]. A function of its own, so that the loop over nodes keeps its
/// numbers in registers.
#[inline(never)]
fn test_leaf<const ANY: bool>(
    tree: &View<'_, impl Leaves>,
    leaf: &Child,
    ray: &SingleRay,
    nearest: &mut Nearest,
) -> bool {
    let first = leaf.first as usize;
    tree.primitives.test_ray::<ANY>(first..first + leaf.count as usize, ray, X8::splat(leaf.near), nearest)
}
