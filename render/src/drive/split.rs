//! Splits an image into areas of tiles of about equal size.

use crate::scene::area::Area;
use crate::settings::Settings;

/// Splits an image into at most `count` areas of whole tiles, as square as possible.
#[must_use]
pub fn areas(settings: &Settings, count: u32) -> Vec<Area> {
    let size = [settings.width, settings.height];
    let tiles = size.map(|side| side.div_ceil(Settings::TILE));
    let grid = |across: u32| [across, (count.max(1) / across).min(tiles[1])];
    let grids = (1..=count.clamp(1, tiles[0])).map(grid);
    let skew = |grid: [u32; 2]| {
        let [w, h] = [0, 1].map(|k| f64::from(tiles[k]) / f64::from(grid[k]));
        (w / h).ln().abs()
    };
    let better = |a: &[u32; 2], b: &[u32; 2]| (a[0] * a[1]).cmp(&(b[0] * b[1])).then(skew(*b).total_cmp(&skew(*a)));
    // as many areas as possible, unless they are much longer than wide
    let slim = |grid: &[u32; 2]| skew(*grid) > f64::ln(4.0);
    let [across, down] =
        grids.clone().filter(|grid| !slim(grid)).max_by(better).or_else(|| grids.max_by(better)).unwrap_or([1; 2]);
    let edge = |k: usize, i: u32, n: u32| {
        let tile = (u64::from(i) * u64::from(tiles[k]) / u64::from(n)) as u32;
        (tile * Settings::TILE).min(size[k])
    };
    let area = |x: u32, y: u32| [edge(0, x, across), edge(1, y, down), edge(0, x + 1, across), edge(1, y + 1, down)];
    (0..down).flat_map(|y| (0..across).map(move |x| area(x, y))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Sampler, Technique};

    fn settings(width: u32, height: u32) -> Settings {
        let (technique, sampler) = (Technique::Auto, Sampler::Sobol);
        Settings { width, height, spp: 16, technique, sampler, ..Settings::DEFAULT }
    }

    #[test]
    fn areas_are_tiles_that_cover_the_image_once() {
        for (width, height) in [(1, 1), (16, 16), (17, 5), (256, 256), (640, 480), (1000, 30), (30, 1000), (1920, 1080)]
        {
            let settings = settings(width, height);
            for count in [1, 2, 3, 7, 16, 63, 64, 65, 1000, 100_000] {
                let areas = areas(&settings, count);
                assert!(!areas.is_empty() && areas.len() <= count as usize, "{width}x{height}: {count}");
                assert!(areas.iter().all(|area| settings.is_of_tiles(*area)), "{width}x{height}: {count}");
                let mut pixels = vec![0_u8; crate::scene::area::count(settings.whole())];
                for area in areas {
                    for (x, y) in (area[1]..area[3]).flat_map(|y| (area[0]..area[2]).map(move |x| (x, y))) {
                        pixels[(y * width + x) as usize] += 1;
                    }
                }
                assert!(pixels.iter().all(|times| *times == 1), "{width}x{height}: {count}");
            }
        }
        assert_eq!(areas(&settings(640, 480), 64).len(), 64);
        assert_eq!(areas(&settings(256, 256), 1000).len(), 256);
    }
}
