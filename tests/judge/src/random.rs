//! Random numbers.

use libm::{cos, exp, log, sin};

/// SplitMix64, independent of the generators under test; before it, given numbers, if there are any: a fuzzer's bytes are then numbers of a
/// shape, and no seed.
#[derive(Clone, Debug)]
pub struct Random {
    numbers: Vec<u64>,
    /// How many of the numbers have been read.
    read: usize,
    rest: etendue_oracle::Random,
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
        let state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x1234_5678_9abc_def0;
        Self { numbers: Vec::new(), read: 0, rest: etendue_oracle::Random(state) }
    }
    /// Begins with these numbers.
    #[must_use]
    pub fn of(numbers: Vec<u64>) -> Self {
        Self { numbers, ..Self::new(0) }
    }
    /// Begins a case, which reads the numbers that others read: they are those of whichever is taken.
    pub(crate) fn begin(&mut self) {
        self.read = 0;
    }
    /// 64 random bits.
    pub fn word(&mut self) -> u64 {
        if let Some(&number) = self.numbers.get(self.read) {
            self.read += 1;
            return number;
        }
        self.rest.word()
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
