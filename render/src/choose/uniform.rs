//! Each light has the same chance, also a sun or a sky.

use super::choose_light::ChooseLight;
use crate::packet::{V8, X8};
use etendue::select::{Choice, Gloss, LightChoice, UniformLights};

/// The greatest number of lights, so that each can be found.
const MOST: usize = 1 << 22;

/// Prepares the choice among so many lights.
pub(super) fn new(count: usize) -> Result<UniformLights, String> {
    if count > MOST {
        return Err(format!("at most {MOST} lights, and the scene has {count}"));
    }
    Ok(UniformLights { count: count as u32 })
}

impl ChooseLight for UniformLights {
    type At<'a> = Self;
    fn at(&self, _p: V8, _normal: V8, _gloss: Option<&Gloss<X8>>) -> Self {
        *self
    }
    fn choose(at: &Self, [u, _]: [X8; 2]) -> Choice<X8> {
        LightChoice::choose(at, u)
    }
    fn pmf(at: &Self, light: u32) -> X8 {
        at.pmf_of(light)
    }
}
