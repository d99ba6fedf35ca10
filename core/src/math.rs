//! Elementary functions of packets, with their errors, and the tools that keep small differences exact.
//!
//! Greatest errors in single precision, over every argument of the stated set, against `libm` in f64
//! (`cargo test -p etendue-tests --test math -- --nocapture` prints them):
//!
//! | function | domain | greatest error |
//! |---|---|---|
//! | [`Real::sin_cos_turns`] | [0, 1), all 2²⁴ multiples of 2⁻²⁴ | 8.4e−8 absolute |
//! | [`Real::acos`] | [−1, 1], 2²⁴ values | 2.1e−7 relative to the result; 4.0e−7 absolute |
//! | [`Real::atan2`] | all octants, ratios 1e−30 … 1e30 | 2.0e−7 relative |
//! | [`rsqrt`] | [2⁻¹⁰⁰, 2¹⁰⁰] | 9.0e−8 relative (1.5 ulp) |
//! | [`one_minus_cos`] | sin² in [0, 1] | 1.1e−7 relative |
//! | [`difference_of_products`] | anything that does not under- or overflow | 1.5 ulp of the exact result |
//!
//! Double precision goes to `libm`.

use crate::real::Real;

/// 1/√x: a division and a square root, both correctly rounded. 0 gives infinity; callers guard.
#[inline(always)]
pub fn rsqrt<R: Real>(x: R) -> R {
    R::lit(1.0) / x.sqrt()
}

/// 1 − cosθ for θ in [0, π/2], from sin²θ in [0, 1]: `s²/(1 + √(1 − s²))`, free of cancellation at every size.
#[inline(always)]
pub fn one_minus_cos<R: Real>(sin_squared: R) -> R {
    let cos = (R::lit(1.0) - sin_squared).max(R::lit(0.0)).sqrt();
    sin_squared / (R::lit(1.0) + cos)
}

/// `a·b − c·d` to within 1.5 ulp of the exact result (Kahan; Jeannerod, Louvet and Muller 2013).
#[inline(always)]
pub fn difference_of_products<R: Real>(a: R, b: R, c: R, d: R) -> R {
    let cd = c * d;
    let error = R::product_error(c, d, cd);
    if cfg!(any(target_feature = "fma", target_arch = "aarch64")) {
        a.mul_add(b, -cd) - error
    } else {
        let ab = a * b;
        (ab - cd) + (R::product_error(a, b, ab) - error)
    }
}

/// `a + b` and its rounding error, exactly (Knuth's TwoSum).
#[inline(always)]
pub fn two_sum<R: Real>(a: R, b: R) -> (R, R) {
    let sum = a + b;
    let other = sum - a;
    (sum, (a - (sum - other)) + (b - other))
}

/// Angle of (x, y) in turns, in [0, 1): the inverse of [`Real::sin_cos_turns`]. 0 at the origin.
#[inline(always)]
pub fn atan2_turns<R: Real>(y: R, x: R) -> R {
    let turns = y.atan2(x) * R::lit(0.5 / core::f64::consts::PI);
    let turns = R::select(turns.lt(R::lit(0.0)), turns + R::lit(1.0), turns);
    turns.min(R::below_one())
}

/// Horner's rule with `mul_add`, coefficients from the constant term up.
#[inline(always)]
pub(crate) fn polynomial<R: Real, const N: usize>(x: R, coefficients: [f64; N]) -> R {
    let mut sum = R::lit(coefficients[N - 1]);
    for &c in coefficients[..N - 1].iter().rev() {
        sum = sum.mul_add(x, R::lit(c));
    }
    sum
}

/// Sine and cosine of `r` quarter turns, |r| ≤ ½: minimax polynomials of degrees 7 and 8.
#[inline(always)]
pub(crate) fn sin_cos_quarter<R: Real>(r: R) -> (R, R) {
    let s = r * r;
    let sin = r * polynomial(s, [1.570_796_321_71, -0.645_963_460_233, 0.079_680_032_770_4, -0.004_601_657_891_18]);
    let cos = polynomial(s, [1.0, -1.233_700_543_35, 0.253_669_244_033, -0.020_860_288_526, 0.000_904_021_705_154]);
    (sin, cos)
}

/// Quadrant and remainder are exact in turns: q = round(4u), r = 4u − q; no argument of trigonometry is ever rounded.
#[inline(always)]
pub(crate) fn sin_cos_turns_f32<R: Real>(u: R) -> (R, R) {
    let u4 = u * R::lit(4.0);
    let q = u4.round_ties_even();
    let (s, c) = sin_cos_quarter(u4 - q);
    // q modulo 4, in {−2, −1, 0, 1, 2}
    let q = q - R::lit(4.0) * (q * R::lit(0.25)).round_ties_even();
    let odd = (q.abs() - R::lit(1.0)).abs().lt(R::lit(0.5));
    let half = q.abs().gt(R::lit(1.5));
    let sin = R::select(odd, c, s).negate_where(half | q.lt(R::lit(-0.5)));
    let cos = R::select(odd, s, c).negate_where(half | q.gt(R::lit(0.5)));
    (sin, cos)
}

/// `√(1−|x|)` times a minimax polynomial of degree 7, reflected for negative x.
#[inline(always)]
pub(crate) fn acos_f32<R: Real>(x: R) -> R {
    let a = x.abs().min(R::lit(1.0));
    let p = polynomial(
        a,
        [
            1.570_796_303_92,
            -0.214_598_696_631,
            0.088_977_312_304,
            -0.050_164_188_752,
            0.030_862_751_818,
            -0.017_045_101_936_8,
            0.006_638_617_827_82,
            -0.001_253_456_771_54,
        ],
    );
    let angle = (R::lit(1.0) - a).sqrt() * p;
    R::select(x.lt(R::lit(0.0)), R::lit(core::f64::consts::PI) - angle, angle)
}

/// Reduced to |t| ≤ tan(π/8) by one division; relative accuracy is kept down to denormals, and 0/0 is 0.
#[inline(always)]
pub(crate) fn atan2_f32<R: Real>(y: R, x: R) -> R {
    let (ay, ax) = (y.abs(), x.abs());
    let swap = ay.gt(ax);
    let (small, large) = (ay.min(ax), ax.max(ay));
    let beyond = small.gt(large * R::lit(0.414_213_562_373));
    let numerator = R::select(beyond, small - large, small);
    let denominator = R::select(beyond, small + large, large);
    let t = numerator / R::select(denominator.gt(R::lit(0.0)), denominator, R::lit(1.0));
    let s = t * t;
    let q = polynomial(s, [-0.333_329_552_665, 0.199_779_264_785, -0.138_798_536_444, 0.080_603_193_725_4]);
    let angle = t.mul_add(q * s, t);
    let angle = angle + R::lit(core::f64::consts::FRAC_PI_4).keep(beyond);
    let angle = R::select(swap, R::lit(core::f64::consts::FRAC_PI_2) - angle, angle);
    // the sign bit of x decides, so that −0 counts as negative, as in IEEE 754
    let negative = R::lit(1.0).copysign(x).lt(R::lit(0.0)) & !(large.le(R::lit(0.0)));
    let angle = R::select(negative, R::lit(core::f64::consts::PI) - angle, angle);
    angle.copysign(y)
}
