//! Rays that are alone, several at a time: they take turns of one step, and what the next step of each reads is fetched meanwhile.

use super::node::{STACK, prefetch, push_in_order};
use super::rays::{GROUP, Hits, Nearest, Rays};
use super::single_ray::{Leaves, SingleRay};
use super::tree::View;
use crate::packet::{X8, each_bit};
use etendue::Mask;
use std::ops::Range;

/// Number of rays that take turns.
const TOGETHER: usize = 16;
/// Greatest number of subtrees that wait for one ray.
const MOST: usize = 24;

/// A child to visit.
#[derive(Clone, Copy, Debug, Default)]
struct Child {
    /// The index of an inner node or of a leaf's first primitive, and 2³² times the number of a leaf's primitives: one number, as processors
    /// pass a store on only to a load that is no larger.
    what: u64,
    near: f32,
}

impl Child {
    #[inline(always)]
    fn is_inner(&self) -> bool {
        self.what >> 32 == 0
    }
    #[inline(always)]
    fn first(&self) -> usize {
        self.what as u32 as usize
    }
    #[inline(always)]
    fn leaf(&self) -> Range<usize> {
        self.first()..self.first() + (self.what >> 32) as usize
    }
}

/// The subtrees in which rays of a group are alone.
#[derive(Debug)]
pub(super) struct Later {
    children: Box<[[Child; MOST]; 8 * GROUP]>,
    count: [u8; 8 * GROUP],
    /// The set of rays for which some wait.
    rays: u64,
}

impl Default for Later {
    fn default() -> Self {
        Self { children: Box::new([[Child::default(); MOST]; 8 * GROUP]), count: [0; 8 * GROUP], rays: 0 }
    }
}

impl Later {
    /// Adds the subtree below a node for each of `rays`, none of which enters it before `near`. Returns the rays that have no room for it.
    #[inline]
    pub(super) fn add(&mut self, rays: u64, node: u32, near: f32) -> u64 {
        let mut full = 0;
        each_bit(rays, |i| {
            let count = &mut self.count[i];
            match self.children[i].get_mut(usize::from(*count)) {
                Some(child) => {
                    *child = Child { what: node.into(), near };
                    *count += 1;
                }
                None => full |= 1 << i,
            }
        });
        self.rays |= rays;
        full
    }
    /// Forgets what waits for other rays than these.
    fn keep(&mut self, rays: u64) {
        each_bit(self.rays & !rays, |i| self.count[i] = 0);
        self.rays &= rays;
    }
    fn next(&self) -> Option<usize> {
        (self.rays != 0).then_some(self.rays.trailing_zeros() as usize & 63)
    }
    fn take(&mut self, ray: usize) -> &[Child] {
        self.rays &= !(1 << ray);
        &self.children[ray][..usize::from(std::mem::take(&mut self.count[ray]))]
    }
}

/// The state of one ray.
#[derive(Clone, Debug)]
struct Walk {
    ray: SingleRay,
    /// The nearest hit so far, or the limit.
    nearest: Nearest,
    /// Index of the ray in the group: 8·packet + lane.
    index: usize,
    /// What the next step visits.
    next: Child,
    height: usize,
    stack: Box<[Child; STACK + MOST]>,
}

impl Default for Walk {
    fn default() -> Self {
        Self {
            ray: SingleRay::default(),
            nearest: Nearest::default(),
            index: 0,
            next: Child::default(),
            height: 0,
            stack: Box::new([Child::default(); STACK + MOST]),
        }
    }
}

/// Memory for rays that take turns, to be reused.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    walks: [Walk; TOGETHER],
    pub(super) later: Later,
}

/// What became of a ray in one step.
#[derive(Clone, Copy, PartialEq)]
enum Step {
    On,
    Hidden,
    Over,
}

