//! Reads any bytes as a scene.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| etendue_fuzz_bodies::scene(bytes));
