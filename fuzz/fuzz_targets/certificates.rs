//! Compares what is proved of small scenes with the oracle.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| etendue_fuzz_bodies::certificates(bytes));
