//! The sky as one of the lights.

use super::record::{Candidate, Far, LightRecord, SKY};
use super::sky::Sky;
use std::f64::consts::FRAC_1_PI;

pub(super) fn candidate(sky: &Sky) -> Candidate {
    let record = LightRecord::bare(SKY, [0.0; 3], [0.0; 3]);
    Candidate { record, power: sky.flux() * FRAC_1_PI, far: Some(Far::Sky) }
}
