//! Runs `fuzz_bodies::piecewise_constant` on any bytes.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| etendue_judge::fuzz_bodies::piecewise_constant(bytes));
