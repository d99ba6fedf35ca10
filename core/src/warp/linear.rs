//! Numbers in [0, 1) with a linear density: what maps of the square and of lines are made of.

use crate::real::{Real, unit_interval};

/// Numbers in [0, 1) with a pdf linear between the end values a at 0 and b at 1.
///
/// - Formula: x = u(a+b) / (a + √(a²(1−u) + b²u)); no term cancels, and the formula covers a = b.
/// - Domain: u in [0, 1); a, b ≥ 0, in any unit (negative ones count as 0).
/// - Density: the pdf is 2(a(1−x) + bx)/(a+b) per unit length on [0, 1]; 0 elsewhere.
/// - Degenerate input: a = b = 0 gives pdf 0 and x = u.
/// - Greatest error: 1.8e−7 in x, 2.1e−7 relative in the pdf.
/// - Source: the inverse of the distribution function, rationalised: Pharr, Jakob and Humphreys, PBR 4th ed., 2.3.2.
#[derive(Clone, Copy)]
pub(crate) struct Linear<R> {
    /// Relative density at 0: ≥ 0, in any unit.
    pub(crate) a: R,
    /// Relative density at 1: ≥ 0, in the unit of `a`.
    pub(crate) b: R,
}

impl<R: Real> Linear<R> {
    /// a and b, ≥ 0, times a power of two that keeps their squares in range.
    #[inline(always)]
    fn scaled(self) -> Self {
        let zero = R::lit(0.0);
        let (a, b) = (self.a.greater(zero), self.b.greater(zero));
        let scale = a.greater(b).pow2_scale();
        Self { a: a * scale, b: b * scale }
    }
    /// [`scaled`](Self::scaled) for a and b ≥ 0, of which few are so small that they need it.
    #[inline(always)]
    pub(super) fn scaled_if_small(self) -> Self {
        let small = self.a.greater(self.b).lt(R::lit(1.0 / 65_536.0));
        let [a, b] = R::where_any(small, [self.a, self.b], || {
            let scaled = self.scaled();
            [scaled.a, scaled.b]
        });
        Self { a, b }
    }
    /// Samples for a and b ≥ 0 whose squares are in range.
    #[inline(always)]
    pub(super) fn sample_in_range(self, u: R) -> R {
        let (Self { a, b }, one) = (self, R::lit(1.0));
        let root = (a * a).mul_add(one - u, b * b * u).sqrt();
        // 0 for a = 0 at u = 0, and for a = b = 0, where x = u
        let denominator = a + root;
        let some = denominator.gt(R::lit(0.0));
        unit_interval(R::blend(some, u * (a + b), u) / R::blend(some, denominator, one))
    }
    /// The pdf per unit length for a and b ≥ 0.
    #[inline(always)]
    pub(super) fn pdf_in_range(self, x: R) -> R {
        let (Self { a, b }, one) = (self, R::lit(1.0));
        let inside = x.ge(R::lit(0.0)) & x.le(one);
        let (x, sum) = (unit(x), a + b);
        let value = a.mul_add(one - x, b * x);
        let some = sum.gt(R::lit(0.0));
        ((value + value) / R::blend(some, sum, one)).keep(some & inside)
    }
    /// Maps `u` in [0, 1] to a number.
    #[inline(always)]
    pub(crate) fn sample(self, u: R) -> R {
        self.scaled().sample_in_range(u)
    }
    /// Returns the `u` in [0, 1) of a number.
    #[inline(always)]
    pub(super) fn invert(self, x: R) -> R {
        let Self { a, b } = self.scaled();
        let (x, sum, one) = (unit(x), a + b, R::lit(1.0));
        let rest = one - x;
        let value = a.mul_add(rest, b * x);
        let some = sum.gt(R::lit(0.0));
        // from the nearer end: the distance to it times the mean of the densities there and at x
        let lower = x.lt(R::lit(0.5));
        let part = R::blend(lower, x, rest) * R::blend(some, R::blend(lower, a, b) + value, one);
        let part = part / R::blend(some, sum, one);
        unit_interval(R::blend(lower, part, one - part))
    }
}

/// Clamps x to [0, 1].
#[inline(always)]
fn unit<R: Real>(x: R) -> R {
    x.clamped(R::lit(0.0), R::lit(1.0))
}
