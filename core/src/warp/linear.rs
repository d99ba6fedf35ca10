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
    /// a and b, ≥ 0, times a power of two that keeps their squares in range.
    #[inline(always)]
    fn scaled(&self) -> Self {
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
}

impl<R: Real> Warp1<R> for Linear<R> {
    #[inline(always)]
    fn sample(&self, u: R) -> R {
        self.scaled().sample_in_range(u)
    }
    /// The pdf per unit length.
    #[inline(always)]
    fn pdf(&self, x: R) -> R {
        self.scaled().pdf_in_range(x)
    }
    #[inline(always)]
    fn invert(&self, x: R) -> R {
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
