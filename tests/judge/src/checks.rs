//! Checks of functions that are not warps. Each takes the function as an argument.

use crate::random::Random;
use etendue::estimate::Heuristic;
use etendue_oracle::Greatest;

/// The greatest error of a function, for comparison with its documentation.
#[derive(Clone, Copy, Debug)]
pub struct MeasuredError {
    /// What was measured.
    pub name: &'static str,
    /// The greatest error, and the arguments at which it occurs.
    pub greatest: Greatest<[f32; 2]>,
}
impl MeasuredError {
    /// No error yet.
    #[must_use]
    pub fn of(name: &'static str) -> Self {
        Self { name, greatest: Greatest::NONE }
    }
    /// Takes one more error into account.
    pub fn take(&mut self, error: f64, at: [f32; 2]) {
        self.greatest.take(error, at);
    }
    /// Asserts that the error is at most `documented`, and at least nine tenths of it, so that the documentation stays tight.
    pub fn assert_below(&self, documented: f64) {
        let (name, error, at) = (self.name, self.greatest.error(), self.greatest.at());
        println!("{name:40} {error:.3e} at {at:?}, documented {documented:.2e}");
        assert!(error <= documented, "{name}: {error:e} at {at:?}");
        assert!(error >= 0.9 * documented, "{name}: the figure can be tightened to {error:e}");
    }
}

/// Checks a two-argument arc tangent at every magnitude including the subnormal ones, on the axes, and for signed zeros.
pub fn atan2(atan2: impl Fn(f32, f32) -> f32) {
    let mut relative = MeasuredError::of("atan2, relative");
    let mut random = Random::new(2);
    for i in 0..1 << 21 {
        let scale = random.magnitude(1e-30, 1e30);
        let ratio = if i % 2 == 0 { random.magnitude(1e-38, 1.0) } else { random.unit_f64() };
        let (a, b) = (scale as f32, (scale * ratio) as f32);
        let signs = random.word();
        let sign = |x: f32, bit: u32| if signs >> bit & 1 == 1 { -x } else { x };
        let (y, x) = if signs >> 2 & 1 == 1 { (sign(a, 0), sign(b, 1)) } else { (sign(b, 0), sign(a, 1)) };
        let truth = f64::from(y).atan2(f64::from(x));
        if truth.abs() > f64::from(f32::MIN_POSITIVE) {
            relative.take((f64::from(atan2(y, x)) / truth - 1.0).abs(), [y, x]);
        }
    }
    relative.assert_below(2.0e-7);
    // both arguments subnormal, at all ratios on their grid; then a subnormal angle
    let mut steps =
        [MeasuredError::of("atan2 below 64 steps of 2⁻¹⁴⁹"), MeasuredError::of("atan2 of subnormal numbers")];
    for (i, j, side) in (1..256_u32).flat_map(|i| (1..256).flat_map(move |j| [(i, j, 1.0), (i, j, -1.0)])) {
        let (y, x) = (f32::from_bits(i), side * f32::from_bits(j));
        let relative = f64::from(atan2(y, x)) / f64::from(y).atan2(f64::from(x)) - 1.0;
        steps[usize::from(i.max(j) >= 64)].take(relative.abs(), [y, x]);
    }
    steps[0].assert_below(5.2e-6);
    steps[1].assert_below(1.6e-7);
    assert_eq!(atan2(1e-30_f32, 1e10), 1e-40);
    // axes and signed zeros, as in IEEE 754
    for y in [0.0_f32, -0.0, 1.0, -1.0] {
        for x in [0.0_f32, -0.0, 1.0, -1.0] {
            let (ours, std) = (atan2(y, x), y.atan2(x));
            if y == 0.0 && x == 0.0 {
                assert!(ours == 0.0 && ours.is_sign_negative() == y.is_sign_negative(), "{y} {x}: {ours}");
            } else {
                assert!(
                    (ours - std).abs() <= 3e-7 && ours.is_sign_negative() == std.is_sign_negative(),
                    "{y} {x}: {ours}"
                );
            }
        }
    }
}

/// All heuristics.
pub const HEURISTICS: [Heuristic; 6] = [
    Heuristic::Balance,
    Heuristic::POWER,
    Heuristic::Power(0),
    Heuristic::Power(1),
    Heuristic::Power(5),
    Heuristic::Maximum,
];
/// Densities from 0 to that of a delta.
pub const EXTREMES: [f32; 13] =
    [0.0, 1e-45, 1e-40, f32::MIN_POSITIVE, 1e-30, 1e-10, 0.3, 1.0, 7.0, 1e20, 1e38, f32::MAX, f32::INFINITY];

/// Weights are in [0, 1] and sum to 1, or to 0 if all densities are 0; a density of 0 has weight 0.
fn weights_sum_to_one(heuristic: Heuristic, densities: &[f32], weights: &[f32]) {
    let sum: f64 = weights.iter().copied().map(f64::from).sum();
    let expected = f64::from(u8::from(densities.iter().any(|d| *d > 0.0)));
    assert!((sum - expected).abs() <= 2.4e-7, "{heuristic:?} {densities:?} {weights:?}");
    assert!(weights.iter().all(|w| (0.0..=1.0).contains(w)), "{heuristic:?} {densities:?} {weights:?}");
    for (d, w) in densities.iter().zip(weights) {
        assert!(*d > 0.0 || *w == 0.0, "{heuristic:?} {densities:?} {weights:?}");
    }
}
/// Checks the weights of two and of three techniques at all pairs and triples of [`EXTREMES`].
pub fn extreme_weights(heuristic: Heuristic) {
    for a in EXTREMES {
        for b in EXTREMES {
            weights_sum_to_one(heuristic, &[a, b], &heuristic.weights([a, b]));
            for c in EXTREMES {
                weights_sum_to_one(heuristic, &[a, b, c], &heuristic.weights([a, b, c]));
            }
        }
    }
}
