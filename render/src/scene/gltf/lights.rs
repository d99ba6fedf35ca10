//! Reads the lights of `KHR_lights_punctual`.

use super::super::lights::{DeltaLight, one_minus_cos};
use super::super::message::Message;
use super::super::params::rounded;
use super::super::transform::{Transform, unit};
use super::source::Source;
use gltf_json::Index;
use gltf_json::extensions::scene::khr_lights_punctual::{Light, Type};
use gltf_json::validation::Checked;

/// Reads the light of a node, which shines along its −z axis; `None` if it emits nothing.
///
/// Candelas count as radiant intensity, and lux as irradiance. Between the inner and the outer angle a spot falls off as a
/// [`DeltaLight::Spot`] does, by a smooth step of the cosine; glTF suggests the square of a linear one.
pub(super) fn read(
    source: &Source<'_>,
    light: Index<Light>,
    node: usize,
    transform: &Transform,
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
    let position = transform.shift.map(|x| x as f32);
    if kind != Type::Directional && !position.iter().all(|x| x.is_finite()) {
        return Err(source.message(format!("node {node}: its light is at {:?}, which is not finite", transform.shift)));
    }
    let axis = unit(transform.vector([0.0, 0.0, -1.0]));
    let axis = || {
        let axis = axis.map(|axis| axis.map(|x| x as f32));
        axis.ok_or_else(|| source.message(format!("node {node}: its transform leaves its light no direction")))
    };
    Ok(Some(match kind {
        Type::Point => DeltaLight::Point { position, intensity: power },
        Type::Directional => DeltaLight::Distant { direction: axis()?.map(|x| -x), irradiance: power },
        Type::Spot => {
            let spot = light.spot.as_ref().ok_or_else(|| failed("a spot light without \"spot\"".into()))?;
            let [inner, outer] = [spot.inner_cone_angle, spot.outer_cone_angle];
            // π/2 rounded to f32 is more than π/2
            if !(outer > 0.0 && outer <= std::f32::consts::FRAC_PI_2 && inner >= 0.0 && inner <= outer) {
                return Err(failed(format!(
                    "innerConeAngle {inner} and outerConeAngle {outer}: must be from 0 to π/2, and the inner one the lesser"
                )));
            }
            let [one_minus_cos_inner, one_minus_cos_outer] =
                [inner, outer].map(|angle| one_minus_cos(f64::from(angle)) as f32);
            DeltaLight::Spot { position, axis: axis()?, one_minus_cos_inner, one_minus_cos_outer, intensity: power }
        }
    }))
}
