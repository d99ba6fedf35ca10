//! One light in each lane, and samples of those that are shapes.

use super::record::{KINDS, PARALLELOGRAM, PICTURED, PROFILED, SPHERE, SPREAD, TWO_SIDED};
use crate::bvh::SHAPE;
use crate::lobe::Lobe;
use crate::packet::{M8, V8, X8, equal, select};
use crate::technique::Measure;
use etendue::light::Spread;
use etendue::{LightSample, LightSampler, Mask, Parallelogram, Real, Sphere, Triangle, Vec2, u32x8};

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
    /// As in the light's record.
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
fn projected<D>(sample: impl Fn() -> D) -> D {
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
    #[inline]
    pub(super) fn sphere<D: From<LightSample<X8>>>(&self, measure: Measure, p: V8, normal: V8, u: Vec2<X8>) -> D {
        let light = Sphere { center: self.place, radius: self.first.x };
        match measure {
            Measure::Area => {
                // From outside, the far side is behind the near one, even if it emits inwards. The light does not occlude itself.
                let drawn = light.by_area(p).sample(u);
                let inside = (light.center - p).length_squared().lt(light.radius * light.radius);
                LightSample { pdf: drawn.pdf.keep(drawn.emits | inside), ..drawn }.into()
            }
            Measure::SolidAngle => light.by_solid_angle(p).sample(u).into(),
            Measure::Projected => light.by_projected_solid_angle(p, normal).sample(u).into(),
        }
    }
    #[inline]
    pub(super) fn triangle<D: From<LightSample<X8>>>(&self, measure: Measure, p: V8, normal: V8, u: Vec2<X8>) -> D {
        let light = Triangle { v0: self.place, e1: self.first, e2: self.second };
        match measure {
            Measure::Area => light.by_area(p).sample(u).into(),
            Measure::SolidAngle => light.by_solid_angle(p).sample(u).into(),
            Measure::Projected => projected(|| light.by_projected_solid_angle(p, normal).sample(u).into()),
        }
    }
    #[inline]
    pub(super) fn parallelogram<D: From<LightSample<X8>>>(
        &self,
        measure: Measure,
        p: V8,
        normal: V8,
        u: Vec2<X8>,
    ) -> D {
        let light = Parallelogram { corner: self.place, edge_s: self.first, edge_t: self.second };
        match measure {
            Measure::Area => light.by_area(p).sample(u).into(),
            Measure::SolidAngle => light.by_solid_angle(p).sample(u).into(),
            Measure::Projected => projected(|| light.by_projected_solid_angle(p, normal).sample(u).into()),
        }
    }
    /// Where points with these normals on these primitives, as in hits, are on the light itself. All lights are convex, so they do not see it,
    /// except from inside of a sphere: what a sample of it finds there is due to rounding.
    #[inline(always)]
    pub fn is_own(&self, primitives: u32x8, p: V8, normal: V8) -> M8 {
        let own = equal(self.shape ^ u32x8::splat(SHAPE), primitives);
        let sphere = equal(self.kind & u32x8::splat(KINDS), u32x8::splat(SPHERE));
        own & !(sphere & normal.dot(p - self.place).lt(X8::lit(0.0)))
    }
    /// Replaces the samples of spheres that emit evenly, where rough metals reflect them, by samples of the lobe. Returns these lanes: the BSDF
    /// need not be sampled for such a light.
    // not inlined, so that it does not burden scenes without rough metals
    #[inline(never)]
    pub fn sample_lobe(&self, sample: &mut Drawn, lobe: &Lobe, p: V8, u: Vec2<X8>) -> M8 {
        let sphere = equal(self.kind & u32x8::splat(KINDS | SPREAD | PICTURED | PROFILED), u32x8::splat(SPHERE));
        let lanes = sphere & lobe.metals();
        if lanes.any() {
            let light = Sphere { center: self.place, radius: self.first.x };
            let mut drawn = Drawn::from(light.by_reflection(p, &lobe.reflection).sample(u));
            drawn.emits = drawn.emits | self.has(TWO_SIDED);
            *sample = Drawn::blend(lanes, drawn, Some(*sample));
        }
        lanes
    }
    /// Leaves of the parallelograms with a spread what the points see, and returns the normals of all flat lights, of any length.
    #[inline(never)]
    pub(super) fn narrow(&mut self, p: V8) -> V8 {
        let normal = self.first.cross(self.second);
        // a picture is on the whole of its light
        let lanes = equal(self.kind & u32x8::splat(KINDS | SPREAD | PICTURED), u32x8::splat(PARALLELOGRAM | SPREAD));
        let light = Parallelogram { corner: self.place, edge_s: self.first, edge_t: self.second };
        let part = Parallelogram::blend(lanes, light.visible_part(p, &self.spread), light);
        (self.place, self.first, self.second) = (part.corner, part.edge_s, part.edge_t);
        normal
    }
    #[inline]
    pub(super) fn has(&self, flag: u32) -> M8 {
        !equal(self.kind & u32x8::splat(flag), u32x8::splat(0))
    }
}
