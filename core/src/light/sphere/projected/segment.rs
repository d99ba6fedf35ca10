//! The area of a circular segment, and its inverse.

use crate::math::{polynomial, ratio};
use crate::real::Real;
use core::f64::consts::{FRAC_1_PI, FRAC_PI_2};

/// S(φ) = φ − sinφ cosφ for φ in [0, π/2]: ½(Φ − sinΦ) with Φ = 2φ, by its power series.
#[inline(always)]
pub(in crate::light) fn segment<R: Real>(phi: R) -> R {
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
    let series = if R::DOUBLE {
        polynomial(square, const { coefficients::<16>() })
    } else {
        polynomial(square, const { coefficients::<9>() })
    };
    phi * square * series
}

/// ρ(cosφ) = S(φ)/sin³φ, from ⅔ at cosφ = 1 to π/2 at 0, within 6e−9 (single precision): a polynomial of 1 − cosφ.
#[inline(always)]
pub(super) fn segment_ratio<R: Real>(cos: R) -> R {
    const SINGLE: [f64; 12] = [
        0.666_666_664_145_315,
        0.400_000_724_855_845,
        0.228_537_187_291_575,
        0.127_612_673_280_7,
        0.063_356_148_518_701_9,
        0.069_709_047_608_361_1,
        -0.091_292_449_574_961_4,
        0.256_865_681_010_746,
        -0.348_412_225_354_885,
        0.323_594_089_456_171,
        -0.167_014_897_934_485,
        0.041_173_678_321_326_9,
    ];
    const DOUBLE: [f64; 26] = [
        0.666_666_666_666_666_666_6,
        0.400_000_000_000_000_093_1,
        0.228_571_428_571_407_659_5,
        0.126_984_126_985_994_324_5,
        0.069_264_069_175_544_931_96,
        0.037_296_039_875_660_331_37,
        0.019_891_169_424_272_145_66,
        0.010_531_348_507_537_191_6,
        0.005_535_190_911_859_085_423,
        0.002_960_392_761_697_277_015,
        0.001_162_369_723_351_519_379,
        0.002_510_797_789_296_206_814,
        -0.006_366_610_633_359_297_341,
        0.021_817_475_691_925_553_2,
        -0.056_112_429_502_166_885_56,
        0.119_806_624_093_271_205_2,
        -0.208_875_422_438_753_403_7,
        0.297_821_655_501_703_139_1,
        -0.345_025_859_971_163_610_1,
        0.321_822_304_225_712_529_1,
        -0.238_078_248_630_677_754_7,
        0.136_551_326_042_359_605_1,
        -0.058_589_118_790_492_091_24,
        0.017_721_863_029_632_796_25,
        -0.003_377_099_417_300_959_873,
        3.062_672_009_183_607_135e-4,
    ];
    let versine = R::lit(1.0) - cos;
    if R::DOUBLE { polynomial(versine, DOUBLE) } else { polynomial(versine, SINGLE) }
}

/// (x ρ(x) − y ρ(y))/(x − y) for x and y in [0, 1], from 0.27 to 1.6, within 1e−8 (single precision): a difference of segments
/// that keeps its digits, as all terms of the polynomial that is divided have one sign near x = y = 1.
#[inline(always)]
pub(super) fn segment_difference<R: Real>(x: R, y: R) -> R {
    const SINGLE: [f64; 13] = [
        0.266_666_670_956_77,
        0.171_427_847_556_221,
        0.101_614_109_394_743,
        0.057_284_268_768_676_5,
        0.035_863_622_027_176_3,
        -0.003_985_660_089_296_22,
        0.086_029_999_107_777_1,
        -0.180_226_853_621_565,
        0.307_449_409_689_981,
        -0.336_870_408_866_487,
        0.244_292_886_876_384,
        -0.103_362_806_183_349,
        0.020_483_581_064_780_1,
    ];
    const DOUBLE: [f64; 27] = [
        0.266_666_666_666_666_666_9,
        0.171_428_571_428_571_257_8,
        0.101_587_301_587_329_158_3,
        0.057_720_057_718_065_275_18,
        0.031_968_032_049_621_047_19,
        0.017_404_815_263_705_578_78,
        0.009_360_612_910_911_873_788,
        0.004_987_687_924_416_068_877,
        0.002_644_366_034_507_915_325,
        0.001_349_064_539_675_879_262,
        9.676_650_810_024_538_851e-4,
        -8.002_469_866_094_299_623e-4,
        0.004_894_428_215_323_234_913,
        -0.015_225_107_186_277_932_89,
        0.041_274_723_085_711_553_28,
        -0.091_675_250_804_544_281_27,
        0.168_980_718_371_679_568_2,
        -0.257_597_986_019_175_603_6,
        0.323_822_309_109_028_300_1,
        -0.333_416_251_861_136_430_5,
        0.278_287_115_115_913_905_1,
        -0.185_347_945_894_686_482_2,
        0.096_216_904_738_043_725_41,
        -0.037_537_808_453_521_961_68,
        0.010_364_210_194_819_893_79,
        -0.001_808_402_521_315_911_64,
        1.504_163_589_413_443_456e-4,
    ];
    #[inline(always)]
    fn divided<R: Real>(x: R, y: R, coefficients: &[f64]) -> R {
        let (mut value, mut difference) = (R::lit(0.0), R::lit(0.0));
        for &c in coefficients.iter().rev() {
            value = value.mul_add(y, R::lit(c));
            difference = difference.mul_add(x, value);
        }
        difference
    }
    let (x, y) = (R::lit(1.0) - x, R::lit(1.0) - y);
    if R::DOUBLE { divided(x, y, &DOUBLE) } else { divided(x, y, &SINGLE) }
}

/// S(φ) from the sine and the cosine of φ in [0, π/2].
#[inline(always)]
pub(super) fn segment_of<R: Real>(sin: R, cos: R) -> R {
    sin * sin * sin * segment_ratio(cos)
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
    if !R::DOUBLE {
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
