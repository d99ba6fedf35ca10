//! Fresnel's reflectance of metals and dielectrics.

use crate::packet::X8;
use etendue::Real;

/// Reflectance of a smooth conductor with index of refraction η + ik for unpolarised light.
///
/// Formula: with t₀ = η² − k² − sin²θ, a² + b² = √(t₀² + 4η²k²) and 2a² = a² + b² + t₀, r⊥ and r∥ of PBR 4th ed., 9.3.6, in real
/// numbers (Born and Wolf, 14.2). Uses the form of 2a² that does not cancel.
#[inline]
pub(super) fn fresnel(cos: X8, eta: X8, k: X8) -> X8 {
    let (zero, one, two) = (X8::lit(0.0), X8::lit(1.0), X8::lit(2.0));
    let cos = cos.greater(zero).lesser(one);
    let square = cos * cos;
    let sin = one - square;
    let (eta_squared, k_squared) = (eta * eta, k * k);
    let t0 = eta_squared - k_squared - sin;
    let product = X8::lit(4.0) * eta_squared * k_squared;
    let sum = t0.mul_add(t0, product).sqrt();
    let opposite = sum - t0;
    let some = opposite.gt(zero);
    let twice = Real::blend(t0.lt(zero), product / Real::blend(some, opposite, one), sum + t0);
    let t2 = two * cos * (twice * X8::lit(0.5)).sqrt();
    let t1 = sum + square;
    let ratio = |low: X8, high: X8| {
        let some = high.gt(zero);
        Real::blend(some, low / Real::blend(some, high, one), one)
    };
    let across = ratio(t1 - t2, t1 + t2);
    let (t3, t4) = (square.mul_add(sum, sin * sin), t2 * sin);
    let along = across * ratio(t3 - t4, t3 + t4);
    X8::lit(0.5) * (across + along)
}
