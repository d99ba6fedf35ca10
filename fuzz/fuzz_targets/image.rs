//! Reads any bytes as an image.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| etendue_fuzz_bodies::image(bytes));
