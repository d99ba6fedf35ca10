//! Few lights are chosen by what each can contribute to the point.

use super::choose_light::{ChooseLight, bounds};
use crate::lights::LightRecord;
use crate::packet::{V8, X8};
use etendue::select::{Choice, Gloss, LightChoice, LightsAt, SpatialLights};

/// Prepares the choice.
pub(super) fn new(all: &[LightRecord]) -> Result<SpatialLights, String> {
    SpatialLights::new(&bounds(all))
        .map_err(|_| format!("at most {} lights, and the scene has {}", SpatialLights::MOST, all.len()))
}

impl ChooseLight for SpatialLights {
    type At<'a> = LightsAt<X8>;
    #[inline(always)]
    fn at(&self, p: V8, normal: V8, gloss: Option<&Gloss<X8>>) -> LightsAt<X8> {
        match gloss {
            None => self.at(p, normal),
            Some(gloss) => self.at_glossy(p, normal, gloss),
        }
    }
    #[inline(always)]
    fn choose(at: &LightsAt<X8>, [u, _]: [X8; 2]) -> Choice<X8> {
        LightChoice::choose(at, u)
    }
    #[inline(always)]
    fn pmf(at: &LightsAt<X8>, light: u32) -> X8 {
        at.pmf_of(light)
    }
}
