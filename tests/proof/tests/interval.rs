//! Interval arithmetic encloses the exact results, which integers of 128 bits give here, and no interval is wider than it must be.

use etendue_oracle::Random;
use etendue_oracle::double_double::Dd;
use etendue_proof::{Interval, affine::Affine};

/// A number as an integer times a power of two.
fn parts(x: f64) -> (i128, i32) {
    let bits = x.to_bits();
    let exponent = (bits >> 52 & 0x7ff) as i32;
    let fraction = i128::from(bits & ((1 << 52) - 1));
    let (magnitude, exponent) = if exponent == 0 { (fraction, -1074) } else { (fraction | 1 << 52, exponent - 1075) };
    (if x < 0.0 { -magnitude } else { magnitude }, exponent)
}
/// Compares two such numbers exactly.
fn is_at_most(a: (i128, i32), b: (i128, i32)) -> bool {
    if a.0 == 0 || b.0 == 0 || (a.0 < 0) != (b.0 < 0) {
        return a.0.signum() <= b.0.signum();
    }
    let by = a.1 - b.1;
    let shifted = |x: i128, by: i32| x.checked_shl(by as u32).filter(|y| by < 127 && y >> by == x);
    if by >= 0 {
        // too great to shift: greater in magnitude
        shifted(a.0, by).map_or(a.0 < 0, |a| a <= b.0)
    } else {
        shifted(b.0, -by).map_or(b.0 > 0, |b| a.0 <= b)
    }
}
fn times(a: (i128, i32), b: (i128, i32)) -> (i128, i32) {
    (a.0 * b.0, a.1 + b.1)
}
fn plus(a: (i128, i32), b: (i128, i32)) -> (i128, i32) {
    let least = a.1.min(b.1);
    ((a.0 << (a.1 - least)) + (b.0 << (b.1 - least)), least)
}

/// Numbers of all signs, magnitudes up to 2^±`reach`, and few or many digits.
struct Numbers(Random, i32);
impl Numbers {
    fn next(&mut self) -> f64 {
        let (bits, reach) = (self.0.word(), self.1);
        let digits = self.0.word() % 53;
        let fraction = (bits & ((1 << 52) - 1)) >> digits << digits;
        let exponent = (self.0.word() % (2 * reach as u64 + 1)) as i32 - reach;
        let x = f64::from_bits(fraction | 1023 << 52) * f64::powi(2.0, exponent);
        if bits >> 63 == 1 { -x } else { x }
    }
}

/// At most one step on each side of the nearest number.
fn is_tight(x: Interval) -> bool {
    x.lo == x.hi || x.lo.next_up() == x.hi
}

