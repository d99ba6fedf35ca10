//! Interleaves incoherent rays to hide memory latency: each ray takes one step in turn, and prefetches what its next step will visit.

use super::node::{Node, STACK, prefetch, push_in_order};
use super::rays::{Hits, Nearest, Rays, each_bit};
use super::single_ray::{Child, Leaves, SingleRay};
use super::tree::Tree;
use crate::packet::X8;
use etendue::Mask;

/// Number of interleaved rays.
const TOGETHER: usize = 8;

/// Greatest number of pending children of one ray in [`Later`].
const MOST: usize = 24;

/// The traversal state of one ray.
#[derive(Clone, Debug)]
struct Walk {
    ray: SingleRay,
    /// The nearest hit so far, or the limit.
    nearest: Nearest,
    /// Index of the ray in the group: 8·packet + lane.
    index: usize,
    height: usize,
    stack: Box<[Child; STACK + MOST]>,
}

impl Default for Walk {
    fn default() -> Self {
        Self {
            ray: SingleRay::default(),
            nearest: Nearest::default(),
            index: 0,
            height: 0,
            stack: Box::new([Child::default(); STACK + MOST]),
        }
    }
}

impl Walk {
    fn start(&mut self, index: usize, rays: &[Rays], hits: &[Hits], later: &mut Later) {
        let (p, lane) = (index >> 3, index & 7);
        self.ray = SingleRay::new(&rays[p], lane);
        (self.index, self.nearest, self.height) = (index, hits[p].nearest(lane), 0);
        for &child in later.take(index) {
            push_in_order(&mut self.stack[..], &mut self.height, 0, child, |c| c.near);
        }
    }
}

/// The nodes from which each ray of a group continues on its own.
#[derive(Debug)]
pub(super) struct Later {
    children: Box<[[Child; MOST]; 64]>,
    count: [u8; 64],
    /// Bit set of the rays with pending nodes.
    rays: u64,
}

impl Default for Later {
    fn default() -> Self {
        Self { children: Box::new([[Child::default(); MOST]; 64]), count: [0; 64], rays: 0 }
    }
}

impl Later {
    /// Adds an inner node for each of `rays`; `near` is a lower bound of their entry distances. Returns false and adds nothing if a ray
    /// has no room.
    #[inline]
    pub(super) fn add(&mut self, rays: u64, node: u32, near: f32) -> bool {
        let mut room = true;
        each_bit(rays, |i| room &= usize::from(self.count[i]) < MOST);
        if room {
            each_bit(rays, |i| {
                self.children[i][usize::from(self.count[i])] = Child { first: node, count: 0, near };
                self.count[i] += 1;
            });
            self.rays |= rays;
        }
        room
    }
    /// Removes all rays except `rays`.
    fn keep(&mut self, rays: u64) {
        each_bit(self.rays & !rays, |i| self.count[i] = 0);
        self.rays &= rays;
    }
    fn next(&self) -> Option<usize> {
        (self.rays != 0).then_some(self.rays.trailing_zeros() as usize & 63)
    }
    fn take(&mut self, index: usize) -> &[Child] {
        self.rays &= !(1 << index);
        &self.children[index][..usize::from(std::mem::take(&mut self.count[index]))]
    }
}

/// Memory for interleaved rays, to be reused.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    walks: [Walk; TOGETHER],
    pub(super) later: Later,
}

/// The result of one step.
enum Step {
    On,
    Hidden,
    Over,
}

impl<P: Leaves> Tree<P> {
    /// A child of a node, which is prefetched.
    #[inline(always)]
    fn child(&self, node: &Node, near: &[f32; 8], slot: usize) -> Child {
        let (first, count) = (node.first[slot], u32::from(node.count[slot]));
        if count == 0 {
            prefetch(&self.nodes[first as usize..=first as usize]);
        } else {
            self.primitives.prefetch(first as usize..(first + count) as usize);
        }
        Child { first, count, near: near[slot] }
    }

    /// Visits one node or leaf. `ANY` means any-hit, otherwise closest-hit.
    #[inline(always)]
    fn step<const ANY: bool>(&self, walk: &mut Walk) -> Step {
        let Walk { ray, nearest, height, stack, .. } = walk;
        let child = loop {
            if *height == 0 {
                return Step::Over;
            }
            *height -= 1;
            let child = stack[*height];
            if ANY || child.near <= nearest.distance {
                break child;
            }
        };
        if child.count != 0 {
            return if self.test_child::<ANY>(&child, ray, nearest) { Step::Hidden } else { Step::On };
        }
        let node = &self.nodes[child.first as usize];
        let (near, mask) = ray.enter::<8>(node, X8::splat(nearest.distance));
        let near = near.to_array();
        let floor = *height;
        each_bit(mask.bits(), |slot| {
            let child = self.child(node, &near, slot);
            if ANY {
                stack[*height] = child;
                *height += 1;
            } else {
                push_in_order(&mut stack[..], height, floor, child, |c| c.near);
            }
        });
        Step::On
    }

    /// Finds the nearest hits of the pending rays, if nearer than those in `hits`. With `ANY`, returns the rays among `open` that hit
    /// something instead.
    pub(super) fn interleaved<const ANY: bool>(
        &self,
        rays: &[Rays],
        open: u64,
        hits: &mut [Hits],
        scratch: &mut Scratch,
    ) -> u64 {
        let Scratch { walks, later } = scratch;
        later.keep(open);
        let mut order: [usize; TOGETHER] = std::array::from_fn(|i| i);
        let (mut going, mut hidden) = (0, 0);
        while let Some(index) = later.next().filter(|_| going < TOGETHER) {
            walks[going].start(index, rays, hits, later);
            going += 1;
        }
        while going > 0 {
            let mut place = 0;
            while place < going {
                let walk = &mut walks[order[place] % TOGETHER];
                let step = self.step::<ANY>(walk);
                if let Step::On = step {
                    place += 1;
                    continue;
                }
                hidden |= u64::from(matches!(step, Step::Hidden)) << walk.index;
                if !ANY {
                    hits[walk.index >> 3].put(walk.index & 7, &walk.nearest);
                }
                if let Some(index) = later.next() {
                    walk.start(index, rays, hits, later);
                } else {
                    going -= 1;
                    order.swap(place, going);
                }
            }
        }
        hidden
    }
}

#[cfg(test)]
mod tests {
    use super::{Later, MOST};

    /// If one ray has no room, no ray is changed; rays that are removed or taken have room again.
    #[test]
    fn later_is_all_or_nothing() {
        let mut later = Later::default();
        for node in 0..MOST as u32 {
            assert!(later.add(0b10, node, 0.5));
        }
        assert!(!later.add(0b11, 99, 0.5));
        assert_eq!(later.rays, 0b10);
        assert_eq!(later.next(), Some(1));
        let nodes: Vec<u32> = later.take(1).iter().map(|child| child.first).collect();
        assert_eq!(nodes, (0..MOST as u32).collect::<Vec<_>>());
        assert_eq!(later.next(), None);
        assert!(later.add(0b11, 7, 0.5));
        later.keep(0b01);
        assert!(later.take(1).is_empty());
        assert_eq!(later.take(0).len(), 1);
    }
}
