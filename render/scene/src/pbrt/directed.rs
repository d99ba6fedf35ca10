//! Reads point lights whose intensity differs by direction: `LightSource "goniometric"` and `"projection"`, and `"spot"` with a `profile`.

use super::inputs::Files;
use super::lights::{power, scale, turned};
use super::params::{Params, shown};
use super::profiles::{self, Profile, picture};
use crate::distribution::Axis;
use crate::message::Notes;
use crate::radiance::{brightness, luminance, rounded};
use crate::transform::Transform;
use etendue::SpotLight;
use etendue_render::image::Picture;
use etendue_render::intensity::{Intensity, Projector};
use etendue_render::scene::{Cone, DeltaLight, Message};

/// Axes of projected images, in light space.
const FORWARD: [Axis; 3] = [(0, 1.0), (1, 1.0), (2, 1.0)];

/// Reads a light of this kind; `None` if it emits nothing. `table` is the index that its intensity will have.
///
/// A goniometric light takes pbrt's square images, older ones of longitude and latitude, and IES files, which pbrt does not read: their
/// candela values are the intensity, times `I` and `scale`.
pub(super) fn read(
    kind: &str,
    params: &mut Params,
    ctm: &Transform,
    files: &Files<'_>,
    notes: &mut Notes,
    table: u32,
) -> Result<Option<(DeltaLight, Intensity)>, Message> {
    let name = match params.text("filename")? {
        None => params.text("mapname")?,
        name => name,
    };
    let name = name.ok_or_else(|| params.error("needs the name of a file, as in \"string filename\" \"lamp.exr\""))?;
    let tint = params.light("I", files)?.unwrap_or([1.0; 3]);
    let scale = scale(params)?;
    let power = power(params)?;
    let found = if kind == "projection" {
        let fov = params.float("fov")?.unwrap_or(90.0);
        if !(fov > 0.0 && fov < 180.0) {
            return Err(params.error(format!("\"fov\": must be between 0 and 180 degrees, not {}", shown(fov))));
        }
        projected(&picture(params, &name, files)?, fov).map_err(|what| params.error(format!("{name}: {what}")))?
    } else {
        let profile = profiles::read(&name, params, files, notes)?;
        profile.map(|Profile { intensity, greatest, aim, .. }| (intensity, greatest, aim.axes))
    };
    let to_light = turned(params, ctm)?;
    let position = ctm.point([0.0; 3]).map(|x| x as f32);
    if !position.iter().all(|x| x.is_finite()) {
        return Err(params.error(format!("its position {:?} is not finite in f32", ctm.point([0.0; 3]))));
    }
    let Some((shape, greatest, axes)) = found else {
        notes.warn(params.error("emits nothing"));
        return Ok(None);
    };
    let color = tint.map(|x| x * greatest);
    let Some(intensity) = strength(color, scale, power, || shape.flux(), params, notes)? else { return Ok(None) };
    let to_light = axes.map(|(axis, sign)| to_light[axis].map(|x| x * sign as f32));
    Ok(Some((DeltaLight::Directed { position, to_light, intensity, table, cone: None }, shape)))
}

/// The greatest intensity of a light: this one, unless a power is given, times the scale. `flux` is the power for the intensity 1. `None` if
/// it is 0.
fn strength(
    mut color: [f64; 3],
    scale: [f64; 3],
    power: Option<f64>,
    flux: impl FnOnce() -> [f64; 3],
    params: &Params,
    notes: &mut Notes,
) -> Result<Option<[f32; 3]>, Message> {
    if let Some(power) = power {
        let flux = flux();
        let emitted = luminance(std::array::from_fn(|k| color[k] * flux[k]));
        color = color.map(|x| if emitted > 0.0 { x * power / emitted } else { 0.0 });
    }
    let color = std::array::from_fn(|k| color[k] * scale[k]);
    let too_large =
        || params.error(format!("its greatest intensity is {color:?}: at most {:e} is supported", f32::MAX));
    let intensity = rounded(color).filter(|rgb| rgb.iter().all(|x| *x <= f32::MAX)).ok_or_else(too_large)?;
    brightness(intensity).into_iter().for_each(|text| notes.warn(params.error(text)));
    if intensity == [0.0; 3] {
        notes.warn(params.error("emits nothing"));
        return Ok(None);
    }
    Ok(Some(intensity))
}

/// A spot light with the intensity of a profile that is aimed along its axis, times its own falloff and intensity; `None` if it emits
/// nothing. The scale and the power are those of the light. `table` is the index that the profile will have.
pub(super) fn spot(
    spot: DeltaLight,
    (scale, power): ([f64; 3], Option<f64>),
    profile: Profile,
    params: &Params,
    ctm: &Transform,
    notes: &mut Notes,
    table: u32,
) -> Result<Option<(DeltaLight, Intensity)>, Message> {
    let DeltaLight::Spot { position, axis, one_minus_cos_inner, one_minus_cos_outer, intensity } = spot else {
        unreachable!("only spot lights have cones")
    };
    let ahead = profile.aim.ahead().map(|x| x as f32);
    let upright = SpotLight { position: [0.0; 3].into(), axis: ahead.into(), one_minus_cos_inner, one_minus_cos_outer };
    let flux = profile.intensity.flux_of_spot(&upright);
    if flux <= 0.0 {
        notes.warn(params.error("emits nothing: its profile is dark in its cone"));
        return Ok(None);
    }
    let color = intensity.map(|x| f64::from(x) * profile.greatest);
    let Some(intensity) = strength(color, scale, power, || [flux; 3], params, notes)? else { return Ok(None) };
    let to_light = profile.aim.aimed(axis.map(f64::from), ctm);
    let cone = Some(Cone { axis, one_minus_cos_inner, one_minus_cos_outer, flux });
    Ok(Some((DeltaLight::Directed { position, to_light, intensity, table, cone }, profile.intensity)))
}

/// A projected image, of which `fov` is the full angle of the shorter side in degrees, with its greatest value and its axes; `None` if it is
/// black.
fn projected(image: &Picture, fov: f64) -> Result<Option<(Intensity, f64, [Axis; 3])>, String> {
    let (width, height) = (image.width as f64, image.height as f64);
    let shorter = libm::tan(fov.to_radians() / 2.0);
    let tan_half = [width, height].map(|side| (shorter * side / width.min(height)) as f32);
    if !tan_half.iter().all(|t| *t > 0.0 && *t <= 1e6) {
        return Err(format!(
            "a projection of {fov} degrees has sides of {tan_half:?} at the distance 1: at most 1e6 is supported"
        ));
    }
    let greatest = image.radiance.as_flattened().iter().fold(0.0, |most: f32, &x| most.max(x));
    if greatest == 0.0 {
        return Ok(None);
    }
    let texels = image.radiance.iter().map(|rgb| rgb.map(|x| x / greatest)).collect();
    let shape = Intensity::Projected { projector: Projector { tan_half }, width: image.width, texels };
    Ok(Some((shape, greatest.into(), FORWARD)))
}
