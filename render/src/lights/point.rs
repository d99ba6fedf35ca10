//! Point lights: a record has the position.

use super::chosen::Chosen;
use super::record::{LightRecord, POINT, sum};
use crate::packet::{V8, X8};
use etendue::{LightSample, LightSampler, PointLight, Vec2};

pub(crate) fn record(position: [f32; 3], intensity: [f32; 3]) -> LightRecord {
    LightRecord::bare(POINT, position, intensity, 4.0 * sum(intensity))
}

/// Samples point lights in all lanes.
#[inline]
pub(super) fn sample(chosen: &Chosen, p: V8, u: Vec2<X8>) -> LightSample<X8> {
    PointLight::new(chosen.place).by_delta(p).sample(u)
}
