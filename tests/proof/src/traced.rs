//! The number type that proves: an interval with the record of its rounding errors.

use crate::affine::Affine;
use crate::interval::Interval;
use crate::tape::{self, EXACT, Side, Wave};
use core::f64::consts::TAU;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};
use etendue::Real;
use std::cell::Cell;
use std::cmp::Ordering;

/// A number of single precision that a routine computes: all values that it can have while its parameters are anywhere in a box.
///
/// Nothing is known of the results of functions that have no lemma in [`lemmas`](crate::lemmas): these are all real numbers.
#[derive(Clone, Copy, Debug)]
pub struct Traced {
    /// What is computed.
    computed: Interval,
    /// The computed numbers, the exact ones and all between.
    between: Interval,
    /// The same by the parameters.
    form: Affine,
    /// The computed numbers are multiples of 2 to this power.
    grid: i32,
    /// The number in exact arithmetic up to the rounding of double precision, if the box is a point.
    exact: f64,
    node: u32,
    /// Equal names are equal numbers.
    name: u32,
    /// The names of the factors, if it is a product.
    factors: [u32; 2],
    /// The name of a number that is not less, since this is its product with one in [0, 1], rounded.
    at_most: u32,
}

/// Errors of elementary functions, which the lemmas prove for all arguments.
pub mod limits {
    /// The greatest error at x: an absolute one, and one times |x| where x is not subnormal. Both hold.
    #[derive(Clone, Copy, Debug)]
    pub struct Error {
        /// The greatest error.
        pub absolute: f64,
        /// The greatest error over |x|.
        pub slope: f64,
    }
    impl Error {
        /// The greatest error up to this argument.
        #[must_use]
        pub fn at(self, most: f64) -> f64 {
            self.absolute.min((self.slope * most.max(f64::from(f32::MIN_POSITIVE))).next_up())
        }
    }
    /// The errors of a sine and a cosine: each, and as a vector.
    #[derive(Clone, Copy, Debug)]
    pub struct WaveError {
        /// Error of the sine.
        pub sin: Error,
        /// Error of the cosine.
        pub cos: Error,
        /// The component of both along the true (cos, sin): the error of the length.
        pub along: Error,
        /// The component across: the error of the angle in radians.
        pub across: Error,
    }
    /// Sine and cosine of x turns, x in [0, 1].
    pub const TURNS: WaveError = WaveError {
        sin: Error { absolute: 8.5e-8, slope: 8.5e-7 },
        cos: Error { absolute: 8.5e-8, slope: f64::INFINITY },
        along: Error { absolute: 9.6e-8, slope: f64::INFINITY },
        across: Error { absolute: 8.5e-8, slope: 9.8e-7 },
    };
    /// Greatest argument in quarter turns. The routines need ½, but intervals exceed it.
    pub const MOST_QUARTERS: f64 = 0.51;
    /// Sine and cosine of x quarter turns, |x| at most [`MOST_QUARTERS`].
    pub const QUARTERS: WaveError = WaveError {
        sin: Error { absolute: 8.5e-8, slope: 2.1e-7 },
        cos: Error { absolute: 7.0e-8, slope: f64::INFINITY },
        along: Error { absolute: 9.8e-8, slope: f64::INFINITY },
        across: Error { absolute: 8.5e-8, slope: 2.5e-7 },
    };
    /// Greatest argument of the arc tangent: a little more than tan(π/8).
    pub const EIGHTH: f64 = 0.42;
    /// Arc tangent of x, |x| at most [`EIGHTH`].
    pub const ATAN_EIGHTH: Error = Error { absolute: 6e-8, slope: 1.2e-7 };
}

