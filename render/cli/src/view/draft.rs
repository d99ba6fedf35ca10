//! An image while its first pass or the next one is rendered: coarse as long as nothing else is known of it, then tile by tile.

use etendue_render::film::{Film, Pixel};
use etendue_render::scene::area::{self, Area};
use etendue_render::{Sampler, Sensor, Settings, Technique, World};
use std::time::Instant;

/// Samples of each pixel of a coarse image.
const SPP: u32 = 4;
/// How many times as wide as those of the image its pixels are.
const SIDES: [u32; 4] = [4, 8, 16, 32];
/// Seconds that a coarse image should take at most, so that the camera is followed while it turns.
const LONG: f64 = 0.1;

/// How an image is sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Way {
    pub(crate) technique: Technique,
    pub(crate) sampler: Sampler,
}

/// What is shown of an image before its pass has ended.
#[derive(Clone, Debug)]
pub(crate) struct Draft {
    pub(crate) way: Way,
    /// Of fewer pixels than the image has as long as it is coarse.
    film: Film,
    size: [u32; 2],
    pub(crate) version: u64,
    /// Whether no tile of the image itself is there yet.
    pub(crate) is_coarse: bool,
    /// Whether somebody has received this version: what changes then has another one.
    is_sent: bool,
}

impl Draft {
    /// A draft of an image of `size` (columns and rows), which shows `film`. It is coarse if that has another size.
    pub(crate) const fn new(way: Way, film: Film, size: [u32; 2], version: u64) -> Self {
        let is_coarse = film.width != size[0] || film.height != size[1];
        Self { way, film, size, version, is_coarse, is_sent: false }
    }

    /// Replaces the pixels of a tile.
    pub(crate) fn paste(&mut self, tile: Area, pixels: &[Pixel], version: impl FnOnce() -> u64) {
        let [width, height] = self.size;
        if std::mem::take(&mut self.is_coarse) {
            self.film = enlarged(&self.film, self.size);
        }
        area::paste(&mut self.film.pixels, [0, 0, width, height], tile, pixels.iter().copied());
        if std::mem::take(&mut self.is_sent) {
            self.version = version();
        }
    }

    /// What is sent of it, and its version.
    pub(crate) fn sent(&mut self) -> (Film, u64) {
        self.is_sent = true;
        (self.film.clone(), self.version)
    }
}

/// An image of fewer pixels, without known variances. `pace` is the number of seconds that a sample of the last one took, 0 if there was none.
pub(crate) fn coarse(world: &World, settings: &Settings, sensor: Sensor, pace: &mut f64) -> Film {
    let all = [settings.width, settings.height];
    let sized = |side: u32| all.map(|all| all.div_ceil(side));
    let count = |size: [u32; 2]| size.map(f64::from).iter().product::<f64>();
    let fits = |side: &u32| count(sized(*side)) * f64::from(SPP) * *pace <= LONG;
    let size @ [width, height] = sized(SIDES.into_iter().find(fits).unwrap_or(SIDES[SIDES.len() - 1]));
    // a trial of so few samples finds nothing, so that `auto` takes its rule
    let few = Settings { width, height, spp: SPP, sets: 1, sampler: Sampler::Sobol, ..*settings };
    let began = Instant::now();
    let (mut film, _) = world.render(&few, &|_| ());
    *pace = began.elapsed().as_secs_f64() / (count(size) * f64::from(SPP));
    // larger pixels receive more power, in proportion to their area
    let share = if sensor == Sensor::Power { (count(size) / count(all)) as f32 } else { 1.0 };
    for pixel in &mut film.pixels {
        let mean = pixel.mean.map(|x| share * x);
        *pixel = Pixel { mean, variance: [f32::INFINITY; 3], ..Pixel::default() };
    }
    film
}

/// The same of another size: each pixel has the nearest one's value.
fn enlarged(film: &Film, [width, height]: [u32; 2]) -> Film {
    let at = |x: u32, from: u32, to: u32| (u64::from(x) * u64::from(to) / u64::from(from)) as usize;
    let pixel =
        |[x, y]: [u32; 2]| film.pixels[at(y, height, film.height) * film.width as usize + at(x, width, film.width)];
    Film { width, height, pixels: area::pixels([0, 0, width, height]).map(pixel).collect() }
}
