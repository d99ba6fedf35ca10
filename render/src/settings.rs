//! What an image depends on besides the scene, and what it cost.

use crate::choose::ChoiceBy;
use crate::sampler::Sampler;
use crate::scene::area::{Area, TILE};
use crate::scene::limits::{MOST_SAMPLES, is_size};
use crate::technique::Technique;

/// The area [x0, y0, x1, y1) of each tile of an area that consists of tiles.
pub(crate) fn tiles([left, top, right, bottom]: Area) -> impl Iterator<Item = Area> {
    let from = |start: u32, end: u32| (start..end).step_by(TILE as usize);
    from(top, bottom)
        .flat_map(move |y| from(left, right).map(move |x| [x, y, (x + TILE).min(right), (y + TILE).min(bottom)]))
}

/// Everything an image depends on besides the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "exr", derive(serde::Serialize))]
pub struct Settings {
    /// Pixels across, at least 1.
    pub width: u32,
    /// Pixels down, at least 1.
    pub height: u32,
    /// Samples per pixel, at least 1.
    pub spp: u32,
    /// How to sample the lights.
    pub technique: Technique,
    /// How to choose one of them.
    pub choice: ChoiceBy,
    /// Greatest number of perfect mirrors along a camera ray.
    pub depth: u32,
    /// How to generate the random numbers.
    pub sampler: Sampler,
    /// Independent sets of samples per pixel: 1, 2 or 4, or 0 for as few as give a variance, see [`Sampler::sets`]. The variance of
    /// a pixel is that of the means of its sets; with 1 set it is infinite. With 0, pixels of [`Sampler::Adaptive`] have one set, and second
    /// sets of some of them tell the variances of all, see [`Sampler::checks`].
    pub sets: u32,
    /// Seed of the random numbers; different seeds give independent images.
    pub seed: u64,
}

impl Settings {
    /// The default depth.
    pub const DEPTH: u32 = 8;
    /// One sample of a single pixel, by what `auto` takes. What an image does not ask for is as here.
    pub const DEFAULT: Self = Self {
        width: 1,
        height: 1,
        spp: 1,
        technique: Technique::Auto,
        choice: ChoiceBy::Auto,
        depth: Self::DEPTH,
        sampler: Sampler::Sobol,
        sets: 0,
        seed: 0,
    };
    /// Side of the square tiles of an image in pixels. Parts of an image consist of whole tiles, since a tile shares what is known of its
    /// lights.
    pub const TILE: u32 = TILE;

    /// Checks that there can be such an image.
    ///
    /// # Errors
    /// Fails if its size, its number of samples or that of its sets is none that images have.
    pub fn check(&self) -> Result<(), String> {
        let Self { width, height, spp, sets, .. } = *self;
        let is_valid = is_size(width.into(), height.into()) && (1..=MOST_SAMPLES).contains(&spp);
        if is_valid && [0, 1, 2, 4].contains(&sets) {
            return Ok(());
        }
        Err(format!("no image has {width} × {height} pixels of {spp} samples in {sets} sets"))
    }
    /// The area [x0, y0, x1, y1) of the whole image in pixels.
    #[must_use]
    pub const fn whole(&self) -> Area {
        [0, 0, self.width, self.height]
    }
    /// Whether an area [x0, y0, x1, y1) consists of whole tiles of the image: its sides are at multiples of 16 or at the image's edges.
    #[must_use]
    pub fn is_of_tiles(&self, [x0, y0, x1, y1]: Area) -> bool {
        let is_side = |at: u32, end: u32| at.is_multiple_of(TILE) || at == end;
        let is_range = |a: u32, b: u32, end: u32| a < b && b <= end && is_side(a, end) && is_side(b, end);
        is_range(x0, x1, self.width) && is_range(y0, y1, self.height)
    }
}
