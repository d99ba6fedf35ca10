//! Greatest errors of the elementary functions. `-- --nocapture` prints the figures that the table in `core/src/math.rs` rounds up.

use core::f64::consts::PI;
use etendue::math::{difference_of_products, one_minus_cos, rsqrt};
use etendue::{Real, f32x8};
use etendue_properties::checks::{self, MeasuredError};
use etendue_properties::generators::Random;

#[test]
fn sin_cos_turns() {
    let mut greatest = MeasuredError::of("sin_cos_turns, absolute");
    let mut unit = MeasuredError::of("sin² + cos² − 1");
    for i in (0..1 << 24).step_by(8) {
        let u = f32x8::from_fn(|k| (i + k) as f32 / 16_777_216.0);
        let (s, c) = u.sin_cos_turns();
        for k in 0..8 {
            let (x, s, c) = (u.lane(k), s.lane_f64(k), c.lane_f64(k));
            let (sin, cos) = (2.0 * PI * f64::from(x)).sin_cos();
            greatest.take((s - sin).abs().max((c - cos).abs()), [x, 0.0]);
            unit.take((s * s + c * c - 1.0).abs(), [x, 0.0]);
        }
    }
    greatest.assert_below(8.4e-8);
    unit.assert_below(1.9e-7);
    for (u, s, c) in [(0.0, 0.0, 1.0), (0.25, 1.0, 0.0), (0.5, 0.0, -1.0), (0.75, -1.0, 0.0), (1.0, 0.0, 1.0)] {
        let (sin, cos) = Real::sin_cos_turns(u as f32);
        assert!(sin == s && cos == c, "{u}: {sin} {cos}");
    }
}

#[test]
fn acos() {
    let (mut relative, mut absolute) = (MeasuredError::of("acos, relative"), MeasuredError::of("acos, absolute"));
    let mut random = Random::new(1);
    let mut check = |x: f32, y: f32| {
        let truth = f64::from(x).acos();
        absolute.take((f64::from(y) - truth).abs(), [x, y]);
        if truth > 0.0 {
            relative.take((f64::from(y) / truth - 1.0).abs(), [x, y]);
        }
    };
    for i in (0..1 << 24).step_by(8) {
        let x = f32x8::from_fn(|k| (i + k) as f32 / 8_388_608.0 - 1.0);
        let y = x.acos();
        (0..8).for_each(|k| check(x.lane(k), y.lane(k)));
    }
    for _ in 0..1 << 20 {
        // close to ±1, and close to 0
        let x = 1.0 - random.magnitude(1e-7, 1.0) as f32;
        check(x, Real::acos(x));
        check(-x, Real::acos(-x));
        let x = random.magnitude(1e-30, 1.0) as f32;
        check(x, Real::acos(x));
    }
    relative.assert_below(2.1e-7);
    absolute.assert_below(4.0e-7);
    assert_eq!((Real::acos(1.0_f32), Real::acos(2.0_f32)), (0.0, 0.0));
}

#[test]
fn atan2() {
    checks::atan2(Real::atan2);
}

#[test]
fn roots_and_differences() {
    let mut random = Random::new(3);
    let mut root = MeasuredError::of("rsqrt, relative");
    let mut cosine = MeasuredError::of("one_minus_cos, relative");
    let mut difference = MeasuredError::of("difference_of_products, ulp");
    for i in 0..1 << 21 {
        let x = random.magnitude(2.0_f64.powi(-100), 2.0_f64.powi(100)) as f32;
        root.take((f64::from(rsqrt(x)) * f64::from(x).sqrt() - 1.0).abs(), [x, 0.0]);

        let sin_squared = if i % 2 == 0 { random.unit() } else { random.magnitude(1e-30, 1.0) as f32 };
        if sin_squared > 0.0 {
            let s = f64::from(sin_squared);
            let truth = s / (1.0 + (1.0 - s).sqrt());
            // close to s = 1, √(1−s) has infinite slope, but s is exact
            cosine.take((f64::from(one_minus_cos(sin_squared)) / truth - 1.0).abs(), [sin_squared, 0.0]);
        }

        // nearly equal products
        let [a, b, c] = core::array::from_fn(|_| random.range(-1.0, 1.0) as f32);
        let d = if i % 2 == 0 { a * b / c * (1.0 + random.range(-1e-6, 1e-6) as f32) } else { random.unit() };
        // both products have 48 bits; if they are far apart, f64 rounds their difference once, which does not matter
        let truth = f64::from(a) * f64::from(b) - f64::from(c) * f64::from(d);
        let (value, rounded) = (difference_of_products(a, b, c, d), truth.abs() as f32);
        if d.is_finite() && rounded > 1e-30 {
            let ulp = f64::from(f32::from_bits(rounded.to_bits() + 1)) - f64::from(rounded);
            difference.take((f64::from(value) - truth).abs() / ulp, [a, d]);
        }
    }
    root.assert_below(9.0e-8);
    cosine.assert_below(1.1e-7);
    difference.assert_below(1.5);
    assert_eq!((one_minus_cos(0.0_f32), one_minus_cos(1.0_f32)), (0.0, 1.0));
}

