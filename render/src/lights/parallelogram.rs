//! Parallelograms that emit: a record has a corner and the edges from there.

use super::chosen::{Chosen, projected};
use super::record::{Extent, LightRecord, PICTURED, SPREAD, wide};
use crate::geometry::Geometry;
use crate::packet::{V8, X8};
use crate::technique::Measure;
use etendue::light::Spread;
use etendue::{LightSample, LightSampler, Parallelogram, Vec2};

pub(super) const KIND: u32 = 2;

/// The vectors of a record.
pub(super) fn vectors(geometry: &Geometry) -> [[f32; 3]; 3] {
    let Geometry::Parallelogram { p, u, v } = *geometry else { unreachable!("a parallelogram") };
    [p, u, v]
}

pub(super) fn extent(record: &LightRecord) -> Extent {
    let (p, u, v) = (wide(record.place), wide(record.first), wide(record.second));
    let radius = 0.5 * (u + v).length().max((u - v).length());
    Extent { center: p + (u + v) * 0.5, radius, normal: u.cross(v), cos_cone: 0.0 }
}

#[inline]
fn lanes(chosen: &Chosen) -> Parallelogram<X8> {
    Parallelogram { corner: chosen.place, edge_s: chosen.first, edge_t: chosen.second }
}

/// Samples parallelograms in all lanes.
#[inline]
pub(super) fn sample<D: From<LightSample<X8>>>(chosen: &Chosen, measure: Measure, p: V8, normal: V8, u: Vec2<X8>) -> D {
    let light = lanes(chosen);
    match measure {
        Measure::Area => light.by_area(p).sample(u).into(),
        Measure::SolidAngle => light.by_solid_angle(p).sample(u).into(),
        Measure::Projected => projected(|| light.by_projected_solid_angle(p, normal).sample(u).into()),
    }
}

/// A parallelogram in all lanes.
#[inline]
pub(super) fn splat(geometry: &Geometry) -> Parallelogram<X8> {
    let [p, u, v] = vectors(geometry);
    Parallelogram::new(p.into(), u.into(), v.into())
}

/// Pdf per steradian with which a parallelogram, or what the points see of one with a spread, is sampled by solid angle in the direction `w`, in
/// which it is hit.
#[inline]
pub(super) fn pdf(geometry: &Geometry, spread: Option<Spread<f32>>, p: V8, w: V8) -> X8 {
    let mut light = splat(geometry);
    if let Some(spread) = spread {
        light = light.visible_part(p, &Spread::splat(spread));
    }
    light.by_solid_angle(p).pdf_of_hit(w)
}

impl Chosen {
    /// Leaves of the parallelograms with a spread what the points see, and returns the normals of all flat lights, of any length.
    #[inline(never)]
    pub(super) fn narrow(&mut self, p: V8) -> V8 {
        let normal = self.first.cross(self.second);
        // a picture is on the whole of its light
        let has_spread = self.is(KIND) & self.has(SPREAD) & !self.has(PICTURED);
        let light = lanes(self);
        let part = Parallelogram::blend(has_spread, light.visible_part(p, &self.spread), light);
        (self.place, self.first, self.second) = (part.corner, part.edge_s, part.edge_t);
        normal
    }
}
