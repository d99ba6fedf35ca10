//! p-values. A test at [`SIGNIFICANCE`](crate::tolerances::SIGNIFICANCE) with a fixed seed either always passes or always fails.

/// Probability of a χ² at least as large as the observed one, if `expected` holds. Cells whose expectation is below 10 are pooled into one;
/// any observation in a cell of expectation 0 gives 0.
#[must_use]
pub fn chi_square(observed: &[u64], expected: &[f64]) -> f64 {
    assert_eq!(observed.len(), expected.len());
    let (mut sum, mut cells) = (0.0, 0_u32);
    let mut pooled = (0.0, 0.0);
    let mut add = |o: f64, e: f64| {
        sum += (o - e) * (o - e) / e;
        cells += 1;
    };
    for (&o, &e) in observed.iter().zip(expected) {
        if e == 0.0 && o > 0 {
            return 0.0;
        }
        if e < 10.0 {
            pooled = (pooled.0 + o as f64, pooled.1 + e);
        } else {
            add(o as f64, e);
        }
    }
    if pooled.1 > 0.0 {
        add(pooled.0, pooled.1.max(1e-300));
    }
    // what is expected, exactly, is not in the domain of the function
    if cells < 2 || sum == 0.0 {
        return 1.0;
    }
    statrs::function::gamma::gamma_ur(f64::from(cells - 1) / 2.0, (sum / 2.0).max(0.0))
}

/// p-value of a χ² test against equal expectations.
#[must_use]
pub fn uniform(observed: &[u64]) -> f64 {
    let expected = observed.iter().sum::<u64>() as f64 / observed.len() as f64;
    chi_square(observed, &vec![expected; observed.len()])
}

/// Probability that a normal deviate lies beyond ±z.
#[must_use]
pub fn two_sided(z: f64) -> f64 {
    statrs::function::erf::erfc(z.abs() / core::f64::consts::SQRT_2)
}

/// Pearson's correlation coefficient.
#[must_use]
pub fn correlation(pairs: &[(f64, f64)]) -> f64 {
    let n = pairs.len() as f64;
    let mean = pairs.iter().fold((0.0, 0.0), |m, p| (m.0 + p.0 / n, m.1 + p.1 / n));
    let (mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0);
    for p in pairs {
        let (x, y) = (p.0 - mean.0, p.1 - mean.1);
        (xx, yy, xy) = (xx + x * x, yy + y * y, xy + x * y);
    }
    xy / (xx * yy).sqrt()
}

/// Mean and variance (divisor n − 1), in two passes.
#[must_use]
pub fn mean_variance(x: &[f64]) -> (f64, f64) {
    let mean = x.iter().sum::<f64>() / x.len() as f64;
    let square = x.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>();
    (mean, square / (x.len() as f64 - 1.0))
}
