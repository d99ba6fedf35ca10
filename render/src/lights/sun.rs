//! Distant lights: a record has the direction to the light.

use super::chosen::Chosen;
use super::record::{LightRecord, SUN, sum};
use crate::packet::X8;
use etendue::{DirectionalLight, LightSample, LightSampler, Vec2};

pub(crate) fn record(direction: [f32; 3], irradiance: [f32; 3]) -> LightRecord {
    // of a point at the distance 1 that causes this irradiance
    LightRecord::bare(SUN, direction, irradiance, 4.0 * sum(irradiance))
}

/// Samples distant lights in all lanes.
#[inline]
pub(super) fn sample(chosen: &Chosen, u: Vec2<X8>) -> LightSample<X8> {
    DirectionalLight::new(chosen.place).by_delta().sample(u)
}
