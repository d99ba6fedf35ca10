//! What to do with samples: mean and variance, exactly mergeable; weights of several techniques; choice from a stream.
//!
//! | | what |
//! |---|---|
//! | [`Welford`] | mean and variance of a stream |
//! | [`Heuristic`], [`technique_pdf`] | multiple importance sampling |
//! | [`Measured`], [`log_variance_error`] | efficiency: variance against cost |
//! | [`Reservoir`] | one of a stream in proportion to weights: choice among lights, resampling |

mod mis;
mod reservoir;

pub use mis::{Heuristic, Measured, log_variance_error, technique_pdf};
pub use reservoir::Reservoir;

use crate::real::Real;

/// Running mean and sum of squared deviations, per lane.
///
/// - Formula: δ = x − mean, mean += δ/n, m2 += δ(x − mean); merged by Chan et al.
/// - The variance is that of independent samples, with n − 1. Of stratified or low-discrepancy samples feed it the means of
///   independent replicates.
/// - Source: Welford 1962; Chan, Golub and LeVeque 1983.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Welford<R> {
    /// Mean of the samples; 0 of none.
    pub mean: R,
    /// Sum of squared deviations from the mean.
    pub m2: R,
}

impl<R: Real> Welford<R> {
    /// Takes the `n`-th sample (counted from 1), whose reciprocal 1/n the caller holds: it is the same for every channel.
    #[inline]
    pub fn push(&mut self, x: R, reciprocal_n: R) {
        let delta = x - self.mean;
        self.mean = delta.mul_add(reciprocal_n, self.mean);
        self.m2 = delta.mul_add(x - self.mean, self.m2);
    }
    /// Both sets of samples, `n` in `self` and `m` in `other`.
    #[inline]
    #[must_use]
    pub fn merge(self, n: R, other: Self, m: R) -> Self {
        let total = n + m;
        let some = total.gt(R::lit(0.0));
        let reciprocal = R::lit(1.0) / R::blend(some, total, R::lit(1.0));
        let delta = other.mean - self.mean;
        Self {
            mean: (delta * m).mul_add(reciprocal, self.mean),
            m2: (delta * delta).mul_add(n * m * reciprocal, self.m2 + other.m2),
        }
    }
    /// Variance of a sample, from `n` of them; infinite for fewer than two: nothing is known.
    #[inline]
    pub fn variance(self, n: R) -> R {
        let known = n.gt(R::lit(1.0));
        R::blend(known, self.m2 / R::blend(known, n - R::lit(1.0), R::lit(1.0)), R::lit(f64::INFINITY))
    }
}
