//! Random numbers.

/// Steps of a lattice of points: 1/g and 1/g² with g³ = g + 1.
pub(crate) const LATTICE: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];

/// SplitMix64 (Steele, Lea and Flood 2014), from this state.
#[derive(Clone, Debug)]
pub struct Random(pub u64);

impl Random {
    /// 64 random bits.
    pub fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    /// A number in \[0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.word() >> 11) as f64 / (1_u64 << 53) as f64
    }
    /// A point of the unit disk.
    pub(crate) fn disk(&mut self) -> [f64; 2] {
        let (r, turn) = (self.unit().sqrt(), self.unit() * core::f64::consts::TAU);
        [r * turn.cos(), r * turn.sin()]
    }
}
