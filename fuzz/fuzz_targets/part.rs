//! Reads any bytes as a part of an image.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| etendue_fuzz_bodies::part(bytes));
