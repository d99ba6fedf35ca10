//! The sky as one of the lights.

use super::record::{LightRecord, SKY};
use super::sky::Sky;
use std::f64::consts::FRAC_1_PI;

pub(super) fn record(sky: &Sky) -> LightRecord {
    LightRecord::bare(SKY, [0.0; 3], [0.0; 3], sky.flux() * FRAC_1_PI)
}
