//! Elementary functions of packets, with their errors, and the tools that keep small differences exact.
//!
//! Greatest errors in single precision, over all floats of the stated domain, against double precision. The worst input is the first at
//! which the error occurs, with its bits:
//!
//! | function | domain, and what it returns elsewhere | greatest error | worst input |
//! |---|---|---|---|
//! | [`Real::sin_cos_turns`] | \|u\| < 2¹²⁶; NaN beyond | 8.5e−8 absolute | `0x3df74f0d` = 0.120756246 |
//! | [`Real::acos`] | [−1, 1]; beyond and NaN: clamped, NaN to 1 | 2.3e−7 relative | `0x3eff7323` = 0.4989253 |
//! | [`Real::acos`] | the same | 4.4e−7 absolute | `0xbef6946b` = −0.4816011 |
//! | [`Real::atan2`] | (v, ±1) and (1, ±v) for v in [0, 1] | 2.1e−7 relative | `0x3edd381b` = 0.43206868 |
//! | [`Real::cbrt`] | 0, and [2⁻¹⁰⁰, 2¹²⁸); 0 of subnormal and negative numbers and of NaN | 7.9e−8 relative | `0x0e017605` = 1.5957302e−30 |
//! | [`Real::cbrt`] | [2⁻¹²⁶, 2⁻¹⁰⁰) | 1.1e−7 relative, below 2⁻¹⁰⁰ | `0x00c4dc07` = 1.8078688e−38 |
//! | [`Real::inverse_cbrt_estimate`] | [2⁻¹²⁶, 2¹²⁸); unspecified elsewhere | 3.5e−2 relative | `0x20b9a7df` = 3.1451307e−19 |
//! | [`rsqrt`] | positive and finite; NaN of negative numbers | 9.0e−8 relative (1.5 ulp) | `0x017fffff` = 4.701977e−38 |
//! | [`one_minus_cos`] | sin² in [0, 1], results ≥ 2⁻¹²⁶; the argument itself above 1 | 1.2e−7 relative | `0x3e708b42` = 0.23490623 |
//!
//! `cargo test --release -p etendue-tests --test exhaustive -- --ignored --nocapture` goes over all 2³² floats and prints these figures.
//! It also shows [`Real::sqrt`] to be correctly rounded, and [`Real::round_ties_even`], [`Real::pow2_scale`],
//! [`Real::unit`] and [`Real::to_uint`] to be exact.
//!
//! Where a product and a sum are rounded twice, in builds without [`SAME_BITS`](crate::real::SAME_BITS), these rows differ (the same command
//! after `CARGO_ENCODED_RUSTFLAGS=`):
//!
//! | function | greatest error | worst input |
//! |---|---|---|
//! | [`Real::sin_cos_turns`] | 8.8e−8 absolute | `0x3df3a1c3` = 0.118960880 |
//! | [`Real::acos`] | 2.2e−7 relative | `0x3efe73a3` = 0.496976 |
//! | [`Real::acos`] | 4.4e−7 absolute | `0xbef0166b` = −0.46892104 |
//! | [`Real::atan2`] | 2.1e−7 relative | `0x3edb1e7f` = 0.42796704 |
//! | [`Real::cbrt`] | 8.3e−8 relative | `0x0e10e0a4` = 1.785753e−30 |
//!
//! No test can go over all pairs of floats. For [`Real::atan2`] the row above has every argument that the polynomial can have, in four
//! octants; the other four differ by a sign that is copied. Elsewhere the quotient is rounded, too. These errors are over random pairs
//! (`cargo test -p etendue-tests math -- --nocapture`):
//!
//! | function | domain | greatest error |
//! |---|---|---|
//! | [`Real::atan2`] | all octants, ratios 1e−30 … 1e30, up to 2¹²⁷ (beyond: finite) | 2.0e−7 relative; 5.2e−6 if both are below 2⁻¹⁴³ |
//! | [`difference_of_products`] | anything that does not under- or overflow | 1.5 ulp of the exact result; 1 ulp without `SAME_BITS` |
//!
//! Double precision uses `libm`.

use crate::real::Real;
pub(crate) use crate::real::polynomial;

/// 1/√x for x > 0, by a correctly rounded square root and division. 0 gives infinity; callers must guard against it.
#[doc(hidden)]
#[inline(always)]
pub fn rsqrt<R: Real>(x: R) -> R {
    R::lit(1.0) / x.sqrt()
}

/// 1 − cosθ for θ in [0, π/2], from sin²θ in [0, 1]: `s²/(1 + √(1 − s²))`, free of cancellation at every size.
#[doc(hidden)]
#[inline(always)]
pub fn one_minus_cos<R: Real>(sin_squared: R) -> R {
    let cos = (R::lit(1.0) - sin_squared).greater(R::lit(0.0)).sqrt();
    sin_squared / (R::lit(1.0) + cos)
}

/// `a·b − c·d` to within 1.5 ulp of the exact result (Kahan; Jeannerod, Louvet and Muller 2013).
#[doc(hidden)]
#[inline(always)]
pub fn difference_of_products<R: Real>(a: R, b: R, c: R, d: R) -> R {
    R::difference_of_products(a, b, c, d)
}

/// a/b, or 0 where b is not positive.
#[doc(hidden)]
#[inline(always)]
pub fn ratio<R: Real>(a: R, b: R) -> R {
    let some = b.gt(R::lit(0.0));
    (a / R::blend(some, b, R::lit(1.0))).keep(some)
}

/// a/b within ±1e37, or 0 where |b| ≤ 1e−37.
#[doc(hidden)]
#[inline(always)]
pub fn quotient<R: Real>(a: R, b: R) -> R {
    quotient_if_any(a, b).0
}

/// The same, and whether there is a quotient: 0 may as well be one.
#[inline(always)]
pub(crate) fn quotient_if_any<R: Real>(a: R, b: R) -> (R, R::Mask) {
    let some = b.abs().gt(R::lit(1e-37));
    let most = R::lit(1e37);
    ((a / R::blend(some, b, R::lit(1.0))).keep(some).clamped(-most, most), some)
}

/// Angle of (x, y) in turns, in [0, 1): the inverse of [`Real::sin_cos_turns`]. 0 at the origin.
#[doc(hidden)]
#[inline(always)]
pub fn atan2_turns<R: Real>(y: R, x: R) -> R {
    let turns = y.atan2(x) * R::lit(0.5 / core::f64::consts::PI);
    let turns = R::blend(turns.lt(R::lit(0.0)), turns + R::lit(1.0), turns);
    // also guards against infinite arguments
    turns.clamped(R::lit(0.0), R::ONE_MINUS_EPSILON)
}
