//! Runs `fuzz_bodies::projected_segment` on any bytes.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| etendue_judge::fuzz_bodies::projected_segment(bytes));