/// A defect to plant, so that a proof must fail.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Defect {
    /// None.
    #[default]
    None,
    /// A constant of this value has a wrong digit: it is greater by this part of itself.
    Constant {
        /// The right value.
        value: f64,
        /// The relative error.
        off: f64,
    },
    /// The n-th call of `clamped`, `lesser` or `greater` returns its argument.
    NoClamp(u32),
    /// Rounding counts as half as large as it is.
    HalfRounding,
    /// Intervals are rounded inwards.
    Inwards,
}
thread_local! {
    static DEFECT: Cell<Defect> = const { Cell::new(Defect::None) };
    static CLAMPS: Cell<u32> = const { Cell::new(0) };
    static NAMES: Cell<u32> = const { Cell::new(0) };
}
fn new_name() -> u32 {
    NAMES.set(NAMES.get().wrapping_add(1).max(1));
    NAMES.get()
}
/// Plants a defect in all routines that this thread traces from now on.
pub fn plant(defect: Defect) {
    DEFECT.set(defect);
    CLAMPS.set(0);
}
/// The defect that is planted.
#[must_use]
pub fn planted() -> Defect {
    DEFECT.get()
}
/// Begins to count clamps anew: for each run of a routine.
pub(crate) fn begin() {
    CLAMPS.set(0);
}
fn clamp_is_missing() -> bool {
    let Defect::NoClamp(n) = DEFECT.get() else { return false };
    CLAMPS.set(CLAMPS.get() + 1);
    CLAMPS.get() == n
}

/// Half the distance between numbers of single precision about `magnitude`, rounded up.
fn half_ulp(magnitude: f64) -> f64 {
    if magnitude < f64::from(f32::MIN_POSITIVE) {
        return 0.5 * f64::from(f32::from_bits(1));
    }
    if magnitude >= 2.0 * f64::powi(2.0, 127) - f64::powi(2.0, 103) {
        return f64::INFINITY;
    }
    let binade = f64::from_bits(magnitude.to_bits() & 0x7ff0_0000_0000_0000);
    let half = binade / 16_777_216.0;
    if DEFECT.get() == Defect::HalfRounding { 0.5 * half } else { half }
}
fn floor_log2(x: f64) -> i32 {
    (x.to_bits() >> 52 & 0x7ff) as i32 - 1023
}
/// The exponent of the grid on which all numbers of single precision of at least this magnitude lie.
fn grid_from(least: f64) -> i32 {
    if least < f64::from(f32::MIN_POSITIVE) { -149 } else { floor_log2(least) - 23 }
}
fn is_power_of_two(x: f64) -> bool {
    x.is_normal() && x.to_bits() & ((1 << 52) - 1) == 0
}

