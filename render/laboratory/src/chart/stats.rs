//! Means, ratios and slopes over replicates, with 95 % confidence intervals.

use std::f64::consts::FRAC_2_PI;

/// A value and half of its 95 % interval, which is infinite if the spread is unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Middle of the interval.
    pub value: f64,
    /// Half of the interval's width.
    pub half: f64,
}

/// An estimate whose half interval exceeds this fraction of the value does not support a claim.
pub const WIDEST: f64 = 0.3;

/// Probability that the magnitude of Student's t exceeds `t`, by the finite sums for whole `freedom` (Abramowitz and Stegun, 26.7.3 and
/// 26.7.4).
fn tails(t: f64, freedom: usize) -> f64 {
    let theta = (t / (freedom as f64).sqrt()).atan();
    let (sin, cos) = theta.sin_cos();
    let odd = freedom % 2;
    let (mut term, mut sum) = (if odd == 1 { cos } else { 1.0 }, 0.0);
    for k in 0..freedom / 2 {
        sum += term;
        let next = (2 * k + 1 + odd) as f64;
        term *= cos * cos * next / (next + 1.0);
    }
    1.0 - if odd == 1 { (theta + sin * sum) * FRAC_2_PI } else { sin * sum }
}

/// The t of `n` values whose magnitude chance exceeds with this probability; infinite for fewer than two values.
#[must_use]
pub fn student(n: usize, probability: f64) -> f64 {
    if n < 2 {
        return f64::INFINITY;
    }
    let exceeds = |t: f64| tails(t, n - 1) > probability;
    let (mut low, mut high) = (0.0, 1.0);
    while exceeds(high) {
        (low, high) = (high, 2.0 * high);
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if exceeds(middle) { &mut low } else { &mut high }) = middle;
    }
    high
}

/// Mean and standard deviation (n − 1) in two passes; the deviation of fewer than two values is 0.
pub fn moments(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let square = values.iter().map(|x| (x - mean).powi(2)).sum::<f64>();
    (mean, (square / (n - 1.0).max(1.0)).sqrt())
}

impl Estimate {
    /// Estimates the mean of independent values by Student's t distribution.
    #[must_use]
    pub fn of(values: &[f64]) -> Self {
        let (value, deviation) = moments(values);
        let half = match values.len() {
            0 | 1 => f64::INFINITY,
            n => student(n, 0.05) * deviation / (n as f64).sqrt(),
        };
        Self { value, half }
    }
    /// Lower end of the interval.
    #[must_use]
    pub fn low(&self) -> f64 {
        self.value - self.half
    }
    /// Upper end of the interval.
    #[must_use]
    pub fn high(&self) -> f64 {
        self.value + self.half
    }
    /// Half of the interval as a fraction of the value.
    #[must_use]
    pub fn relative(&self) -> f64 {
        self.half / self.value.abs()
    }
    /// Whether the value is positive and its interval narrow enough to support a claim.
    #[must_use]
    pub fn is_sure(&self) -> bool {
        self.value > 0.0 && self.relative() <= WIDEST
    }
}

/// Error and time of one replicate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// Mean squared error without that of the reference.
    pub mse: f64,
    /// The same of relative errors.
    pub relative: f64,
    /// Rendering time in seconds.
    pub seconds: f64,
}

/// Mean over the replicates of the least-squares slope of log y over log x. Every replicate has one y for each x.
///
/// `None` if there are fewer than two different x, or if a value is not positive.
#[must_use]
pub fn slope(x: &[f64], replicates: &[Vec<f64>]) -> Option<Estimate> {
    let log_x: Vec<f64> = x.iter().map(|x| x.ln()).collect();
    let (middle, _) = moments(&log_x);
    let square: f64 = log_x.iter().map(|x| (x - middle).powi(2)).sum();
    let known = |y: &Vec<f64>| y.len() == x.len() && y.iter().all(|y| *y > 0.0);
    if replicates.is_empty() || square.is_nan() || square <= 0.0 || !replicates.iter().all(known) {
        return None;
    }
    let one = |y: &Vec<f64>| log_x.iter().zip(y).map(|(x, y)| (x - middle) * y.ln()).sum::<f64>() / square;
    Some(Estimate::of(&replicates.iter().map(one).collect::<Vec<_>>()))
}

/// When a series reaches an error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Seconds of an image with this error.
    pub seconds: f64,
    /// The 95 % interval is from `seconds / factor` to `seconds × factor`; infinite if the spread is unknown.
    pub factor: f64,
    /// Whether the error is smaller than that of any image that was measured.
    pub is_beyond: bool,
    /// Whether the shortest image has a smaller error: the error is reached after at most these seconds.
    pub is_upper_bound: bool,
}

