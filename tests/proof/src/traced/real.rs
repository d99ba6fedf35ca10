//! What a routine asks of its numbers.

use super::{Traced, floor_log2};
use crate::affine::Affine;
use crate::defect::{Defect, clamp_is_missing, planted};
use crate::interval::Interval;
use crate::limits;
use crate::tape::{self, EXACT};
use etendue::Real;

/// A number that is known exactly.
const fn constant(value: f64) -> Traced {
    let point = Interval::point(value);
    Traced {
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
}

impl Real for Traced {
    type Scalar = Self;
    type Mask = bool;
    type Uint = u32;
    const LANES: usize = 1;
    const DOUBLE: bool = false;
    const ZERO: Self = constant(0.0);
    const ONE_MINUS_EPSILON: Self = constant(1.0 - 1.0 / 16_777_216.0);

    fn splat(value: Self) -> Self {
        value
    }
    fn lit(value: f64) -> Self {
        let value = match planted() {
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
    fn cbrt(self) -> Self {
        Self::unknown()
    }
    fn inverse_cbrt_estimate(self) -> Self {
        Self::unknown()
    }
}
