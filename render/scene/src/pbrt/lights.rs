//! Reads `LightSource`.

use super::daylight;
use super::given::Given;
use super::params::{Params, shown};
use super::portals;
use crate::message::shortened;
use crate::radiance::{brightness, luminance, rounded, sky_of};
use crate::transform::{one_minus_cos, sub};
use etendue::light::{EnvironmentMap, Portal};
use etendue_render::scene::limits::MOST_RADIANCE;
use etendue_render::scene::{DeltaLight, Environment, Message, SkyRadiance};
use std::f64::consts::PI;

/// What a `LightSource` directive creates.
pub(super) enum Source {
    Delta(DeltaLight),
    Environment(Environment),
    /// Nothing, since the light emits nothing.
    Dark,
}

/// Reads a `LightSource`.
pub(super) fn read(kind: &str, given: &mut Given<'_>) -> Result<Source, Message> {
    given.require(
        ["point", "spot", "distant", "infinite"].contains(&kind),
        || "not supported, only \"point\", \"spot\", \"distant\", \"infinite\" and \"goniometric\"",
    )?;
    let is_sky = kind == "infinite";
    let file = match if is_sky { given.text("filename")? } else { None } {
        None if is_sky => given.text("mapname")?,
        file => file,
    };
    let portals = if is_sky { portals::read(given)? } else { Vec::new() };
    // older files scale by a colour
    let scale = scale(given)?;
    let name = if kind == "point" || kind == "spot" { "I" } else { "L" };
    let colour = given.light(name)?;
    let wanted = match kind {
        "point" | "spot" => given.float("power")?,
        _ => given.float("illuminance")?,
    };
    if let Some(x) = wanted.filter(|&x| x <= 0.0) {
        return Err(given.error(format!("\"power\" or \"illuminance\": must be greater than 0, not {}", shown(x))));
    }
    let formula = if is_sky { given.text("sky")? } else { None };
    let strength = Strength { colour, scale, wanted };
    let source = match (file, formula) {
        (Some(file), Some(_)) => {
            return Err(
                given.error(format!("\"sky\" and \"filename\" {}: a sky has one or the other", shortened(&file)))
            );
        }
        (None, Some(formula)) => {
            let (to_light, own) = (turned(given)?, colour.unwrap_or([1.0; 3]));
            let daylight = daylight::read(&formula, given, own, scale, wanted, &to_light)?;
            let light = |(sky, sun)| Source::Environment(Environment { to_light, sky, portals, sun });
            daylight.map_or(Source::Dark, light)
        }
        (Some(file), None) => {
            let to_light = turned(given)?;
            match pictured(&file, &strength, given)? {
                Some(sky) => Source::Environment(Environment { to_light, sky, portals, sun: None }),
                None => Source::Dark,
            }
        }
        (None, None) => even(kind, name, &strength, given, portals)?,
    };
    if matches!(source, Source::Dark) {
        given.warn("emits nothing");
    }
    Ok(source)
}

/// How strong a light is.
struct Strength {
    /// Intensity or radiance; 1 if it is not given.
    colour: Option<[f64; 3]>,
    scale: [f64; 3],
    /// The power or illuminance, if that is given.
    wanted: Option<f64>,
}

/// The sky that an image shows, unless it is black.
fn pictured(
    file: &str,
    &Strength { colour, scale, wanted }: &Strength,
    given: &mut Given<'_>,
) -> Result<Option<SkyRadiance>, Message> {
    let image = given.files.image(file).map_err(|error| given.error(error.to_string()))?;
    let shown = |given: &Given<'_>, scale| sky_of(&image, file, scale).map_err(|what| given.error(what));
    // pbrt-v3 multiplies both, and pbrt-v4 refuses them
    let colour = colour.unwrap_or([1.0; 3]);
    let factor = match wanted {
        Some(wanted) => match shown(given, colour)?.0.map_or(0.0, |sky| illuminance(&sky)) {
            0.0 => {
                given.warn("\"illuminance\" is ignored: the upper half of the sky is dark");
                1.0
            }
            own => wanted / own,
        },
        None => 1.0,
    };
    let (sky, warning) = shown(given, std::array::from_fn(|k| scale[k] * colour[k] * factor))?;
    warning.into_iter().for_each(|what| given.warn(what));
    Ok(sky)
}

