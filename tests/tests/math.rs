//! Functions of two and four arguments, double precision, and exact values. `exhaustive` has the errors of functions of one argument.
//! `-- --nocapture` prints the figures that the second table in `core/src/math.rs` rounds up.

use etendue::math::{difference_of_products, one_minus_cos};
use etendue::real::SAME_BITS;
use etendue::{Real, f32x8, f64x4, f64x8};
use etendue_judge::checks::{self, MeasuredError};
use etendue_judge::generators::Random;
use etendue_oracle::tier::cases;

/// Sine and cosine of all multiples of 2⁻²⁴ make a vector of length 1, and are exact at quarters.
#[test]
fn sin_cos_turns() {
    let mut unit = MeasuredError::of("sin² + cos² − 1");
    for i in (0..1 << 24).step_by(8) {
        let u = f32x8::from_fn(|k| (i + k) as f32 / 16_777_216.0);
        let (s, c) = u.sin_cos_turns();
        for k in 0..8 {
            let (s, c) = (s.lane_f64(k), c.lane_f64(k));
            unit.take((s * s + c * c - 1.0).abs(), [u.lane(k), 0.0]);
        }
    }
    unit.assert_below(if SAME_BITS { 1.9e-7 } else { 2.1e-7 });
    for (u, s, c) in [(0.0, 0.0, 1.0), (0.25, 1.0, 0.0), (0.5, 0.0, -1.0), (0.75, -1.0, 0.0), (1.0, 0.0, 1.0)] {
        let (sin, cos) = Real::sin_cos_turns(u as f32);
        assert!(sin == s && cos == c, "{u}: {sin} {cos}");
    }
}

#[test]
fn atan2() {
    checks::atan2(Real::atan2);
}
/// In double precision angles have the bits of `libm`, among edges and at random in all ranges; where y is more than 10¹⁸ times x they are π/2,
/// and 0 at the origin.
#[test]
fn atan2_is_that_of_libm() {
    fn check<R: Real<Scalar = f64>>(y: &[f64], x: &[f64]) {
        for (y, x) in y.chunks_exact(R::LANES).zip(x.chunks_exact(R::LANES)) {
            let found = R::from_fn(|i| y[i]).atan2(R::from_fn(|i| x[i]));
            for i in 0..R::LANES {
                let (found, alone) = (found.lane(i), Real::atan2(y[i], x[i]));
                let truth = match (y[i], x[i]) {
                    (y, x) if (y / x).abs() >= 1e18 => core::f64::consts::FRAC_PI_2.copysign(y),
                    (y, 0.0) if y == 0.0 => y,
                    (y, x) => libm::atan2(y, x),
                };
                assert!(found.to_bits() == alone.to_bits() || found.is_nan() && alone.is_nan());
                let same = found.to_bits() == truth.to_bits() || found.is_nan() && truth.is_nan();
                assert!(same, "atan2({:e}, {:e}) is {found:e} and not {truth:e}", y[i], x[i]);
            }
        }
    }
    let beside = |x: f64| [x.next_down(), x, x.next_up()];
    let steps = [0.4375, 0.6875, 1.0, 1.1875, 2.4375, 1e-300, 1e18, 2f64.powi(-60), 2f64.powi(64)];
    let ends = [0.0, f64::from_bits(1), f64::MIN_POSITIVE, f64::MAX, f64::INFINITY, f64::NAN];
    let positive: Vec<f64> = steps.into_iter().flat_map(beside).chain(ends).collect();
    let edges: Vec<f64> = positive.iter().flat_map(|&x| [x, -x]).collect();
    let (mut y, mut x) = (Vec::new(), Vec::new());
    for &a in &edges {
        for &b in &edges {
            y.push(a);
            x.push(b);
        }
    }
    let mut random = Random::new(5);
    for i in 0..cases(1_000_000, 30_000_000) {
        let mut number = || match i % 3 {
            0 => f64::from_bits(random.word()),
            1 => random.range(-3.0, 3.0),
            _ => random.range(-1.0, 1.0) * random.range(-30.0, 30.0).exp2(),
        };
        y.push(number());
        x.push(number());
        if y.len() == 1 << 16 {
            check::<f64x4>(&y, &x);
            check::<f64x8>(&y, &x);
            y.clear();
            x.clear();
        }
    }
    check::<f64x4>(&y, &x);
    check::<f64x8>(&y, &x);
}

/// Of nearly equal products, and of others.
#[test]
fn differences() {
    let mut random = Random::new(3);
    let mut difference = MeasuredError::of("difference_of_products, ulp");
    for i in 0..1 << 21 {
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
    difference.assert_below(if SAME_BITS { 1.5 } else { 1.0 });
}

#[test]
fn exact_values() {
    assert_eq!([1.0_f32, 2.0].map(Real::acos), [0.0, 0.0]);
    assert_eq!([0.0_f32, 1.0].map(one_minus_cos), [0.0, 1.0]);
    assert_eq!([0.0, -0.0, 1e-40, 1.0, 8.0].map(|x: f32| Real::cbrt(x)), [0.0, 0.0, 0.0, 1.0, 2.0]);
    // hardware and compilers give the NaNs that they compute either sign
    let nans = f32x8::from_fn(|k| if k % 2 == 0 { f32::NAN } else { -f32::NAN });
    assert_eq!([f32::NAN, -f32::NAN, -1.0].map(|sign| Real::copysign(2.0_f32, sign)), [2.0, 2.0, -2.0]);
    assert_eq!(Real::copysign(f32x8::lit(2.0), nans).to_array(), [2.0; 8]);
}
