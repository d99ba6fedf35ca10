//! Intervals of real numbers with ends in double precision, rounded outwards.

use core::ops::{Add, Div, Mul, Neg, Sub};

/// All real numbers from `lo` to `hi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Lower end.
    pub lo: f64,
    /// Upper end.
    pub hi: f64,
}

/// Below this magnitude the error of a product may not fit double precision, so that its sign is unknown.
const TINY: f64 = 1e-280;

/// The numbers next to `x` below and above that enclose a real number of which `x` is the rounded value and `error` has the sign of its
/// difference from `x`.
fn enclose(x: f64, error: f64) -> [f64; 2] {
    if error.is_nan() {
        [f64::NEG_INFINITY, f64::INFINITY]
    } else {
        [if error < 0.0 { x.next_down() } else { x }, if error > 0.0 { x.next_up() } else { x }]
    }
}

/// As `enclose`, where the sign of the error is only known for a result that is not tiny.
fn enclose_product(x: f64, error: f64, exact_zero: bool) -> [f64; 2] {
    if exact_zero {
        [0.0; 2]
    } else if x.abs() < TINY {
        [x.next_down(), x.next_up()]
    } else {
        enclose(x, error)
    }
}

fn sum(a: f64, b: f64) -> [f64; 2] {
    let s = a + b;
    if s.is_infinite() {
        // an infinite end is an end already; an overflow is one on one side
        return if a.is_infinite() || b.is_infinite() { [s, s] } else { overflow(s) };
    }
    let other = s - a;
    enclose(s, (a - (s - other)) + (b - other))
}
fn overflow(s: f64) -> [f64; 2] {
    if s > 0.0 { [f64::MAX, s] } else { [s, f64::MIN] }
}
fn product(a: f64, b: f64) -> [f64; 2] {
    if a == 0.0 || b == 0.0 {
        // also for an infinite end, which stands for finite numbers without a bound
        return [0.0; 2];
    }
    let p = a * b;
    if p.is_infinite() {
        return if a.is_infinite() || b.is_infinite() { [p, p] } else { overflow(p) };
    }
    enclose_product(p, a.mul_add(b, -p), false)
}
fn quotient(a: f64, b: f64) -> [f64; 2] {
    if a == 0.0 || b.is_infinite() && a.is_finite() {
        return [0.0; 2];
    }
    let q = a / b;
    if q.is_infinite() {
        return if a.is_infinite() { [q, q] } else { overflow(q) };
    }
    if a.abs() < TINY {
        return [q.next_down(), q.next_up()];
    }
    // the remainder a − qb has the sign of the error times that of b
    let remainder = (-q).mul_add(b, a);
    enclose_product(q, if b < 0.0 { -remainder } else { remainder }, false)
}

