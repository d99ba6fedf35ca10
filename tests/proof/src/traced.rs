//! The number type that proves: an interval with the record of its rounding errors.

mod operators;
mod real;

use crate::affine::Affine;
use crate::defect::{Defect, planted};
use crate::interval::Interval;
use crate::limits::WaveError;
use crate::tape::{self, EXACT, Side, Wave};
use core::f64::consts::TAU;
use std::cell::Cell;

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

thread_local! {
    static NAMES: Cell<u32> = const { Cell::new(0) };
}
fn new_name() -> u32 {
    NAMES.set(NAMES.get().wrapping_add(1).max(1));
    NAMES.get()
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
    if planted() == Defect::HalfRounding { 0.5 * half } else { half }
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
        if planted() == Defect::Inwards {
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
    fn wave(self, turns: f64, errors: WaveError) -> (Self, Self) {
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
