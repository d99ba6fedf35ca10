//! Affine forms: numbers as linear functions of the parameters and a remainder, so that what depends on the same parameter cancels.
//!
//! The width of their ranges falls with the square of the width of a box, that of plain intervals in proportion to it (de Figueiredo and
//! Stolfi 2004, "Affine Arithmetic: Concepts and Applications").

use crate::interval::Interval;

/// The greatest number of parameters.
pub const MOST_PARAMETERS: usize = 11;

/// `middle + Σ slopes[j] εⱼ + rest ε`, where each ε is in [−1, 1] and εⱼ is the place of parameter j in its range.
#[derive(Clone, Copy, Debug)]
pub struct Affine {
    middle: f64,
    slopes: [f64; MOST_PARAMETERS],
    rest: f64,
}

/// Bounds the rounding errors of one of these operations, relative to the magnitudes of all its terms.
const ROUNDING: f64 = 1.0 / (1_u64 << 47) as f64;

impl Affine {
    /// One number.
    #[must_use]
    pub const fn constant(x: f64) -> Self {
        Self { middle: x, slopes: [0.0; MOST_PARAMETERS], rest: 0.0 }
    }
    /// A parameter anywhere in a range.
    #[must_use]
    pub fn parameter(range: Interval, index: usize) -> Self {
        let mut form = Self::anywhere(range);
        (form.slopes[index], form.rest) = (form.rest, 0.0);
        form
    }
    /// A number of which only the range is known.
    #[must_use]
    pub fn anywhere(range: Interval) -> Self {
        let middle = 0.5 * range.lo + 0.5 * range.hi;
        let rest = if range.is_point() { 0.0 } else { (range.hi - middle).max(middle - range.lo).next_up() };
        Self { middle, slopes: [0.0; MOST_PARAMETERS], rest }
    }
    fn reach(&self) -> f64 {
        self.slopes.iter().map(|s| s.abs()).sum::<f64>() + self.rest
    }
    /// The numbers that it can be.
    #[must_use]
    pub fn range(&self) -> Interval {
        Interval::point(self.middle).widened(self.reach() * (1.0 + ROUNDING))
    }
    /// The form with rounding errors of its own operations, and this much more.
    fn and(mut self, magnitude: f64, more: f64) -> Self {
        self.rest = (self.rest + more + magnitude * ROUNDING) * (1.0 + ROUNDING);
        self
    }
    /// Within this much of the form.
    #[must_use]
    pub fn widened(self, by: f64) -> Self {
        self.and(0.0, by)
    }
    fn combined(&self, a: f64, o: &Self, b: f64, more: f64) -> Self {
        let magnitude = a.abs() * (self.middle.abs() + self.reach()) + b.abs() * (o.middle.abs() + o.reach());
        let slopes = core::array::from_fn(|j| a * self.slopes[j] + b * o.slopes[j]);
        let rest = a.abs() * self.rest + b.abs() * o.rest;
        Self { middle: a * self.middle + b * o.middle, slopes, rest }.and(magnitude, more)
    }
    /// Sum.
    #[must_use]
    pub fn plus(&self, o: &Self) -> Self {
        self.combined(1.0, o, 1.0, 0.0)
    }
    /// Product.
    #[must_use]
    pub fn times(&self, o: &Self) -> Self {
        let (a, b) = (self.middle, o.middle);
        let mut product = self.combined(b, o, a, self.reach() * o.reach());
        product.middle = a * b;
        product
    }
    /// Negative.
    #[must_use]
    pub fn negative(&self) -> Self {
        Self { middle: -self.middle, slopes: self.slopes.map(|s| -s), rest: self.rest }
    }
    /// f of the form, from the value at its middle and the range of the derivative: by the mean value theorem, f(x) is within
    /// f(m) + f'(X)(x − m).
    #[must_use]
    pub fn function(&self, at_middle: Interval, derivative: Interval) -> Self {
        let slope = 0.5 * derivative.lo + 0.5 * derivative.hi;
        let spread = (derivative.hi - slope).max(slope - derivative.lo);
        let at = Self::anywhere(at_middle);
        let mut from_middle = *self;
        from_middle.middle = 0.0;
        from_middle.combined(slope, &at, 1.0, spread * self.reach())
    }
    /// The middle.
    #[must_use]
    pub fn middle(&self) -> f64 {
        self.middle
    }
}
