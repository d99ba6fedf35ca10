//! What an estimator is given, and what it returns.

use super::points::Points;
use crate::allocation::Allocated;
use crate::bsdf::Bsdf;
use crate::bvh::GROUP;
use crate::choose::Chooser;
use crate::ledger::Ledger;
use crate::lights::Lights;
use crate::packet::{M8, V8, X8};
use crate::prepared::PreparedScene;
use crate::surfaces::Surface;
use etendue::{Mask, Vec2};

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

/// Random numbers of each packet of a group.
pub(crate) struct Numbers {
    /// For the point on the light, or the direction.
    pub(crate) light: [Vec2<X8>; GROUP],
    /// For the choice of a light, if there are so many that it needs numbers of its own.
    pub(crate) choice: Option<[Vec2<X8>; GROUP]>,
    /// For a direction from the BSDF in addition to a light, if the technique combines them.
    pub(crate) surface: Option<[Vec2<X8>; GROUP]>,
}

/// The shading points of up to [`GROUP`] packets, and the random numbers of their samples.
pub(crate) struct Group<'a> {
    pub(crate) scene: &'a PreparedScene,
    /// The lights that are sampled, and how they are chosen.
    pub(crate) lights: &'a Lights,
    pub(crate) chooser: &'a Chooser,
    pub(crate) points: &'a Points,
    /// Number of packets.
    pub(crate) count: usize,
    pub(crate) numbers: &'a Numbers,
    /// Allocates each sample of each packet to a light, or is empty.
    pub(crate) allocated: &'a [Allocated<'a>],
    /// If samples are allocated, a bit for each light that is worth some in a packet.
    pub(crate) expected: &'a [u32; GROUP],
}

impl Group<'_> {
    /// The packets in which anything reflects.
    pub(crate) fn reflecting(&self) -> impl Iterator<Item = (usize, &Surface)> {
        self.points.surfaces[..self.count].iter().enumerate().filter(|(_, surface)| surface.reflects.any())
    }
    /// The BSDFs of a packet.
    #[inline(always)]
    pub(super) fn bsdf<const GENERAL: bool>(&self, packet: usize) -> Bsdf<GENERAL> {
        let Surface { normal, albedo, .. } = self.points.surfaces[packet];
        if GENERAL {
            let end = &self.points.ends[packet];
            Bsdf::new([normal, end.flat], albedo, end.direction, end.metal, self.numbers.light[packet])
        } else {
            Bsdf::new([normal; 2], albedo, V8::default(), None, Vec2::default())
        }
    }
    /// The fits of f cosθ of rough surfaces, for the unit directions `w` with the cosine `cos` to the normal.
    #[inline]
    pub(super) fn fit(&self, packet: usize, w: V8, cos: X8) -> V8 {
        self.points.lobes[packet].as_ref().map_or(V8::default(), |lobe| lobe.evaluate(w, cos))
    }
    /// Lanes of rough metals and of coats.
    #[inline(always)]
    pub(super) fn rough<const GENERAL: bool>(&self, packet: usize) -> M8 {
        if GENERAL { self.points.ends[packet].rough() } else { M8::splat(false) }
    }
}