/// Every mantissa at three exponents, which cover all cases, and random ones at any exponent.
#[test]
fn cube_root() {
    let mut cube = MeasuredError::of("cbrt, relative");
    let mut random = Random::new(6);
    for i in 0..3 << 23 {
        let x = f32::from_bits(0x3f80_0000 + i);
        cube.take((f64::from(Real::cbrt(x)) / f64::from(x).cbrt() - 1.0).abs(), [x, 0.0]);
        if i % 8 == 0 {
            let x = random.magnitude(1e-30, 3.4e38) as f32;
            cube.take((f64::from(Real::cbrt(x)) / f64::from(x).cbrt() - 1.0).abs(), [x, 0.0]);
        }
    }
    cube.assert_below(7.9e-8);
    assert_eq!([0.0, -0.0, 1e-40, 1.0, 8.0].map(|x: f32| Real::cbrt(x)), [0.0, 0.0, 0.0, 1.0, 2.0]);
    assert!(Real::cbrt(f32::MAX).is_finite() && Real::cbrt(f32::MIN_POSITIVE) > 0.0);
}

/// Relative errors, except where the result is 0 or 1.
#[test]
fn exponentials_and_logarithms() {
    let mut random = Random::new(4);
    let [mut exp, mut exp_m1, mut ln_1p] = ["exp", "exp_m1", "ln_1p"].map(MeasuredError::of);
    for i in 0..1 << 22 {
        let magnitude = random.magnitude(1e-30, 87.0) as f32;
        let x = if i % 2 == 0 { -magnitude } else { magnitude };
        let wide = f64::from(x);
        exp.take((f64::from(Real::exp(x)) / wide.exp() - 1.0).abs(), [x, 0.0]);
        exp_m1.take((f64::from(Real::exp_m1(x)) / wide.exp_m1() - 1.0).abs(), [x, 0.0]);
        let x = match i % 4 {
            0 => -random.unit(),
            1 => -(random.magnitude(1e-30, 1.0) as f32),
            2 => random.magnitude(1e-30, 1e30) as f32,
            _ => random.unit_f64() as f32,
        };
        if x > -1.0 {
            let truth = f64::from(x).ln_1p();
            ln_1p.take(if x == 0.0 { 0.0 } else { (f64::from(Real::ln_1p(x)) / truth - 1.0).abs() }, [x, 0.0]);
        }
    }
    exp.assert_below(8.2e-8);
    exp_m1.assert_below(1.2e-7);
    ln_1p.assert_below(1.3e-7);
    assert_eq!([-1e30_f32, -100.0, -0.0, 0.0].map(Real::exp), [0.0, 0.0, 1.0, 1.0]);
    assert_eq!([-1e30_f32, -0.0, 0.0].map(Real::exp_m1), [-1.0, 0.0, 0.0]);
    assert!(Real::exp(1e30_f32).is_finite() && Real::exp_m1(1e30_f32).is_finite());
    assert_eq!(Real::ln_1p(0.0_f32), 0.0);
}

#[test]
fn normal_distribution() {
    use core::f64::consts::FRAC_1_SQRT_2;
    let phi = |z: f64| 0.5 * statrs::function::erf::erfc(-z * FRAC_1_SQRT_2);
    let mut random = Random::new(5);
    let mut cdf = MeasuredError::of("normal_cdf, relative, to 1e-37");
    for i in 0..1 << 20 {
        let z = (if i % 2 == 0 { random.range(-12.8, 6.0) } else { -random.magnitude(1e-30, 12.8) }) as f32;
        cdf.take((f64::from(Real::normal_cdf(z)) / phi(f64::from(z)) - 1.0).abs(), [z, 0.0]);
    }
    cdf.assert_below(3.9e-7);
    assert_eq!([-1e30_f32, -30.0, 0.0, 30.0, 1e30].map(Real::normal_cdf), [0.0, 0.0, 0.5, 1.0, 1.0]);
    // every possible u: single precision against double, and double against its own integral
    let mut quantile = MeasuredError::of("normal_quantile, relative");
    let mut statrs = MeasuredError::of("the same by statrs");
    let mut double = MeasuredError::of("normal_quantile in double precision, Φ(z)/u − 1");
    for i in (0..1 << 24).step_by(8) {
        let u = f32x8::from_fn(|k| (i + k) as f32 / 16_777_216.0);
        let z = u.normal_quantile();
        for k in 0..8 {
            let (u, z) = (u.lane(k), z.lane_f64(k));
            let truth = Real::normal_quantile(f64::from(u));
            quantile.take(if truth == 0.0 { z.abs() } else { (z / truth - 1.0).abs() }, [u, z as f32]);
            if u > 0.0 && (i + k) % 16 == 0 {
                let (tail, z) = if u > 0.5 { (1.0 - f64::from(u), -truth) } else { (f64::from(u), truth) };
                // `libm`'s integral; that of `statrs` is only accurate to 1e-10
                double.take((Real::normal_cdf(z) / tail - 1.0).abs(), [u, z as f32]);
                statrs.take((phi(z) / tail - 1.0).abs(), [u, z as f32]);
            }
        }
    }
    quantile.assert_below(3.3e-7);
    for (g, allowed) in [(double, 1e-14), (statrs, 2e-10)] {
        assert!(g.greatest.error() < allowed, "{}: {:?}", g.name, g.greatest);
    }
    let ends = [0.0, 1.0].map(|u: f32| Real::normal_quantile(u));
    assert!(ends[0] == -ends[1] && (ends[1] - 5.42).abs() < 0.01, "{ends:?}");
}
