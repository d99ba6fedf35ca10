//! What an estimator is given, and what it returns.

use super::points::Points;
use super::tracer::Tracer;
use crate::allocation::Allocated;
use crate::bsdf::Bsdf;
use crate::bvh::GROUP;
use crate::choose::Chooser;
use crate::lights::Lights;
use crate::packet::{M8, V8, X8};
use crate::prepared::PreparedScene;
use crate::surfaces::Surface;
use etendue::{Mask, Vec2};

/// A way to estimate the light that a group of shading points reflects, or what an [`Integrand`] has left of it.
pub(crate) trait Estimator<I> {
    /// Adds an unbiased estimate for each point. `GENERAL` compiles in what surfaces need that are not flat and diffuse.
    fn add<const GENERAL: bool>(
        &mut self,
        group: &Group<'_>,
        integrand: &I,
        tracer: &mut Tracer,
        reflected: &mut Reflected,
    );
    /// The estimate for each point. What a scene does not need is not compiled in.
    fn estimate(&mut self, group: &Group<'_>, integrand: &I, tracer: &mut Tracer) -> Reflected {
        let mut reflected = Reflected::default();
        match group.scene.surfaces.is_plain {
            true => self.add::<false>(group, integrand, tracer, &mut reflected),
            false => self.add::<true>(group, integrand, tracer, &mut reflected),
        }
        reflected
    }
}

/// An estimator of all light, as the tiles of an image use it. What only closed forms can answer has a default for all others.
pub(crate) trait TileEstimator {
    /// Whether a sample needs a pair of numbers for the surface besides that for the light.
    fn is_combined(&self) -> bool;
    /// Radiance that a group of shading points reflects towards the camera rays.
    fn reflected(&mut self, group: &Group<'_>, tracer: &mut Tracer) -> Reflected;
    /// Prepares for the samples of a tile, by its first pixel. Returns whether it wants to [look ahead](Self::look_ahead).
    fn begin(&mut self, _origin: [u32; 2]) -> bool {
        false
    }
    /// Looks at some points of the tile, each of them seen in a pixel of its own.
    fn look_ahead(&mut self, _points: &Points, _pixels: &[[[u32; 2]; 8]; GROUP]) {}
    /// Whether lights of this tile may be known without samples.
    fn asks(&self) -> bool {
        false
    }
    /// Whether all lights were known at all points that were looked at.
    fn knows_all(&self) -> bool {
        false
    }
    /// Sets the lanes of a packet of shading points, each of them seen in one of these pixels, in which each light must be sampled.
    fn remaining(&mut self, points: &Points, packet: usize, _pixels: &[[u32; 2]; 8], remaining: &mut [M8]) {
        remaining.fill(points.surfaces[packet].reflects);
    }
    /// A bound of the error of what is known without samples at the first shading point.
    fn error_bound(&mut self, _points: &Points) -> V8 {
        V8::default()
    }
}

/// The radiance that the points of a group reflect.
#[derive(Clone, Copy, Default)]
pub(crate) struct Reflected {
    /// The part that is computed without samples of lights.
    pub(crate) known: [V8; GROUP],
    /// The estimate of the rest.
    pub(crate) sampled: [V8; GROUP],
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
            Bsdf::new(normal, end.flat, albedo, end.direction, end.metal)
        } else {
            Bsdf::new(normal, normal, albedo, V8::default(), None)
        }
    }
    /// Lanes of rough metals and of coats.
    #[inline(always)]
    pub(super) fn rough<const GENERAL: bool>(&self, packet: usize) -> M8 {
        if GENERAL { self.points.ends[packet].rough() } else { M8::splat(false) }
    }
}