/// Factor for which an unknown interval counts where series are compared.
pub const UNKNOWN: f64 = 4.0;

impl Reach {
    fn spread(&self) -> f64 {
        if self.factor.is_finite() { self.factor } else { UNKNOWN }
    }
    /// Lower end of the interval.
    #[must_use]
    pub fn low(&self) -> f64 {
        if self.is_upper_bound { 0.0 } else { self.seconds / self.spread() }
    }
    /// Upper end of the interval.
    #[must_use]
    pub fn high(&self) -> f64 {
        self.seconds * self.spread()
    }
}

/// When a series with these costs at ascending numbers of samples reaches a mean squared error, of which `known` is how well the reference
/// is known: between two images by a straight line in logarithms, after the last as 1/time. `None` without a positive error.
///
/// The interval is that of the logarithm over replicates, each of which has a line of its own.
#[must_use]
pub fn reach(points: &[&[Cost]], mse: f64, known: f64) -> Option<Reach> {
    let mean = |costs: &[Cost], of: fn(&Cost) -> f64| costs.iter().map(of).sum::<f64>() / costs.len() as f64;
    let of = |costs: &&&[Cost]| mean(costs, |c| c.mse) > 0.0;
    let points: Vec<&[Cost]> = points.iter().filter(of).copied().collect();
    let above = points.iter().rposition(|costs| mean(costs, |c| c.mse) > mse);
    let is_upper_bound = above.is_none();
    let start = points.get(above.unwrap_or(0))?;
    let end = above.and_then(|above| points.get(above + 1));
    // logarithms of time and error at both ends, and of the time between them
    let time = |[t, m]: [f64; 2], end: Option<[f64; 2]>| {
        let slope = end.map_or(-1.0, |[u, n]| (u - t) / (n - m));
        (if is_upper_bound { t } else { t + slope * (mse.ln() - m) }, slope)
    };
    let logs = |c: [f64; 2]| c.map(f64::ln);
    let whole = |costs: &[Cost]| logs([mean(costs, |c| c.seconds), mean(costs, |c| c.mse)]);
    let (value, slope) = time(whole(start), end.map(|end| whole(end)));
    let count = end.map_or(usize::MAX, |end| end.len()).min(start.len());
    let single = |c: &Cost| logs([c.seconds, c.mse]);
    let each: Vec<f64> = (0..count).map(|i| time(single(&start[i]), end.map(|end| single(&end[i]))).0).collect();
    let half = if each.iter().all(|x| x.is_finite()) { Estimate::of(&each).half } else { f64::INFINITY };
    let reference = if is_upper_bound { 0.0 } else { (slope * known / mse).abs() };
    Some(Reach {
        seconds: value.exp(),
        factor: (half + reference).exp(),
        is_beyond: above.is_some() && end.is_none(),
        is_upper_bound,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Uniform random numbers from a fixed sequence.
    fn random(state: &mut u64) -> f64 {
        *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((*state >> 33) as f64 + 0.5) / (1_u64 << 31) as f64
    }
    fn normal(state: &mut u64) -> f64 {
        (-2.0 * random(state).ln()).sqrt() * (std::f64::consts::TAU * random(state)).cos()
    }
    /// Fraction of 4000 trials in which `holds` returns true.
    fn share(mut holds: impl FnMut(&mut u64) -> bool) -> f64 {
        let mut state = 7;
        (0..4000).filter(|_| holds(&mut state)).count() as f64 / 4000.0
    }
    /// Asserts a fraction of 0.95, within five standard errors of 4000 trials.
    fn nineteen_of_twenty(share: f64) {
        assert!((share - 0.95).abs() < 5.0 * (0.95 * 0.05_f64 / 4000.0).sqrt(), "{share}");
    }

    #[test]
    fn intervals_hold_the_truth_as_often_as_they_claim() {
        for n in [2, 3, 5, 12] {
            nineteen_of_twenty(share(|s| {
                let e = Estimate::of(&(0..n).map(|_| 3.0 + 0.5 * normal(s)).collect::<Vec<_>>());
                (e.value - 3.0).abs() <= e.half
            }));
            // an error that is reached between two images, at 1.5 s, with noise of a few per cent in errors and times
            nineteen_of_twenty(share(|s| {
                let [a, b] = [(1.0, 1.0), (2.0, 0.3)].map(|(seconds, mse)| {
                    let mut one = |_| Cost {
                        mse: mse * (1.0 + 0.03 * normal(s)),
                        relative: 1.0,
                        seconds: seconds * (1.0 + 0.02 * normal(s)),
                    };
                    (0..n).map(&mut one).collect::<Vec<_>>()
                });
                let mse = 0.3_f64.powf(1.5_f64.log2());
                let reach = reach(&[&a, &b], mse, 0.0).unwrap();
                reach.low() <= 1.5 && 1.5 <= reach.high() || !reach.factor.is_finite()
            }));
            let x = [1.0_f64, 4.0, 16.0, 64.0];
            nineteen_of_twenty(share(|s| {
                let lines: Vec<Vec<f64>> =
                    (0..n).map(|_| x.iter().map(|x| x.powf(-1.5) * (0.1 * normal(s)).exp()).collect()).collect();
                let e = slope(&x, &lines).unwrap();
                (e.value + 1.5).abs() <= e.half
            }));
        }
    }

    #[test]
    fn what_is_not_known_is_said() {
        assert_eq!(Estimate::of(&[2.0]), Estimate { value: 2.0, half: f64::INFINITY });
        assert!(!Estimate::of(&[2.0]).is_sure() && !Estimate { value: -1.0, half: 0.0 }.is_sure());
        assert!(Estimate { value: 1.0, half: 0.29 }.is_sure() && !Estimate { value: 1.0, half: 0.31 }.is_sure());
        let cost = |mse| Cost { mse, relative: mse, seconds: 1.0 };
        assert_eq!(reach(&[&[cost(2.0)]], 1.0, 0.0).map(|reach| reach.factor), Some(f64::INFINITY));
        assert_eq!(reach(&[], 1.0, 0.0), None);
        assert_eq!(slope(&[1.0, 2.0], &[vec![1.0, -1.0]]), None);
        assert_eq!(slope(&[2.0, 2.0], &[vec![1.0, 1.0]]), None);
    }

    #[test]
    fn students_quantiles_are_those_of_the_tables() {
        // of distributions with 1, 2, 4, 9 and 30 degrees of freedom
        for (n, probability, t) in [
            (2, 0.05, 12.706_204_7),
            (3, 0.05, 4.302_652_7),
            (5, 0.05, 2.776_445_1),
            (10, 0.05, 2.262_157_2),
            (31, 0.05, 2.042_272_5),
            (5, 0.001, 8.610_301_6),
            (10, 0.001, 4.780_912_6),
        ] {
            assert!((student(n, probability) / t - 1.0).abs() < 1e-7, "{n} {probability}: {}", student(n, probability));
        }
        assert_eq!(student(1, 0.05), f64::INFINITY);
    }

    /// A line of slope −2 in logarithms, then −1 as no image goes on: by hand.
    #[test]
    fn errors_are_reached_between_images_and_after_the_last() {
        let at = |seconds: f64, mse: f64| [1.0, 1.02, 0.98].map(|f| Cost { mse: mse * f, relative: 1.0, seconds });
        let (a, b) = (at(1.0, 1.0), at(2.0, 0.25));
        let reached = |mse: f64| reach(&[&a, &b], mse, 0.0).unwrap();
        for (mse, seconds) in [(0.25, 2.0), (0.5, 2.0_f64.sqrt()), (0.125, 4.0), (0.01, 50.0)] {
            assert!((reached(mse).seconds / seconds - 1.0).abs() < 1e-12, "{mse}: {:?}", reached(mse));
            assert_eq!((reached(mse).is_beyond, reached(mse).is_upper_bound), (mse < 0.25, false));
        }
        assert!(reached(1.5).is_upper_bound && reached(1.5).seconds == 1.0 && reached(1.5).low() == 0.0);
        // three images that differ by 2 %: ±2 % × 4.3 / √3 in error, half of that in time where the slope is −2
        let factor = |mse: f64| reached(mse).factor.ln();
        assert!((factor(0.01) / (4.302_65 * 0.02 / 3_f64.sqrt()) - 1.0).abs() < 0.01, "{}", factor(0.01));
        assert!((factor(0.5) / (0.5 * factor(0.01)) - 1.0).abs() < 0.01, "{}", factor(0.5));
        // a reference whose error is known to a tenth of the target
        let rough = reach(&[&a, &b], 0.01, 0.001).unwrap();
        assert!((rough.factor / reached(0.01).factor / 0.1_f64.exp() - 1.0).abs() < 1e-12);
        assert_eq!(reach(&[&at(1.0, -1.0)], 0.01, 0.0), None);
        // an error that rises again was not reached
        assert!((reach(&[&b, &a, &at(4.0, 0.5)], 0.5 + 1e-9, 0.0).unwrap().seconds / 4.0 - 1.0).abs() < 1e-6);
    }
}
