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

/// Efficiency of `a` relative to `b`, where efficiency is 1/(MSE × time) of the means.
///
/// Replicates of the same round are paired, so that a slow round affects neither. The interval is that of the logarithm, to first
/// order in the relative errors (the delta method): `value / factor` to `value × factor`, with `half = value (factor − 1)`. `None`
/// if a mean is not positive.
#[must_use]
pub fn gain(a: &[Cost], b: &[Cost]) -> Option<Estimate> {
    let n = a.len().min(b.len());
    let mean = |c: &[Cost], f: fn(&Cost) -> f64| c[..n].iter().map(f).sum::<f64>() / n as f64;
    let of = |c: &[Cost]| [mean(c, |c| c.mse), mean(c, |c| c.seconds)];
    let ([am, at], [bm, bt]) = (of(a), of(b));
    if n == 0 || [am, at, bm, bt].iter().any(|x| !x.is_finite() || *x <= 0.0) {
        return None;
    }
    let value = bm * bt / (am * at);
    let influence: Vec<f64> =
        (0..n).map(|i| b[i].mse / bm + b[i].seconds / bt - a[i].mse / am - a[i].seconds / at).collect();
    Some(Estimate { value, half: value * Estimate::of(&influence).half.exp_m1() })
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

/// The y at `x` of a polyline through points (x, y), in logarithms. Beyond its ends, y falls as 1/x. `None` without a positive point.
#[must_use]
pub fn level(points: &[(f64, f64)], x: f64) -> Option<f64> {
    let mut points: Vec<_> = points.iter().copied().filter(|p| p.0 > 0.0 && p.1 > 0.0).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (first, last) = (points.first()?, points.last()?);
    for (end, beyond) in [(first, x <= first.0), (last, x >= last.0)] {
        if beyond {
            return Some(end.1 * end.0 / x);
        }
    }
    let [a, b] = points.windows(2).find(|p| x < p[1].0).and_then(|p| <[_; 2]>::try_from(p).ok())?;
    Some(a.1 * (b.1 / a.1).powf((x / a.0).ln() / (b.0 / a.0).ln()))
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
            // a relative efficiency of 6, noise of a few per cent, and rounds that are slow for both
            nineteen_of_twenty(share(|s| {
                let (mut a, mut b) = (Vec::new(), Vec::new());
                for _ in 0..n {
                    let slow = 1.0 + random(s);
                    let mut one = |mse: f64, seconds: f64| Cost {
                        mse: mse * (1.0 + 0.03 * normal(s)),
                        relative: 1.0,
                        seconds: seconds * slow * (1.0 + 0.02 * normal(s)),
                    };
                    a.push(one(1.0, 2.0));
                    b.push(one(4.0, 3.0));
                }
                let g = gain(&a, &b).unwrap();
                let factor = 1.0 + g.half / g.value;
                g.value / factor <= 6.0 && 6.0 <= g.value * factor
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
        assert_eq!(gain(&[cost(-1.0), cost(0.5)], &[cost(1.0), cost(1.0)]), None);
        assert_eq!(gain(&[], &[cost(1.0)]), None);
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

    #[test]
    fn a_line_has_a_level_within_and_beyond() {
        let line = [(1.0, 1.0), (2.0, 0.5), (8.0, 0.25)];
        for (x, y) in [(0.5, 2.0), (1.0, 1.0), (2.0, 0.5), (4.0, 0.5_f64.powf(1.5)), (8.0, 0.25), (16.0, 0.125)] {
            assert!((level(&line, x).unwrap() / y - 1.0).abs() < 1e-12, "{x}");
        }
        assert_eq!(level(&[(1.0, -1.0)], 2.0), None);
    }
}
