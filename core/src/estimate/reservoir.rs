//! Reservoirs: one of a stream of candidates, in proportion to its weight.

use crate::real::{Real, Uint};

/// Holds one candidate of a stream, chosen in proportion to weights that arrive one at a time: for lights, or samples of them.
///
/// Start from `Reservoir::default()`, `push` each candidate, then read `held` and [`pmf`](Reservoir::pmf). Lanes are
/// independent reservoirs. A weight that is negative, infinite or NaN counts as 0; without a positive weight, the pmf is 0.
///
/// ```
/// use etendue::estimate::Reservoir;
/// let mut lights = Reservoir::<f32>::default();
/// let mut u = 0.6;
/// for (light, bound) in [3.0, 0.0, 1.0, 4.0].into_iter().enumerate() {
///     u = lights.push(light as u32, bound, u);
/// }
/// assert_ne!(lights.held, 1);
/// assert_eq!(lights.pmf(), [3.0, 0.0, 1.0, 4.0][lights.held as usize] / 8.0);
/// assert!((0.0..1.0).contains(&u));
/// ```
///
/// It has two uses:
/// 1. *Choice of a light* by a bound of its contribution: the weight is the bound, and the estimate is divided by the
///    [`pmf`](Reservoir::pmf) of the light held.
/// 2. *Resampled importance sampling*: candidates xᵢ come from pdfs pᵢ, and weights are mᵢ·p̂(xᵢ)/pᵢ with MIS weights mᵢ (1/M
///    for M candidates from one pdf). The estimate from the sample held is f·[`contribution`](Reservoir::contribution)(p̂),
///    unbiased if p̂ > 0 wherever f ≠ 0.
///
/// - Formula: candidate i replaces the one held with probability wᵢ/Σ_{j≤i} wⱼ, so that at the end each is held with
///   probability wᵢ/Σw. One uniform number serves the whole stream: the part of it that the decision leaves is stretched back
///   to [0, 1).
/// - Domain: weights in [0, ∞) in any unit; u in [0, 1).
/// - Degenerate input: NaN, negative and infinite weights count as 0, and such a candidate is never held.
/// - Greatest error: `u` has 24 bits, and each stretch leaves fewer, so each candidate's frequency is within about 2⁻²⁴ of its
///   probability per candidate of the stream. For a long stream, push a fresh `u` now and then.
/// - Source: Chao 1982; Talbot, Cline and Egbert, "Importance Resampling for Global Illumination", EGSR 2005; Ogaki 2021 for
///   the reuse of u; Wyman and Panteleev 2021.
#[derive(Clone, Copy, Debug)]
pub struct Reservoir<R: Real> {
    /// The candidate held, as pushed; 0 if none had a positive weight.
    pub held: R::Uint,
    /// Weight of the candidate held: ≥ 0, in the unit of the weights.
    pub weight: R,
    /// Sum of the weights of all candidates so far: ≥ 0, at most `f32::MAX`.
    pub sum: R,
}

impl<R: Real> Default for Reservoir<R> {
    #[inline]
    fn default() -> Self {
        Self { held: R::Uint::splat(0), weight: R::lit(0.0), sum: R::lit(0.0) }
    }
}

impl<R: Real> Reservoir<R> {
    /// Offers a candidate with its weight and a `u` in [0, 1). Returns what is left of `u`: uniform again, and independent of
    /// the decision.
    #[inline]
    pub fn push(&mut self, candidate: R::Uint, weight: R, u: R) -> R {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let largest = R::lit(f64::from(f32::MAX));
        let weight = weight.keep(weight.gt(zero) & weight.le(largest));
        let sum = (self.sum + weight).lesser(largest);
        let chance = weight / R::blend(sum.gt(zero), sum, one);
        let take = u.lt(chance);
        self.held = R::blend_uint(take, candidate, self.held);
        self.weight = R::blend(take, weight, self.weight);
        self.sum = sum;
        let (offset, width) = (R::blend(take, zero, chance), R::blend(take, chance, one - chance));
        let rest = (u - offset) / R::blend(width.gt(zero), width, one);
        crate::real::unit_interval(rest)
    }
    /// Probability of the candidate held, weight/Σweights; 0 if there is none.
    #[inline]
    #[must_use]
    pub fn pmf(&self) -> R {
        self.weight / R::blend(self.sum.gt(R::lit(0.0)), self.sum, R::lit(1.0))
    }
    /// The unbiased contribution weight, which replaces 1/pdf for a resampled sample: Σweights/target, where `target` is p̂ of
    /// the sample held; 0 where that is 0.
    #[inline]
    #[must_use]
    pub fn contribution(&self, target: R) -> R {
        let some = target.gt(R::lit(0.0));
        (self.sum / R::blend(some, target, R::lit(1.0))).keep(some)
    }
}
