//! Elementary functions of packets, with their errors, and the tools that keep small differences exact.
//!
//! Greatest errors in single precision, over the whole stated domain, against `libm` in f64
//! (`cargo test -p etendue-tests --test math -- --nocapture` prints them):
//!
//! | function | domain | greatest error |
//! |---|---|---|
//! | [`Real::sin_cos_turns`] | [0, 1), all 2²⁴ multiples of 2⁻²⁴ | 8.4e−8 absolute |
//! | [`Real::acos`] | [−1, 1], 2²⁴ values | 2.1e−7 relative to the result; 4.0e−7 absolute |
//! | [`Real::atan2`] | all octants, ratios 1e−30 … 1e30, up to 2¹²⁷ (beyond: finite) | 2.0e−7 relative; 5.2e−6 if both are below 2⁻¹⁴³ |
//! | [`Real::exp`] | [−87.3, 88.3] | 8.2e−8 relative |
//! | [`Real::exp_m1`] | [−87.3, 88.3] | 1.2e−7 relative |
//! | [`Real::ln_1p`] | (−1, 1e30] | 1.3e−7 relative |
//! | [`Real::cbrt`] | 0, and [2⁻¹⁰⁰, 2¹²⁸) | 7.9e−8 relative |
//! | [`Real::normal_cdf`] | [−12.8, ∞) | 3.9e−7 relative, in the lower tail too |
//! | [`Real::normal_quantile`] | [0, 1), all 2²⁴ multiples of 2⁻²⁴ | 3.3e−7 relative |
//! | [`rsqrt`] | [2⁻¹⁰⁰, 2¹⁰⁰] | 9.0e−8 relative (1.5 ulp) |
//! | [`one_minus_cos`] | sin² in [0, 1] | 1.1e−7 relative |
//! | [`difference_of_products`] | anything that does not under- or overflow | 1.5 ulp of the exact result |
//!
//! Double precision uses `libm`.

use crate::real::Real;
pub(crate) use crate::real::{exp_minus_half_square, polynomial};

/// 1/√x for x > 0, by a correctly rounded square root and division. 0 gives infinity; callers must guard against it.
#[inline(always)]
pub fn rsqrt<R: Real>(x: R) -> R {
    R::lit(1.0) / x.sqrt()
}

/// 1 − cosθ for θ in [0, π/2], from sin²θ in [0, 1]: `s²/(1 + √(1 − s²))`, free of cancellation at every size.
#[inline(always)]
pub fn one_minus_cos<R: Real>(sin_squared: R) -> R {
    let cos = (R::lit(1.0) - sin_squared).greater(R::lit(0.0)).sqrt();
    sin_squared / (R::lit(1.0) + cos)
}

/// `a·b − c·d` to within 1.5 ulp of the exact result (Kahan; Jeannerod, Louvet and Muller 2013).
#[inline(always)]
pub fn difference_of_products<R: Real>(a: R, b: R, c: R, d: R) -> R {
    let cd = c * d;
    let error = R::two_prod_error(c, d, cd);
    a.mul_add(b, -cd) - error
}

/// a/b, or 0 where b is not positive.
#[inline(always)]
pub(crate) fn ratio<R: Real>(a: R, b: R) -> R {
    let some = b.gt(R::lit(0.0));
    (a / R::blend(some, b, R::lit(1.0))).keep(some)
}

/// True in double precision, where series are longer and iterations take more steps.
#[inline(always)]
pub(crate) fn double<R: Real>() -> bool {
    size_of::<R::Scalar>() > 4
}

/// Angle of (x, y) in turns, in [0, 1): the inverse of [`Real::sin_cos_turns`]. 0 at the origin.
#[inline(always)]
pub fn atan2_turns<R: Real>(y: R, x: R) -> R {
    let turns = y.atan2(x) * R::lit(0.5 / core::f64::consts::PI);
    let turns = R::blend(turns.lt(R::lit(0.0)), turns + R::lit(1.0), turns);
    // also guards against infinite arguments
    turns.clamped(R::lit(0.0), R::ONE_MINUS_EPSILON)
}
