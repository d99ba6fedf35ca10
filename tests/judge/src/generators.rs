//! Arguments: points of the unit square biased towards its edges, and shapes from each regime in which some method fails.
//!
//! They are the same on every platform: `libm` computes the sines and logarithms here, since those of the standard library are the
//! C library's, which differ in their last bits.

mod flat;
mod horizon;
mod line;
mod round;
mod warps;

use etendue_oracle::narrow;
pub use flat::*;
pub use horizon::*;
use libm::{cos, exp, log, sin};
pub use line::*;
pub use round::*;
pub use warps::*;

/// A [`ZOrder`](etendue::sequence::ZOrder) whose pixels are positions along the curve, for what takes any sequence.
#[derive(Clone, Copy, Debug)]
pub struct AlongCurve(pub etendue::sequence::ZOrder);

impl etendue::sequence::Sequence for AlongCurve {
    fn pair<R: etendue::Real>(&self, pixel: R::Uint, sample: R::Uint, dimension: u32) -> etendue::Vec2<R> {
        self.0.pair(etendue::sequence::ZOrderIndex::from_position(pixel), sample, dimension)
    }
}

/// SplitMix64, independent of the generators under test; before it, given numbers, if there are any: a fuzzer's bytes are then numbers of a
/// shape, and no seed.
#[derive(Clone, Debug)]
pub struct Random {
    numbers: Vec<u64>,
    /// How many of the numbers have been read.
    read: usize,
    state: u64,
}

impl From<u64> for Random {
    fn from(seed: u64) -> Self {
        Self::new(seed)
    }
}

impl Random {
    /// Starts a stream.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self { numbers: Vec::new(), read: 0, state: seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x1234_5678_9abc_def0 }
    }
    /// Begins with these numbers.
    #[must_use]
    pub fn of(numbers: Vec<u64>) -> Self {
        Self { numbers, ..Self::new(0) }
    }
    /// Begins a case, which reads the numbers that others read: they are those of whichever is taken.
    fn begin(&mut self) {
        self.read = 0;
    }
    /// 64 random bits.
    pub fn word(&mut self) -> u64 {
        if let Some(&number) = self.numbers.get(self.read) {
            self.read += 1;
            return number;
        }
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }
    /// One of the first `n` numbers; the same also where addresses have 32 bits.
    pub fn below(&mut self, n: usize) -> usize {
        (self.word() % n as u64) as usize
    }
    /// A multiple of 2⁻²⁴ in [0, 1).
    pub fn unit(&mut self) -> f32 {
        (self.word() >> 40) as f32 / 16_777_216.0
    }
    /// In [0, 1).
    pub fn unit_f64(&mut self) -> f64 {
        (self.word() >> 11) as f64 / 9_007_199_254_740_992.0
    }
    /// Uniform from `low` to `high`.
    pub fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit_f64()
    }
    /// Log-uniform from `low` to `high`.
    pub fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        exp(self.range(log(low), log(high)))
    }
    /// A uniform unit vector.
    pub fn direction(&mut self) -> [f64; 3] {
        let (z, phi) = (self.range(-1.0, 1.0), self.range(0.0, core::f64::consts::TAU));
        let r = (1.0 - z * z).sqrt();
        [r * cos(phi), r * sin(phi), z]
    }
    /// A finite f32 from random bits.
    pub fn any_f32(&mut self) -> f32 {
        loop {
            let x = f32::from_bits(self.word() as u32);
            if x.is_finite() {
                return x;
            }
        }
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
