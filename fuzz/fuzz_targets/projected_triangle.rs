//! Any bits as a triangle over any horizon: total and the same in every lane. Triangles of the domain's regimes: every law.
#![no_main]

use etendue_tests::domain::{self, Random};
use etendue_tests::{laws, subjects::ProjectedTriangle};

libfuzzer_sys::fuzz_target!(|bits: ([[f32; 3]; 4], [u32; 2], u64)| {
    let (vectors @ [v0, e1, e2, normal], words, seed) = bits;
    let u = words.map(|w| (w >> 8) as f32 / 16_777_216.0);
    if vectors.as_flattened().iter().all(|x| x.is_finite()) {
        laws::any_bits(&ProjectedTriangle::by_edges(v0, e1, e2, normal), u);
        laws::any_bits(&ProjectedTriangle::by_vertices(v0, e1, e2, normal), u);
    }
    let regimes = domain::projected_triangles(1, seed);
    let (name, triangle) = &regimes[seed as usize % regimes.len()];
    // as of the spherical triangle: near a hemisphere a step of `u` turns the direction by more than the tolerance
    if name.contains("hemisphere") || name.contains("huge") {
        laws::any_bits(triangle, u);
    } else {
        laws::pointwise(triangle, u, &mut Random::new(seed));
    }
});
