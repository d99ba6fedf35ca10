//! Any bits as a cone: total and the same in every lane. A cone of the domain: every law.
#![no_main]

use etendue_tests::{domain::Random, laws, subjects::Cone};

libfuzzer_sys::fuzz_target!(|bits: (f32, [u32; 2], u64)| {
    let (one_minus_cos, words, seed) = bits;
    let (cone, u) = (Cone { one_minus_cos }, words.map(|w| (w >> 8) as f32 / 16_777_216.0));
    if one_minus_cos.is_finite() {
        laws::any_bits(&cone, u);
    }
    if (1e-30..=2.0).contains(&one_minus_cos) {
        laws::pointwise(&cone, u, &mut Random::new(seed));
    }
});
