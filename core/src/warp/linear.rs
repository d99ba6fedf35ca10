//! Linear densities on an interval, and tents.

use super::Warp1;
use crate::lanewise::lanewise;
use crate::real::{GREATEST, Real, unit_interval};

lanewise! {
    /// Numbers in [0, 1) with a pdf linear between the end values a at 0 and b at 1.
    ///
    /// Set `a` and `b`, then call `sample`, `pdf` or `invert`; a = b is not a special case. If neither is positive, the pdf is
    /// 0 and x = u.
    ///
    /// ```
    /// use etendue::warp::{Linear, Warp1};
    /// let falling = Linear { a: 3.0_f32, b: 1.0 };
    /// let x = falling.sample(0.625);
    /// assert!((x - 0.5).abs() < 1e-6 && (falling.pdf(x) - 1.0).abs() < 1e-6 && (falling.invert(x) - 0.625).abs() < 1e-6);
    /// ```
    ///
    /// - Formula: x = u(a+b) / (a + √(a²(1−u) + b²u)); no term cancels, and the formula covers a = b.
    /// - Domain: u in [0, 1); a, b ≥ 0, in any unit (negative ones count as 0).
    /// - Density: the pdf is 2(a(1−x) + bx)/(a+b) per unit length on [0, 1]; 0 elsewhere.
    /// - Degenerate input: a = b = 0 gives pdf 0 and x = u.
    /// - Greatest error: 1.8e−7 in x, 2.1e−7 relative in the pdf.
    /// - Over all 2²⁴ values of u and fourteen pairs of a and b: greatest error 1.8e−7 at u = 0xf6361c/2²⁴ of
    ///   `Linear { a: 1e38, b: 3e38 }`; inverse within 5 · 2⁻²⁴ at u = 0xa71523/2²⁴ of `Linear { a: 1e-6, b: 1.0 }`;
    ///   Kolmogorov distance 5.7 · 2⁻²⁴ at u = 0xf7ffe3/2²⁴ of `Linear { a: 1e-6, b: 1.0 }`, where exact samples have 2⁻²⁴. Rounding
    ///   leaves it not quite monotone: x falls by up to 1.2e−7 from one u to the next at u = 0xd9c7e7/2²⁴ of
    ///   `Linear { a: 1e38, b: 3e38 }`.
    /// - Source: the inverse of the distribution function, rationalised: Pharr, Jakob and Humphreys, PBR 4th ed., 2.3.2.
    pub struct Linear {
        /// Relative density at 0: ≥ 0, in any unit.
        pub a: R,
        /// Relative density at 1: ≥ 0, in the unit of `a`.
        pub b: R,
    }
}

impl<R: Real> Linear<R> {
    /// a and b times a power of two that keeps their squares in range, a + b, and whether that sum is positive; a = b = 1 where
    /// it is not.
    #[inline(always)]
    fn scaled(&self) -> (R, R, R, R::Mask) {
        let zero = R::lit(0.0);
        let (a, b) = (self.a.greater(zero), self.b.greater(zero));
        let scale = a.greater(b).pow2_scale();
        let (a, b) = (a * scale, b * scale);
        let some = (a + b).gt(zero);
        // degenerate: uniform, so that the point is finite
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
        // 0 for a = 0 at u = 0
        let denominator = a + root;
        let some = denominator.gt(R::lit(0.0));
        unit_interval(u * sum / R::blend(some, denominator, R::lit(1.0)))
    }
    /// The pdf per unit length.
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
        // from the nearer end: the distance to it times the mean of the densities there and at x
        let lower = x.lt(R::lit(0.5));
        let part = R::blend(lower, x * (a + value), rest * (b + value)) / sum;
        unit_interval(R::blend(lower, part, R::lit(1.0) - part))
    }
}

/// Clamps x to [0, 1].
#[inline(always)]
fn unit<R: Real>(x: R) -> R {
    x.clamped(R::lit(0.0), R::lit(1.0))
}

lanewise! {
    /// Numbers in [−r, r] with a pdf that falls linearly from the middle to 0 at ±r: the tent filter of pixel reconstruction.
    ///
    /// Set `radius`, then call `sample`, `pdf` or `invert`. A radius of 1e−37 or less gives pdf 0 and x = 0.
    ///
    /// - Formula, with t = min(u, 1−u): x = r(2u−1)/(1 + √(2t)), which is r(√(2u) − 1) below the middle and r(1 − √(2(1−u)))
    ///   above, without their cancellation at the middle.
    /// - Domain: u in [0, 1); r > 0.
    /// - Density: the pdf is (1 − |x|/r)/r per unit length within ±r; 0 elsewhere.
    /// - Degenerate input: r ≤ 1e−37 (0, negative or nearly subnormal) gives pdf 0 and x = 0.
    /// - Greatest error: 1.7e−7 relative in x, 2e−7 relative in the pdf.
    /// - Over all 2²⁴ values of u and six radii: greatest error 1.7e−7 at u = 0x47ddb0/2²⁴ of `Tent { radius: 1.01e-37 }`;
    ///   inverse within 2 · 2⁻²⁴ at u = 0x800b8a/2²⁴ of `Tent { radius: 1e-30 }`; Kolmogorov distance 1.7 · 2⁻²⁴ at
    ///   u = 0xe3609c/2²⁴ of `Tent { radius: 1.9 }`, where exact samples have 2⁻²⁴; monotone.
    /// - Source: the inverse of the distribution function, rationalised.
    pub struct Tent {
        /// r, half the width of the tent: > 0, in the unit of x.
        pub radius: R,
    }
}

impl<R: Real> Tent<R> {
    /// r, or 1 where it is degenerate; and whether it is usable.
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
    /// The pdf per unit length.
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
