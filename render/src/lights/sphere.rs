//! Spheres that emit: a record has the centre, and the radius in x of its first edge.

use super::chosen::{Chosen, Drawn};
use super::record::{Extent, LightRecord, PICTURED, PROFILED, SPREAD, TWO_SIDED, wide};
use crate::geometry::Geometry;
use crate::lobe::Lobe;
use crate::packet::{M8, V8, X8};
use crate::technique::Measure;
use etendue::light::Spread;
use etendue::{LightSample, LightSampler, Mask, Real, Sphere, Vec2, Vec3};

pub(super) const KIND: u32 = 0;

/// The vectors of a record.
pub(super) fn vectors(geometry: &Geometry) -> [[f32; 3]; 3] {
    let Geometry::Sphere { center, radius } = *geometry else { unreachable!("a sphere") };
    [center, [radius, 0.0, 0.0], [0.0; 3]]
}

pub(super) fn extent(record: &LightRecord) -> Extent {
    let radius = f64::from(record.first[0]);
    Extent { center: wide(record.place), radius, normal: Vec3::default(), cos_cone: 0.0 }
}

#[inline]
fn lanes(chosen: &Chosen) -> Sphere<X8> {
    Sphere { center: chosen.place, radius: chosen.first.x }
}

/// Samples spheres in all lanes.
#[inline]
pub(super) fn sample<D: From<LightSample<X8>>>(chosen: &Chosen, measure: Measure, p: V8, normal: V8, u: Vec2<X8>) -> D {
    let light = lanes(chosen);
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

/// Pdf per steradian with which a sphere is sampled by solid angle in the direction `w`, in which it is hit.
#[inline]
pub(super) fn pdf(geometry: &Geometry, _spread: Option<Spread<f32>>, p: V8, w: V8) -> X8 {
    let Geometry::Sphere { center, radius } = *geometry else { unreachable!("a sphere") };
    Sphere::new(center.into(), X8::splat(radius)).by_solid_angle(p).pdf_of_hit(w)
}

impl Chosen {
    /// Lanes of spheres that points on them, with these normals, see: from inside.
    #[inline(always)]
    pub(super) fn surrounds(&self, p: V8, normal: V8) -> M8 {
        self.is(KIND) & normal.dot(p - self.place).lt(X8::lit(0.0))
    }
    /// Replaces the samples of spheres that emit evenly, where rough metals reflect them, by samples of the lobe. Returns these lanes: the BSDF
    /// need not be sampled for such a light.
    // not inlined, so that it does not burden scenes without rough metals
    #[inline(never)]
    pub fn sample_lobe(&self, sample: &mut Drawn, lobe: &Lobe, p: V8, u: Vec2<X8>) -> M8 {
        let reflected = self.is(KIND) & !self.has(SPREAD | PICTURED | PROFILED) & lobe.metals();
        if reflected.any() {
            let mut drawn = Drawn::from(lanes(self).by_reflection(p, &lobe.reflection).sample(u));
            drawn.emits = drawn.emits | self.has(TWO_SIDED);
            *sample = Drawn::blend(reflected, drawn, Some(*sample));
        }
        reflected
    }
}
