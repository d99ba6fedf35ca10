//! What an image depends on.

use etendue_render::scene::area::PlaceInImage;
use etendue_render::scene::limits::MOST_SAMPLES;
use etendue_render::{Identity, Sampler, Sensor, Settings, World};
use std::path::Path;

const SETTINGS: Settings = Settings { width: 8, height: 8, spp: 4, ..Settings::DEFAULT };

/// Settings of no image are refused before a pixel is rendered.
#[test]
fn impossible_settings_are_named() {
    let world = World::new(&etendue_scene::load("quads").unwrap()).unwrap();
    assert_eq!(SETTINGS.check(), Ok(()));
    for (settings, what) in [
        (Settings { spp: 0, ..SETTINGS }, "8 × 8 pixels of 0 samples in 0 sets"),
        (Settings { spp: MOST_SAMPLES + 1, ..SETTINGS }, "of 4194305 samples"),
        (Settings { sets: 3, ..SETTINGS }, "in 3 sets"),
        (Settings { sets: 8, spp: 64, sampler: Sampler::Adaptive, ..SETTINGS }, "in 8 sets"),
        (Settings { width: 0, ..SETTINGS }, "0 × 8 pixels"),
        (Settings { height: 1 << 20, ..SETTINGS }, "8 × 1048576 pixels"),
    ] {
        let panic = std::panic::catch_unwind(|| drop(world.render(&settings, &|_| ()))).unwrap_err();
        let found = panic.downcast_ref::<String>().unwrap();
        assert!(found.contains(what), "{found}");
    }
}

/// A part of an image knows its place.
#[test]
fn a_part_has_a_place() {
    let view = "Camera \"perspective\" WorldBegin LightSource \"point\"";
    let film = "Film \"rgb\" \"integer xresolution\" 64 \"integer yresolution\" 32 \"integer pixelbounds\" [10 20 5 9]";
    let scene = etendue_scene::parse(&format!("{film} {view}"), "a.pbrt", Path::new("")).unwrap();
    let settings = Settings { width: scene.film.width, height: scene.film.height, ..SETTINGS };
    let identity = Identity::new(&scene, settings, Sensor::Radiance);
    assert_eq!(identity.place, Some(PlaceInImage { start: [10, 5], whole: [64, 32] }));
}
