//
// WGSL promises neither that `fma` rounds once, nor correctly rounded division and square roots, nor subnormal numbers, infinities and
// NaN. Where a device has all these, the functions return the bits of the Rust library `etendue`. Elsewhere results differ: mostly in their last
// digits, but hostile input can return NaN, or a pdf where there is none. `--exact` writes the first three out.

fn etendue_shader_from_bits(bits: u32) -> f32 {
    return bitcast<f32>(bits);
}
// b where either is NaN.
fn etendue_shader_lesser(a: f32, b: f32) -> f32 {
    return select(b, a, a < b);
}
// b where either is NaN.
fn etendue_shader_greater(a: f32, b: f32) -> f32 {
    return select(b, a, a > b);
}
// The magnitude of x with the sign of another number; a NaN counts as positive.
fn etendue_shader_copysign(x: f32, sign: f32) -> f32 {
    let magnitude = bitcast<u32>(x) & 0x7fffffffu;
    return bitcast<f32>(magnitude | select(0u, bitcast<u32>(sign) & 0x80000000u, sign == sign));
}
// The power of two that scales a normal number to [1, 2); of 0 and subnormal numbers 2^127.
fn etendue_shader_pow2_scale(x: f32) -> f32 {
    return etendue_shader_greater(bitcast<f32>(0x7f000000u - (bitcast<u32>(x) & 0x7f800000u)), 5.877471754111438e-39f);
}
// An unsigned number of less than 2^31 as the nearest number.
fn etendue_shader_from_word(k: u32) -> f32 {
    return f32(i32(k));
}
// The integer part of a number in [0, 2^24].
fn etendue_shader_to_word(x: f32) -> u32 {
    return u32(i32(x));
}
// x^(-1/3) of a positive normal number within 3.5 %.
fn etendue_shader_inverse_cbrt_estimate(x: f32) -> f32 {
    return bitcast<f32>(etendue_shader_to_word(1419916083.0f - etendue_shader_from_word(bitcast<u32>(x)) * 0.33333334f));
}
// A number in [0, 1 - 2^-24] from the 24 high bits.
fn etendue_shader_unit(k: u32) -> f32 {
    return f32(k >> 8u) * 5.9604645e-8f;
}
// All ones where a < b, else 0.
fn etendue_shader_word_less(a: u32, b: u32) -> u32 {
    return select(0u, 0xffffffffu, a < b);
}
