//! Spot lights: a record has the position and the axis, then 1 − cosθ of the inner and the outer angle, and a cosine from which on it is dark.

use super::chosen::Chosen;
use super::record::{KINDS, LightRecord, SPOT, sum, wide};
use crate::geometry::Extent;
use crate::packet::{V8, X8};
use etendue::{LightSample, LightSampler, SpotLight, Vec2};

/// The cosine of the narrowest cone that a tree tells from its axis. A narrower light counts as if it filled this cone: as bright as it is
/// on its axis, it would take the samples of all points around its cone, which it does not light.
const NARROWEST: f32 = 253.0 / 254.0;

/// The cosine, less a rounding, of an angle given by 1 − cosθ.
pub(super) fn cosine_below(one_minus_cos: f32) -> f32 {
    (1.0 - one_minus_cos).next_down()
}

pub(crate) fn record(position: [f32; 3], axis: [f32; 3], [inner, outer]: [f32; 2], intensity: [f32; 3]) -> LightRecord {
    let (first, second) = (axis, [inner, outer, cosine_below(outer)]);
    let cone = f64::from(inner) + f64::from(outer);
    // a cone too narrow for numbers still has a chance
    let power = cone.max(1e-30) * sum(intensity);
    LightRecord { first, second, ..LightRecord::bare(SPOT, position, intensity, power) }
}

/// The extent of a light whose record has an axis and a cosine as that of a spot light, and that cosine.
pub(super) fn extent(record: &LightRecord) -> (Extent, f32) {
    let (axis, cos) = (record.first, record.second[2]);
    // beyond a hemisphere, a cone bounds nothing
    let normal = if cos > 0.0 { wide(axis) } else { Default::default() };
    (Extent { normal, ..record.point() }, cos.clamp(0.0, NARROWEST))
}

impl LightRecord {
    /// A spot light that is narrower than a tree can tell, and the sum of the channels of its intensity.
    pub(crate) fn beam(&self) -> Option<(SpotLight<f32>, f64)> {
        let LightRecord { kind, place, first, second, radiance, .. } = *self;
        let [one_minus_cos_inner, one_minus_cos_outer, cos] = second;
        let (position, axis) = (place.into(), first.into());
        let light = SpotLight { position, axis, one_minus_cos_inner, one_minus_cos_outer };
        (kind & KINDS == SPOT && cos > NARROWEST).then(|| (light, sum(radiance)))
    }
}

/// Samples spot lights in all lanes.
#[inline]
pub(super) fn sample(chosen: &Chosen, p: V8, u: Vec2<X8>) -> LightSample<X8> {
    let Chosen { place: position, first: axis, second, .. } = *chosen;
    let [one_minus_cos_inner, one_minus_cos_outer] = [second.x, second.y];
    SpotLight { position, axis, one_minus_cos_inner, one_minus_cos_outer }.by_delta(p).sample(u)
}
