//! Elementary functions of single precision, by polynomials of our own: one body for scalars and packets. [`crate::math`] lists their
//! errors.

use super::Real;

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
pub(super) fn sin_cos_quarters_f32<R: Real>(r: R) -> (R, R) {
    let s = r * r;
    let sin = r * polynomial(s, [1.570_796_321_71, -0.645_963_460_233, 0.079_680_032_770_4, -0.004_601_657_891_18]);
    let cos = polynomial(s, [1.0, -1.233_700_543_35, 0.253_669_244_033, -0.020_860_288_526, 0.000_904_021_705_154]);
    (sin, cos)
}

/// Sine and cosine of u turns. Quadrant q = round(4u) and remainder r = 4u − q are exact, so no trigonometric argument is ever
/// rounded.
#[inline(always)]
pub(crate) fn sin_cos_turns_f32<R: Real>(u: R) -> (R, R) {
    let u4 = u * R::lit(4.0);
    let q = u4.round_ties_even();
    let (s, c) = (u4 - q).sin_cos_quarters();
    // q modulo 4, in {−2, −1, 0, 1, 2}
    let q = q - R::lit(4.0) * (q * R::lit(0.25)).round_ties_even();
    let odd = (q.abs() - R::lit(1.0)).abs().lt(R::lit(0.5));
    let half = q.abs().gt(R::lit(1.5));
    let sin = R::blend(odd, c, s).negate_where(half | q.lt(R::lit(-0.5)));
    let cos = R::blend(odd, s, c).negate_where(half | q.gt(R::lit(0.5)));
    (sin, cos)
}

/// Arc cosine of x clamped to [−1, 1]: `√(1−|x|)` times a minimax polynomial of degree 7, reflected for negative x.
#[inline(always)]
pub(crate) fn acos_f32<R: Real>(x: R) -> R {
    let a = x.abs().lesser(R::lit(1.0));
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
    R::blend(x.lt(R::lit(0.0)), R::lit(core::f64::consts::PI) - angle, angle)
}

/// Arc tangent of t for |t| ≤ tan(π/8), by a minimax polynomial of degree 9.
#[inline(always)]
pub(super) fn atan_eighth_f32<R: Real>(t: R) -> R {
    let s = t * t;
    let q = polynomial(s, [-0.333_329_552_665, 0.199_779_264_785, -0.138_798_536_444, 0.080_603_193_725_4]);
    t.mul_add(q * s, t)
}

/// Angle of (x, y), reduced to |t| ≤ tan(π/8) by one division; relative accuracy holds down to subnormal numbers, and 0/0 is 0.
#[inline(always)]
pub(crate) fn atan2_f32<R: Real>(y: R, x: R) -> R {
    let (ay, ax) = (y.abs(), x.abs());
    let swap = ay.gt(ax);
    let (small, large) = (ay.lesser(ax), ax.greater(ay));
    let beyond = small.gt(large * R::lit(0.414_213_562_373));
    let numerator = R::blend(beyond, small - large, small);
    let denominator = R::blend(beyond, small + large, large);
    let t = numerator / R::blend(denominator.gt(R::lit(0.0)), denominator, R::lit(1.0));
    let angle = t.atan_eighth();
    let angle = angle + R::lit(core::f64::consts::FRAC_PI_4).keep(beyond);
    let angle = R::blend(swap, R::lit(core::f64::consts::FRAC_PI_2) - angle, angle);
    // the sign bit of x decides, so that −0 counts as negative, as in IEEE 754
    let negative = R::lit(1.0).copysign(x).lt(R::lit(0.0)) & !(large.le(R::lit(0.0)));
    let angle = R::blend(negative, R::lit(core::f64::consts::PI) - angle, angle);
    angle.copysign(y)
}

