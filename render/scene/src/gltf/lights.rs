//! Reads the lights of `KHR_lights_punctual`.

use super::source::Source;
use crate::message::Notes;
use crate::radiance::rounded;
use crate::transform::{Transform, cross, one_minus_cos, unit};
use etendue_render::scene::intensity::Intensity;
use etendue_render::scene::{DeltaLight, Message};
use gltf_json::Index;
use gltf_json::extensions::scene::khr_lights_punctual::{Light, Type};
use gltf_json::validation::Checked;
use std::sync::Arc;

/// Reads the light of a node, which shines along its −z axis; `None` if it emits nothing. A spot adds its relative intensity to those.
///
/// Candelas count as radiant intensity, and lux as irradiance. Spots fall off as glTF suggests, but for their least width of 0.001, which is
/// to keep from dividing by 0.
pub(super) fn read(
    source: &Source<'_>,
    light: Index<Light>,
    node: usize,
    transform: &Transform,
    intensities: &mut Vec<Arc<Intensity>>,
    notes: &mut Notes,
) -> Result<Option<DeltaLight>, Message> {
    let root = &source.root;
    let lights = root.extensions.as_ref().and_then(|all| all.khr_lights_punctual.as_ref());
    let lights = lights.map_or(&[][..], |list| &list.lights);
    let (index, light) = source.item(lights, light, "light", &format!("node {node}"))?;
    let failed = |what: String| source.message(format!("light {index}: {what}"));
    let Checked::Valid(kind) = light.type_ else {
        return Err(failed("its type is not \"point\", \"spot\" or \"directional\"".into()));
    };
    let power = light.color.map(|x| f64::from(x) * f64::from(light.intensity));
    let power = rounded(power).filter(|rgb| rgb.iter().all(|&x| x >= 0.0)).ok_or_else(|| {
        let (color, intensity) = (light.color, light.intensity);
        failed(format!("color {color:?} times intensity {intensity} must be finite and at least 0"))
    })?;
    if power == [0.0; 3] {
        return Ok(None);
    }
    if let Some(range) = light.range.filter(|_| kind != Type::Directional) {
        let message =
            || failed(format!("its range of {range} is ignored: its light falls off with the square of the distance"));
        notes.stand_in("range", message);
    }
    let position = transform.shift.map(|x| x as f32);
    if kind != Type::Directional && !position.iter().all(|x| x.is_finite()) {
        return Err(source.message(format!("node {node}: its light is at {:?}, which is not finite", transform.shift)));
    }
    // rotations in files are rounded to f32
    let axis = || {
        let axis = transform.direction([0.0, 0.0, -1.0], 1e-6);
        axis.ok_or_else(|| source.message(format!("node {node}: its transform leaves its light no direction")))
    };
    Ok(Some(match kind {
        Type::Point => DeltaLight::Point { position, intensity: power },
        Type::Directional => DeltaLight::Distant { direction: axis()?.map(|x| -x as f32), irradiance: power },
        Type::Spot => {
            let spot = light.spot.as_ref().ok_or_else(|| failed("a spot light without \"spot\"".into()))?;
            let [inner, outer] = [spot.inner_cone_angle, spot.outer_cone_angle];
            // π/2 rounded to f32 is more than π/2
            if !(outer > 0.0 && outer <= std::f32::consts::FRAC_PI_2 && inner >= 0.0 && inner <= outer) {
                return Err(failed(format!(
                    "innerConeAngle {inner} and outerConeAngle {outer}: must be from 0 to π/2, and the inner one the lesser"
                )));
            }
            let axis = axis()?;
            let aside = cross(axis, if axis[0].abs() < 0.5 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] });
            let aside = unit(aside).unwrap_or_default();
            let to_light = [aside, cross(axis, aside), axis].map(|row| row.map(|x| x as f32));
            let [inner, outer] = [inner, outer].map(|angle| one_minus_cos(f64::from(angle)) as f32);
            let table = intensities.len() as u32;
            intensities.push(Intensity::Cone { inner, outer }.into());
            DeltaLight::Directed { position, to_light, intensity: power, table, cone: None }
        }
    }))
}
