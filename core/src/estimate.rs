//! Combines samples: mergeable mean and variance, weights of several techniques.
//!
//! | | purpose |
//! |---|---|
//! | [`Welford`] | mean and variance of a stream |
//! | [`Heuristic`] | multiple importance sampling |

mod mis;

pub use mis::Heuristic;

use crate::real::Real;

/// Running mean and variance of a stream, per lane. It counts its samples itself.
///
/// ```
/// use etendue::estimate::Welford;
/// let mut w = Welford::default();
/// [1.0, 2.0, 6.0].map(|x: f64| w.push(x));
/// assert_eq!((w.count(), w.mean(), w.variance()), (3.0, 3.0, 7.0));
/// ```
///
/// - Formula: δ = x − mean, mean += δ/n, m2 += δ(x − mean); merged by Chan et al.
/// - Domain: finite samples; up to 2²⁴ of them in single precision, beyond which the count no longer grows.
/// - The variance is that of independent samples, with n − 1. For stratified or low-discrepancy samples, push the means of independent
///   replicates.
/// - Degenerate: the variance of fewer than two samples is ∞, since nothing is known of it; the mean of none is 0.
/// - Source: Welford 1962; Chan, Golub and LeVeque 1983.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Welford<R> {
    count: R,
    mean: R,
    m2: R,
}

impl<R: Real> Welford<R> {
    /// Takes a sample.
    #[inline]
    pub fn push(&mut self, x: R) {
        let one = R::lit(1.0);
        self.count += one;
        let delta = x - self.mean;
        self.mean = delta.mul_add(one / self.count, self.mean);
        self.m2 = delta.mul_add(x - self.mean, self.m2);
    }
    /// Both sets of samples together.
    #[inline]
    #[must_use]
    pub fn merge(self, other: Self) -> Self {
        let (n, m) = (self.count, other.count);
        let total = n + m;
        let some = total.gt(R::lit(0.0));
        let reciprocal = R::lit(1.0) / R::blend(some, total, R::lit(1.0));
        let delta = other.mean - self.mean;
        Self {
            count: total,
            mean: (delta * m).mul_add(reciprocal, self.mean),
            m2: (delta * delta).mul_add(n * m * reciprocal, self.m2 + other.m2),
        }
    }
    /// Number of samples.
    #[inline]
    pub fn count(self) -> R {
        self.count
    }
    /// Mean of the samples; 0 if there are none.
    #[inline]
    pub fn mean(self) -> R {
        self.mean
    }
    /// Sum of squared deviations from the mean.
    #[inline]
    pub fn m2(self) -> R {
        self.m2
    }
    /// Variance of a sample; ∞ for fewer than two samples.
    #[inline]
    pub fn variance(self) -> R {
        let (one, known) = (R::lit(1.0), self.count.gt(R::lit(1.0)));
        R::blend(known, self.m2 / R::blend(known, self.count - one, one), R::lit(f64::INFINITY))
    }
}
