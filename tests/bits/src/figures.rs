//! The numbers that a routine returns, in an order that does not depend on the width.

#[cfg(any(feature = "all-widths", target_feature = "avx512f"))]
use etendue::f32x16;
use etendue::{Mask, Real, Uint, Vec2, Vec3, f32x8};
#[cfg(feature = "all-widths")]
use etendue::{f32x4, f64x4, f64x8};

/// A routine with all its arguments. They are in slots, the number of which is a multiple of [`Figures::MOST`]; a packet takes as many
/// successive slots as it has lanes.
pub trait Routine {
    /// The greatest number of lanes that the routine takes.
    const MOST: usize = Figures::MOST;
    /// Adds all that the routine returns.
    fn run<R: Real>(&self, figures: &mut Figures);
}

/// All numbers that a routine returned, slot by slot.
#[derive(Clone, Debug, Default)]
pub struct Figures {
    slots: Vec<Vec<u64>>,
    nans: usize,
}

impl Figures {
    /// The greatest number of lanes.
    pub const MOST: usize = 16;

    /// Runs a routine.
    pub fn of<R: Real>(routine: &impl Routine) -> Self {
        let mut all = Self::default();
        routine.run::<R>(&mut all);
        all
    }
    /// Calls `f` with the first slot of each packet.
    pub fn packets<R: Real>(&mut self, slots: usize, mut f: impl FnMut(usize, &mut Lanes<'_>)) {
        assert!(slots.is_multiple_of(Self::MOST), "{slots} slots fill no packets");
        for first in (0..slots).step_by(R::LANES) {
            let begin = self.slots.len();
            self.slots.resize(begin + R::LANES, Vec::new());
            f(first, &mut Lanes { slots: &mut self.slots[begin..], nans: &mut self.nans });
        }
    }
    /// A number that belongs to no slot.
    pub fn number(&mut self, x: f64) {
        self.nans += usize::from(x.is_nan());
        self.slots.push(vec![bits(x)]);
    }
    /// How often a result was no number.
    #[must_use]
    pub fn nans(&self) -> usize {
        self.nans
    }
    /// FNV-1a of 64 bits, of the numbers in f64 from the low byte on.
    #[must_use]
    pub fn hash(&self) -> u64 {
        let bytes = self.slots.iter().flatten().flat_map(|word| word.to_le_bytes());
        bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
    }
    /// One line per slot.
    pub fn lines(&self, width: &str) -> impl Iterator<Item = String> {
        self.slots.iter().enumerate().map(move |(i, slot)| {
            let words: String = slot.iter().map(|word| format!(" {word:016x}")).collect();
            format!("{width} {i}{words}")
        })
    }
}

/// The bits of a number; those of NaN say nothing, so that all are one.
fn bits(x: f64) -> u64 {
    if x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() }
}

/// The slots of one packet.
#[derive(Debug)]
pub struct Lanes<'a> {
    slots: &'a mut [Vec<u64>],
    nans: &'a mut usize,
}

impl Lanes<'_> {
    /// Adds a number of one lane.
    pub fn lane(&mut self, lane: usize, x: f64) {
        *self.nans += usize::from(x.is_nan());
        self.slots[lane].push(bits(x));
    }
    /// Adds a number of each lane.
    pub fn real<R: Real>(&mut self, x: R) {
        (0..R::LANES).for_each(|i| self.lane(i, x.lane_f64(i)));
    }
    /// Adds numbers of each lane.
    pub fn reals<R: Real, const N: usize>(&mut self, all: [R; N]) {
        all.into_iter().for_each(|x| self.real(x));
    }
    /// Adds a vector.
    pub fn vector<R: Real>(&mut self, v: Vec3<R>) {
        self.reals([v.x, v.y, v.z]);
    }
    /// Adds a pair.
    pub fn pair<R: Real>(&mut self, v: Vec2<R>) {
        self.reals([v.x, v.y]);
    }
    /// Adds counters.
    pub fn words<U: Uint>(&mut self, x: U) {
        (0..U::LANES).for_each(|i| self.slots[i].push(u64::from(x.lane(i))));
    }
    /// Adds truth values.
    pub fn truth<R: Real>(&mut self, mask: R::Mask) {
        (0..R::LANES).for_each(|i| self.slots[i].push(u64::from(mask.lane(i))));
    }
}

/// A routine's name, and its numbers at each width.
#[derive(Debug)]
pub(crate) struct Entry {
    pub(crate) name: String,
    pub(crate) widths: Vec<(&'static str, Figures)>,
}

fn widths<T: Routine>(routine: &T) -> Vec<(&'static str, Figures)> {
    let mut all = Vec::new();
    #[cfg(feature = "all-widths")]
    all.extend([("f32", Figures::of::<f32>(routine)), ("f32x4", Figures::of::<f32x4>(routine))]);
    all.extend([("f32x8", Figures::of::<f32x8>(routine)), ("f64", Figures::of::<f64>(routine))]);
    #[cfg(feature = "all-widths")]
    all.extend([("f64x4", Figures::of::<f64x4>(routine)), ("f64x8", Figures::of::<f64x8>(routine))]);
    // others have no registers of this width
    #[cfg(any(feature = "all-widths", target_feature = "avx512f"))]
    if T::MOST >= 16 {
        all.push(("f32x16", Figures::of::<f32x16>(routine)));
    }
    all
}

/// Takes the routines of each module.
pub(crate) struct List<'a>(&'a mut dyn FnMut(Entry));

impl<'a> List<'a> {
    pub(crate) fn new(take: &'a mut dyn FnMut(Entry)) -> Self {
        Self(take)
    }
    pub(crate) fn add(&mut self, name: impl Into<String>, routine: &impl Routine) {
        let widths = widths(routine);
        (self.0)(Entry { name: name.into(), widths });
    }
}
