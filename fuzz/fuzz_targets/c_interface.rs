//! Calls the C interface with any counts, addresses, null pointers and numbers.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| etendue_fuzz_bodies::c_interface(bytes));
