//! The sky as one of the lights.

use super::record::{Candidate, Far, LightRecord};
use super::sky::Sky;
use std::f64::consts::FRAC_1_PI;

pub(super) const KIND: u32 = 11;

pub(super) fn candidate(sky: &Sky) -> Candidate {
    let record = LightRecord::bare(KIND, [0.0; 3], [0.0; 3]);
    Candidate { record, power: sky.flux() * FRAC_1_PI, far: Some(Far::Sky) }
}
