//! The counter hash for the `rand` ecosystem.

use super::independent::hash4;
use core::convert::Infallible;
use rand_core::{SeedableRng, TryRng};

/// The counter hash as a random generator: `rand_core`'s `Rng`, seedable, with a period of 2⁶⁴ words.
///
/// Call `CounterRng::seed_from_u64(seed)`, then `next_u32`. It never fails.
///
/// ```
/// use etendue::{Real, sequence::CounterRng};
/// use rand_core::{Rng, SeedableRng};
/// let mut rng = CounterRng::seed_from_u64(1);
/// let u: f32 = Real::unit(rng.next_u32());
/// assert!(u >= 0.0 && u < 1.0);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CounterRng {
    key: [u32; 2],
    counter: u64,
    words: [u32; 4],
}

impl SeedableRng for CounterRng {
    type Seed = [u8; 8];
    fn from_seed(seed: Self::Seed) -> Self {
        let seed = u64::from_le_bytes(seed);
        Self { key: [seed as u32, (seed >> 32) as u32], counter: 0, words: [0; 4] }
    }
}

impl TryRng for CounterRng {
    type Error = Infallible;
    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        let index = (self.counter % 4) as usize;
        if index == 0 {
            let block = self.counter / 4;
            self.words = hash4([block as u32, (block >> 32) as u32, self.key[0], self.key[1]]);
        }
        self.counter = self.counter.wrapping_add(1);
        Ok(self.words[index])
    }
    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        let low = u64::from(self.try_next_u32()?);
        Ok(low | u64::from(self.try_next_u32()?) << 32)
    }
    fn try_fill_bytes(&mut self, dst: &mut [u8]) -> Result<(), Infallible> {
        rand_core::utils::fill_bytes_via_next_word(dst, || self.try_next_u32())
    }
}
