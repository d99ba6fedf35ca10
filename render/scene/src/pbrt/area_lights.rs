//! Reads `AreaLightSource`.

use super::given::Given;
use super::lights::{power, scale};
use super::params::Params;
use super::profiles::{self, Profile};
use crate::distribution::Distribution;
use crate::radiance::{brightness, luminance, radiances, rounded};
use etendue::Real;
use etendue_render::film::image::Picture;
use etendue_render::geometry::spread::Spread;
use etendue_render::packet::X8;
use etendue_render::scene::light_profile::LuminousOpening;
use etendue_render::scene::limits::MOST_RADIANCE;
use etendue_render::scene::texture::{self, Colors, Mapping, Texels, Wrap};
use etendue_render::scene::{Emission, Message};
use std::collections::HashMap;
use std::sync::Arc;

/// The tangent of an angle to the normal that all of a hemisphere is within.
const WIDE: f64 = 1e6;

/// What an `AreaLightSource` makes of shapes.
#[derive(Clone, Debug, Default)]
pub(super) struct Area {
    /// Nothing if it is dark. With a picture, the radiance is what its texels are multiplied by.
    pub(super) emission: Option<Emission>,
    /// The picture that each shape shows by its texture coordinates.
    pub(super) picture: Option<texture::Picture>,
    /// How flat shapes distribute what they emit.
    pub(super) profile: Option<Arc<Distribution>>,
    /// The power of each shape in watts, if the scene gives it.
    pub(super) power: Option<f64>,
}

/// The pictures of lights that were read so far, by the files that name them and their names there.
pub(super) type Shown = HashMap<(Arc<str>, String), Arc<Texels>>;

/// Reads an `AreaLightSource`.
pub(super) fn read(kind: &str, given: &mut Given<'_>, known: &mut Shown) -> Result<Area, Message> {
    given.require(kind == "diffuse" || kind == "area", || "not supported, only \"diffuse\"")?;
    let texels = match given.text("filename")? {
        Some(name) => Some(shown_texels(&name, given, known)?),
        None => None,
    };
    // pbrt-v4 refuses a radiance beside a picture
    let radiance = given.light("L")?.unwrap_or([1.0; 3]);
    let power = power(given)?;
    let scale = scale(given)?;
    let scaled = std::array::from_fn(|k| radiance[k] * scale[k]);
    let power = power.map(|power| power * luminance(scaled) / luminance(radiance));
    let two_sided = given.flag("twosided")?.unwrap_or(false);
    let (profile, radiance) = match given.text("profile")? {
        Some(name) => match distribution(&name, two_sided, given)? {
            None => (None, [0.0; 3]),
            profile => (profile, scaled),
        },
        None => (None, scaled),
    };
    let greatest = texels.as_ref().map_or([1.0; 3], |texels| texels.greatest().map(f64::from));
    let brightest: [f64; 3] = std::array::from_fn(|k| radiance[k] * greatest[k]);
    let spread = spread(given)?;
    given.require(
        spread.is_none() || profile.is_none(),
        || "\"spread\" and \"profile\": a light has one or the other",
    )?;
    // the greatest factor of the spread is on the axis, and that of a profile at most at its least cosine
    let gain = match &profile {
        Some(distribution) => distribution.opening.factor(X8::lit(0.0), X8::lit(1.0)).lane_f64(0),
        None => spread.map_or(1.0, |spread| f64::from(spread.tan_half) * f64::from(spread.gain)),
    };
    let most = (f64::from(MOST_RADIANCE) / gain) as f32;
    let too_large = || given.error(format!("the radiance {brightest:?}: at most {most:e} is supported"));
    let brightest = rounded(brightest).filter(|rgb| rgb.iter().all(|&x| x <= most)).ok_or_else(too_large)?;
    let radiance = rounded(radiance).ok_or_else(too_large)?;
    brightness(brightest).into_iter().for_each(|text| given.warn(text));
    let dark = brightest == [0.0; 3];
    if dark {
        given.warn("emits nothing");
    }
    // pbrt's (0, 0) is the lower left corner
    let mapping = Mapping([[1.0, 0.0, 0.0], [0.0, -1.0, 1.0]]);
    let picture = texels.map(|texels| texture::Picture { texels, mapping, wrap: [Wrap::Clamp; 2], bilinear: true });
    let (spread, profile) = match profile {
        Some(distribution) => (Some(distribution.cone), Some(Arc::new(distribution))),
        None => (spread, None),
    };
    let emission = Emission { radiance, two_sided, spread, ..Emission::default() };
    Ok(Area { emission: (!dark).then_some(emission), picture, profile, power })
}

/// Reads the profile of an area light; `None` if the light is dark.
fn distribution(name: &str, two_sided: bool, given: &mut Given<'_>) -> Result<Option<Distribution>, Message> {
    let Some(Profile { intensity, aim, .. }) = profiles::read(name, given)? else {
        return Ok(None);
    };
    let ahead = aim.ahead();
    let Some(opening) = LuminousOpening::new(ahead, two_sided, &intensity) else {
        return Ok(None);
    };
    // about another axis, or behind, the cone of the intensity tells nothing
    let cos = if ahead[2] == 1.0 && !two_sided { f64::from(intensity.cos_cone()) } else { -1.0 };
    // a little wider, since directions are rounded
    let tangent = if cos > 0.02 { libm::sqrt(1.0 - cos * cos) / cos * 1.001 + 1e-4 } else { WIDE };
    let cone = Spread { tan_half: tangent as f32, gain: 0.0 };
    Ok(Some(Distribution { intensity: intensity.into(), aim, opening, cone }))
}

/// The texels of the picture of a light, which is read once.
fn shown_texels(name: &str, given: &mut Given<'_>, known: &mut Shown) -> Result<Arc<Texels>, Message> {
    let key = (Arc::clone(&given.place.file), name.to_owned());
    if let Some(texels) = known.get(&key) {
        return Ok(Arc::clone(texels));
    }
    let image = given.files.image(name).map_err(|error| given.error(error.to_string()))?;
    let (colors, warning) = radiances(&image, name, [1.0; 3]).map_err(|what| given.error(what))?;
    warning.into_iter().for_each(|what| given.warn(what));
    let Picture { width, height, .. } = image;
    let texels = Arc::new(Texels { width, height, colors: Colors::Float(colors), alpha: None });
    known.insert(key, Arc::clone(&texels));
    Ok(texels)
}

/// The spread of an area light: the full angle in degrees, as in Cycles. pbrt has none.
fn spread(params: &mut Params) -> Result<Option<Spread<f32>>, Message> {
    let Some(angle) = params.float("spread")? else { return Ok(None) };
    params.bound("spread", angle, (0.1..=180.0).contains(&angle), "from 0.1 to 180 degrees")?;
    Ok((angle < 180.0).then(|| Spread::new(angle.to_radians())))
}