#[test]
fn sums_and_products_of_numbers() {
    let mut numbers = Numbers(Random(1), 30);
    for _ in 0..1_000_000 {
        let (a, b) = (numbers.next(), numbers.next());
        let [x, y] = [a, b].map(Interval::point);
        for (found, exact) in
            [(x + y, plus(parts(a), parts(b))), (x - y, plus(parts(a), parts(-b))), (x * y, times(parts(a), parts(b)))]
        {
            let ends = [parts(found.lo), parts(found.hi)];
            assert!(
                is_at_most(ends[0], exact) && is_at_most(exact, ends[1]) && is_tight(found),
                "{a:e} {b:e}: {found:?}"
            );
        }
    }
}
#[test]
fn quotients_and_roots_of_numbers() {
    let mut numbers = Numbers(Random(2), 30);
    for _ in 0..1_000_000 {
        let (a, b) = (numbers.next(), numbers.next().abs());
        let quotient = Interval::point(a) / Interval::point(b);
        // q ≤ a/b if qb ≤ a
        let [lo, hi] = [quotient.lo, quotient.hi].map(|q| times(parts(q), parts(b)));
        assert!(
            is_at_most(lo, parts(a)) && is_at_most(parts(a), hi) && is_tight(quotient),
            "{a:e}/{b:e}: {quotient:?}"
        );
        let negative = Interval::point(a) / Interval::point(-b);
        assert_eq!(negative, -quotient);
        let root = Interval::point(b).sqrt().unwrap();
        let [lo, hi] = [root.lo, root.hi].map(|r| times(parts(r), parts(r)));
        assert!(is_at_most(lo, parts(b)) && is_at_most(parts(b), hi) && is_tight(root), "√{b:e}: {root:?}");
    }
}
#[test]
fn intervals_enclose_the_results_of_all_their_numbers() {
    let mut numbers = Numbers(Random(3), 8);
    for _ in 0..200_000 {
        let mut interval = || {
            let (a, b) = (numbers.next(), numbers.next());
            (Interval::new(a.min(b), a.max(b)), a.min(b) + (a - b).abs() * 0.37)
        };
        let ((x, a), (y, b)) = (interval(), interval());
        assert!((x + y).contains(a + b) && (x - y).contains(a - b) && (x * y).contains(a * b), "{x:?} {y:?}");
        assert!((x / y).contains(a / b) && x.square().contains(a * a) && x.abs().contains(a.abs()), "{x:?} {y:?}");
        assert!(x.lesser(y).contains(a.min(b)) && x.greater(y).contains(a.max(b)) && x.hull(y).contains(b));
        assert!(x.sqrt().is_none_or(|root| root.contains(a.sqrt())) && x.sqrt().is_some() == (x.lo >= 0.0));
        assert!(x.atan().contains(a.atan()) && y.contains(0.0) != (x / y).is_finite());
        let turns = Interval::new(x.lo / 64.0, x.hi / 64.0);
        let [sin, cos] = turns.sin_cos_turns();
        let (s, c) = (core::f64::consts::TAU * (a / 64.0)).sin_cos();
        assert!(sin.widened(1e-15).contains(s) && cos.widened(1e-15).contains(c), "{turns:?}");
    }
}
/// Against twice the precision.
#[test]
fn the_ends_of_sines_are_outside() {
    for i in 0..10_000 {
        let u = f64::from(i) / 20_011.0;
        let x = Dd::from(core::f64::consts::TAU) * Dd::from(u) + Dd::from(2.449_293_598_294_706_4e-16) * Dd::from(u);
        let (sin, cos) = x.sin_cos();
        let [s, c] = Interval::point(u).sin_cos_turns();
        for (found, truth) in [(s, sin), (c, cos)] {
            let below = (truth - Dd::from(found.lo)).to_f64();
            let above = (Dd::from(found.hi) - truth).to_f64();
            assert!(below >= 0.0 && above >= 0.0 && found.hi - found.lo < 1e-14, "{u}: {found:?}");
        }
    }
}
#[test]
fn overflow_and_underflow_are_enclosed() {
    let (most, least) = (Interval::point(f64::MAX), Interval::point(f64::from_bits(1)));
    assert_eq!((most + most).hi, f64::INFINITY);
    assert!((most + most).lo == f64::MAX && (most * most).lo == f64::MAX && (-most - most).hi == -f64::MAX);
    let tiny = least * least;
    assert!(tiny.lo == 0.0 && tiny.hi > 0.0 && (least / most).hi > 0.0);
    assert_eq!(Interval::point(1.0) / Interval::new(-1.0, 1.0), Interval::ALL);
    assert_eq!(Interval::point(-1e-300).sqrt(), None);
}

/// A polynomial of two parameters, by affine forms: it contains the values, and cancels what intervals do not.
#[test]
fn affine_forms_enclose_and_cancel() {
    let mut numbers = Numbers(Random(5), 2);
    for _ in 0..20_000 {
        let (a, b, w) = (numbers.next(), numbers.next(), 1e-3);
        let ranges = [Interval::new(a - w, a + w), Interval::new(b - w, b + w)];
        let [x, y] = [0, 1].map(|j| Affine::parameter(ranges[j], j));
        let f = x.times(&y).plus(&x.times(&x).negative()).plus(&x).plus(&x.negative());
        let at = |s: f64, t: f64| {
            let (x, y) = (a + s * w, b + t * w);
            x * y - x * x
        };
        let range = f.range().widened(1e-12);
        for (s, t) in [(0.0, 0.0), (1.0, 1.0), (-1.0, 1.0), (0.3, -0.9), (-1.0, -1.0)] {
            assert!(range.contains(at(s, t)), "{range:?} lacks {}", at(s, t));
        }
        // the slopes are exact: what is left is of second order
        let width = 2.0 * w * ((b - 2.0 * a).abs() + a.abs());
        assert!(range.hi - range.lo <= width + 10.0 * w * w, "{range:?} is wider than {width}");
    }
}
