//! Elementary functions of single precision, by polynomials of our own, and small differences: one body for scalars and packets.
//! [`crate::math`] lists their errors.

use super::Real;

/// Horner's rule with `mul_add`, coefficients from the constant term up.
#[inline(always)]
pub fn polynomial<R: Real, const N: usize>(x: R, coefficients: [f64; N]) -> R {
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

/// a·b − c·d by products and their rests.
#[inline(always)]
pub(super) fn difference_of_products<R: Real>(a: R, b: R, c: R, d: R) -> R {
    let cd = c * d;
    let error = R::two_prod_error(c, d, cd);
    if R::FUSED {
        return a.mul_add(b, -cd) - error;
    }
    let ab = a * b;
    (ab - cd) + (R::two_prod_error(a, b, ab) - error)
}

/// a·b of vectors by products and sums with their rests (Ogita, Rump and Oishi 2005, "Accurate Sum and Dot Product", algorithm 5.3).
#[inline(always)]
pub(super) fn dot_in_two<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 2] {
    let product = |a: R, b: R| {
        let p = a * b;
        (p, R::two_prod_error(a, b, p))
    };
    let ((x, ex), (y, ey), (z, ez)) = (product(a[0], b[0]), product(a[1], b[1]), product(a[2], b[2]));
    let (s, e1) = x.two_sum(y);
    let (s, e2) = s.two_sum(z);
    [s, (e1 + e2) + (ex + (ey + ez))]
}
