//! `campaign::line_warps` on any bytes.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| etendue_tests::campaign::line_warps(bytes));