impl Traced {
    fn new(computed: Interval, between: Interval, exact: f64, node: u32) -> Self {
        Self::formed(computed, between, Affine::anywhere(between), exact, node)
    }
    /// A number with a form, which may narrow its intervals.
    fn formed(computed: Interval, between: Interval, form: Affine, exact: f64, node: u32) -> Self {
        let between = between.intersection(form.range()).unwrap_or(between);
        let computed = computed.intersection(between).unwrap_or(computed);
        let grid = grid_from(computed.least());
        Self { computed, between, form, grid, exact, node, name: new_name(), factors: [0; 2], at_most: 0 }
    }
    /// The parameter of this index: all numbers of single precision from `lo` to `hi`.
    #[must_use]
    pub fn range(lo: f32, hi: f32, index: usize) -> Self {
        let all = Interval::new(f64::from(lo), f64::from(hi));
        Self::formed(all, all, Affine::parameter(all, index), all.lo, EXACT)
    }
    /// The parameter of this index: all multiples of 2⁻²⁴ between two of them.
    #[must_use]
    pub fn steps(from: u32, to: u32, index: usize) -> Self {
        let step = 1.0 / 16_777_216.0;
        let all = Interval::new(f64::from(from) * step, f64::from(to) * step);
        Self { grid: -24, ..Self::formed(all, all, Affine::parameter(all, index), all.lo, EXACT) }
    }
    /// A constant that is no parameter.
    fn constant(x: f64) -> Self {
        let point = Interval::point(x);
        let grid = if x == 0.0 || !x.is_finite() {
            i32::MAX / 4
        } else {
            (floor_log2(x.abs()) - 52 + x.to_bits().trailing_zeros().min(52) as i32).max(-149)
        };
        Self { grid, ..Self::new(point, point, x, EXACT) }
    }
    /// A number of which nothing is known.
    fn unknown() -> Self {
        Self::new(Interval::ALL, Interval::ALL, f64::NAN, tape::push(&[], f64::INFINITY))
    }
    /// All numbers that the routine can compute.
    #[must_use]
    pub fn computed(self) -> Interval {
        self.computed
    }
    /// The computed numbers, the exact ones and all between.
    #[must_use]
    pub fn between(self) -> Interval {
        self.between
    }
    /// A bound of |computed − exact|; infinite if there is none.
    #[must_use]
    pub fn error(self) -> f64 {
        if self.computed.is_finite() { tape::error(self.node) } else { f64::INFINITY }
    }
    /// Whether what a routine computes at a point is where it must be: within the intervals, and no farther from the exact number than
    /// the bound of the error.
    #[must_use]
    pub fn encloses(self, computed: f64) -> bool {
        let slack = 1e-12 * self.exact.abs() + 1e-30;
        self.computed.contains(computed)
            && self.between.contains(computed)
            && self.between.widened(slack).contains(self.exact)
            && (computed - self.exact).abs() <= self.error() + slack
    }
    /// The number in exact arithmetic up to the rounding of double precision, if all parameters are points.
    #[must_use]
    pub fn exact(self) -> f64 {
        self.exact
    }

