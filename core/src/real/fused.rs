//! Multiplication and addition with one rounding, on targets whose instructions round twice. All targets so return the same bits.

/// True where `wide` multiplies and adds in one instruction, with one rounding.
pub(super) const IN_HARDWARE: bool = cfg!(any(target_feature = "fma", target_arch = "aarch64"));

/// `a·b + c` of each lane, rounded once.
///
/// In double precision the product is exact. Rounding the sum to double and then to single precision differs from rounding once only
/// where the first rounding ends halfway between two numbers of single precision, or where the result is subnormal. These rare lanes are
/// left to `libm`. (A result of 0 is right: where the product is so small, its sum is exact in double precision.)
///
/// Builds with assertions do not inline it, because that takes LLVM minutes for every program that uses many routines.
#[cfg_attr(debug_assertions, inline(never))]
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn single<const N: usize>(a: [f32; N], b: [f32; N], c: [f32; N]) -> [f32; N] {
    let sums: [f64; N] = core::array::from_fn(|i| f64::from(a[i]) * f64::from(b[i]) + f64::from(c[i]));
    let rounded = sums.map(|sum| sum as f32);
    let mut doubtful = false;
    for i in 0..N {
        // the 29 bits that single precision lacks are those of one half
        let halfway = (sums[i].to_bits() as u32) << 3 == 0x8000_0000;
        // the exponent is the least or that of a subnormal number, and the number is not 0
        let tiny = (rounded[i].to_bits() & 0x7fff_ffff).wrapping_sub(1) & 0xff80_0000 == 0;
        doubtful |= halfway | tiny;
    }
    if doubtful { exactly(a, b, c) } else { rounded }
}

#[cold]
#[inline(never)]
fn exactly<const N: usize>(a: [f32; N], b: [f32; N], c: [f32; N]) -> [f32; N] {
    core::array::from_fn(|i| libm::fmaf(a[i], b[i], c[i]))
}

/// `a·b + c` of each lane, rounded once.
#[cfg_attr(debug_assertions, inline(never))]
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn double<const N: usize>(a: [f64; N], b: [f64; N], c: [f64; N]) -> [f64; N] {
    core::array::from_fn(|i| libm::fma(a[i], b[i], c[i]))
}
