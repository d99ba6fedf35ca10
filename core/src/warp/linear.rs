use super::Warp1;
use crate::lanewise::lanewise;
use crate::real::{GREATEST, Real, unit_interval};

lanewise! {
    /// Density linear between the end values a at 0 and b at 1.
    ///
    /// - Formula: x = u(a+b) / (a + √(a²(1−u) + b²u)); no term cancels, and a = b needs no other formula.
    /// - Domain: u in [0, 1); a, b ≥ 0, in any unit (negative ones count as 0).
    /// - Density: 2(a(1−x) + bx)/(a+b) per unit length on [0, 1], 0 elsewhere.
    /// - Degenerate: a = b = 0 has no density: pdf 0, and x = u.
    /// - Greatest error: 1.4e−7 in x, 2.1e−7 relative in the pdf.
    /// - Source: the inverse of the distribution function, rationalised: Pharr, Jakob and Humphreys, PBR 4th ed., 2.3.2.
    ///
    /// ```
    /// use etendue::warp::{Linear, Warp1};
    /// let falling = Linear { a: 3.0_f32, b: 1.0 };
    /// let x = falling.sample(0.625);
    /// assert!((x - 0.5).abs() < 1e-6 && (falling.pdf(x) - 1.0).abs() < 1e-6 && (falling.invert(x) - 0.625).abs() < 1e-6);
    /// ```
    pub struct Linear {
        /// Relative density at 0.
        pub a: R,
        /// Relative density at 1.
        pub b: R,
    }
}

impl<R: Real> Linear<R> {
    /// End values times a power of two that keeps their squares in range; a + b, or 1 where that is 0; is there a density?
    #[inline(always)]
    fn scaled(&self) -> (R, R, R, R::Mask) {
        let zero = R::lit(0.0);
        let (a, b) = (self.a.greater(zero), self.b.greater(zero));
        let scale = a.greater(b).pow2_scale();
        let (a, b) = (a * scale, b * scale);
        let some = (a + b).gt(zero);
        // without a density: uniform, so that the point is finite
        let one = R::lit(1.0);
        let (a, b) = (R::blend(some, a, one), R::blend(some, b, one));
        (a, b, a + b, some)
    }
}

impl<R: Real> Warp1<R> for Linear<R> {
    #[inline(always)]
    fn sample(&self, u: R) -> R {
        let (a, b, sum, _) = self.scaled();
        let root = (a * a).mul_add(R::lit(1.0) - u, b * b * u).greater(R::lit(0.0)).sqrt();
        // a = 0 at u = 0
        let denominator = a + root;
        let some = denominator.gt(R::lit(0.0));
        unit_interval(u * sum / R::blend(some, denominator, R::lit(1.0)))
    }
    #[inline(always)]
    fn pdf(&self, x: R) -> R {
        let (a, b, sum, some) = self.scaled();
        let one = R::lit(1.0);
        let inside = x.ge(R::lit(0.0)) & x.le(one);
        let x = unit(x);
        let value = a.mul_add(one - x, b * x);
        ((value + value) / sum).keep(some & inside)
    }
    #[inline(always)]
    fn invert(&self, x: R) -> R {
        let (a, b, sum, _) = self.scaled();
        let x = unit(x);
        let rest = R::lit(1.0) - x;
        let value = a.mul_add(rest, b * x);
        // from the nearer end: its distance times the mean of the densities at the end and at x
        let lower = x.lt(R::lit(0.5));
        let part = R::blend(lower, x * (a + value), rest * (b + value)) / sum;
        unit_interval(R::blend(lower, part, R::lit(1.0) - part))
    }
}

/// Into [0, 1].
#[inline(always)]
fn unit<R: Real>(x: R) -> R {
    x.clamped(R::lit(0.0), R::lit(1.0))
}

lanewise! {
    /// Density that falls linearly from 0 to ±r: the tent or triangle filter.
    ///
    /// - Formula, with t = min(u, 1−u): x = r(2u−1)/(1 + √(2t)), which is r(√(2u) − 1) below the middle and r(1 − √(2(1−u))) above,
    ///   without their cancellation at the middle.
    /// - Domain: u in [0, 1); r > 0.
    /// - Density: (1 − |x|/r)/r per unit length within ±r, 0 elsewhere.
    /// - Degenerate: r ≤ 1e−37 (0, negative or nearly subnormal) gives pdf 0 and x = 0.
    /// - Greatest error: 1.6e−7 relative in x, 2e−7 relative in the pdf.
    /// - Source: the inverse of the distribution function, rationalised.
    pub struct Tent {
        /// Half-width r.
        pub radius: R,
    }
}

impl<R: Real> Tent<R> {
    /// r, or 1 where it is degenerate.
    #[inline(always)]
    fn usable(&self) -> (R, R::Mask) {
        let some = self.radius.gt(R::lit(1e-37));
        (R::blend(some, self.radius, R::lit(1.0)), some)
    }
}

impl<R: Real> Warp1<R> for Tent<R> {
    #[inline(always)]
    fn sample(&self, u: R) -> R {
        let one = R::lit(1.0);
        let t = u.lesser(one - u).greater(R::lit(0.0));
        let x = R::lit(2.0).mul_add(u, -one) / (one + (t + t).sqrt());
        (x * self.radius).keep(self.usable().1)
    }
    #[inline(always)]
    fn pdf(&self, x: R) -> R {
        let (r, some) = self.usable();
        let rest = (r - x.abs()).greater(R::lit(0.0));
        (rest / r / r).keep(some)
    }
    #[inline(always)]
    fn invert(&self, x: R) -> R {
        let (r, _) = self.usable();
        let s = (r - x.clamped(R::lit(-GREATEST), R::lit(GREATEST)).abs()).greater(R::lit(0.0)) / r;
        let t = R::lit(0.5) * s * s;
        unit_interval(R::blend(x.lt(R::lit(0.0)), t, R::lit(1.0) - t))
    }
}
