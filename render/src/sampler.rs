//! Generates the random numbers of a pixel's samples.
//!
//! Each sample has a pair of numbers for each use: [`FILM`], [`LIGHT`], [`CHOICE`], [`LENS`], [`SURFACE`]; 5 and up are free.
//! *Padding* makes each pair a well-distributed set of its own and combines the pairs at random; a *joint* set is well
//! distributed in all of its dimensions together.
//!
//! The samples of a well-distributed set are not independent, so their spread does not measure the error. A pixel therefore
//! consists of a few independent *sets*, and its variance is that of the mean of their means. The sampler
//! `adaptive` needs one set in a pixel: it renders some pixels twice, and the differences estimate the variance everywhere.

use crate::named::named;
use crate::packet::{M8, X8};
use etendue::sequence::{Independent, JointSobol, OwenSobol, Sequence, Stratified, ZOrder, ZOrderIndex};
use etendue::{Vec2, u32x8};

named! {
    /// How random numbers are spread over the samples of a pixel.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Sampler {
        /// Independent random numbers
        Independent = "independent",
        /// Jittered strata in the pixel and on the light, paired at random
        Stratified = "stratified",
        /// Owen-scrambled Sobol pairs in the pixel and on the light, paired at random
        Sobol = "sobol",
        /// Owen-scrambled Sobol points of pixel × light (× lens)
        Sobol4d = "sobol-4d",
        /// Owen-scrambled Sobol pairs distributed along a Z-order curve of pixels: blue noise
        ZOrder = "z-order",
        /// Like sobol where samples are counted per light, else like sobol-4d; more samples in pixels whose neighbours have more variance
        Adaptive = "adaptive",
    }
}

/// The pair for the position in the pixel.
pub const FILM: u32 = 0;
/// The pair for the point on the light, or the direction.
pub const LIGHT: u32 = 1;
/// The pair whose first number chooses the light.
pub const CHOICE: u32 = 2;
/// The pair for the point on the lens.
pub const LENS: u32 = 3;
/// The pair for a direction sampled from the surface's BSDF, in addition to a point on the light.
pub const SURFACE: u32 = 4;

/// Eight samples to be taken.
#[derive(Clone, Copy, Debug)]
pub struct Packet {
    /// Columns of their pixels.
    pub x: u32x8,
    /// Rows of their pixels.
    pub y: u32x8,
    /// Indices of the samples in their pixels.
    pub sample: u32x8,
    /// Indices of the sets in their pixels: ⌊sample/set_size⌋, or 0 if each sample is a set; see [`NumberSource::set_size`].
    pub set: u32x8,
    /// Lanes that hold a sample.
    pub active: M8,
}

impl Packet {
    /// The pixel of all samples, if they are of one.
    pub fn pixel(&self) -> Option<[u32; 2]> {
        let [x, y] = [self.x, self.y].map(u32x8::to_array);
        (1..8).all(|lane| x[lane] == x[0] && y[lane] == y[0]).then_some([x[0], y[0]])
    }
}

/// Sets of a pixel of `spp` samples: the fewest that give a variance, or 4 if each then has at least 8 samples.
const fn fewest_sets(spp: u32) -> u32 {
    if spp.is_multiple_of(4) && spp >= 32 {
        4
    } else if spp.is_multiple_of(2) {
        2
    } else {
        1
    }
}

/// Fewest samples of a pixel in each set of [`Sampler::Adaptive`]: a packet of 8 for the pilot.
pub(crate) const FEWEST: u32 = 8;

