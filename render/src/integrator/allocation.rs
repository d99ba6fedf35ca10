//! Allocates the samples of a pixel to a few lights, instead of choosing lights at random.
//!
//! Each light receives a power of two of successive samples of a set, which are well distributed on their own. Its contribution is
//! divided by its share of the samples. No light is sampled more or less often than it should be, which for lights of different
//! colours is most of the noise. The number of samples of a light depends on its possible contribution to the pixel's corners, or on
//! the samples of neighbouring pixels, never on the pixel's own samples: that keeps the estimate unbiased.

use super::{TILE, Work};
use crate::bvh::{GROUP, Hits, Rays};
use crate::camera::Camera;
use crate::lights::FEW;
use crate::packet::{M8, X8};
use crate::technique::Technique;
use etendue::{Mask, Real, u32x8};

/// Greatest number of lights whose variances the adaptive sampler measures separately.
pub(super) const APART: usize = 8;
/// Least weight of a light, as a fraction of the sum: a pixel may differ from its corners and neighbours.
const LEAST: f32 = 0.02;
/// The squared error of a light with contribution c falls about as c² n^−1.5. For a given Σn the sum is least with n ∝ c^0.8.
const POWER: f32 = 0.8;

/// The weights of the lights in the pixels of an area, row by row.
pub(super) struct Weights {
    pub(super) lights: usize,
    pub(super) of: Vec<f32>,
    pub(super) area: [u32; 4],
    /// log₂ of the samples per set that each light received in the first block of each pixel; empty if that block is not done.
    pub(super) begun: Vec<[u8; APART]>,
}

/// The allocation of a block of 2ᵏ samples to the lights, in decreasing order of their numbers.
#[derive(Clone, Copy)]
struct Allocation {
    lights: usize,
    light: [u32; FEW],
    /// End of each light's samples in the block, and the number of its samples before the block.
    end: [u32; FEW],
    before: [u32; FEW],
    reciprocal: f32,
}

/// Eight allocated samples.
#[derive(Clone, Copy)]
pub(super) struct Allocated {
    pub(super) light: u32x8,
    /// Indices among the samples of their lights.
    pub(super) sample: u32x8,
    /// Fractions of the block's samples that their lights receive.
    pub(super) share: X8,
}

impl Weights {
    fn index(&self, [x, y]: [u32; 2]) -> usize {
        let [x0, y0, x1, _] = self.area;
        ((y - y0) * (x1 - x0) + (x - x0)) as usize
    }
    /// Allocates a block of a pixel, and adds the allocated samples to `before`, the numbers before the block.
    fn allocate(&self, pixel: usize, size: u32, before: &mut [u32; FEW]) -> Allocation {
        Allocation::new(&self.of[pixel * self.lights..][..self.lights], size, before)
    }
}

impl Allocation {
    fn new(weights: &[f32], size: u32, before: &mut [u32; FEW]) -> Self {
        let lights = weights.len();
        let mut left = size - lights as u32;
        let mut each = [1; FEW];
        let mut worth = [0.0; FEW];
        let least = LEAST * weights.iter().sum::<f32>().max(f32::MIN_POSITIVE);
        for (worth, weight) in worth.iter_mut().zip(weights) {
            *worth = weight + least;
        }
        // doubles the count of the light with the greatest weight per sample as long as samples are left; the least count divides
        // the rest, so that none remain
        while left > 0 {
            let mut best = usize::MAX;
            for k in (0..lights).filter(|&k| each[k] <= left) {
                if best == usize::MAX || worth[k] > worth[best] {
                    best = k;
                }
            }
            left -= each[best];
            each[best] *= 2;
            worth[best] *= 0.5;
        }
        let mut light: [u32; FEW] = std::array::from_fn(|k| k as u32);
        light[..lights].sort_by_key(|&k| std::cmp::Reverse(each[k as usize]));
        let mut allocation = Self { lights, light, end: [0; FEW], before: [0; FEW], reciprocal: 1.0 / size as f32 };
        let mut sum = 0;
        for (k, one) in light.iter().enumerate().take(lights) {
            let one = *one as usize;
            sum += each[one];
            (allocation.end[k], allocation.before[k]) = (sum, before[one]);
            before[one] += each[one];
        }
        allocation
    }
    /// Eight samples of the block, from `first` on.
    fn packet(&self, first: u32) -> Allocated {
        let (mut light, mut sample, mut share) = ([0; 8], [0; 8], [0.0; 8]);
        let mut k = self.end[..self.lights].partition_point(|&end| end <= first);
        for (lane, j) in (first..first + 8).enumerate() {
            if j >= self.end[k] {
                k += 1;
            }
            let start = if k == 0 { 0 } else { self.end[k - 1] };
            light[lane] = self.light[k];
            sample[lane] = self.before[k] + j - start;
            share[lane] = (self.end[k] - start) as f32 * self.reciprocal;
        }
        Allocated { light: u32x8::new(light), sample: u32x8::new(sample), share: X8::from(share) }
    }
}