    /// The rounded result of an operation. `computed` and `between` enclose the operation in exact arithmetic on such operands.
    fn rounded(
        [computed, between]: [Interval; 2],
        form: Affine,
        is_exact: bool,
        grid: i32,
        exact: f64,
        push: impl FnOnce(f64) -> u32,
    ) -> Self {
        let between = between.intersection(form.range()).unwrap_or(between);
        let computed = computed.intersection(between).unwrap_or(computed);
        if !computed.is_finite() || !between.is_finite() {
            return Self { exact, ..Self::unknown() };
        }
        let fits = computed.is_point() && f64::from(computed.lo as f32) == computed.lo;
        let noise = if is_exact || fits { 0.0 } else { half_ulp(computed.greatest()) };
        if noise.is_infinite() {
            return Self { exact, ..Self::unknown() };
        }
        let node = push(noise);
        if noise == 0.0 {
            let sum = Self::formed(computed, between, form, exact, node);
            return Self { grid: grid.max(sum.grid), ..sum };
        }
        // rounding to the nearest is monotone
        let rounded = Interval::new(f64::from(computed.lo as f32), f64::from(computed.hi as f32));
        if DEFECT.get() == Defect::Inwards {
            return Self::formed(rounded, between.widened(-noise), form, exact, node);
        }
        Self::formed(rounded, between.widened(noise).hull(rounded), form.widened(noise), exact, node)
    }
    /// True if numbers on this grid up to this magnitude are numbers of single precision.
    fn fits(grid: i32, magnitude: f64) -> bool {
        grid >= -149 && (grid >= 200 || magnitude <= f64::powi(2.0, grid + 24))
    }
    fn times(self, o: Self, addend: Option<Self>) -> Self {
        let zero = Interval::point(0.0);
        let product = |a: Interval, b: Interval| if a == zero || b == zero { zero } else { a * b };
        let mut computed = product(self.computed, o.computed);
        let mut between = product(self.between, o.between);
        if self.name == o.name {
            (computed, between) = (self.computed.square(), self.between.square());
        }
        let mut grid = self.grid.saturating_add(o.grid);
        let mut exact = self.exact * o.exact;
        let mut form = self.form.times(&o.form);
        if let Some(c) = addend {
            form = form.plus(&c.form);
            (computed, between) = (computed + c.computed, between + c.between);
            grid = grid.min(c.grid);
            exact = self.exact.mul_add(o.exact, c.exact);
        }
        let scaled = |x: Self, by: Self| {
            by.computed.is_point()
                && is_power_of_two(by.computed.lo)
                && addend.is_none()
                && (x.computed.least() * by.computed.lo.abs() >= f64::from(f32::MIN_POSITIVE)
                    || by.computed.lo.abs() >= 1.0)
        };
        let is_exact = Self::fits(grid, computed.greatest()) || scaled(self, o) || scaled(o, self);
        let by = |x: Self, derivative: Interval| (if derivative == zero { EXACT } else { x.node }, derivative);
        let operands = [by(self, o.between), by(o, self.between)];
        let third = addend.map(|c| (c.node, Interval::point(1.0)));
        let operands = [operands[0], operands[1], third.unwrap_or((EXACT, zero))];
        let result =
            Self::rounded([computed, between], form, is_exact, grid, exact, |noise| tape::push(&operands, noise));
        if addend.is_some() {
            return result;
        }
        let shrinks = |x: Self, by: Self| x.computed.lo >= 0.0 && by.computed.lo >= 0.0 && by.computed.hi <= 1.0;
        let at_most = if shrinks(self, o) {
            self.name
        } else if shrinks(o, self) {
            o.name
        } else {
            0
        };
        Self { factors: [self.name, o.name], at_most, ..result }
    }
    /// A number that is one of two, continuous where it changes.
    fn either(self, o: Self, join: fn(Interval, Interval) -> Interval, exact: f64) -> Self {
        let (none, one) = (Interval::point(0.0), Interval::new(0.0, 1.0));
        let by = |x: Self| (x.node, if x.node == EXACT { none } else { one });
        let node = tape::push(&[by(self), by(o)], 0.0);
        let [computed, between] = [join(self.computed, o.computed), join(self.between, o.between)];
        Self { grid: self.grid.min(o.grid), ..Self::new(computed, between, exact, node) }
    }
    /// −δ of a rounded result, which some operations form exactly; `noise` is the error of that.
    fn minus_rounding(of: Self, noise: f64) -> Self {
        let most = tape::noise(of.node);
        if most == 0.0 && noise == 0.0 {
            return Self::constant(0.0);
        }
        let all = Interval::within(most + noise);
        Self::new(all, all, 0.0, tape::push_minus_noise(of.node, noise))
    }
    /// A function of one number that the lemmas prove: its values and derivatives on an interval, and its greatest error.
    fn function(self, values: impl Fn(Interval) -> Interval, derivative: Interval, noise: f64, exact: f64) -> Self {
        if !self.computed.is_finite() || !self.between.is_finite() {
            return Self::unknown();
        }
        let node = tape::push(&[(self.node, derivative)], noise);
        let form = self.form.function(values(Interval::point(self.form.middle())), derivative).widened(noise);
        Self::formed(values(self.computed).widened(noise), values(self.between).widened(noise), form, exact, node)
    }
    /// Sine and cosine of this many times `turns` turns.
    fn wave(self, turns: f64, errors: limits::WaveError) -> (Self, Self) {
        let angle = |x: Interval| x * Interval::point(turns);
        // the nearest number to 2π is less
        let slope = Interval::new(TAU, TAU.next_up()) * Interval::point(turns);
        let most = self.computed.greatest();
        let [sin, cos] = [errors.sin.at(most), errors.cos.at(most)];
        let [s, c] = angle(self.between).sin_cos_turns().map(|x| x.widened(sin.max(cos)));
        let [computed_s, computed_c] = angle(self.computed).sin_cos_turns();
        let wave = Wave { sin: s, cos: c, along: errors.along.at(most), across: errors.across.at(most) };
        let nodes = tape::push_wave(((self.node, c * slope), sin), ((self.node, -(s * slope)), cos), wave);
        let exact = libm::sincos(TAU * turns * self.exact);
        let middle = angle(Interval::point(self.form.middle())).sin_cos_turns();
        let form_s = self.form.function(middle[0], c * slope).widened(sin);
        let form_c = self.form.function(middle[1], -(s * slope)).widened(cos);
        (
            Self::formed(computed_s.widened(sin), s, form_s, exact.0, nodes[0]),
            Self::formed(computed_c.widened(cos), c, form_c, exact.1, nodes[1]),
        )
    }
    fn compare(self, o: Self, strict: bool) -> bool {
        let side = |x: Self| Side { name: x.name, node: x.node, computed: x.computed, exact: x.exact };
        tape::decide([side(self), side(o)], strict)
    }
    /// Whether it is negative; where it may be 0 of either sign, both.
    fn sign_is_set(self) -> bool {
        if self.computed.is_point() && self.computed.lo == 0.0 {
            return self.computed.lo.is_sign_negative();
        }
        self.computed.lo < 0.0 && (self.computed.hi < 0.0 || self.compare(Self::constant(0.0), true))
            || self.computed.lo == 0.0 && self.compare(Self::constant(0.0), false)
    }
}