/// eˣ = 2ⁿ(1 + q): returns (q, 2ⁿ) for x in [−87.3, 88.3], with q in [−0.30, 0.42].
///
/// n = round(x/ln 2), and r = x − n ln 2 with ln 2 in two parts, the first of 15 bits so that its product with n is exact. q =
/// eʳ − 1 = r + r²P(r); the truncation of P has a relative error of 1.4e−8.
#[inline(always)]
fn exp_parts<R: Real>(x: R) -> (R, R) {
    let n = (x * R::lit(core::f64::consts::LOG2_E)).round_ties_even();
    let r = n.mul_add(R::lit(-0.693_359_375), x);
    let r = n.mul_add(R::lit(2.121_944_400_546_905_8e-4), r);
    let p = polynomial(
        r,
        [0.499_999_981_54, 0.166_665_436_21, 0.041_667_199_859_4, 0.008_366_520_578_59, 0.001_388_252_148_51],
    );
    (p.mul_add(r * r, r), n.power_of_two())
}

#[inline(always)]
pub(crate) fn exp_f32<R: Real>(x: R) -> R {
    let least = R::lit(-87.3);
    let (q, scale) = exp_parts(x.clamped(least, R::lit(88.3)));
    q.mul_add(scale, scale).keep(x.ge(least))
}

#[inline(always)]
pub(crate) fn exp_m1_f32<R: Real>(x: R) -> R {
    let (q, scale) = exp_parts(x.clamped(R::lit(-87.3), R::lit(88.3)));
    q.mul_add(scale, scale - R::lit(1.0))
}

/// ln(1 + x), by [`ln_sum`] of the rounded y = 1 + x and its rounding error.
#[inline(always)]
pub(crate) fn ln_1p_f32<R: Real>(x: R) -> R {
    let one = R::lit(1.0);
    let y = x + one;
    ln_sum(y, R::blend(x.lt(one), x - (y - one), one - (y - x)))
}

/// ln(y + `lost`), where `lost` is less than an ulp of y: y = 2ᵏ(1 + f) with f in [√½ − 1, √2 − 1].
///
/// ln(1 + f) = f + f²P(f), plus k ln 2 in two parts; the truncation of P has a relative error of 4e−9. A y that is subnormal or
/// not positive counts as the least normal number.
#[inline(always)]
fn ln_sum<R: Real>(y: R, lost: R) -> R {
    let y = y.greater(R::lit(f64::from(f32::MIN_POSITIVE)));
    let k = (y * R::lit(core::f64::consts::SQRT_2)).exponent();
    let scale = (-k).power_of_two();
    let f = lost.mul_add(scale, y.mul_add(scale, R::lit(-1.0)));
    let p = polynomial(
        f,
        [
            -0.499_999_883_457,
            0.333_333_256_888,
            -0.250_015_830_158,
            0.200_019_741_5,
            -0.166_090_814_812,
            0.141_818_204_427,
            -0.132_429_923_003,
            0.129_044_648_983,
            -0.076_218_053_119_5,
        ],
    );
    let low = k.mul_add(R::lit(-2.121_944_400_546_905_8e-4), f * f * p);
    k.mul_add(R::lit(0.693_359_375), low + f)
}

/// x^⅓ from an estimate of x^(−⅓) within 3.5 %: one step raises the error to its fourth power, one squares it, and one corrects
/// the root itself, whose residue has a single rounding.
#[inline(always)]
pub(crate) fn cbrt_f32<R: Real>(x: R) -> R {
    let one = R::lit(1.0);
    let guess = x.inverse_cbrt_estimate();
    let residue = |y: R| one - x * y * y * y;
    let h = residue(guess);
    let series = h.mul_add(R::lit(14.0 / 81.0), R::lit(2.0 / 9.0)).mul_add(h, R::lit(1.0 / 3.0));
    let y = (guess * h).mul_add(series, guess);
    let y = (y * residue(y)).mul_add(R::lit(1.0 / 3.0), y);
    let root = x * y * y;
    let left = (-(root * root)).mul_add(root, x);
    let root = (left * R::lit(1.0 / 3.0)).mul_add(y * y, root);
    root.keep(x.ge(R::lit(f64::from(f32::MIN_POSITIVE))))
}

