//! The area of a circular segment, and its inverse.

use crate::math::{double, polynomial, ratio};
use crate::real::Real;
use core::f64::consts::{FRAC_1_PI, FRAC_PI_2};

/// S(φ) = φ − sinφ cosφ for φ in [0, π/2]: ½(Φ − sinΦ) with Φ = 2φ, by its power series.
#[inline(always)]
pub(in crate::spherical) fn segment<R: Real>(phi: R) -> R {
    const fn coefficients<const N: usize>() -> [f64; N] {
        let mut c = [2.0 / 3.0; N];
        let mut i = 1;
        while i < N {
            let k = 2.0 * i as f64;
            c[i] = c[i - 1] * -4.0 / ((k + 2.0) * (k + 3.0));
            i += 1;
        }
        c
    }
    let square = phi * phi;
    let series = if double::<R>() {
        polynomial(square, const { coefficients::<16>() })
    } else {
        polynomial(square, const { coefficients::<9>() })
    };
    phi * square * series
}

/// Sine and cosine of the φ in [0, π/2] with S(φ) = `area`.
///
/// Both are series in w², w = (12·`area`)^⅓: sinφ = wP(w²), cosφ = Q(w²), fitted to 2.0e−8 and 1.1e−8. Double precision adds
/// two steps of Newton's method.
#[inline(always)]
pub(super) fn invert_segment<R: Real>(area: R) -> (R, R) {
    let (zero, one) = (R::lit(0.0), R::lit(1.0));
    let w = (area * R::lit(12.0)).cbrt();
    let square = w * w;
    let s = w * polynomial(
        square,
        [
            0.500_000_009_931_523_5,
            -0.012_500_255_289_766,
            -4.230_223_999_96e-4,
            -2.379_496_922_54e-5,
            1.383_191_848_72e-7,
            -7.832_574_102_47e-7,
            1.875_718_478_73e-7,
            -3.250_715_830_96e-8,
            2.903_164_908_64e-9,
            -1.209_365_723_01e-10,
        ],
    );
    let c = polynomial(
        square,
        [
            1.000_000_011_322_127,
            -0.125_000_298_255_369,
            -1.561_205_631_04e-3,
            -6.355_213_900_01e-5,
            -1.361_557_694_34e-6,
            -1.061_289_853_71e-6,
            2.346_930_727_66e-7,
            -4.226_810_935_78e-8,
            3.797_874_220_48e-9,
            -1.627_831_372_74e-10,
        ],
    );
    let (s, c) = (s.lesser(one), c.clamped(zero, one));
    if !double::<R>() {
        return (s, c);
    }
    let turns = R::lit(0.5 * FRAC_1_PI);
    let mut phi = s.atan2(c);
    for _ in 0..2 {
        let (s, c) = (phi * turns).sin_cos_turns();
        let off = segment(phi) - area;
        let slope = (s * s) * (s + s) - off * c;
        phi = (phi - off * ratio(s, slope)).clamped(zero, R::lit(FRAC_PI_2));
    }
    (phi * turns).sin_cos_turns()
}
