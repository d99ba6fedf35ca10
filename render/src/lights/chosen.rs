//! One light in each lane, and what is sampled of it.

use super::record::{KINDS, PICTURED, PROFILED, SPREAD, TWO_SIDED};
use crate::bvh::PrimitiveIds;
use crate::geometry::spread::Spread;
use crate::geometry::{self, Kind, Parallelogram, Sphere};
use crate::packet::{M8, V8, X8, each_bit, equal};
use crate::surfaces::lobe::Lobe;
use etendue::{LightSample, LightSampler, Mask, Real, Vec2, u32x8};

/// A direction to a light in each lane, and what comes from there.
#[derive(Clone, Copy)]
pub struct Drawn {
    /// The direction.
    pub to: LightDirection,
    /// Radiance from there; of a delta light, its intensity over the squared distance, or its irradiance.
    pub radiance: V8,
    /// The shapes there; none for lights that no ray can hit.
    pub primitives: PrimitiveIds,
}

/// A direction to a light in each lane: the part of a [`LightSample`] that direct lighting needs.
#[derive(Clone, Copy)]
pub struct LightDirection {
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

impl LightDirection {
    /// No sample in any lane.
    #[inline(always)]
    pub(super) fn none() -> Self {
        let (zero, none) = (X8::lit(0.0), M8::splat(false));
        Self { direction: V8::default(), distance: zero, pdf: zero, emits: none, delta: none }
    }
    /// Replaces these lanes by those of another sample.
    #[inline(always)]
    pub(super) fn put(&mut self, here: M8, sample: &Self) {
        self.direction = V8::blend(here, sample.direction, self.direction);
        self.distance = Real::blend(here, sample.distance, self.distance);
        self.pdf = Real::blend(here, sample.pdf, self.pdf);
        self.emits = sample.emits & here | self.emits & !here;
        self.delta = sample.delta & here | self.delta & !here;
    }
}

impl From<LightSample<X8>> for LightDirection {
    #[inline(always)]
    fn from(s: LightSample<X8>) -> Self {
        let LightSample { direction, distance, pdf, emits, delta, .. } = s;
        Self { direction, distance, pdf, emits, delta }
    }
}

/// One light in each lane.
#[derive(Clone, Copy)]
pub struct Chosen {
    /// As in the light's record, whose kind says what these are.
    pub(super) place: V8,
    pub(super) first: V8,
    pub(super) second: V8,
    /// Radiance; intensity or irradiance for a delta light. Of a picture, it is the mean.
    pub(super) radiance: V8,
    pub(super) spread: Spread<X8>,
    pub(super) kind: u32x8,
    /// Its shape, if it has one.
    pub(super) primitives: PrimitiveIds,
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
            primitives: PrimitiveIds::from_floats(b[5]),
        }
    }
    /// The three vectors of their records.
    #[inline(always)]
    pub(super) fn vectors(&self) -> [V8; 3] {
        [self.place, self.first, self.second]
    }
    /// Where points with these normals on these primitives are on the light itself. All lights are convex, so they do not see it,
    /// except from inside of a sphere: what a sample of it finds there is due to rounding.
    #[inline(always)]
    pub fn is_own(&self, primitives: PrimitiveIds, p: V8, normal: V8) -> M8 {
        self.primitives.equal(primitives) & !self.surrounds(p, normal)
    }
    /// Lanes of spheres that points on them, with these normals, see: from inside.
    #[inline(always)]
    fn surrounds(&self, p: V8, normal: V8) -> M8 {
        self.is(Kind::Sphere as u32) & normal.dot(p - self.place).lt(X8::lit(0.0))
    }
    /// Replaces the samples of spheres that emit evenly, where rough metals reflect them, by samples of the lobe. Returns these lanes: the BSDF
    /// need not be sampled for such a light.
    // not inlined, so that it does not burden scenes without rough metals
    #[inline(never)]
    pub fn sample_lobe(&self, sample: &mut LightDirection, lobe: &Lobe, p: V8, u: Vec2<X8>) -> M8 {
        let reflected = self.is(Kind::Sphere as u32) & !self.has(SPREAD | PICTURED | PROFILED) & lobe.metals();
        if reflected.any() {
            let light = Sphere::light(self.vectors());
            let mut drawn = LightDirection::from(light.by_reflection(p, &lobe.reflection).sample(u));
            drawn.emits = drawn.emits | self.has(TWO_SIDED);
            sample.put(reflected, &drawn);
        }
        reflected
    }
    /// The normals of the lights that are shapes of these kinds, of any length; 0 for curved ones, and the lights, of
    /// which parallelograms with a spread are what the points see of them.
    #[inline(never)]
    pub(super) fn narrowed(&self, kinds: u32, p: V8) -> (V8, Self) {
        let mut normal = V8::default();
        each_bit(kinds, |kind| {
            let of_kind = geometry::normals(kind as u32, self.vectors());
            normal = V8::blend(self.is(kind as u32), of_kind, normal);
        });
        // a picture is on the whole of its light
        let has_spread = self.is(Kind::Parallelogram as u32) & self.has(SPREAD) & !self.has(PICTURED);
        let light = Parallelogram::light(self.vectors());
        let part = etendue::Parallelogram::blend(has_spread, self.spread.visible_part(&light, p), light);
        (normal, Self { place: part.corner, first: part.edge_s, second: part.edge_t, ..*self })
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
