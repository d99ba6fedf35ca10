//! Runs `etendue_fuzz_bodies::daylight` on any bytes.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| etendue_fuzz_bodies::daylight(bytes));
