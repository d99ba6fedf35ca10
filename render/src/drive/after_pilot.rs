//! The samples that follow the pilot of adaptive sampling.

use super::adaptive::{Allotment, Effort, Statistics};
use super::allocation::Weights;
use super::second_sets::Checks;
use super::tile::TileRenderer;
use crate::area::{self, Area};
use crate::film::Pixel;

impl Allotment {
    /// Renders the samples of a tile that follow the pilot, and second sets of some pixels if these tell the variances of all. Returns the
    /// finished pixels.
    pub(super) fn rest(
        &self,
        renderer: &mut TileRenderer<'_>,
        tile: Area,
        weights: Option<&Weights<'_>>,
        &Effort { sets, pilot, checks, .. }: &Effort,
    ) -> Vec<Pixel> {
        renderer.begin(tile);
        let rest = renderer.parts(tile, pilot, 0..sets, weights, |pixel| [pilot, self.packets_at(pixel)]);
        let mut pixels = self.finish(tile, &rest, sets);
        if checks > 0.0 {
            let by_spread = self.by_spread(tile, &rest, pilot);
            let packets: Vec<u32> = area::pixels(tile).map(|pixel| self.packets_at(pixel)).collect();
            let checks = Checks::new(tile, &by_spread, &packets, checks, renderer.settings.seed);
            // their first samples are allocated by the pilot, too, which makes little difference
            let weights = weights.map(Weights::anew);
            let range = |pixel| [0, if checks.contains(pixel) { self.packets_at(pixel) } else { 0 }];
            let second = renderer.parts(tile, pilot, sets..sets + 1, weights.as_ref(), range);
            let mean = |(of, n): (&Statistics, &u32)| of.sums[0].map(|sum| sum / f64::from(8 * n));
            let second: Vec<_> = second.iter().zip(&packets).map(mean).collect();
            checks.judge(&mut pixels, &by_spread, &second);
        }
        pixels
    }
}
