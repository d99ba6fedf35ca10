//! What is known of the lights of a group of shading points before any is sampled: plain data, which `know` writes and estimators read.

use crate::bvh::GROUP;
use crate::camera::{Group, Points};
use crate::choose::allocation::FEW;
use crate::packet::{M8, V8, X8};
use etendue::{Mask, Real, u32x8};

/// What can be known of lights before any is sampled.
pub(crate) trait Know {
    /// Prepares for the samples of a tile, by its first pixel.
    fn begin(&mut self, origin: [u32; 2]);
    /// Looks at some points of the tile, each of them seen in a pixel of its own, and decides what is worth asking for.
    fn look_ahead(&mut self, points: &Points, pixels: &[[[u32; 2]; 8]; GROUP]) -> Outlook;
    /// Writes what is known of the lights of a group, and adds the light that follows from it.
    fn know(&mut self, group: &Group<'_>, ledger: &mut Ledger, reflected: &mut [V8; GROUP]);
    /// Sets the lanes of a packet of shading points, each of them seen in one of these pixels, in which each light is open.
    fn open_at(&mut self, points: &Points, packet: usize, pixels: &[[u32; 2]; 8], open: &mut [M8]);
    /// [`RayCount::proofs`](crate::bvh::RayCount::proofs), `met` and `forms` since the last call.
    fn take_counts(&mut self) -> [u64; 3];
    /// A bound of the error of what is known without samples at the first shading point.
    fn error_bound(&mut self, points: &Points) -> V8;
}

/// What is foreseen of a tile.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Outlook {
    /// Whether lights of this tile may be known without samples.
    pub(crate) some: bool,
    /// Whether all lights were known at all points that were looked at.
    pub(crate) all: bool,
}

/// What is known of each light at the points of a group, for each packet and lane.
///
/// Estimators add the integral of what is left to what is counted already, so that the sum is all of the light. Whole lights may be missing
/// from it ([`open`](Self::open)). The other two are control variates: where a [fit](Proven::fitted) g of f cosθ was integrated over a light,
/// an estimator samples (f cosθ − g) · L · V, and where a fraction of its visibility was [counted](Self::counted), f cosθ · L · (V − fraction).
pub(crate) struct Ledger {
    /// Whether anything is known: without that, nothing else is read.
    pub(crate) is_known: bool,
    /// Whether no light is left to be sampled.
    pub(crate) is_closed: bool,
    /// Lanes in which each light must be sampled, whole or in part.
    pub(crate) open: Vec<[M8; GROUP]>,
    /// The fraction of its visibility that is counted, if lights [have such fractions](Self::has_fractions).
    pub(crate) fractions: Vec<[X8; GROUP]>,
    pub(crate) has_fractions: bool,
    /// What is proved of it where rough surfaces have fits.
    pub(crate) proven: Vec<[Proven; GROUP]>,
    /// Whether any surface of a packet has a fit.
    pub(crate) has_fits: [bool; GROUP],
}

/// What is proved of a light, as seen from a packet of rough surfaces.
#[derive(Clone, Copy)]
pub(crate) struct Proven {
    /// Lanes in which the fit of the BSDF was integrated over the light.
    pub(crate) fitted: M8,
    /// Lanes that see all of the light, so that samples need no shadow ray.
    pub(crate) lit: M8,
    /// Lanes that see nothing of the light.
    pub(crate) dark: M8,
}

impl Proven {
    /// Nothing is proved.
    pub(crate) fn nothing() -> Self {
        let none = M8::splat(false);
        Self { fitted: none, lit: none, dark: none }
    }
}

impl Ledger {
    /// Nothing is known: all lights are open. It has room for up to [`FEW`] lights if something may be known.
    pub(crate) fn all_open(has_room: bool) -> Self {
        let lights = if has_room { FEW } else { 0 };
        Self {
            is_known: false,
            is_closed: false,
            open: vec![[M8::splat(false); GROUP]; lights],
            fractions: vec![[X8::lit(0.0); GROUP]; lights],
            has_fractions: false,
            proven: vec![[Proven::nothing(); GROUP]; lights],
            has_fits: [false; GROUP],
        }
    }
    /// Nothing is known any more.
    #[inline]
    pub(crate) const fn forget(&mut self) {
        (self.is_known, self.is_closed) = (false, false);
    }
    /// Lanes in which each light is open, for each light and packet; everywhere, if `None`.
    #[inline(always)]
    pub(crate) fn open(&self) -> Option<&[[M8; GROUP]]> {
        self.is_known.then_some(&self.open)
    }
    /// What is proved of these lights, one for each lane of a packet, if its surfaces have fits.
    #[inline(always)]
    pub(crate) fn proven(&self, packet: usize, lights: u32x8) -> Option<Proven> {
        (self.is_known && self.has_fits[packet]).then(|| self.proven_of(packet, lights))
    }
    #[inline(never)]
    fn proven_of(&self, packet: usize, lights: u32x8) -> Proven {
        let mut all = Proven::nothing();
        for (lane, &light) in lights.as_array().iter().enumerate() {
            let Some(of) = self.proven.get(light as usize) else { continue };
            let (lane, Proven { fitted, lit, dark }) = (M8::from_bits(1 << lane), of[packet]);
            all.fitted = all.fitted | fitted & lane;
            all.lit = all.lit | lit & lane;
            all.dark = all.dark | dark & lane;
        }
        all
    }
    /// The fractions of these lights that are counted, if there are any.
    #[inline(always)]
    pub(crate) fn counted(&self, packet: usize, lights: u32x8) -> Option<X8> {
        (self.is_known && self.has_fractions).then(|| self.counted_of(packet, lights))
    }
    #[inline(never)]
    fn counted_of(&self, packet: usize, lights: u32x8) -> X8 {
        let of = |lane: usize| self.fractions.get(lights.as_array()[lane] as usize);
        X8::from_fn(|lane| of(lane).map_or(0.0, |of| of[packet].lane(lane)))
    }
}
