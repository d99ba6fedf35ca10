//! What it takes to write, read and merge the parts of an image, as their number and size grow.
//!
//! `cargo bench -p etendue-benches --bench parts -- [MOST]` omits images of more than MOST parts (10⁴). Each part has the finished pixels of
//! a tile, all of which are 64 × 64 pixels of the scene `quads`, repeated. Times are on as many threads as there are processors; "peak" is
//! the peak memory of the process while it merges. The last lines extrapolate.

use etendue_benches::memory::{peak, start_peak};
use etendue_render::drive::Content;
use etendue_render::drive::merge::{Merged, merge};
use etendue_render::drive::parts::{self, Piece};
use etendue_render::film::Pixel;
use etendue_render::film::sensor::Sensor;
use etendue_render::sampler::Sampler;
use etendue_render::technique::Technique;
use etendue_render::{Identity, Settings, World};
use rayon::prelude::*;
use std::fs;
use std::path::PathBuf;
use std::time::Instant;

/// Side of the tiles in pixels, and samples of a pixel.
const SIDE: u32 = 64;
const SAMPLES: u32 = 8;

fn settings(side: u32, spp: u32) -> Settings {
    let (technique, sampler) = (Technique::SolidAngle, Sampler::Sobol);
    Settings { width: side, height: side, spp, technique, sampler, sets: 1, seed: 1, ..Settings::DEFAULT }
}

/// Seconds of a merge, and what it made.
struct Merge {
    seconds: f64,
    pixels: f64,
    parts: f64,
}

/// Writes the parts of an image, merges them, and prints a row.
fn row(what: &str, identity: &Identity, count: u32, piece: impl Fn(u32) -> Piece + Sync) -> Merge {
    let folder = std::env::temp_dir().join(format!("etendue-bench-{}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    let path = |i: u32| folder.join(format!("{i:06}.exr"));
    let start = Instant::now();
    let write = |i: u32| {
        parts::write(&path(i), identity, piece(i)).expect("a folder for temporary files");
        path(i)
    };
    let files: Vec<PathBuf> = (0..count).into_par_iter().map(write).collect();
    let written = start.elapsed().as_secs_f64();
    let bytes: u64 = files.iter().map(|file| fs::metadata(file).map_or(0, |file| file.len())).sum();
    start_peak();
    let start = Instant::now();
    let Merged::Image(film) = merge(&files, false, &|_| ()).expect("whole parts").merged else {
        unreachable!("the goal is an image")
    };
    let merged = start.elapsed().as_secs_f64();
    let (pixels, start) = (film.pixels.len() as f64, Instant::now());
    parts::write_image(&folder.join("image.exr"), identity, film.pixels).expect("a folder for temporary files");
    let (saved, peak) = (start.elapsed().as_secs_f64(), peak());
    let (each, size) = (bytes as f64 / f64::from(count) / 1e3, pixels / 1e6);
    println!("| {count} {what} | {size:.2} | {each:.1} | {written:.2} | {merged:.2} | {saved:.2} | {peak:.0} |");
    let _ = fs::remove_dir_all(&folder);
    Merge { seconds: merged + saved, pixels, parts: count.into() }
}

fn main() {
    let most = std::env::args().skip(1).find_map(|a| a.parse().ok()).unwrap_or(10_000_u32);
    let scene = etendue_scene::load("quads").expect("a built-in scene");
    let world = World::new(&scene).expect("few primitives");
    let identity = |settings: Settings| Identity::new(&scene, settings, Sensor::Radiance);
    println!("| parts | image, M pixels | kB each | written in s | merged in s | image written in s | peak, MB |");
    println!("|---|---|---|---|---|---|---|");
    let pixels = world.render(&settings(SIDE, SAMPLES), &|_| ()).0.pixels;
    let tiles = |what: &str, side: u32, across: u32, pixels: &[Pixel]| {
        let tile = |i: u32| [i % across * side, i / across * side, (i % across + 1) * side, (i / across + 1) * side];
        let piece = |i: u32| Piece { area: tile(i), content: Content::Pixels(pixels.to_vec()) };
        row(what, &identity(settings(side * across, SAMPLES)), across * across, piece)
    };
    let mut merges = Vec::new();
    for across in [10, 32, 100].into_iter().filter(|across| across * across <= most) {
        merges.push(tiles("tiles of 64²", SIDE, across, &pixels));
    }
    // fewer pixels in as many parts, to tell the cost of a part from that of a pixel
    for across in [32, 100].into_iter().filter(|across| across * across <= most) {
        merges.push(tiles("tiles of 16²", 16, across, &pixels[..256]));
    }
    // each of the two costs contains some of the other, so their sum is too much rather than too little
    let largest = |few: bool| {
        let of_size = merges.iter().filter(|merge| (merge.pixels / merge.parts < 300.0) == few);
        of_size.max_by(|a, b| a.parts.total_cmp(&b.parts))
    };
    if let (Some(big), Some(small)) = (largest(false), largest(true)) {
        let (part, pixel) = (small.seconds / small.parts, big.seconds / big.pixels);
        println!();
        println!("at most {:.3} ms for each part and {:.0} ns for each pixel", part * 1e3, pixel * 1e9);
        let (parts, pixels) = (1e5, 7680.0 * 4320.0);
        println!("7680 × 4320 pixels in 10⁵ parts, extrapolated: at most {:.0} s", parts * part + pixels * pixel);
    }
}
