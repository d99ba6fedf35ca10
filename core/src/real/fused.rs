//! Multiplication and addition with one rounding, on targets whose instructions round twice.

/// True where `wide` multiplies and adds in one instruction, with one rounding.
pub(super) const IN_HARDWARE: bool = cfg!(any(target_feature = "fma", target_arch = "aarch64"));

/// True where numbers are multiplied and added with one rounding, by an instruction or, with the feature `same-bits`, by software.
pub(super) const ALWAYS: bool = IN_HARDWARE || cfg!(feature = "same-bits");

/// `a·b − product` of each lane, exactly, if `product` is a·b rounded and the difference neither over- nor underflows.
#[inline(always)]
pub(super) fn product_error<const N: usize>(a: [f32; N], b: [f32; N], product: [f32; N]) -> [f32; N] {
    core::array::from_fn(|i| (f64::from(a[i]) * f64::from(b[i]) - f64::from(product[i])) as f32)
}

/// The same in double precision: Dekker's product of halves (1971, "A Floating-Point Technique for Extending the Available Precision"), each
/// of which has 26 bits, so that no partial product is rounded.
#[inline(always)]
pub(super) fn double_product_error<const N: usize>(a: [f64; N], b: [f64; N], product: [f64; N]) -> [f64; N] {
    core::array::from_fn(|i| {
        let [(a, rest_a), (b, rest_b)] = [a[i], b[i]].map(halves);
        ((a * b - product[i]) + (a * rest_b + rest_a * b)) + rest_a * rest_b
    })
}

/// A number as the sum of one that is rounded to 26 bits, half of them upwards, and of the rest. By its bits, not by Veltkamp's product with 2²⁷ + 1:
/// that one overflows 2²⁷ times earlier.
#[inline(always)]
fn halves(x: f64) -> (f64, f64) {
    let high = f64::from_bits((x.to_bits().wrapping_add(1 << 26)) & !((1 << 27) - 1));
    (high, x - high)
}

/// `a·b + c` of each lane, rounded once.
///
/// In double precision the product is exact. Rounding the sum to double and then to single precision differs from rounding once only
/// where the first rounding ends halfway between two numbers of single precision, or where the result is subnormal. These rare lanes are
/// left to `libm`. (A result of 0 is right: where the product is so small, its sum is exact in double precision.)
///
/// A function of its own: inline, it would take LLVM minutes for every program that uses many routines.
#[inline(never)]
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
#[inline(never)]
pub(super) fn double<const N: usize>(a: [f64; N], b: [f64; N], c: [f64; N]) -> [f64; N] {
    core::array::from_fn(|i| libm::fma(a[i], b[i], c[i]))
}

#[cfg(test)]
mod tests {
    use super::{double_product_error, product_error, single};
    use crate::real::Real;
    use wide::f32x4;

    fn check(a: f32, b: f32, c: f32) {
        let (found, right) = (single([a], [b], [c])[0], libm::fmaf(a, b, c));
        let same = found.to_bits() == right.to_bits() || found.is_nan() && right.is_nan();
        assert!(same, "{a:e} × {b:e} + {c:e} is {right:e} and not {found:e}");
    }
    /// A generator of bits (Marsaglia 2003).
    fn bits(state: &mut u64) -> u32 {
        *state ^= *state << 13;
        *state ^= *state >> 7;
        *state ^= *state << 17;
        (*state >> 16) as u32
    }

    #[test]
    fn any_numbers_are_rounded_once() {
        let mut state = 1;
        for _ in 0..2_000_000 {
            let [a, b, c] = [(); 3].map(|()| f32::from_bits(bits(&mut state)));
            check(a, b, c);
        }
    }
    #[test]
    fn the_rest_of_a_product_is_exact() {
        let mut state = 4;
        for _ in 0..2_000_000 {
            let [a, b] = [(); 2].map(|()| f32::from_bits(bits(&mut state)));
            let product = a * b;
            // below, the rest has digits beyond the least number
            if product.is_finite() && product.abs() > 1e-30 {
                let (rest, right) = (product_error([a], [b], [product])[0], libm::fmaf(a, b, -product));
                assert!(rest == right, "{a:e} × {b:e} leaves {right:e} and not {rest:e}");
            }
        }
    }
    #[test]
    fn the_rest_of_a_product_is_exact_in_double_precision() {
        let mut state = 6;
        for _ in 0..2_000_000 {
            let [a, b] =
                [(); 2].map(|()| f64::from_bits(u64::from(bits(&mut state)) << 32 | u64::from(bits(&mut state))));
            let product = a * b;
            if product.is_finite() && product.abs() > 1e-280 && a.abs().max(b.abs()) < 1e300 {
                let (rest, right) = (double_product_error([a], [b], [product])[0], libm::fma(a, b, -product));
                assert!(rest == right, "{a:e} × {b:e} leaves {right:e} and not {rest:e}");
            }
        }
    }
    /// Also in builds for processors without an instruction for both, with the feature `same-bits` and without it.
    #[test]
    fn the_rest_of_a_product_is_exact_in_packets() {
        let mut state = 5;
        for _ in 0..100_000 {
            let [a, b] = [(); 2].map(|()| f32::from_bits(bits(&mut state)));
            let product = a * b;
            if product.is_finite() && product.abs() > 1e-30 {
                let [x, y, xy] = [a, b, product].map(f32x4::splat);
                let right = libm::fmaf(a, b, -product);
                assert_eq!(f32x4::two_prod_error(x, y, xy).to_array(), [right; 4], "{a:e} × {b:e}");
            }
        }
    }
    /// Sums next to the middle of two numbers, where rounding to double precision first loses on which side they are.
    #[test]
    fn halfway_sums_are_rounded_once() {
        let mut state = 2;
        for _ in 0..500_000 {
            let c = 1.0 + (bits(&mut state) >> 9) as f32 * f32::EPSILON;
            // a product of half a step of c, but for some 2⁻²⁵ of itself and often much less
            let a = 1.0 + (bits(&mut state) >> 9) as f32 * f32::EPSILON;
            let b = 0.5 * f32::EPSILON / a;
            check(a, b, c);
            check(a, -b, c);
        }
    }
    /// The same about subnormal numbers, whose middles are at other bits.
    #[test]
    fn subnormal_sums_are_rounded_once() {
        let mut state = 3;
        // 2⁻⁷⁵, whose square is half of the least number
        let root = f32::from_bits((127 - 75) << 23);
        for _ in 0..500_000 {
            let c = f32::from_bits(bits(&mut state) & 0x80ff_ffff);
            let a = 1.0 + (bits(&mut state) >> 9) as f32 * f32::EPSILON;
            check(a * root, root / a, c);
            check(a * root, -root / a, c);
            check(a * root, root / a, 0.0);
            check(a * root, f32::from_bits(bits(&mut state) & 0x83ff_ffff), c);
        }
    }
    #[test]
    fn infinities_and_zeros() {
        let special =
            [0.0, -0.0, 1.0, -1.0, f32::MAX, f32::MIN, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, 1e-45, -1e-45];
        for a in special {
            for b in special {
                special.iter().for_each(|&c| check(a, b, c));
            }
        }
    }
}