fn by_zero(divisor: Interval) -> bool {
    divisor.contains(0.0)
}

impl PartialEq for Traced {
    /// True for what is surely the same number.
    fn eq(&self, o: &Self) -> bool {
        self.name == o.name || self.computed.is_point() && self.computed == o.computed
    }
}
impl PartialOrd for Traced {
    fn partial_cmp(&self, o: &Self) -> Option<Ordering> {
        if self == o {
            Some(Ordering::Equal)
        } else if self.compare(*o, true) {
            Some(Ordering::Less)
        } else {
            Some(Ordering::Greater)
        }
    }
}
impl Default for Traced {
    fn default() -> Self {
        Self::constant(0.0)
    }
}

impl Add for Traced {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        let one = Interval::point(1.0);
        let [computed, between] = [self.computed + o.computed, self.between + o.between];
        let grid = self.grid.min(o.grid);
        let is_exact = Self::fits(grid, computed.greatest());
        let form = self.form.plus(&o.form);
        Self::rounded([computed, between], form, is_exact, grid, self.exact + o.exact, |noise| {
            // a sum that is subnormal is exact
            let subnormal = computed.greatest() < f64::from(f32::MIN_POSITIVE);
            tape::push(&[(self.node, one), (o.node, one)], if subnormal { 0.0 } else { noise })
        })
    }
}
impl Neg for Traced {
    type Output = Self;
    fn neg(self) -> Self {
        let node = tape::push(&[(self.node, Interval::point(-1.0))], 0.0);
        let negative = Self::formed(-self.computed, -self.between, self.form.negative(), -self.exact, node);
        Self { grid: self.grid, ..negative }
    }
}
impl Sub for Traced {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        let mut difference = self + -o;
        if o.at_most == self.name {
            difference.computed.lo = difference.computed.lo.max(0.0);
        }
        difference
    }
}
impl Mul for Traced {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        self.times(o, None)
    }
}
impl Div for Traced {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let inverse = Interval::point(1.0) / o.between;
        let between = self.between / o.between;
        let derivatives = [(self.node, inverse), (o.node, -(between * inverse))];
        let by = o.computed;
        let is_power = by.is_point() && is_power_of_two(by.lo);
        let normal = self.computed.least() / by.lo.abs() >= f64::from(f32::MIN_POSITIVE) || by.lo.abs() <= 1.0;
        let exact = self.exact / o.exact;
        let form = if by_zero(o.between) {
            Affine::anywhere(Interval::ALL)
        } else {
            let one = Interval::point(1.0);
            let reciprocal = o.form.function(one / Interval::point(o.form.middle()), -(inverse * inverse));
            self.form.times(&reciprocal)
        };
        Self::rounded([self.computed / by, between], form, is_power && normal, -149, exact, |noise| {
            tape::push(&derivatives, noise)
        })
    }
}
impl AddAssign for Traced {
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}
impl SubAssign for Traced {
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}
impl MulAssign for Traced {
    fn mul_assign(&mut self, o: Self) {
        *self = *self * o;
    }
}

