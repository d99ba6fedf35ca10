//! Allocates the samples of pixels to a few lights, instead of choosing lights at random.
//!
//! The number of samples of a light depends on its possible contribution to the pixel's corners, or on the samples of neighbouring
//! pixels, never on the pixel's own samples: that keeps the estimate unbiased.

use crate::choose::allocation::{Allocation, FEW};
use crate::scene::area::Area;
use std::borrow::Cow;

/// Greatest number of lights whose variances the adaptive sampler measures separately.
pub(super) const APART: usize = 8;

/// The weights of the lights in the pixels of an area, row by row.
pub(super) struct LightWeights<'a> {
    pub(super) lights: usize,
    pub(super) of: Cow<'a, [f32]>,
    pub(super) area: Area,
    /// Samples per set that each light received in the first block of each pixel; empty if that block is not done.
    pub(super) begun: &'a [[u32; APART]],
}

impl LightWeights<'_> {
    fn index(&self, [x, y]: [u32; 2]) -> usize {
        let [x0, y0, x1, _] = self.area;
        ((y - y0) * (x1 - x0) + (x - x0)) as usize
    }
    /// The same weights for sets of which no block is done.
    pub(super) fn anew(&self) -> LightWeights<'_> {
        LightWeights { lights: self.lights, of: Cow::Borrowed(&self.of), area: self.area, begun: &[] }
    }
    /// A bit for each light that has some weight in a pixel.
    pub(super) fn expected(&self, pixel: [u32; 2]) -> u32 {
        let of = &self.of[self.index(pixel) * self.lights..][..self.lights];
        of.iter().zip(0..).fold(0, |bits, (&weight, light)| bits | u32::from(weight > 0.0) << light)
    }
    /// Allocates a block of a pixel, and adds the allocated samples to `before`, the numbers before the block.
    fn allocate(&self, pixel: usize, size: u32, before: &mut [u32; FEW]) -> Allocation {
        Allocation::new(&self.of[pixel * self.lights..][..self.lights], size, before)
    }
}

/// The allocations of successive pixels. The samples of a set form blocks: one of `first` samples, then each as long as all before it.
pub(super) struct LightBlocks {
    first: u32,
    /// The last pixel and the first sample of the block that the last of the allocations belongs to.
    last: Option<([u32; 2], u32)>,
    allocations: Vec<Allocation>,
}

impl LightBlocks {
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
    pub(super) fn find(&mut self, weights: &LightWeights<'_>, pixel: [u32; 2], sample: u32) -> (usize, u32) {
        let start = (sample / self.first).checked_ilog2().map_or(0, |doubled| self.first << doubled);
        if self.last != Some((pixel, start)) {
            self.allocations.push(self.allocate(weights, pixel, start));
            self.last = Some((pixel, start));
        }
        (self.allocations.len() - 1, sample - start)
    }
    fn allocate(&self, weights: &LightWeights<'_>, pixel: [u32; 2], start: u32) -> Allocation {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Each block of each pixel is allocated by the weights of that pixel, and continues the samples of the blocks before it, wherever the
    /// search begins.
    #[test]
    fn blocks_follow_the_weights_of_their_pixel() {
        let (lights, area) = (3, [5, 7, 8, 9]);
        let of: Vec<f32> = (0..6 * lights).map(|i| (i * 7 % 11) as f32 + 0.5).collect();
        let begun: Vec<[u32; APART]> = (0..6).map(|i| [i + 1, 2, 5 - i, 0, 0, 0, 0, 0]).collect();
        for begun in [&[][..], &begun] {
            let weights = LightWeights { lights, of: of.as_slice().into(), area, begun };
            let mut blocks = LightBlocks::new(8);
            for (pixel, [x, y]) in [[5, 7], [6, 7], [7, 7], [5, 8], [6, 8], [7, 8]].into_iter().enumerate() {
                let own = &of[pixel * lights..][..lights];
                let mut before = Allocation::NONE;
                if let Some(begun) = begun.get(pixel) {
                    before[..lights].copy_from_slice(&begun[..lights]);
                }
                // where the pilot has taken the first block, its samples are not asked for
                let first = if begun.is_empty() { 0 } else { 8 };
                for start in [0, 8, 16, 32, 64].into_iter().filter(|&start| start >= first) {
                    let size = start.max(8);
                    let last = before;
                    let expected = Allocation::new(own, size, &mut before);
                    for sample in [start, start + size - 1] {
                        let (block, index) = blocks.find(&weights, [x, y], sample);
                        assert_eq!(index, sample - start);
                        let found = blocks.allocations()[block];
                        for light in 0..lights as u32 {
                            assert_eq!(found.share(light), expected.share(light), "pixel {pixel} from {start}");
                        }
                        let own = found.samples(0);
                        let [sample, light] = [own.sample, own.light].map(|lanes| lanes.to_array()[0]);
                        assert_eq!(sample, last[light as usize], "pixel {pixel} from {start}");
                    }
                }
                blocks.forget();
                assert_eq!(blocks.allocations().len(), 1);
            }
        }
    }
}
