//! Which of a few lights each sample of a pixel goes to, where that need not be left to chance.
//!
//! The samples of a pixel are strata of one set: a light gets a power of two of them, one after another, so that they are a good set of
//! their own. Its share of them is known, and what it adds is divided by that: no light is sampled more or less often than
//! it should be, which for lights of different colours is most of the noise. How many a light gets goes by what it can contribute
//! to the pixel's corners, or by what has been found at the pixel's neighbours, never by what its own samples have found: so nothing
//! is biased.

use super::{TILE, Work};
use crate::accel::{GROUP, Hits, M8, Rays, X8};
use crate::lens::Camera;
use crate::lights::{FEW, Technique};
use etendue::{Mask, Real, u32x8};

/// Up to so many lights, the adaptive sampler tells which of them vary.
pub(super) const APART: usize = 8;
/// Least share of a light in what all are worth: a pixel may be unlike its corners and neighbours.
const LEAST: f32 = 0.02;
/// Squared error of a light's part c falls about as c² n^−1.5: at a given sum of the n it is least with n in proportion to c^0.8.
const POWER: f32 = 0.8;

/// What samples of the lights are worth in the pixels of an area: of each, row by row, a number for each light.
pub(super) struct Weights {
    pub(super) lights: usize,
    pub(super) of: Vec<f32>,
    pub(super) area: [u32; 4],
    /// Logarithms to base 2 of the samples in a set that each light has had in the first block of each pixel, if that is done.
    pub(super) begun: Vec<[u8; APART]>,
}

/// How the samples of a block of a power of two are allocated to the lights, most to the first.
#[derive(Clone, Copy)]
struct Allocation {
    lights: usize,
    light: [u32; FEW],
    /// Where in the block each one's samples end, and how many of its samples came before the block.
    end: [u32; FEW],
    before: [u32; FEW],
    reciprocal: f32,
}

/// Eight allocated samples.
#[derive(Clone, Copy)]
pub(super) struct Allocated {
    pub(super) light: u32x8,
    /// Which of that light's samples it is.
    pub(super) sample: u32x8,
    /// Samples of that light over samples of the block.
    pub(super) share: X8,
}

impl Weights {
    fn index(&self, [x, y]: [u32; 2]) -> usize {
        let [x0, y0, x1, _] = self.area;
        ((y - y0) * (x1 - x0) + (x - x0)) as usize
    }
    /// Of a block of a pixel, where each light has had `before` samples of it, to which this adds.
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
        // while there are samples left, twice as many for the light for which they are worth most: the least count divides what
        // is left, so that it comes out even
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
    /// The eight samples of the block from `first` on.
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

/// The allocations of one pixel after another. The samples of a set are blocks: the first of `first`, then each as long as all before.
pub(super) struct Blocks {
    first: u32,
    known: Option<([u32; 2], u32, Allocation)>,
}

impl Blocks {
    pub(super) const fn new(first: u32) -> Self {
        Self { first, known: None }
    }
    /// The eight samples from `sample` on of a set of a pixel.
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
    /// What the lights can contribute to the pixels of an area, by what is seen at their corners; nothing where lights are chosen, or
    /// too many for blocks of `size` samples.
    pub(super) fn weights(&mut self, area: [u32; 4], size: u32) -> Option<Weights> {
        let world = self.world;
        let by_light =
            matches!(self.settings.technique, Technique::Area | Technique::SolidAngle | Technique::ProjectedSolidAngle);
        let Camera::Pinhole(camera) = self.camera else { return None };
        let lights = world.lights.few()?;
        // each light takes a sample at the least, if it is worth it or not: of many, they take half the samples at the most
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
                *ray = world.accel.rays(origin, direction);
            }
            let mut hits = [Hits::none(X8::lit(f64::INFINITY)); GROUP];
            let active = [M8::splat(true); GROUP];
            world.accel.closest(&rays[..count], &active[..count], &mut hits[..count], &mut self.stack);
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