/// exp(−(z² + `less`)/2) with z² in twice the working precision: at 5σ its rounding alone would be 25 ulp.
#[inline(always)]
pub(crate) fn exp_minus_half_square<R: Real>(z: R, less: R) -> R {
    let square = z * z;
    let error = R::two_prod_error(z, z, square) + less;
    let value = (square * R::lit(-0.5)).exp();
    (error * R::lit(-0.5)).mul_add(value, value)
}

/// Φ(z), from Φ(−|z|) = exp(−z²/2) t P(t) with t = 1/(1 + 0.3|z|); the truncation of P has a relative error of 3.4e−9 for |z| ≤
/// 13.3, and the exponential is 0 beyond.
#[inline(always)]
pub(crate) fn normal_cdf_f32<R: Real>(z: R) -> R {
    let one = R::lit(1.0);
    let a = z.abs().lesser(R::lit(14.0));
    let t = one / R::lit(0.3).mul_add(a, one);
    let p = polynomial(
        t,
        [
            0.119_686_482_44,
            0.119_575_624_945,
            0.110_205_451_797,
            0.078_522_302_954_5,
            0.095_791_974_964_2,
            -0.078_775_311_041_8,
            0.191_039_126_353,
            -0.227_677_363_708,
            0.112_216_196_896,
            -0.020_584_487_309_1,
        ],
    );
    let tail = exp_minus_half_square(a, R::lit(0.0)) * (t * p);
    R::blend(z.gt(R::lit(0.0)), one - tail, tail)
}

/// The least tail probability that [`Real::normal_quantile`] distinguishes from 0: half a step of `u`.
pub(crate) const LEAST_TAIL: f64 = 1.0 / 33_554_432.0;

/// Φ⁻¹(u) = (2u − 1)P(w) with w = −ln(4u(1−u)): one polynomial of degree 8 in w below 5, one in √w above; their truncations
/// have relative errors of 9.4e−8 and 5.6e−8. The split is that of Giles, "Approximating the erfinv function", GPU Computing
/// Gems, 2011; the coefficients are fitted to this range of u.
#[inline(always)]
pub(crate) fn normal_quantile_f32<R: Real>(u: R) -> R {
    const CENTRAL: [f64; 9] = [
        2.123_313_566_59,
        0.348_802_659_557,
        -0.005_908_170_968_61,
        -0.001_773_009_798_28,
        0.000_309_150_158_24,
        -6.218_090_365_35e-6,
        -4.990_541_370_7e-6,
        4.861_120_233_24e-7,
        4.035_201_908_56e-8,
    ];
    const TAIL: [f64; 9] = [
        4.006_434_353_67,
        1.416_580_993_47,
        0.013_349_691_714_5,
        -0.010_778_095_263_7,
        0.008_109_539_768_34,
        -0.005_201_290_258_73,
        0.001_924_490_718_02,
        0.000_149_030_131_196,
        -0.000_294_894_690_764,
    ];
    let (half, one) = (R::lit(0.5), R::lit(1.0));
    let u = u.clamped(R::lit(0.0), one);
    // lower and upper tail: each is exact where it is small
    let least = R::lit(LEAST_TAIL);
    let (low, high) = (u.greater(least), (one - u).greater(least));
    let x = (low.lesser(half) - half) + (half - high.lesser(half));
    // w = −ln(4u(1−u)) is at most 16; P(w) is flat near the median, where w → 0, so only the absolute error of w counts
    let w = -ln_sum(R::lit(4.0) * low * high, R::lit(0.0));
    let central = w.lt(R::lit(5.0));
    let v = R::blend(central, w - R::lit(2.5), w.greater(R::lit(0.0)).sqrt() - R::lit(3.0));
    let mut sum = R::blend(central, R::lit(CENTRAL[8]), R::lit(TAIL[8]));
    for i in (0..8).rev() {
        sum = sum.mul_add(v, R::blend(central, R::lit(CENTRAL[i]), R::lit(TAIL[i])));
    }
    (x + x) * sum
}