/// The allocations of successive pixels. The samples of a set form blocks: one of `first` samples, then each as long as all before it.
pub(super) struct Blocks {
    first: u32,
    known: Option<([u32; 2], u32, Allocation)>,
}

impl Blocks {
    pub(super) const fn new(first: u32) -> Self {
        Self { first, known: None }
    }
    /// Eight samples of a set of a pixel, from `sample` on.
    pub(super) fn packet(&mut self, weights: &Weights, pixel: [u32; 2], sample: u32) -> Allocated {
        let start = (sample / self.first).checked_ilog2().map_or(0, |doubled| self.first << doubled);
        if let Some((of, at, allocation)) = &self.known
            && (*of, *at) == (pixel, start)
        {
            return allocation.packet(sample - start);
        }
        let (mut from, mut before) = (0, [0; FEW]);
        let index = weights.index(pixel);
        if let Some(begun) = weights.begun.get(index) {
            from = self.first;
            for (before, begun) in before.iter_mut().zip(&begun[..weights.lights]) {
                *before = 1 << begun;
            }
        }
        loop {
            let allocation = weights.allocate(index, from.max(self.first), &mut before);
            if from == start {
                self.known = Some((pixel, start, allocation));
                return allocation.packet(sample - start);
            }
            from += from.max(self.first);
        }
    }
}

impl Work<'_> {
    /// Weights of the lights by their possible contributions at the corners of the pixels of an area; `None` if lights are chosen at
    /// random, or if there are too many for blocks of `size` samples.
    pub(super) fn weights(&mut self, area: [u32; 4], size: u32) -> Option<Weights> {
        let world = self.world;
        let by_light =
            matches!(self.settings.technique, Technique::Area | Technique::SolidAngle | Technique::ProjectedSolidAngle);
        let Camera::Pinhole(camera) = self.camera else { return None };
        let lights = world.lights.few()?;
        // each light takes at least one sample, worth it or not: for many lights, these are limited to half of the samples
        let fits = size.is_power_of_two() && size.is_multiple_of(8) && (lights <= 8 || size as usize >= 2 * lights);
        if !fits || !by_light || !world.plain(self.settings.technique) || !self.source.allocates() {
            return None;
        }
        let [x0, y0, x1, y1] = area;
        let (across, down) = ((x1 - x0 + 1) as usize, (y1 - y0 + 1) as usize);
        let mut corners = vec![0.0; across * down * lights];
        let mut rays = [Rays::default(); GROUP];
        for start in (0..across * down).step_by(8 * GROUP) {
            let count = (across * down - start).div_ceil(8).min(GROUP);
            let place = |p: usize, lane: usize| (start + 8 * p + lane).min(across * down - 1);
            for (p, ray) in rays[..count].iter_mut().enumerate() {
                let at = |of: &dyn Fn(usize) -> u32| X8::from(std::array::from_fn(|lane| of(place(p, lane)) as f32));
                let (x, y) = (at(&|i| x0 + (i % across) as u32), at(&|i| y0 + (i / across) as u32));
                let (origin, direction) = camera.ray(x, y);
                *ray = world.bvh.rays(origin, direction);
            }
            let mut hits = [Hits::none(X8::lit(f64::INFINITY)); GROUP];
            let active = [M8::splat(true); GROUP];
            world.bvh.closest(&rays[..count], &active[..count], &mut hits[..count], &mut self.stack);
            self.count.corner += (across * down - start).min(8 * GROUP) as u64;
            for (p, (hits, rays)) in hits[..count].iter().zip(&rays).enumerate() {
                let surface = world.surface(hits, rays);
                if let Some(near) = world.lights.near(surface.point, surface.normal) {
                    for (k, part) in near.parts(lights).enumerate() {
                        let part = part.keep(surface.reflects).to_array();
                        for (lane, part) in part.into_iter().enumerate() {
                            corners[place(p, lane) * lights + k] = part;
                        }
                    }
                }
            }
        }
        let mut of = Vec::with_capacity((TILE * TILE) as usize * lights);
        for (y, x) in (0..down - 1).flat_map(|y| (0..across - 1).map(move |x| (y, x))) {
            let corner = |dx: usize, dy: usize| ((y + dy) * across + x + dx) * lights;
            let four = [corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)];
            of.extend((0..lights).map(|k| four.iter().map(|c| corners[c + k]).sum::<f32>().powf(POWER)));
        }
        Some(Weights { lights, of, area, begun: Vec::new() })
    }
}
