//! The arctangent of `libm` for all lanes at once.

use super::Real;

/// Coefficients of z, z², … in (x − atan x)/x with z = x², for |x| < 7/16.
const SERIES: [f64; 11] = [
    3.333_333_333_333_293e-1,
    -1.999_999_999_987_648_3e-1,
    1.428_571_427_250_346_6e-1,
    -1.111_111_040_546_235_6e-1,
    9.090_887_133_436_507e-2,
    -7.691_876_205_044_83e-2,
    6.661_073_137_387_531e-2,
    -5.833_570_133_790_573_5e-2,
    4.976_877_994_615_932e-2,
    -3.653_157_274_421_691_6e-2,
    1.628_582_011_536_578_2e-2,
];
/// What the double-precision values of atan(1/2), atan(1), atan(3/2) and π/2 lack.
const REST: [f64; 4] =
    [2.269_877_745_296_168_7e-17, 3.061_616_997_868_383e-17, 1.390_331_103_123_099_8e-17, 6.123_233_995_736_766e-17];

/// The angle of the vector (x, y) in [−π, π] for any x and y, with the bits of `libm::atan2` up to |y/x| = 10¹⁸: the same operations in the same
/// order, after Sun's fdlibm (`e_atan2.c` and `s_atan.c`). Beyond it is π/2, and 0 at the origin. It calls no other function, so that compilers see
/// whether a caller needs it. atan q = atan c + atan((q − c)/(1 + c q)), where c is 1/2, 1, 3/2 or infinity if q is at least 7/16.
#[inline]
pub(super) fn atan2<R: Real<Scalar = f64>>(y: R, x: R) -> R {
    let (one, pi) = (R::lit(1.0), R::lit(core::f64::consts::PI));
    // of infinities, too
    let is_diagonal = y.abs().le(x.abs()) & y.abs().ge(x.abs());
    let q = R::blend(is_diagonal, one.keep(x.abs().gt(R::lit(0.0))), (y / x).abs());
    let none = (R::lit(0.0), R::lit(0.0), q);
    let (offset, rest, left) = R::where_any(q.ge(R::lit(0.4375)), none, || {
        let ((mut offset, mut rest, mut left), mut divisor) = (none, one);
        let mut from = |least: f64, value: f64, lacks: f64, over: R, under: R| {
            let here = q.ge(R::lit(least));
            offset = R::blend(here, R::lit(value), offset);
            rest = R::blend(here, R::lit(lacks), rest);
            left = R::blend(here, over, left);
            divisor = R::blend(here, under, divisor);
        };
        from(0.4375, 4.636_476_090_008_061e-1, REST[0], R::lit(2.0) * q - one, R::lit(2.0) + q);
        from(0.6875, core::f64::consts::FRAC_PI_4, REST[1], q - one, q + one);
        from(1.1875, 9.827_937_232_473_29e-1, REST[2], q - R::lit(1.5), one + R::lit(1.5) * q);
        from(2.4375, core::f64::consts::FRAC_PI_2, REST[3], -one, q);
        (offset, rest, left / divisor)
    });
    let z = left * left;
    let w = z * z;
    let [a, b, c, d, e, f, g, h, i, j, k] = SERIES.map(R::lit);
    let odd = z * (a + w * (c + w * (e + w * (g + w * (i + w * k)))));
    let even = w * (b + w * (d + w * (f + w * (h + w * j))));
    let angle = offset - (left * (odd + even) - rest - left);
    let angle = R::blend(x.lt(R::lit(0.0)), pi - (angle - R::lit(1.224_646_799_147_353_2e-16)), angle);
    R::blend(q.ge(R::lit(1e18)), R::lit(core::f64::consts::FRAC_PI_2), angle).copysign(y)
}