/// Mixes bits: the output function of SplitMix64 (Steele, Lea and Flood 2014).
pub(crate) const fn hash64(mut bits: u64) -> u64 {
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

impl Sampler {
    /// Checks that this sampler supports `spp` samples per pixel in `sets` sets (see [`Settings::sets`](crate::Settings::sets)).
    ///
    /// # Errors
    /// Fails if `spp` is unsupported; the message says which numbers are.
    pub fn check(self, spp: u32, sets: u32) -> Result<(), String> {
        if sets > 1 && !spp.is_multiple_of(sets) {
            return Err(format!("{spp} samples per pixel cannot be split into {sets} equal sets"));
        }
        match self {
            Self::Adaptive if spp < FEWEST * sets.max(1) => {
                Err(format!("adaptive needs at least {} samples per pixel: {spp} is too few", FEWEST * sets.max(1)))
            }
            _ => Ok(()),
        }
    }
    /// Whether the samples of a pixel form sets, within which they are not independent.
    #[must_use]
    pub fn has_sets(self) -> bool {
        self != Self::Independent
    }
    /// Whether some pixels are rendered twice, so that the differences estimate the variance everywhere: if no number of sets is asked for.
    #[must_use]
    pub fn checks(self, asked: u32) -> bool {
        self == Self::Adaptive && asked == 0
    }
    /// Independent sets of samples per pixel if `asked` sets are requested (0: as few as give a variance, if any number does).
    #[must_use]
    pub fn sets(self, spp: u32, asked: u32) -> u32 {
        match self {
            _ if asked != 0 => asked,
            Self::Adaptive => 1,
            _ => fewest_sets(spp),
        }
    }
}

#[derive(Debug)]
enum AnySequence {
    Independent(Independent),
    Stratified(Stratified),
    Sobol(OwenSobol),
    Sobol4d(JointSobol),
    ZOrder(ZOrder),
}

/// Random numbers for the samples of an image.
#[derive(Debug)]
pub struct NumberSource {
    sequence: AnySequence,
    /// Samples in a set; 0 if each sample is a set.
    set_size: u32,
    /// Distance of the first indices of two successive sets, less `set_size`.
    gap: u32x8,
    width: u32x8,
}

/// Index of a pair in a joint point. The lens comes before the choice of a light, which few scenes need.
const fn joint(dimension: u32) -> u32 {
    match dimension {
        LENS => 2,
        CHOICE => 3,
        other => other,
    }
}

impl NumberSource {
    /// Prepares `spp` samples per pixel, in `sets` sets, for an image of this width.
    ///
    /// Every count is valid; Sobol points are best if a set is a power of two. With [`Sampler::Adaptive`], points are joint in pixel and light
    /// unless samples are `counted` per light, each of which has points of its own.
    #[must_use]
    pub fn new(sampler: Sampler, seed: u64, [spp, sets]: [u32; 2], width: u32, counted: bool) -> Self {
        let set_size = match sampler {
            // its sets have no fixed length, so samples are counted within each
            Sampler::Adaptive => 0,
            _ => spp / sampler.sets(spp, sets),
        };
        // each set starts anew
        let (sequence, stride) = match sampler {
            Sampler::Independent => (AnySequence::Independent(Independent::new(seed)), set_size),
            Sampler::Stratified => (AnySequence::Stratified(Stratified::new(seed, set_size)), set_size),
            Sampler::Adaptive if counted => (AnySequence::Sobol(OwenSobol::new(seed)), set_size),
            Sampler::Sobol => (AnySequence::Sobol(OwenSobol::new(seed)), set_size),
            Sampler::Sobol4d | Sampler::Adaptive => (AnySequence::Sobol4d(JointSobol::new(seed)), set_size),
            Sampler::ZOrder => {
                let set = ZOrder::new(seed, set_size);
                (AnySequence::ZOrder(set), set.samples())
            }
        };
        let set_size = if sampler == Sampler::Independent { 0 } else { set_size };
        Self { sequence, set_size, gap: u32x8::splat(stride.saturating_sub(set_size)), width: u32x8::splat(width) }
    }
    /// Samples in a set; 0 if each sample is a set.
    #[must_use]
    pub const fn set_size(&self) -> u32 {
        self.set_size
    }
    /// The pairs [`FILM`] and [`LIGHT`].
    #[inline(always)]
    pub fn film_and_light(&self, packet: &Packet) -> [Vec2<X8>; 2] {
        match &self.sequence {
            AnySequence::Independent(set) => set.two_pairs(packet.y * self.width + packet.x, packet.sample, 0),
            _ => [self.pair(packet, FILM), self.pair(packet, LIGHT)],
        }
    }
    /// Whether samples can be counted per light, so that each light gets a well-distributed set of its own.
    #[must_use]
    pub const fn allocates(&self) -> bool {
        matches!(self.sequence, AnySequence::Sobol(_))
    }
    /// The pair [`FILM`], and the pair [`LIGHT`] of samples that are counted per light: `sample` is the index among those of the
    /// lane's `light`.
    #[inline]
    pub fn film_and_light_of(&self, packet: &Packet, light: u32x8, sample: u32x8) -> [Vec2<X8>; 2] {
        let pixel = packet.y * self.width + packet.x;
        let key = pixel * u32x8::splat(4) + packet.set + light * u32x8::splat(0x9e37_79b9);
        match &self.sequence {
            AnySequence::Sobol(set) => [self.pair(packet, FILM), set.pair(key, sample, LIGHT)],
            _ => self.film_and_light(packet),
        }
    }
    /// A pair of numbers for each of eight samples.
    #[inline]
    pub fn pair(&self, packet: &Packet, dimension: u32) -> Vec2<X8> {
        let pixel = packet.y * self.width + packet.x;
        // the Sobol sequence does not end, so the set is part of the key
        let sobol = || {
            let first = packet.set * u32x8::splat(self.set_size);
            (pixel * u32x8::splat(4) + packet.set, packet.sample - first)
        };
        let sample = || packet.sample + packet.set * self.gap;
        match &self.sequence {
            AnySequence::Independent(set) => set.pair(pixel, packet.sample, dimension),
            AnySequence::Stratified(set) => set.pair(pixel, packet.sample, dimension),
            AnySequence::Sobol(set) => {
                let (key, index) = sobol();
                set.pair(key, index, dimension)
            }
            AnySequence::Sobol4d(set) => {
                let (key, index) = sobol();
                set.pair(key, index, joint(dimension))
            }
            AnySequence::ZOrder(set) => set.pair(ZOrderIndex::new(packet.x, packet.y), sample(), dimension),
        }
    }
}

/// The most accurate sampler that can also estimate the variance of `spp` samples in `sets` sets (see
/// [`Settings::sets`](crate::Settings::sets)): [`Sampler::Adaptive`] from 8 samples in each set on, else [`Sampler::Sobol`] for an even number
/// of samples, else [`Sampler::Independent`]. If one set is asked for, nobody asks for a variance.
#[must_use]
pub fn default_sampler(spp: u32, sets: u32) -> Sampler {
    let fits = |s: &Sampler| s.check(spp, sets).is_ok() && (sets == 1 || reports_variance(*s, spp, sets));
    [Sampler::Adaptive, Sampler::Sobol].into_iter().find(fits).unwrap_or(Sampler::Independent)
}

/// Whether pixels of `spp` samples in `sets` sets (see [`Settings::sets`](crate::Settings::sets)) have a finite variance.
#[must_use]
pub fn reports_variance(sampler: Sampler, spp: u32, sets: u32) -> bool {
    match sampler {
        // each of its samples is a set
        Sampler::Independent => spp > 1,
        _ => sampler.checks(sets) || sampler.sets(spp, sets) > 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_sampler_reports_a_variance_if_any_does() {
        for spp in 2..200 {
            assert!(reports_variance(default_sampler(spp, 0), spp, 0), "{spp}");
        }
        let chosen = [1, 2, 3, 6, 7, 8, 33, 64].map(|spp| default_sampler(spp, 0));
        use Sampler::{Adaptive, Independent, Sobol};
        assert_eq!(chosen, [Independent, Sobol, Independent, Sobol, Independent, Adaptive, Adaptive, Adaptive]);
        assert_eq!([6, 8].map(|spp| default_sampler(spp, 1)), [Sobol, Adaptive]);
        assert_eq!(default_sampler(16, 4), Sobol);
    }
}
