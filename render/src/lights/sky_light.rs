//! The sky as one of the lights.

use super::chosen::{Chosen, Drawn};
use super::record::{Candidate, Far, LightRecord};
use super::sky::Sky;
use crate::packet::{M8, V8, X8};
use crate::technique::Measure;
use etendue::Vec2;
use std::f64::consts::FRAC_1_PI;

pub(super) const KIND: u32 = 11;

pub(super) fn candidate(sky: &Sky) -> Candidate {
    let record = LightRecord::bare(KIND, [0.0; 3], [0.0; 3]);
    Candidate { record, power: sky.flux() * FRAC_1_PI, far: Some(Far::Sky) }
}

/// Samples the sky in all lanes, and puts the radiance of the sampled directions into the lanes `here`.
#[inline]
pub(super) fn sample(
    sky: &Sky,
    here: M8,
    chosen: &mut Chosen,
    measure: Measure,
    p: V8,
    normal: V8,
    u: Vec2<X8>,
) -> Drawn {
    let (sample, radiance) = sky.sample(measure, p, normal, u);
    chosen.radiance = V8::blend(here, radiance, chosen.radiance);
    sample.into()
}