impl Walk {
    fn start(&mut self, index: usize, rays: &[Rays], hits: &[Hits], later: &mut Later) {
        let (p, lane) = (index >> 3, index & 7);
        self.ray = SingleRay::new(&rays[p], lane);
        (self.index, self.nearest, self.height) = (index, hits[p].nearest(lane), 0);
        for &child in later.take(index) {
            push_in_order(&mut self.stack[..], &mut self.height, 0, child, |c| c.near);
        }
        self.height -= 1;
        self.next = self.stack[self.height];
    }
    /// Visits one node or leaf, and fetches what comes next.
    #[inline(always)]
    fn step<const ANY: bool>(&mut self, tree: &View<'_, impl Leaves>) -> Step {
        let Self { ray, nearest, next, height, stack, .. } = self;
        if next.is_inner() {
            let node = &tree.nodes[next.first()];
            let (near, mask) = ray.enter::<8>(node, X8::splat(nearest.distance));
            let near = near.to_array();
            let mut bits = mask.bits();
            let mut take = || {
                let slot = bits.trailing_zeros() as usize & 7;
                let some = bits != 0;
                bits &= bits.wrapping_sub(1);
                let what = u64::from(node.count[slot]) << 32 | u64::from(node.first[slot]);
                some.then_some(Child { what, near: near[slot] })
            };
            if ANY {
                while let Some(child) = take() {
                    stack[*height] = child;
                    *height += 1;
                }
            } else if let Some(mut nearer) = take() {
                let floor = *height;
                while let Some(mut other) = take() {
                    if other.near < nearer.near {
                        (nearer, other) = (other, nearer);
                    }
                    push_in_order(&mut stack[..], height, floor, other, |c| c.near);
                }
                *next = nearer;
                self.fetch(tree);
                return Step::On;
            }
        } else if tree.primitives.test_ray::<ANY>(next.leaf(), ray, X8::splat(next.near), nearest) {
            return Step::Hidden;
        }
        loop {
            if *height == 0 {
                return Step::Over;
            }
            *height -= 1;
            *next = stack[*height];
            if ANY || next.near <= nearest.distance {
                break;
            }
        }
        self.fetch(tree);
        Step::On
    }
    #[inline(always)]
    fn fetch(&self, tree: &View<'_, impl Leaves>) {
        if self.next.is_inner() {
            prefetch(&tree.nodes[self.next.first()..=self.next.first()]);
        } else {
            tree.primitives.prefetch(self.next.leaf());
        }
    }
}

/// Finds the nearest hits of the rays among `open` in the subtrees that wait for them, if nearer than those in `hits`. With `ANY`, returns
/// the rays that hit something instead. No subtree waits any more.
#[inline(never)]
pub(super) fn interleaved<const ANY: bool>(
    tree: &View<'_, impl Leaves>,
    rays: &[Rays],
    open: u64,
    hits: &mut [Hits],
    scratch: &mut Scratch,
) -> u64 {
    let Scratch { walks, later } = scratch;
    later.keep(open);
    let (mut going, mut hidden) = (0_u32, 0);
    for (k, walk) in walks.iter_mut().enumerate() {
        if let Some(index) = later.next() {
            walk.start(index, rays, hits, later);
            going |= 1 << k;
        }
    }
    while going != 0 {
        each_bit(going, |k| {
            let walk = &mut walks[k % TOGETHER];
            let step = walk.step::<ANY>(tree);
            if step == Step::On {
                return;
            }
            hidden |= u64::from(step == Step::Hidden) << walk.index;
            if !ANY {
                hits[walk.index >> 3].put(walk.index & 7, &walk.nearest);
            }
            if let Some(index) = later.next() {
                walk.start(index, rays, hits, later);
            } else {
                going &= !(1 << k);
            }
        });
    }
    hidden
}

#[cfg(test)]
mod tests {
    use super::{Later, MOST};

    /// A ray without room is returned, the others wait; rays that are forgotten or taken have room again.
    #[test]
    fn subtrees_wait_while_there_is_room() {
        let mut later = Later::default();
        for node in 0..MOST as u32 {
            assert_eq!(later.add(0b10, node, 0.5), 0);
        }
        assert_eq!(later.add(0b11, 99, 0.5), 0b10);
        assert_eq!(later.next(), Some(0));
        assert_eq!(later.take(0).iter().map(|child| child.first()).collect::<Vec<_>>(), [99]);
        assert_eq!(later.next(), Some(1));
        assert_eq!(later.take(1).iter().map(|child| child.first()).collect::<Vec<_>>(), Vec::from_iter(0..MOST));
        assert_eq!(later.next(), None);
        assert_eq!(later.add(0b11, 7, 0.5), 0);
        later.keep(0b01);
        assert_eq!(later.next(), Some(0));
        assert!(later.take(1).is_empty());
        assert_eq!(later.take(0).len(), 1);
    }
}
