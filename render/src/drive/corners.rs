//! What lights can contribute to the corners of pixels: the weights by which samples are allocated to them.

use super::light_weights::LightWeights;
use super::tile::TileRenderer;
use crate::bvh::GROUP;
use crate::packet::{M8, X8};
use crate::scene::area::{Area, TILE};
use etendue::{Mask, Real};

/// The squared error of a light with contribution c falls about as c² n^−1.5. For a given Σn the sum is least with n ∝ c^0.8.
const POWER: f32 = 0.8;

/// So many lights may take all samples of a block.
const FREE: usize = 8;
/// The same where certificates are asked for: most of these lights are known, and their samples would be wasted. The test
/// `known_lights_take_no_samples_from_others` prints 1.0 times the variance with 4, and 32 times with 8.
const FREE_IF_ASKED: usize = 4;

/// The packets of the smallest block whose samples can be allocated to so many lights, wherever they are.
pub(super) fn packets_for(lights: usize) -> u32 {
    if lights <= FREE { 0 } else { (2 * lights).div_ceil(8).next_power_of_two() as u32 }
}

impl TileRenderer<'_> {
    /// Whether samples can be allocated to lights in blocks of `size` samples.
    pub(super) fn allocates(&self, size: u32) -> bool {
        let Some(lights) = self.chooser.few() else { return false };
        // each light takes at least one sample, worth it or not: for many lights, these are limited to half of the samples
        let free = if self.outlook.some { FREE_IF_ASKED } else { FREE };
        let fits = size.is_power_of_two() && size.is_multiple_of(8) && (lights <= free || size as usize >= 2 * lights);
        fits && !self.settings.technique.finds_lights() && self.source.allocates()
    }

    /// LightWeights of the lights by their possible contributions at the corners of the pixels of an area, seen through the middle of the
    /// lens; `None` if lights are chosen at random, or if there are too many for blocks of `size` samples.
    pub(super) fn weights(&mut self, area: Area, size: u32) -> Option<LightWeights<'static>> {
        let lights = self.chooser.few()?;
        if !self.allocates(size) || self.outlook.all {
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
        Some(LightWeights { lights, of: of.into(), area, begun: &[] })
    }

    /// The possible contribution of each light to the corners of the pixels of an area, row by row, where the light must be sampled.
    fn contributions_at_corners(&mut self, [x0, y0, x1, y1]: Area, lights: usize) -> Vec<f32> {
        let asks = self.outlook.some;
        let (across, down) = ((x1 - x0 + 1) as usize, (y1 - y0 + 1) as usize);
        let mut corners = vec![0.0; across * down * lights];
        let mut open = vec![M8::splat(true); lights];
        for start in (0..across * down).step_by(8 * GROUP) {
            let count = (across * down - start).div_ceil(8).min(GROUP);
            let place = |p: usize, lane: usize| (start + 8 * p + lane).min(across * down - 1);
            let [left, top] = [x0 - self.start[0], y0 - self.start[1]];
            self.rehearse(&[M8::splat(true); GROUP][..count], None, |p| {
                let at = |of: &dyn Fn(usize) -> u32| X8::from(std::array::from_fn(|lane| of(place(p, lane)) as f32));
                [at(&|i| left + (i % across) as u32), at(&|i| top + (i / across) as u32)]
            });
            let pixel = |i: usize| [(x0 + (i % across) as u32).min(x1 - 1), (y0 + (i / across) as u32).min(y1 - 1)];
            for p in 0..count {
                let points = &self.paths.points;
                let surface = &points.surfaces[p];
                if let Some(know) = self.know.as_mut().filter(|_| asks) {
                    know.open_at(points, p, &std::array::from_fn(|lane| pixel(place(p, lane))), &mut open);
                }
                let Some(parts) = self.chooser.contributions(surface.point, surface.normal) else { continue };
                for (k, part) in parts.weights().enumerate() {
                    let part = part.keep(surface.reflects & open[k]).to_array();
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
