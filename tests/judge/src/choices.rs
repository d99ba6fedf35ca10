//! Judges choosers among lights against sums over all lights.

use crate::random::Random;
use crate::stats::{self, chi_square};
use crate::tolerances::SIGNIFICANCE;

/// Chooses one of many lights.
pub trait Chooser {
    /// The light for `u` in [0, 1) and the probability with which it is chosen; `None` chooses none.
    fn choose(&self, u: f32) -> Option<(usize, f32)>;
    /// The probability of a light.
    fn pmf(&self, light: usize) -> f32;
}

/// What is said about a chooser.
#[derive(Clone, Debug, Default)]
pub struct Choice {
    /// Lights that contribute and are never chosen.
    pub lost: Vec<usize>,
    /// Σ pmf over all lights.
    pub sum: f64,
    /// Variance of one choice over the squared sum of all contributions; 0 is the optimum.
    pub variance: f64,
    /// What is wrong, in sentences.
    pub findings: Vec<String>,
}

/// Greatest relative error of a probability.
const ERROR: f64 = 1e-3;
/// Expected number of choices of a light from which none at all says that it is lost: once in 10¹³ by chance.
const CERTAIN: f64 = 30.0;

/// Judges a chooser whose lights contribute `all`, by `draws` choices, which should be 50 for each light at least.
pub fn choices(chooser: &dyn Chooser, all: &[f64], draws: usize, seed: u64) -> Choice {
    let pmf: Vec<f64> = (0..all.len()).map(|i| f64::from(chooser.pmf(i))).collect();
    let (sum, total) = (pmf.iter().sum::<f64>(), all.iter().sum::<f64>());
    let mut said = Choice { sum, ..Choice::default() };
    if let Some((i, p)) = pmf.iter().enumerate().find(|(_, p)| !(p.is_finite() && **p >= 0.0)) {
        said.findings.push(format!("the pmf of light {i} is {p}"));
        return said;
    }
    // draws: one in each stratum
    let (mut counts, mut random, mut none) = (vec![0_u64; all.len()], Random::new(seed), 0_usize);
    let (mut worst, mut estimate) = ((0.0, 0, 0.0_f32), 0.0);
    for k in 0..draws {
        let u = ((k as f64 + random.unit_f64()) / draws as f64) as f32;
        let Some((i, p)) = chooser.choose(u.min(1.0 - 1.0 / 16_777_216.0)) else {
            none += 1;
            continue;
        };
        if i >= all.len() {
            said.findings.push(format!("u = {u:?} chooses light {i} of {}", all.len()));
            return said;
        }
        counts[i] += 1;
        estimate += if p > 0.0 { all[i] / f64::from(p) } else { f64::INFINITY };
        let off = (f64::from(p) / pmf[i] - 1.0).abs();
        if !(off <= worst.0) {
            worst = (off, i, u);
        }
    }
    if !(worst.0 <= ERROR) {
        said.findings
            .push(format!("u = {:?} chooses light {} with a pmf that is off by {:.1e}", worst.2, worst.1, worst.0));
    }
    let drawn = (draws - none) as f64 / draws as f64;
    if (sum - drawn).abs() > ERROR {
        said.findings.push(format!("Σ pmf is {sum:.6}, and {drawn:.6} of the draws choose a light"));
    }
    let is_lost = |i: usize| all[i] > 0.0 && (pmf[i] == 0.0 || counts[i] == 0 && pmf[i] * draws as f64 > CERTAIN);
    said.lost = (0..all.len()).filter(|i| is_lost(*i)).collect();
    if let Some(first) = said.lost.first() {
        let part = said.lost.iter().map(|i| all[*i]).sum::<f64>() / total;
        let count = said.lost.len();
        said.findings
            .push(format!("{count} lights are never chosen, light {first} first: {part:.1e} of all light is lost"));
    }
    let expected: Vec<f64> = pmf.iter().map(|p| p * draws as f64).collect();
    let p = chi_square(&counts, &expected);
    if p < 1e-7 && said.lost.is_empty() {
        said.findings.push(format!("lights are not chosen as often as their pmf says: p = {p:.1e}"));
    }
    let squares = all.iter().zip(&pmf).filter(|(c, _)| **c > 0.0).map(|(c, p)| c * c / p).sum::<f64>();
    said.variance = (squares / (total * total) - 1.0).max(0.0);
    // five standard deviations of the plain estimate, which strata only lessen
    let allowed = ERROR.max(5.0 * (said.variance / draws as f64).sqrt());
    let off = (estimate / draws as f64 / total - 1.0).abs();
    if said.lost.is_empty() && !(off <= allowed) {
        said.findings.push(format!("the estimate of all light is off by {off:.1e}"));
    }
    said
}

/// Lights are chosen as often as their probabilities say, of which the last is that of none, and the number that is left is uniform and independent of
/// the light.
///
/// # Panics
/// If that is not so.
pub fn frequencies(name: &str, probabilities: &[f64], chosen: &[etendue::select::Choice<f32>]) {
    let none = probabilities.len() - 1;
    let (mut counts, mut left, mut pairs) = (vec![0_u64; none + 1], vec![0_u64; 64], Vec::new());
    for choice in chosen {
        counts[(choice.index as usize).min(none)] += 1;
        // of a light that few numbers choose, the number left has few values
        if choice.pmf > 5e-4 {
            left[(choice.u * 64.0) as usize] += 1;
            pairs.push((f64::from(choice.index), f64::from(choice.u)));
        }
    }
    let expected: Vec<f64> = probabilities.iter().map(|p| p * chosen.len() as f64).collect();
    let p = chi_square(&counts, &expected);
    assert!(p > SIGNIFICANCE, "{name}: frequencies, p = {p}");
    if let Some(first) = pairs.first() {
        let p = stats::uniform(&left);
        assert!(p > SIGNIFICANCE, "{name}: number left, p = {p}");
        // without two lights that are often chosen there is nothing to correlate
        if pairs.iter().any(|pair| pair.0 != first.0) {
            let p = stats::two_sided(stats::correlation(&pairs) * (pairs.len() as f64).sqrt());
            assert!(p > SIGNIFICANCE, "{name}: correlation, p = {p}");
        }
    }
}
