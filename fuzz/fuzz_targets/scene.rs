//! Reads any bytes as a scene.
#![no_main]

#[path = "../bodies/files.rs"]
#[allow(dead_code, reason = "each target calls one of them")]
mod files;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| files::scene(bytes));
