//! `campaign::sphere_surface` on any bytes.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| etendue_tests::campaign::sphere_surface(bytes));
