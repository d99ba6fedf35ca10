//! Distant lights: a record has the direction to the light.

use super::chosen::Chosen;
use super::record::{Candidate, Far, LightRecord, SUN, sum};
use crate::packet::X8;
use etendue::{DirectionalLight, LightSample, LightSampler, Vec2};

pub(crate) fn candidate(direction: [f32; 3], irradiance: [f32; 3]) -> Candidate {
    let record = LightRecord::bare(SUN, direction, irradiance);
    // of a point at the distance 1 that causes this irradiance
    Candidate { record, power: 4.0 * sum(irradiance), far: Some(Far::Sun) }
}

/// Samples distant lights in all lanes.
#[inline]
pub(super) fn sample(chosen: &Chosen, u: Vec2<X8>) -> LightSample<X8> {
    DirectionalLight::new(chosen.place).by_delta().sample(u)
}
