//! Compares the certificates of small scenes with single segments.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| etendue_fuzz_bodies::certificates(bytes));