/// A light of the same intensity or radiance, the parameter `name`, in all directions in which it shines.
fn even(
    kind: &str,
    name: &str,
    &Strength { colour, scale, wanted }: &Strength,
    given: &mut Given<'_>,
    portals: Vec<Portal>,
) -> Result<Source, Message> {
    let mut colour = colour.unwrap_or([1.0; 3]);
    if let Some(wanted) = wanted {
        // what a light of the intensity or radiance 1 has
        let per_unit = match kind {
            "point" => 4.0 * PI,
            "spot" => spot_angle(given)?,
            "distant" => 1.0,
            _ => PI,
        };
        let y = luminance(colour);
        colour = colour.map(|x| if y > 0.0 { x * wanted / (y * per_unit) } else { 0.0 });
    }
    let colour = std::array::from_fn(|k| colour[k] * scale[k]);
    let most = if kind == "infinite" { MOST_RADIANCE } else { f32::MAX };
    let too_large = || given.error(format!("{name:?} times \"scale\" is {colour:?}: at most {most:e} is supported"));
    let colour = rounded(colour).filter(|rgb| rgb.iter().all(|x| *x <= most)).ok_or_else(too_large)?;
    brightness(colour).into_iter().for_each(|text| given.warn(text));
    let source = constant(kind, given, colour, portals)?;
    Ok(if colour == [0.0; 3] { Source::Dark } else { source })
}

/// Reads the power that a light shall have.
pub(super) fn power(params: &mut Params) -> Result<Option<f64>, Message> {
    params.float("power")?.map(|power| params.bound("power", power, power > 0.0, "greater than 0")).transpose()
}

/// The factor of a light; older files have one for each channel.
pub(super) fn scale(params: &mut Params) -> Result<[f64; 3], Message> {
    let scale = params.numbers_of("scale", &["float", "rgb"], 1)?.unwrap_or_else(|| vec![1.0]);
    let scale: [f64; 3] = match scale[..] {
        [x] => [x; 3],
        [r, g, b] => [r, g, b],
        _ => return Err(params.error(format!("\"scale\": expected one number, found {}", scale.len()))),
    };
    scale.into_iter().try_for_each(|x| params.bound("scale", x, x >= 0.0, "at least 0").map(|_| ()))?;
    Ok(scale)
}

/// The power of a spot light of intensity 1 by pbrt's formula, which takes the mean of both cones: an angle in steradians.
fn spot_angle(params: &mut Params) -> Result<f64, Message> {
    let outer = params.float("coneangle")?.unwrap_or(30.0);
    let delta = params.float("conedeltaangle")?.unwrap_or(5.0);
    params.set_float("coneangle", outer);
    params.set_float("conedeltaangle", delta);
    let [inner, outer] = [outer - delta, outer].map(|degrees| one_minus_cos(degrees.to_radians()));
    Ok(PI * (inner + outer))
}

/// The illuminance of a surface that faces the light's +z, as in pbrt-v4.
fn illuminance(sky: &SkyRadiance) -> f64 {
    match sky {
        SkyRadiance::Constant(rgb) => PI * luminance(rgb.map(f64::from)),
        SkyRadiance::Image { width, map, texels } => {
            let size = [*width, texels.len() / width];
            let lit = |(i, texel): (usize, &[f32; 3])| {
                luminance(texel.map(f64::from)) * facing(*map, size, [i % width, i / width])
            };
            texels.iter().enumerate().map(lit).sum()
        }
    }
}