impl Interval {
    /// All real numbers.
    pub const ALL: Self = Self { lo: f64::NEG_INFINITY, hi: f64::INFINITY };
    /// The numbers from `lo` to `hi`.
    #[must_use]
    pub const fn new(lo: f64, hi: f64) -> Self {
        Self { lo, hi }
    }
    /// One number.
    #[must_use]
    pub const fn point(x: f64) -> Self {
        Self { lo: x, hi: x }
    }
    /// The numbers whose magnitude is at most `x`.
    #[must_use]
    pub const fn within(x: f64) -> Self {
        Self { lo: -x, hi: x }
    }
    /// True if it consists of one number.
    #[must_use]
    pub fn is_point(self) -> bool {
        self.lo == self.hi
    }
    /// True if it has finite ends in order.
    #[must_use]
    pub fn is_finite(self) -> bool {
        self.lo <= self.hi && self.lo.is_finite() && self.hi.is_finite()
    }
    /// True if it contains `x`.
    #[must_use]
    pub fn contains(self, x: f64) -> bool {
        self.lo <= x && x <= self.hi
    }
    /// The greatest magnitude.
    #[must_use]
    pub fn greatest(self) -> f64 {
        self.lo.abs().max(self.hi.abs())
    }
    /// The least magnitude.
    #[must_use]
    pub fn least(self) -> f64 {
        if self.contains(0.0) { 0.0 } else { self.lo.abs().min(self.hi.abs()) }
    }
    /// The least interval that contains both.
    #[must_use]
    pub fn hull(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }
    /// The numbers that are in both; `None` if there are none.
    #[must_use]
    pub fn intersection(self, other: Self) -> Option<Self> {
        let both = Self { lo: self.lo.max(other.lo), hi: self.hi.min(other.hi) };
        (both.lo <= both.hi).then_some(both)
    }
    /// All numbers within `by` of one of its own.
    #[must_use]
    pub fn widened(self, by: f64) -> Self {
        Self { lo: sum(self.lo, -by)[0], hi: sum(self.hi, by)[1] }
    }
    /// Absolute values.
    #[must_use]
    pub fn abs(self) -> Self {
        Self { lo: self.least(), hi: self.greatest() }
    }
    /// The lesser of a number of each.
    #[must_use]
    pub fn lesser(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.min(other.hi) }
    }
    /// The greater of a number of each.
    #[must_use]
    pub fn greater(self, other: Self) -> Self {
        Self { lo: self.lo.max(other.lo), hi: self.hi.max(other.hi) }
    }
    /// Squares.
    #[must_use]
    pub fn square(self) -> Self {
        let (least, greatest) = (self.least(), self.greatest());
        Self { lo: product(least, least)[0].max(0.0), hi: product(greatest, greatest)[1] }
    }
    /// Square roots; `None` if there are negative numbers.
    #[must_use]
    pub fn sqrt(self) -> Option<Self> {
        let root = |x: f64| {
            let r = x.sqrt();
            if x.is_infinite() {
                [f64::MAX, x]
            } else if x < TINY && x > 0.0 {
                [r.next_down(), r.next_up()]
            } else {
                enclose(r, (-r).mul_add(r, x))
            }
        };
        (self.lo >= 0.0).then(|| Self { lo: root(self.lo)[0], hi: root(self.hi)[1] })
    }
    /// sin 2πx and cos 2πx. The ends are those of `libm`, whose error is below 1 ulp, moved by 2⁻⁵⁰.
    #[must_use]
    pub fn sin_cos_turns(self) -> [Self; 2] {
        const BEYOND_LIBM: f64 = 1.0 / (1_u64 << 50) as f64;
        let wave = |shift: f64| {
            // extrema of cos 2π(x − shift) are at multiples of a half turn
            let (from, to) = (2.0 * (self.lo - shift), 2.0 * (self.hi - shift));
            let at = |x: f64| libm::cos(core::f64::consts::TAU * (x - shift));
            let (mut lo, mut hi) = (at(self.lo).min(at(self.hi)), at(self.lo).max(at(self.hi)));
            if !(self.lo.abs() <= 4.0 && self.hi.abs() <= 4.0) {
                return Self::new(-1.0, 1.0);
            }
            for k in (from - 1e-9).ceil() as i32..=(to + 1e-9).floor() as i32 {
                if k % 2 == 0 { hi = 1.0 } else { lo = -1.0 }
            }
            Self::new((lo - BEYOND_LIBM).max(-1.0), (hi + BEYOND_LIBM).min(1.0))
        };
        [wave(0.25), wave(0.0)]
    }
    /// Arc tangents. The ends are those of `libm`, whose error is below 1 ulp, moved by 2 ulp.
    #[must_use]
    pub fn atan(self) -> Self {
        Self { lo: libm::atan(self.lo).next_down().next_down(), hi: libm::atan(self.hi).next_up().next_up() }
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self { lo: sum(self.lo, o.lo)[0], hi: sum(self.hi, o.hi)[1] }
    }
}
impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Self { lo: -self.hi, hi: -self.lo }
    }
}
impl Sub for Interval {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        self + -o
    }
}
impl Mul for Interval {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        let ends = [product(self.lo, o.lo), product(self.lo, o.hi), product(self.hi, o.lo), product(self.hi, o.hi)];
        let (lo, hi) = ends.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), e| (lo.min(e[0]), hi.max(e[1])));
        // the product of numbers that are not negative is not negative, however tiny
        let same = self.lo >= 0.0 && o.lo >= 0.0 || self.hi <= 0.0 && o.hi <= 0.0;
        let opposite = self.lo >= 0.0 && o.hi <= 0.0 || self.hi <= 0.0 && o.lo >= 0.0;
        Self { lo: if same { lo.max(0.0) } else { lo }, hi: if opposite { hi.min(0.0) } else { hi } }
    }
}
impl Div for Interval {
    type Output = Self;
    /// All real numbers where the divisor contains 0.
    fn div(self, o: Self) -> Self {
        if o.contains(0.0) || o.lo > o.hi || o.lo.is_nan() || o.hi.is_nan() {
            return Self::ALL;
        }
        let ends = [quotient(self.lo, o.lo), quotient(self.lo, o.hi), quotient(self.hi, o.lo), quotient(self.hi, o.hi)];
        let (lo, hi) = ends.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), e| (lo.min(e[0]), hi.max(e[1])));
        let same = self.lo >= 0.0 && o.lo > 0.0 || self.hi <= 0.0 && o.hi < 0.0;
        let opposite = self.lo >= 0.0 && o.hi < 0.0 || self.hi <= 0.0 && o.lo > 0.0;
        Self { lo: if same { lo.max(0.0) } else { lo }, hi: if opposite { hi.min(0.0) } else { hi } }
    }
}
