//! Comparison and arithmetic of traced numbers.

use super::{Traced, is_power_of_two};
use crate::affine::Affine;
use crate::interval::Interval;
use crate::tape;
use core::cmp::Ordering;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

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
