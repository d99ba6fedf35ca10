//! What shapes emit, each with its own part of a picture.

use super::lights::Emission;
use super::params::MOST_RADIANCE;
use super::shape_attributes::ShapeAttributes;
use super::spectrum::luminance;
use crate::geometry::Geometry;
use crate::light_picture::{LightPicture, WORLD};
use crate::light_profile::LightProfile;
use crate::texture::{Mapping, Picture};
use std::f64::consts::PI;
use std::sync::Arc;

/// Most cells between texels that the means over all shapes of a scene may take, so that a small file cannot ask for any number.
const MOST_CELLS: u64 = 1 << 28;

/// The pictures of the shapes of a scene.
#[derive(Debug)]
pub(super) struct Lamps {
    pub(super) pictures: Vec<LightPicture>,
    pub(super) profiles: Vec<LightProfile>,
    /// How many cells of pictures may still be looked at.
    cells: u64,
}

impl Default for Lamps {
    fn default() -> Self {
        Self { pictures: Vec::new(), profiles: Vec::new(), cells: MOST_CELLS }
    }
}

impl Lamps {
    /// The emission of a shape as its attributes tell; `None` if it is dark. `mapping` takes its coordinates to texture coordinates.
    pub(super) fn emission(
        &mut self,
        surface: &ShapeAttributes,
        geometry: &Geometry,
        mapping: impl FnOnce() -> Mapping,
    ) -> Option<Emission> {
        let Emission { radiance, two_sided, spread, .. } = surface.emission?;
        let profile = self.profile(surface, geometry);
        let powered = |color: [f32; 3], mean: [f32; 3]| match surface.power {
            Some(power) => {
                // a Lambertian emitter of mean radiance L has the power πAL on each side that emits
                let sides = if two_sided { 2.0 } else { 1.0 };
                let y = luminance(mean.map(f64::from)) * PI * sides * geometry.area();
                color.map(|x| (f64::from(x) * power / y).min(MOST_RADIANCE.into()) as f32)
            }
            None => color,
        };
        let Some(picture) = &surface.picture else {
            return Some(Emission { radiance: powered(radiance, radiance), two_sided, picture: None, spread, profile });
        };
        let picture = Picture { mapping: mapping().then(&picture.mapping), ..picture.clone() };
        let axes = if matches!(geometry, Geometry::Sphere { .. }) { surface.ctm.axes()? } else { WORLD };
        let shown = LightPicture { picture, factor: radiance, axes };
        let mean = shown.mean_over(geometry, &mut self.cells);
        // what emits at all has a chance, however dim it is
        let mean = mean.map(|x| if x > 0.0 { (x as f32).clamp(f32::MIN_POSITIVE, MOST_RADIANCE) } else { 0.0 });
        if mean == [0.0; 3] {
            return None;
        }
        let index = self.pictures.len() as u32;
        self.pictures.push(LightPicture { factor: powered(radiance, mean), ..shown });
        Some(Emission { radiance: powered(mean, mean), two_sided, picture: Some(index), spread, profile })
    }

    /// The index of the profile of a flat shape, if it has one: that of the last one for shapes that follow each other in a plane.
    fn profile(&mut self, surface: &ShapeAttributes, geometry: &Geometry) -> Option<u32> {
        let distribution = surface.profile.as_ref()?;
        let [_, normal] = geometry.plane()?;
        let to_light = distribution.aim.aimed([normal.x, normal.y, normal.z], &surface.ctm);
        let (intensity, opening) = (Arc::clone(&distribution.intensity), distribution.opening);
        let profile = LightProfile { to_light, intensity, opening };
        let is_last = |last: &LightProfile| {
            (last.to_light, last.opening) == (to_light, opening) && Arc::ptr_eq(&last.intensity, &profile.intensity)
        };
        if !self.profiles.last().is_some_and(is_last) {
            self.profiles.push(profile);
        }
        Some(self.profiles.len() as u32 - 1)
    }
}
