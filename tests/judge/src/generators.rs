//! Arguments: points of the unit square biased towards its edges, and shapes from each regime in which some method fails.
//!
//! They are the same on every platform: `libm` computes the sines and logarithms here, since those of the standard library are the
//! C library's, which differ in their last bits.

mod flat;
mod horizon;
mod lights;
mod line;
mod round;
mod warps;

use crate::fixture::Fixture;
pub use crate::random::Random;
use etendue_oracle::narrow;
pub use flat::*;
pub use horizon::*;
use libm::{cos, sin};
pub use lights::lights;
pub use line::*;
pub use warps::*;

/// A [`ZOrder`](etendue::sequence::ZOrder) whose pixels are positions along the curve, for what takes any sequence.
#[derive(Clone, Copy, Debug)]
pub struct AlongCurve(pub etendue::sequence::ZOrder);

impl etendue::sequence::Sequence for AlongCurve {
    fn pair<R: etendue::Real>(&self, pixel: R::Uint, sample: R::Uint, dimension: u32) -> etendue::Vec2<R> {
        self.0.pair(etendue::sequence::ZOrderIndex::from_position(pixel), sample, dimension)
    }
}

const EPSILON: f32 = 1.0 / 16_777_216.0;

/// Numbers in [0, 1) at which maps break: the ends, the middle, and their neighbours.
pub const EDGES: [f32; 11] = [
    0.0,
    EPSILON,
    2.0 * EPSILON,
    1e-3,
    0.25,
    0.5 - EPSILON,
    0.5,
    0.5 + EPSILON,
    0.75,
    1.0 - 2.0 * EPSILON,
    1.0 - EPSILON,
];

/// All pairs of [`EDGES`], then `random` further points.
#[must_use]
pub fn square(random: usize, seed: u64) -> Vec<[f32; 2]> {
    let mut rng = Random::new(seed);
    let mut all: Vec<_> = EDGES.iter().flat_map(|&x| EDGES.map(|y| [x, y])).collect();
    all.extend((0..random).map(|_| [rng.unit(), rng.unit()]));
    all
}

/// A number in [0, 1); one in three is from [`EDGES`].
pub fn unit_or_edge(random: &mut Random) -> f64 {
    let word = random.word();
    if word.is_multiple_of(3) { f64::from(EDGES[(word >> 32) as usize % EDGES.len()]) } else { random.unit_f64() }
}

/// A shape, with the name of the regime that it represents.
pub type Case<S> = (&'static str, S);

/// Those cases of which a horizon leaves anything.
#[must_use]
pub fn seen<S: Fixture>(mut cases: Vec<Case<S>>) -> Vec<Case<S>> {
    cases.retain(|case| case.1.truth().is_seen());
    cases
}

/// A frame of any orientation: a case begins.
fn frame(random: &mut Random) -> [[f64; 3]; 3] {
    random.begin();
    let n = random.direction();
    let (s, t) = etendue_oracle::basis(n);
    let turn = random.range(0.0, core::f64::consts::TAU);
    let mix = |a: [f64; 3], b: [f64; 3], c: f64, d: f64| core::array::from_fn(|i| a[i] * c + b[i] * d);
    [mix(s, t, cos(turn), sin(turn)), mix(s, t, -sin(turn), cos(turn)), n]
}

fn combine(axes: &[[f64; 3]; 3], x: f64, y: f64, z: f64) -> [f64; 3] {
    core::array::from_fn(|i| axes[0][i] * x + axes[1][i] * y + axes[2][i] * z)
}

/// Lengths and coordinates that break naive code.
pub const NASTY: [f32; 14] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    1e-30,
    -1e-30,
    1e30,
    -1e30,
    1e-42,
    1e-45,
    f32::MIN_POSITIVE,
    1.0 + 2.0 * EPSILON,
    f32::MAX,
    -f32::MAX,
];

/// A vector of [`NASTY`] coordinates, some of which are often equal.
pub fn nasty(random: &mut Random) -> [f32; 3] {
    let mut pick = || NASTY[(random.word() % NASTY.len() as u64) as usize];
    let (a, b, c) = (pick(), pick(), pick());
    match random.word() % 4 {
        0 => [0.0, a, 0.0],
        1 => [a, a, b],
        _ => [a, b, c],
    }
}