/// ∫max(cosθ, 0) dω over a texel, where θ is the angle to +z.
fn facing(map: EnvironmentMap, [width, height]: [usize; 2], [x, y]: [usize; 2]) -> f64 {
    let edges = |i: usize, n: usize| [i, i + 1].map(|i| i as f64 / n as f64);
    let (across, down) = (edges(x, width), edges(y, height));
    let sum = match map {
        EnvironmentMap::Equirectangular => {
            let [top, bottom] = down.map(|v| libm::cos(PI * v).max(0.0));
            PI * (top * top - bottom * bottom) / width as f64
        }
        EnvironmentMap::EqualArea => {
            // at (a, b) in [−1, 1]² the cosine is 1 − (|a| + |b|)², or less than 0 beyond |a| + |b| = 1, and dω = π da db
            let twice =
                |s: f64| if s < 1.0 { s * s * (6.0 - s * s) / 12.0 } else { 5.0 / 12.0 + 2.0 / 3.0 * (s - 1.0) };
            // the integral from the middle to a corner
            let corner = |a: f64, b: f64| {
                let (p, q) = (a.abs(), b.abs());
                (a * b).signum() * (twice(p + q) - twice(p) - twice(q))
            };
            let [[left, right], [top, bottom]] = [across, down].map(|edges| edges.map(|x| 2.0 * x - 1.0));
            PI * (corner(right, bottom) - corner(left, bottom) - corner(right, top) + corner(left, top))
        }
    };
    // below the horizon it is rounding noise
    if sum > 1e-7 * map.texel_solid_angle(width, height, y) { sum } else { 0.0 }
}

fn constant(kind: &str, given: &mut Given<'_>, colour: [f32; 3], portals: Vec<Portal>) -> Result<Source, Message> {
    let point = |given: &mut Given<'_>, name: &str, default: [f64; 3]| -> Result<[f64; 3], Message> {
        let Some(p) = given.numbers(name, "point3", 3)? else { return Ok(default) };
        <[f64; 3]>::try_from(&p[..])
            .map_err(|_| given.error(format!("{name:?}: expected three numbers, found {}", p.len())))
    };
    if kind == "infinite" {
        return Ok(Source::Environment(Environment {
            to_light: turned(given)?,
            sky: SkyRadiance::Constant(colour),
            portals,
            sun: None,
        }));
    }
    let from = point(given, "from", [0.0; 3])?;
    let position = position(given, given.ctm.point(from))?;
    if kind == "point" {
        return Ok(Source::Delta(DeltaLight::Point { position, intensity: colour }));
    }
    let to = point(given, "to", [0.0, 0.0, 1.0])?;
    let axis = given.ctm.direction(sub(to, from), 1e-12);
    let axis = axis.ok_or_else(|| given.error(format!("\"from\" {from:?} and \"to\" {to:?} define no direction")))?;
    if kind == "distant" {
        let direction = axis.map(|x| -x as f32);
        return Ok(Source::Delta(DeltaLight::Distant { direction, irradiance: colour }));
    }
    given.require(
        given.ctm.similarity().is_some(),
        || "its transform stretches its cone: only rotations, reflections and uniform scales are supported",
    )?;
    let outer = given.float("coneangle")?.unwrap_or(30.0);
    let delta = given.float("conedeltaangle")?.unwrap_or(5.0);
    given.bound("coneangle", outer, outer > 0.0 && outer <= 180.0, "greater than 0 and at most 180 degrees")?;
    let range = format!("from 0 to the cone angle {outer}");
    given.bound("conedeltaangle", delta, (0.0..=outer).contains(&delta), &range)?;
    let [one_minus_cos_inner, one_minus_cos_outer] =
        [outer - delta, outer].map(|degrees| one_minus_cos(degrees.to_radians()) as f32);
    let axis = axis.map(|x| x as f32);
    let intensity = colour;
    Ok(Source::Delta(DeltaLight::Spot { position, axis, one_minus_cos_inner, one_minus_cos_outer, intensity }))
}

/// The position of a light in world space.
pub(super) fn position(params: &Params, p: [f64; 3]) -> Result<[f32; 3], Message> {
    let rounded = p.map(|x| x as f32);
    params.require(rounded.iter().all(|x| x.is_finite()), || format!("its position {p:?} is not finite in f32"))?;
    Ok(rounded)
}

/// The rotation from world space to light space.
pub(super) fn turned(given: &Given<'_>) -> Result<[[f32; 3]; 3], Message> {
    let stretched = || given.error("its transform may only consist of rotations, reflections and uniform scales");
    given.ctm.axes().ok_or_else(stretched)
}
