//! Lights are chosen by their power. The power of a sun or a sky is the flux through a disk whose radius is the greatest coordinate of the scene.

use super::choose_light::ChooseLight;
use crate::lights::{Far, LightRecord};
use crate::packet::{V8, X8};
use etendue::discrete::{Cell2d, PiecewiseConstant2d};
use etendue::select::{Choice, Gloss};
use etendue::{Real, Vec2, u32x8};
use std::f64::consts::PI;

/// The distribution of the powers, as a table of one row.
#[derive(Debug)]
pub(super) struct Power {
    table: Vec<f32>,
    count: usize,
}

impl Power {
    /// Prepares the choice in a scene whose greatest coordinate is `reach`.
    pub(super) fn new(all: &[LightRecord], reach: f32) -> Result<Self, String> {
        let squared = f64::from(reach).powi(2);
        let power = |light: &LightRecord| match light.far() {
            // the power of a sun is that of a point at the distance 1, 4 times its irradiance, and that of a sky its flux over π
            Some(Far::Sun) => light.power * 0.25 * squared,
            Some(Far::Sky) => light.power * PI * squared,
            None => light.power,
        };
        let greatest = all.iter().map(power).fold(f64::MIN_POSITIVE, f64::max);
        // none is lost by rounding
        let relative =
            |power: f64| if power > 0.0 { (power / greatest).max(f64::from(f32::MIN_POSITIVE)) } else { 0.0 };
        let powers: Vec<f32> = all.iter().map(|light| relative(power(light)) as f32).collect();
        let count = powers.len();
        let mut table = vec![0.0; PiecewiseConstant2d::buffer(count, 1)];
        PiecewiseConstant2d::build(&powers, count, &mut table).map_err(|error| error.to_string())?;
        Ok(Self { table, count })
    }
}

impl ChooseLight for Power {
    type At<'a> = PiecewiseConstant2d<'a>;
    fn at(&self, _p: V8, _normal: V8, _gloss: Option<&Gloss<X8>>) -> PiecewiseConstant2d<'_> {
        PiecewiseConstant2d::from_buffer(&self.table, self.count).expect("a table of its own size")
    }
    fn choose(at: &PiecewiseConstant2d<'_>, [u, _]: [X8; 2]) -> Choice<X8> {
        let Cell2d { x: index, offset, pmf, .. } = at.cell(Vec2::new(u, X8::lit(0.0)));
        Choice { index, pmf, u: offset.x }
    }
    fn pmf(at: &PiecewiseConstant2d<'_>, light: u32) -> X8 {
        at.pmf(u32x8::splat(light), u32x8::splat(0))
    }
}
