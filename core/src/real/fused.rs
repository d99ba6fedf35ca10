//! Multiplication and addition with one rounding, on targets whose instructions round twice. All targets so return the same bits.

/// True where `wide` multiplies and adds in one instruction, with one rounding.
pub(super) const IN_HARDWARE: bool = cfg!(any(target_feature = "fma", target_arch = "aarch64"));

/// `a·b + c` of each lane, rounded once.
///
/// In double precision the product is exact. Rounding the sum to double and then to single precision differs from rounding once only
/// where the first rounding ends halfway between two numbers of single precision, or where the result is subnormal. These rare lanes are
/// left to `libm`.
///
/// Builds with assertions do not inline it, because that takes LLVM minutes for every program that uses many routines.
#[cfg_attr(debug_assertions, inline(never))]
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn single<const N: usize>(a: [f32; N], b: [f32; N], c: [f32; N]) -> [f32; N] {
    let mut sums = [0.0_f64; N];
    for i in 0..N {
        sums[i] = f64::from(a[i]) * f64::from(b[i]) + f64::from(c[i]);
    }
    let mut doubtful = false;
    for sum in sums {
        let bits = sum.to_bits() & (u64::MAX >> 1);
        // the 29 bits that single precision lacks are those of one half, or the exponent is below −126 and the number is not 0
        doubtful |= bits & 0x1fff_ffff == 0x1000_0000 || bits.wrapping_sub(1) < (897 << 52) - 1;
    }
    if doubtful { exactly(a, b, c) } else { sums.map(|sum| sum as f32) }
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
