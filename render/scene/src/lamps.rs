//! What shapes emit, each with its own part of a picture.

use crate::radiance::luminance;
use crate::shape_attributes::ShapeAttributes;
use etendue_render::geometry::{Chart, Geometry};
use etendue_render::scene::light_picture::{LightPicture, WORLD};
use etendue_render::scene::light_profile::LightProfile;
use etendue_render::scene::limits::MOST_RADIANCE;
use etendue_render::scene::texture::{Mapping, Picture};
use etendue_render::scene::{Emission, Shape};
use std::f64::consts::PI;
use std::sync::Arc;

/// Most cells between texels that the means over all shapes of a scene may take, so that a small file cannot ask for any number.
const MOST_CELLS: u64 = 1 << 26;

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
        let emission = surface.emission?;
        let profile = self.profile(surface, geometry);
        let Some(picture) = &surface.picture else {
            return Some(Emission { picture: None, profile, ..emission });
        };
        let picture = Picture { mapping: mapping().then(&picture.mapping), ..picture.clone() };
        let axes = if geometry.chart() == Some(Chart::Sphere) { surface.ctm.axes()? } else { WORLD };
        let shown = LightPicture { picture, factor: emission.radiance, axes };
        let mean = shown.mean_over(geometry, &mut self.cells);
        // what emits at all has a chance, however dim it is
        let mean = mean.map(|x| if x > 0.0 { (x as f32).clamp(f32::MIN_POSITIVE, MOST_RADIANCE) } else { 0.0 });
        if mean == [0.0; 3] {
            return None;
        }
        let index = self.pictures.len() as u32;
        self.pictures.push(shown);
        Some(Emission { radiance: mean, picture: Some(index), profile, ..emission })
    }

    /// Gives the parts of one shape this power in all, in watts, and keeps what they emit in proportion. Fails if one becomes too bright.
    pub(super) fn share(&mut self, power: f64, parts: &mut [Shape]) -> Result<(), String> {
        // a Lambertian emitter of mean radiance L has the power πAL on each side that emits
        let emitted = |Shape { geometry, emission, .. }: &Shape| {
            let Emission { radiance, two_sided, .. } = emission.unwrap_or_default();
            luminance(radiance.map(f64::from)) * PI * if two_sided { 2.0 } else { 1.0 } * geometry.area()
        };
        let factor = power / parts.iter().map(emitted).sum::<f64>();
        for emission in parts.iter_mut().filter_map(|part| part.emission.as_mut()) {
            let radiance = emission.radiance.map(|x| f64::from(x) * factor);
            if radiance.iter().any(|&x| x > MOST_RADIANCE.into()) {
                return Err(format!(
                    "its power makes the radiance {radiance:?}: at most {MOST_RADIANCE:e} is supported"
                ));
            }
            // what emits at all has a chance, however dim it is
            emission.radiance = radiance.map(|x| if x > 0.0 { (x as f32).max(f32::MIN_POSITIVE) } else { 0.0 });
            if let Some(picture) = emission.picture {
                let shown = &mut self.pictures[picture as usize].factor;
                *shown = shown.map(|x| (f64::from(x) * factor).min(MOST_RADIANCE.into()) as f32);
            }
        }
        Ok(())
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
