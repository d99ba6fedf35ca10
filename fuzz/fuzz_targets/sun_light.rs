//! Runs `fuzz_bodies::sun_light` on any bytes.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| etendue_judge::fuzz_bodies::sun_light(bytes));
