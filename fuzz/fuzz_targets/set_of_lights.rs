//! Runs `fuzz_bodies::set_of_lights` on any bytes.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| etendue_judge::fuzz_bodies::set_of_lights(bytes));
