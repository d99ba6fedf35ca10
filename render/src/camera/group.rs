//! Groups of shading points, of which lights are known and at which they are sampled.

use super::points::Points;
use super::prepared::PreparedScene;
use crate::bvh::GROUP;
use crate::choose::Chooser;
use crate::choose::allocation::Allocated;
use crate::lights::Lights;
use crate::packet::{M8, V8, X8};
use crate::surfaces::Surface;
use crate::surfaces::bsdf::Bsdf;
use etendue::{Mask, Vec2};

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
    pub(crate) fn bsdf<const GENERAL: bool>(&self, packet: usize) -> Bsdf<'_, GENERAL> {
        let Surface { normal, albedo, .. } = self.points.surfaces[packet];
        if GENERAL {
            let end = &self.points.ends[packet];
            Bsdf::new([normal, end.flat], albedo, end.direction, end.metal.as_ref(), self.numbers.light[packet])
        } else {
            Bsdf::new([normal; 2], albedo, V8::default(), None, Vec2::default())
        }
    }
    /// The fits of f cosθ of rough surfaces, for the unit directions `w` with the cosine `cos` to the normal.
    #[inline]
    pub(crate) fn fit(&self, packet: usize, w: V8, cos: X8) -> V8 {
        self.points.lobes[packet].as_ref().map_or(V8::default(), |lobe| lobe.evaluate(w, cos))
    }
    /// Lanes of rough metals and of coats.
    #[inline(always)]
    pub(crate) fn rough<const GENERAL: bool>(&self, packet: usize) -> M8 {
        if GENERAL { self.points.ends[packet].rough() } else { M8::splat(false) }
    }
}
