//! Nodes of a tree, bounding boxes, and how packets of rays enter them.

use super::rays::Rays;
use crate::packet::{M8, X8};
use etendue::Real;
use std::ops::Range;

/// Greatest number of children of a node.
pub(super) const WIDTH: usize = 8;
/// Greatest accepted depth of a binary tree from obvhs.
pub(super) const DEPTH: usize = 96;
/// Stack size: each level of the tree leaves at most seven children on the stack.
pub(super) const STACK: usize = 7 * DEPTH + 8;

/// In the place of a slot: a child that is an inner node.
pub(super) const INNER: u32 = u32::MAX;

/// The stack of a traversal.
#[derive(Debug)]
pub(super) struct Stack<T>(pub(super) Box<[T; STACK]>);

impl<T: Copy + Default> Default for Stack<T> {
    fn default() -> Self {
        Self(Box::new([T::default(); STACK]))
    }
}

/// An inner node: the boxes of up to eight children, in structure-of-arrays layout.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Node {
    /// Lower and upper planes of each axis; an absent child has an empty box.
    pub(super) planes: [[[f32; WIDTH]; 3]; 2],
    /// For each child, the index of an inner node, or of a leaf's first primitive.
    pub(super) first: [u32; WIDTH],
    /// For each child, the number of primitives of a leaf, or 0 for an inner node.
    pub(super) count: [u8; WIDTH],
    /// Number of children.
    pub(super) children: u32,
    /// The set of children that are inner nodes.
    pub(super) inner: u32,
}

impl Default for Node {
    fn default() -> Self {
        Self {
            planes: [[[f32::INFINITY; WIDTH]; 3], [[f32::NEG_INFINITY; WIDTH]; 3]],
            first: [0; WIDTH],
            count: [0; WIDTH],
            children: 0,
            inner: 0,
        }
    }
}

impl Node {
    /// The primitives of a child that is a leaf.
    #[inline(always)]
    pub(super) fn leaf(&self, slot: usize) -> Range<usize> {
        let first = self.first[slot] as usize;
        first..first + usize::from(self.count[slot])
    }
    pub(super) fn push(&mut self, bounds: &Bounds, first: u32, count: usize) {
        let slot = self.children as usize;
        for (planes, bound) in self.planes.iter_mut().zip(bounds) {
            for (plane, coordinate) in planes.iter_mut().zip(bound) {
                plane[slot] = *coordinate;
            }
        }
        (self.first[slot], self.count[slot]) = (first, count as u8);
        self.inner |= u32::from(count == 0) << slot;
        self.children += 1;
    }
}

/// Asks for the memory of items that will be read soon.
#[inline(always)]
pub(super) fn prefetch<T>(items: &[T]) {
    #[cfg(target_arch = "x86_64")]
    for line in (0..size_of_val(items)).step_by(64) {
        use core::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: prefetching is only a hint, and the address is within `items`
        unsafe { _mm_prefetch::<_MM_HINT_T0>(items.as_ptr().cast::<i8>().add(line)) };
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = items;
}

/// Distances at which the rays enter a child's box, and the lanes that enter it before their limit.
#[inline(always)]
pub(super) fn slabs<const COMMON: bool>(node: &Node, slot: usize, rays: &Rays, sign: [bool; 3], limit: X8) -> (X8, M8) {
    let axis = |k: usize, inverse: X8, below: X8, above: X8| {
        let a = X8::splat(node.planes[0][k][slot]).mul_add(inverse, below);
        let b = X8::splat(node.planes[1][k][slot]).mul_add(inverse, above);
        if !COMMON {
            (a.lesser(b), a.greater(b))
        } else if sign[k] {
            (b, a)
        } else {
            (a, b)
        }
    };
    let (nx, fx) = axis(0, rays.inverse.x, rays.offset[0].x, rays.offset[1].x);
    let (ny, fy) = axis(1, rays.inverse.y, rays.offset[0].y, rays.offset[1].y);
    let (nz, fz) = axis(2, rays.inverse.z, rays.offset[0].z, rays.offset[1].z);
    let near = nx.greater(ny).greater(nz.greater(X8::lit(0.0)));
    let far = fx.lesser(fy).lesser(fz.lesser(limit));
    (near, near.le(far))
}

/// Least and greatest corner.
pub(super) type Bounds = [[f32; 3]; 2];

/// The empty box.
pub(super) const EMPTY: Bounds = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];

/// The lesser; `b` if either is NaN. (`f32::min` takes three times as long, to handle NaNs that do not occur here.)
#[inline(always)]
pub(super) fn lesser(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The greater; `b` if either is NaN.
#[inline(always)]
pub(super) fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

#[inline]
pub(super) fn union(a: Bounds, b: Bounds) -> Bounds {
    [std::array::from_fn(|k| lesser(a[0][k], b[0][k])), std::array::from_fn(|k| greater(a[1][k], b[1][k]))]
}

/// Items with a bounding box.
pub(super) trait Bounded: Copy + Send + Sync {
    fn bounds(&self) -> Bounds;
    /// The middle of the box along one axis.
    #[inline]
    fn middle(&self, axis: usize) -> f32 {
        let [low, high] = self.bounds();
        0.5 * low[axis] + 0.5 * high[axis]
    }
}

impl Bounded for Bounds {
    #[inline]
    fn bounds(&self) -> Bounds {
        *self
    }
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

/// Why a tree could not be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuildError {
    /// Number of primitives or lights.
    pub count: usize,
    /// The greatest number.
    pub most: usize,
}

impl std::fmt::Display for BuildError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} primitives or lights: a tree can index at most {}", self.count, self.most)
    }
}

impl std::error::Error for BuildError {}
