//! Reads point lights whose intensity differs by direction: `LightSource "goniometric"`, and `"spot"` with a `profile`.

use super::given::Given;
use super::lights::{position, power, scale, turned};
use super::profiles::{self, Profile};
use crate::radiance::{brightness, luminance, rounded};
use etendue::SpotLight;
use etendue_render::scene::intensity::Intensity;
use etendue_render::scene::{Cone, DeltaLight, Message};

/// Reads a `LightSource "goniometric"`; `None` if it emits nothing. `table` is the index that its intensity will have.
///
/// It takes pbrt's square images, older ones of longitude and latitude, and IES files, which pbrt does not read: their
/// candela values are the intensity, times `I` and `scale`.
pub(super) fn read(given: &mut Given<'_>, table: u32) -> Result<Option<(DeltaLight, Intensity)>, Message> {
    let name = match given.text("filename")? {
        None => given.text("mapname")?,
        name => name,
    };
    let name = name.ok_or_else(|| given.error("needs the name of a file, as in \"string filename\" \"lamp.exr\""))?;
    let tint = given.light("I")?.unwrap_or([1.0; 3]);
    let scale = scale(given)?;
    let power = power(given)?;
    let profile = profiles::read(&name, given)?;
    let to_light = turned(given)?;
    let position = position(given, given.ctm.point([0.0; 3]))?;
    let Some(Profile { intensity: shape, greatest, aim }) = profile else {
        given.warn("emits nothing");
        return Ok(None);
    };
    let color = tint.map(|x| x * greatest);
    let Some(intensity) = strength(color, scale, power, || shape.flux(), given)? else { return Ok(None) };
    let to_light = aim.axes.map(|(axis, sign)| to_light[axis].map(|x| x * sign as f32));
    Ok(Some((DeltaLight::Directed { position, to_light, intensity, table, cone: None }, shape)))
}

/// The greatest intensity of a light: this one, unless a power is given, times the scale. `flux` is the power for the intensity 1. `None` if
/// it is 0.
fn strength(
    mut color: [f64; 3],
    scale: [f64; 3],
    power: Option<f64>,
    flux: impl FnOnce() -> f64,
    given: &mut Given<'_>,
) -> Result<Option<[f32; 3]>, Message> {
    if let Some(power) = power {
        let emitted = luminance(color) * flux();
        color = color.map(|x| if emitted > 0.0 { x * power / emitted } else { 0.0 });
    }
    let color = std::array::from_fn(|k| color[k] * scale[k]);
    let too_large = || given.error(format!("its greatest intensity is {color:?}: at most {:e} is supported", f32::MAX));
    let intensity = rounded(color).filter(|rgb| rgb.iter().all(|x| *x <= f32::MAX)).ok_or_else(too_large)?;
    brightness(intensity).into_iter().for_each(|text| given.warn(text));
    if intensity == [0.0; 3] {
        given.warn("emits nothing");
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
    given: &mut Given<'_>,
    table: u32,
) -> Result<Option<(DeltaLight, Intensity)>, Message> {
    let DeltaLight::Spot { position, axis, one_minus_cos_inner, one_minus_cos_outer, intensity } = spot else {
        unreachable!("only spot lights have cones")
    };
    let ahead = profile.aim.ahead().map(|x| x as f32);
    let upright = SpotLight { position: [0.0; 3].into(), axis: ahead.into(), one_minus_cos_inner, one_minus_cos_outer };
    let flux = profile.intensity.flux_of_spot(&upright);
    if flux <= 0.0 {
        given.warn("emits nothing: its profile is dark in its cone");
        return Ok(None);
    }
    let color = intensity.map(|x| f64::from(x) * profile.greatest);
    let Some(intensity) = strength(color, scale, power, || flux, given)? else { return Ok(None) };
    let to_light = profile.aim.aimed(axis.map(f64::from), given.ctm);
    let cone = Some(Cone { axis, one_minus_cos_inner, one_minus_cos_outer, flux });
    Ok(Some((DeltaLight::Directed { position, to_light, intensity, table, cone }, profile.intensity)))
}
