//! One light in each lane, and what is sampled of it.

use super::record::KINDS;
use crate::bvh::SHAPE;
use crate::packet::{M8, V8, X8, equal, select};
use etendue::light::Spread;
use etendue::{LightSample, u32x8};

/// A direction to a light in each lane: the part of a [`LightSample`] that direct lighting needs.
#[derive(Clone, Copy)]
pub struct Drawn {
    /// Unit direction to the light.
    pub direction: V8,
    /// Distance to the light along it.
    pub distance: X8,
    /// Pdf per steradian, without the choice of the light; 0 where there is no sample.
    pub pdf: X8,
    /// True where the light emits towards the point.
    pub emits: M8,
    /// True where no other technique can hit the light.
    pub delta: M8,
}

impl Drawn {
    /// The sample in these lanes, and the other, if there is one, elsewhere.
    #[inline(always)]
    pub(super) fn blend(here: M8, sample: Self, other: Option<Self>) -> Self {
        let Some(other) = other else { return sample };
        Self {
            direction: V8::blend(here, sample.direction, other.direction),
            distance: select(here, sample.distance, other.distance),
            pdf: select(here, sample.pdf, other.pdf),
            emits: sample.emits & here | other.emits & !here,
            delta: sample.delta & here | other.delta & !here,
        }
    }
}

impl From<LightSample<X8>> for Drawn {
    #[inline(always)]
    fn from(s: LightSample<X8>) -> Self {
        let LightSample { direction, distance, pdf, emits, delta, .. } = s;
        Self { direction, distance, pdf, emits, delta }
    }
}

/// One light in each lane.
pub struct Chosen {
    /// As in the light's record, whose kind says what these are.
    pub(super) place: V8,
    pub(super) first: V8,
    pub(super) second: V8,
    /// Radiance; intensity or irradiance for a delta light. That of a picture is the mean until the light is sampled.
    pub radiance: V8,
    pub(super) spread: Spread<X8>,
    pub(super) kind: u32x8,
    /// Index of its shape; [`NOTHING`](crate::bvh::NOTHING) for a light without one.
    pub shape: u32x8,
}

/// Not inlined, so that its registers do not burden the cheaper measures.
#[inline(never)]
pub(super) fn projected<D>(sample: impl Fn() -> D) -> D {
    sample()
}

impl Chosen {
    /// From the two halves of the records, one light per lane.
    #[inline(always)]
    pub(super) fn new([a, b]: [[X8; 8]; 2]) -> Self {
        Self {
            place: V8::new(a[0], a[1], a[2]),
            first: V8::new(a[3], a[4], a[5]),
            second: V8::new(a[6], a[7], b[0]),
            radiance: V8::new(b[1], b[2], b[3]),
            spread: Spread { tan_half: b[6], gain: b[7] },
            kind: b[4].to_bits(),
            shape: b[5].to_bits(),
        }
    }
    /// Where points with these normals on these primitives, as in hits, are on the light itself. All lights are convex, so they do not see it,
    /// except from inside of a sphere: what a sample of it finds there is due to rounding.
    #[inline(always)]
    pub fn is_own(&self, primitives: u32x8, p: V8, normal: V8) -> M8 {
        equal(self.shape ^ u32x8::splat(SHAPE), primitives) & !self.surrounds(p, normal)
    }
    /// Lanes of this kind of light.
    #[inline]
    pub(super) fn is(&self, kind: u32) -> M8 {
        equal(self.kind & u32x8::splat(KINDS), u32x8::splat(kind))
    }
    /// Lanes of lights with any of these flags.
    #[inline]
    pub(super) fn has(&self, flag: u32) -> M8 {
        !equal(self.kind & u32x8::splat(flag), u32x8::splat(0))
    }
}
