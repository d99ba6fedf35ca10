use super::Warp1;
use crate::lanewise::lanewise;
use crate::math::exp_minus_half_square;
use crate::real::{GREATEST, Real, unit_interval};

const INV_SQRT_TWO_PI: f64 = 0.398_942_280_401_432_7;

lanewise! {
    /// Numbers with a normal distribution, by its quantile function: unlike Box and Muller's method it keeps strata of `u` and
    /// has an inverse.
    ///
    /// Set `mean` and `sigma`, then call `sample`, `pdf` or `invert`. A sigma of 1e−37 or less gives pdf 0 and x = μ.
    ///
    /// - Formula: x = μ + σΦ⁻¹(u).
    /// - Domain: u in [0, 1), kept at least 2⁻²⁵ away from 0 and 1, so that |x − μ| ≤ 5.42σ; σ > 0.
    /// - Density: the pdf is exp(−z²/2)/(σ√(2π)) per unit length, z = (x−μ)/σ; 0 where |z| > 13.2.
    /// - Degenerate input: σ ≤ 1e−37 (0, negative or nearly subnormal) gives pdf 0 and x = μ.
    /// - Over all 2²⁴ values of u and six pairs of μ and σ: greatest error 3.7e−7 at u = 0x4e389d/2²⁴ of
    ///   `Normal { mean: 0.0, sigma: 2.7 }`, relative to σz and besides the rounding of the sum; inverse within 4 · 2⁻²⁴ at
    ///   u = 0x7c3671/2²⁴ of `Normal { mean: -3.0, sigma: 0.7 }`; Kolmogorov distance 2.9 · 2⁻²⁴ at u = 0x4c95f6/2²⁴ of
    ///   `Normal { mean: -3.0, sigma: 0.7 }`, where exact samples have 2⁻²⁴ (more if |μ| exceeds 5σ, by the rounding of the sum);
    ///   monotone.
    /// - Greatest error: 3.7e−7 σz in x − μ, besides the rounding of the sum; 5e−7 relative in the pdf, in the tails too.
    /// - Source: Giles, "Approximating the erfinv function", GPU Computing Gems, 2011, for the form of the approximation; the
    ///   coefficients are fitted here.
    pub struct Normal {
        /// μ, the mean: finite, in the unit of x.
        pub mean: R,
        /// σ, the standard deviation: > 0, in the unit of x.
        pub sigma: R,
    }
}

impl<R: Real> Normal<R> {
    /// σ, or 1 where it is degenerate; and whether it is usable.
    #[inline(always)]
    fn usable(&self) -> (R, R::Mask) {
        let some = self.sigma.gt(R::lit(1e-37));
        (R::blend(some, self.sigma, R::lit(1.0)), some)
    }
    /// z clamped to ±20, its rounding error, and 1/σ.
    #[inline(always)]
    fn standard(&self, sigma: R, x: R) -> (R, R, R) {
        let inverse = R::lit(1.0) / sigma;
        let limit = (R::lit(20.0) * sigma).lesser(R::lit(GREATEST));
        let (d, lost) = x.two_sum(-self.mean);
        let d = d.clamped(-limit, limit);
        let z = (d * inverse).clamped(R::lit(-20.0), R::lit(20.0));
        let product = z * sigma;
        let rest = (d - product) - (R::two_prod_error(z, sigma, product) - lost);
        // NaN if something overflowed, which takes |x|, |μ| or σ beyond 1e37
        (z, rest.keep(rest.abs().le(sigma)) * inverse, inverse)
    }
}

impl<R: Real> Warp1<R> for Normal<R> {
    #[inline(always)]
    fn sample(&self, u: R) -> R {
        let (sigma, some) = self.usable();
        let x = u.normal_quantile().mul_add(sigma.keep(some), self.mean);
        x.clamped(R::lit(-GREATEST), R::lit(GREATEST))
    }
    /// The pdf per unit length.
    #[inline(always)]
    fn pdf(&self, x: R) -> R {
        let (sigma, some) = self.usable();
        let (z, error, inverse) = self.standard(sigma, x);
        // exp_minus_half_square forms z² in twice the precision, and (z + e)² = z² + 2ze
        let value = exp_minus_half_square(z, (z + z) * error) * R::lit(INV_SQRT_TWO_PI);
        (value * inverse).keep(some & z.abs().lt(R::lit(13.2)))
    }
    #[inline(always)]
    fn invert(&self, x: R) -> R {
        let (sigma, _) = self.usable();
        unit_interval(self.standard(sigma, x).0.normal_cdf())
    }
}
