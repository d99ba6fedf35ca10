//! Sine and cosine of double precision for all lanes at once.

use super::Real;

/// Coefficients of x³, x⁵, … of the sine, and of x⁴, x⁶, … of the cosine, for |x| ≤ π/4.
const SINE: [f64; 6] = [
    -1.666_666_666_666_663_2e-1,
    8.333_333_333_322_49e-3,
    -1.984_126_982_985_795e-4,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];
const COSINE: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// Sine and cosine of |x| ≤ π/4, with the bits of `libm::sincos`: the same operations in the same order, after Sun's fdlibm (`k_sin.c` and
/// `k_cos.c`).
#[inline(always)]
fn sin_cos_eighth<R: Real<Scalar = f64>>(x: R) -> (R, R) {
    let (one, half) = (R::lit(1.0), R::lit(0.5));
    let [s1, s2, s3, s4, s5, s6] = SINE.map(R::lit);
    let [c1, c2, c3, c4, c5, c6] = COSINE.map(R::lit);
    let z = x * x;
    let w = z * z;
    let rest = s2 + z * (s3 + z * s4) + z * w * (s5 + z * s6);
    let sin = x + z * x * (s1 + z * rest);
    let rest = z * (c1 + z * (c2 + z * c3)) + w * w * (c4 + z * (c5 + z * c6));
    let hz = half * z;
    let w = one - hz;
    let cos = w + (((one - w) - hz) + z * rest);
    (sin, cos)
}

/// Sine and cosine of `r` quarter turns, |r| ≤ ½.
#[inline(always)]
pub(super) fn sin_cos_quarters<R: Real<Scalar = f64>>(r: R) -> (R, R) {
    sin_cos_eighth(r * R::lit(core::f64::consts::FRAC_PI_2))
}

/// Sine and cosine of u turns. Quadrant q = round(4u) and remainder 4u − q are exact.
#[inline(always)]
pub(super) fn sin_cos_turns<R: Real<Scalar = f64>>(u: R) -> (R, R) {
    let u4 = u * R::lit(4.0);
    let q = u4.round_ties_even();
    let (s, c) = sin_cos_quarters(u4 - q);
    // q modulo 4, in {−2, −1, 0, 1, 2}
    let q = q - R::lit(4.0) * (q * R::lit(0.25)).round_ties_even();
    let odd = (q.abs() - R::lit(1.0)).abs().lt(R::lit(0.5));
    let half = q.abs().gt(R::lit(1.5));
    let sin = R::blend(odd, c, s).negate_where(half | q.lt(R::lit(-0.5)));
    let cos = R::blend(odd, s, c).negate_where(half | q.gt(R::lit(0.5)));
    (sin, cos)
}

#[cfg(test)]
mod tests {
    use super::sin_cos_turns;
    use crate::real::Real;
    use wide::f64x4;

    /// The bits of `libm`, in numbers and packets.
    #[test]
    fn sines_and_cosines_have_the_bits_of_libm() {
        let mut state = 1_u64;
        for _ in 0..400_000 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let exponent = (state >> 58) as i32 - 60;
            let u = libm::ldexp((state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0, exponent);
            let quarter = Real::round_ties_even(u * 4.0);
            let (s, c) = libm::sincos((u * 4.0 - quarter) * core::f64::consts::FRAC_PI_2);
            let (sin, cos) = match quarter as i64 & 3 {
                0 => (s, c),
                1 => (c, -s),
                2 => (-s, -c),
                _ => (-c, s),
            };
            let found = sin_cos_turns(u);
            assert_eq!((found.0.to_bits(), found.1.to_bits()), (sin.to_bits(), cos.to_bits()), "{u:e}");
            let packet = sin_cos_turns(f64x4::splat(u));
            assert_eq!([packet.0.to_array(), packet.1.to_array()], [[sin; 4], [cos; 4]], "{u:e}");
        }
    }
}
