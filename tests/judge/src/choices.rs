//! Judges choices among lights.

use crate::stats::{self, chi_square};
use crate::tolerances::SIGNIFICANCE;

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