impl Real for Traced {
    type Scalar = Self;
    type Mask = bool;
    type Uint = u32;
    const LANES: usize = 1;
    const ONE_MINUS_EPSILON: Self = {
        let point = Interval::point(1.0 - 1.0 / 16_777_216.0);
        Self {
            computed: point,
            between: point,
            form: Affine::constant(point.lo),
            grid: -24,
            exact: point.lo,
            node: EXACT,
            name: 0,
            factors: [0; 2],
            at_most: 0,
        }
    };

    fn splat(value: Self) -> Self {
        value
    }
    fn lit(value: f64) -> Self {
        let value = match DEFECT.get() {
            Defect::Constant { value: right, off } if (value - right).abs() <= 1e-15 * right.abs() => {
                value * (1.0 + off)
            }
            _ => value,
        };
        let rounded = f64::from(value as f32);
        if rounded == value || !rounded.is_finite() {
            return Self::constant(rounded);
        }
        // the constant itself is known to double precision
        let noise = ((rounded - value).abs() + value.abs() * f64::EPSILON).next_up();
        let between = Interval::point(rounded).widened(noise);
        Self::new(Interval::point(rounded), between, value, tape::push(&[], noise))
    }
    fn from_fn(mut f: impl FnMut(usize) -> Self) -> Self {
        f(0)
    }
    fn lane(self, i: usize) -> Self {
        [self][i]
    }
    fn lane_f64(self, i: usize) -> f64 {
        [self][i].exact
    }
    fn lt(self, o: Self) -> bool {
        self.compare(o, true)
    }
    fn le(self, o: Self) -> bool {
        self.compare(o, false)
    }
    fn blend(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
    fn blend_uint(mask: bool, yes: u32, no: u32) -> u32 {
        if mask { yes } else { no }
    }
    fn keep(self, mask: bool) -> Self {
        if mask { self } else { Self::constant(0.0) }
    }
    fn negate_where(self, mask: bool) -> Self {
        if mask { -self } else { self }
    }
    fn lesser(self, o: Self) -> Self {
        if clamp_is_missing() || self.computed.hi < o.computed.lo {
            self
        } else if self.computed.lo >= o.computed.hi {
            o
        } else {
            self.either(o, Interval::lesser, self.exact.min(o.exact))
        }
    }
    fn greater(self, o: Self) -> Self {
        if clamp_is_missing() || self.computed.lo > o.computed.hi {
            self
        } else if self.computed.hi <= o.computed.lo {
            o
        } else {
            self.either(o, Interval::greater, self.exact.max(o.exact))
        }
    }
    fn abs(self) -> Self {
        if self.computed.lo >= 0.0 {
            self
        } else if self.computed.hi <= 0.0 {
            -self
        } else {
            let node = tape::push(&[(self.node, Interval::within(1.0))], 0.0);
            Self { grid: self.grid, ..Self::new(self.computed.abs(), self.between.abs(), self.exact.abs(), node) }
        }
    }
    fn copysign(self, sign: Self) -> Self {
        let magnitude = self.abs();
        if sign.sign_is_set() { -magnitude } else { magnitude }
    }
    fn sqrt(self) -> Self {
        if self.between == Interval::point(0.0) {
            return Self::constant(0.0);
        }
        let positive = Interval::new(self.between.lo.max(0.0), self.between.hi);
        let (Some(computed), Some(between)) = (self.computed.sqrt(), positive.sqrt()) else {
            return Self::unknown();
        };
        // without a bound where the operand may be 0 or, between the exact and the computed one, less
        let derivative = Interval::point(0.5) / between;
        let form = match Interval::point(self.form.middle()).sqrt() {
            Some(middle) if between.lo > 0.0 => self.form.function(middle, derivative),
            _ => Affine::anywhere(between),
        };
        Self::rounded([computed, between], form, false, -149, self.exact.sqrt(), |noise| {
            tape::push(&[(self.node, derivative)], noise)
        })
    }
    fn round_ties_even(self) -> Self {
        Self::unknown()
    }
    fn mul_add(self, a: Self, b: Self) -> Self {
        self.times(a, Some(b))
    }
    fn two_sum(self, o: Self) -> (Self, Self) {
        let sum = self + o;
        (sum, Self::minus_rounding(sum, 0.0))
    }
    fn two_prod_error(a: Self, b: Self, product: Self) -> Self {
        let factors = [a.name, b.name];
        if product.factors != factors && product.factors != [b.name, a.name] {
            return a.mul_add(b, -product);
        }
        // the error is a number of single precision unless it is below all of them
        let underflow = a.grid.saturating_add(b.grid) < -149;
        Self::minus_rounding(product, if underflow { f64::powi(2.0, -150) } else { 0.0 })
    }
    fn pow2_scale(self) -> Self {
        let (least, greatest) = (self.computed.least(), self.computed.greatest());
        if !(greatest.is_finite() && least >= f64::from(f32::MIN_POSITIVE)) {
            return Self::unknown();
        }
        // one path for each binade, of which there must be few
        let (from, to) = (floor_log2(least), floor_log2(greatest));
        if to - from > 4 {
            return Self::unknown();
        }
        let magnitude = self.abs();
        let binade = (from..to).find(|&e| magnitude.lt(Self::constant(f64::powi(2.0, e + 1)))).unwrap_or(to);
        Self::constant(f64::powi(2.0, -binade).max(f64::powi(2.0, -127)))
    }
    fn exponent(self) -> Self {
        Self::unknown()
    }
    fn power_of_two(self) -> Self {
        Self::unknown()
    }
    fn unit(bits: u32) -> Self {
        Self::constant(f64::from(bits >> 8) / 16_777_216.0)
    }
    fn from_uint(value: u32) -> Self {
        Self::constant(f64::from(value))
    }
    fn to_uint(self) -> u32 {
        panic!("a proof cannot follow a conversion to an integer")
    }
    fn sin_cos_turns(self) -> (Self, Self) {
        if !(self.computed.lo >= 0.0 && self.computed.hi <= 1.0) {
            return (Self::unknown(), Self::unknown());
        }
        self.wave(1.0, limits::TURNS)
    }
    fn sin_cos_quarters(self) -> (Self, Self) {
        if self.computed.greatest() > limits::MOST_QUARTERS {
            return (Self::unknown(), Self::unknown());
        }
        self.wave(0.25, limits::QUARTERS)
    }
    fn atan_eighth(self) -> Self {
        let (one, t) = (Interval::point(1.0), self.between);
        if self.computed.greatest() > limits::EIGHTH {
            return Self::unknown();
        }
        let noise = limits::ATAN_EIGHTH.at(self.computed.greatest());
        self.function(Interval::atan, one / (one + t.square()), noise, libm::atan(self.exact))
    }
    fn acos(self) -> Self {
        Self::unknown()
    }
    fn exp(self) -> Self {
        Self::unknown()
    }
    fn exp_m1(self) -> Self {
        Self::unknown()
    }
    fn ln_1p(self) -> Self {
        Self::unknown()
    }
    fn cbrt(self) -> Self {
        Self::unknown()
    }
    fn inverse_cbrt_estimate(self) -> Self {
        Self::unknown()
    }
    fn normal_cdf(self) -> Self {
        Self::unknown()
    }
    fn normal_quantile(self) -> Self {
        Self::unknown()
    }
}
