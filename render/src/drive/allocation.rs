//! Allocates the samples of pixels to a few lights, instead of choosing lights at random.
//!
//! The number of samples of a light depends on its possible contribution to the pixel's corners, or on the samples of neighbouring
//! pixels, never on the pixel's own samples: that keeps the estimate unbiased.

use super::tile::TileRenderer;
use crate::area::Area;
use crate::bvh::GROUP;
use crate::camera::CameraSample;
use crate::packet::{M8, X8};
use crate::settings::TILE;
use etendue::select::{Allocation, FEW};
use etendue::{Mask, Real, Vec2};
use std::borrow::Cow;

/// Greatest number of lights whose variances the adaptive sampler measures separately.
pub const APART: usize = 8;

/// The weights of the lights in the pixels of an area, row by row.
pub(super) struct Weights<'a> {
    pub(super) lights: usize,
    pub(super) of: Cow<'a, [f32]>,
    pub(super) area: Area,
    /// Samples per set that each light received in the first block of each pixel; empty if that block is not done.
    pub(super) begun: &'a [[u32; APART]],
}

impl Weights<'_> {
    fn index(&self, [x, y]: [u32; 2]) -> usize {
        let [x0, y0, x1, _] = self.area;
        ((y - y0) * (x1 - x0) + (x - x0)) as usize
    }
    /// The same weights for sets of which no block is done.
    pub(super) fn anew(&self) -> Weights<'_> {
        Weights { lights: self.lights, of: Cow::Borrowed(&self.of), area: self.area, begun: &[] }
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

/// The squared error of a light with contribution c falls about as c² n^−1.5. For a given Σn the sum is least with n ∝ c^0.8.
const POWER: f32 = 0.8;

/// So many lights may take all samples of a block.
const FREE: usize = 8;
/// The same where certificates are asked for: most of these lights are known, and their samples would be wasted. The test
/// `known_lights_take_no_samples_from_others` prints 1.0 times the variance with 4, and 32 times with 8.
const FREE_IF_ASKED: usize = 4;

impl TileRenderer<'_> {
    /// Whether samples can be allocated to lights in blocks of `size` samples.
    pub(super) fn allocates(&self, size: u32) -> bool {
        let Some(lights) = self.scene.lights.few() else { return false };
        // each light takes at least one sample, worth it or not: for many lights, these are limited to half of the samples
        let free = if self.estimator.asks() { FREE_IF_ASKED } else { FREE };
        let fits = size.is_power_of_two() && size.is_multiple_of(8) && (lights <= free || size as usize >= 2 * lights);
        fits && !self.settings.technique.finds_lights() && self.source.allocates()
    }

    /// Weights of the lights by their possible contributions at the corners of the pixels of an area, seen through the middle of the
    /// lens; `None` if lights are chosen at random, or if there are too many for blocks of `size` samples.
    pub(super) fn weights(&mut self, area: Area, size: u32) -> Option<Weights<'static>> {
        let lights = self.scene.lights.few()?;
        if !self.allocates(size) || self.estimator.knows_all() {
            return None;
        }
        let [x0, y0, x1, y1] = area;
        let (across, down) = ((x1 - x0 + 1) as usize, (y1 - y0 + 1) as usize);
        let corners = self.contributions_at_corners(area, lights);
        let mut of = Vec::with_capacity((TILE * TILE) as usize * lights);
        for (y, x) in (0..down - 1).flat_map(|y| (0..across - 1).map(move |x| (y, x))) {
            let corner = |dx: usize, dy: usize| ((y + dy) * across + x + dx) * lights;
            let four = [corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)];
            of.extend((0..lights).map(|k| libm::powf(four.iter().map(|c| corners[c + k]).sum::<f32>(), POWER)));
        }
        Some(Weights { lights, of: of.into(), area, begun: &[] })
    }

    /// The possible contribution of each light to the corners of the pixels of an area, row by row, where the light must be sampled.
    fn contributions_at_corners(&mut self, [x0, y0, x1, y1]: Area, lights: usize) -> Vec<f32> {
        let asks = self.estimator.asks();
        let (across, down) = ((x1 - x0 + 1) as usize, (y1 - y0 + 1) as usize);
        let mut corners = vec![0.0; across * down * lights];
        let mut remaining = vec![M8::splat(true); lights];
        for start in (0..across * down).step_by(8 * GROUP) {
            let count = (across * down - start).div_ceil(8).min(GROUP);
            let place = |p: usize, lane: usize| (start + 8 * p + lane).min(across * down - 1);
            for p in 0..count {
                let at = |of: &dyn Fn(usize) -> u32| X8::from(std::array::from_fn(|lane| of(place(p, lane)) as f32));
                let (left, top) = (x0 - self.start[0], y0 - self.start[1]);
                let (x, y) = (at(&|i| left + (i % across) as u32), at(&|i| top + (i / across) as u32));
                let sample = CameraSample { film: Vec2::new(x, y), lens: Vec2::default() };
                self.paths.start(p, self.camera.rays(&sample), None);
            }
            self.paths.follow(&[M8::splat(true); GROUP][..count]);
            if asks {
                self.paths.note_lobes(count);
            }
            let pixel = |i: usize| [(x0 + (i % across) as u32).min(x1 - 1), (y0 + (i / across) as u32).min(y1 - 1)];
            for p in 0..count {
                let points = &self.paths.points;
                let surface = &points.surfaces[p];
                if let Some(analytic) = self.estimator.analytic().filter(|_| asks) {
                    let pixels = std::array::from_fn(|lane| pixel(place(p, lane)));
                    analytic.remaining(points, p, &pixels, &mut remaining);
                }
                let Some(parts) = self.scene.lights.contributions(surface.point, surface.normal) else { continue };
                for (k, part) in parts.weights().enumerate() {
                    let part = part.keep(surface.reflects & remaining[k]).to_array();
                    for (lane, part) in part.into_iter().enumerate() {
                        corners[place(p, lane) * lights + k] = part;
                    }
                }
            }
            self.paths.tracer.count.corner += (across * down - start).min(8 * GROUP) as u64;
        }
        corners
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
            let weights = Weights { lights, of: of.as_slice().into(), area, begun };
            let mut blocks = Blocks::new(8);
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
                        let own = found.samples::<f32>(0);
                        assert_eq!(own.sample, last[own.light as usize], "pixel {pixel} from {start}");
                    }
                }
                blocks.forget();
                assert_eq!(blocks.allocations().len(), 1);
            }
        }
    }
}
