//! Any text as a scene file: a scene or an error with file and line, never a panic; and a scene that is read can be built.
#![no_main]

use etendue_render::{World, scene};
use std::path::Path;

libfuzzer_sys::fuzz_target!(|text: &str| {
    match scene::parse(text, "fuzz.pbrt", Path::new("no such folder")) {
        Ok(scene) => drop(World::new(&scene)),
        Err(error) => assert!(error.to_string().starts_with("fuzz.pbrt:"), "{error}"),
    }
});
