//! Allocates the samples of pixels to a few lights, instead of choosing lights at random.
//!
//! The number of samples of a light depends on its possible contribution to the pixel's corners, or on the samples of neighbouring
//! pixels, never on the pixel's own samples: that keeps the estimate unbiased.

use etendue::select::{Allocation, FEW};
use std::borrow::Cow;

/// Greatest number of lights whose variances the adaptive sampler measures separately.
pub const APART: usize = 8;

/// The weights of the lights in the pixels of an area, row by row.
pub(super) struct Weights<'a> {
    pub(super) lights: usize,
    pub(super) of: Cow<'a, [f32]>,
    pub(super) area: [u32; 4],
    /// Samples per set that each light received in the first block of each pixel; empty if that block is not done.
    pub(super) begun: &'a [[u32; APART]],
}

impl Weights<'_> {
    fn index(&self, [x, y]: [u32; 2]) -> usize {
        let [x0, y0, x1, _] = self.area;
        ((y - y0) * (x1 - x0) + (x - x0)) as usize
    }
    /// Allocates a block of a pixel, and adds the allocated samples to `before`, the numbers before the block.
    fn allocate(&self, pixel: usize, size: u32, before: &mut [u32; FEW]) -> Allocation {
        Allocation::new(&self.of[pixel * self.lights..][..self.lights], size, before)
    }
}

/// The allocations of successive pixels. The samples of a set form blocks: one of `first` samples, then each as long as all before it.
pub(super) struct Blocks {
    first: u32,
    /// The last pixel and the first sample of the block that the last of the allocations belongs to.
    last: Option<([u32; 2], u32)>,
    allocations: Vec<Allocation>,
}

impl Blocks {
    pub(super) const fn new(first: u32) -> Self {
        Self { first, last: None, allocations: Vec::new() }
    }
    /// Forgets all allocations but the last.
    pub(super) fn forget(&mut self) {
        let most = self.allocations.len().saturating_sub(1);
        self.allocations.drain(..most);
    }
    /// The allocations that [`find`](Self::find) returns.
    pub(super) fn allocations(&self) -> &[Allocation] {
        &self.allocations
    }
    /// Index of the block of a set of a pixel that contains a sample, and the sample's index in the block.
    pub(super) fn find(&mut self, weights: &Weights<'_>, pixel: [u32; 2], sample: u32) -> (usize, u32) {
        let start = (sample / self.first).checked_ilog2().map_or(0, |doubled| self.first << doubled);
        if self.last != Some((pixel, start)) {
            self.allocations.push(self.allocate(weights, pixel, start));
            self.last = Some((pixel, start));
        }
        (self.allocations.len() - 1, sample - start)
    }
    fn allocate(&self, weights: &Weights<'_>, pixel: [u32; 2], start: u32) -> Allocation {
        let (mut from, mut before) = (0, Allocation::NONE);
        let index = weights.index(pixel);
        if let Some(begun) = weights.begun.get(index) {
            from = self.first;
            before[..weights.lights].copy_from_slice(&begun[..weights.lights]);
        }
        loop {
            let allocation = weights.allocate(index, from.max(self.first), &mut before);
            if from == start {
                return allocation;
            }
            from += from.max(self.first);
        }
    }
}
