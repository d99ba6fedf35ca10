//! Runs `fuzz_bodies::light_choice` on any bytes.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| etendue_judge::fuzz_bodies::light_choice(bytes));
