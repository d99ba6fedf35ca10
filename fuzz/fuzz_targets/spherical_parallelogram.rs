//! `campaign::spherical_parallelogram` on any bytes.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| etendue_tests::campaign::spherical_parallelogram(bytes));
