//! Reads `LightSource`: lights without a shape.

use super::lexer::shortened;
use super::message::Message;
use super::params::{MOST_RADIANCE, Params, brightness, rounded, shown};
use super::transform::{Transform, sub, unit};
use crate::files::FileError;
use crate::image::Picture;
use etendue::light::EnvironmentMap;

/// A light that is seen from every point in a single direction, and that no ray can hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DeltaLight {
    /// A point light of the same intensity in all directions.
    Point {
        /// World position.
        position: [f32; 3],
        /// Radiant intensity, linear RGB.
        intensity: [f32; 3],
    },
    /// A spotlight: a cone whose intensity falls off smoothly between two angles.
    Spot {
        /// World position.
        position: [f32; 3],
        /// Unit vector along which the light travels.
        axis: [f32; 3],
        /// Cosine of the angle up to which the intensity is constant.
        cos_inner: f32,
        /// Cosine of the angle from which on the intensity is 0.
        cos_outer: f32,
        /// Radiant intensity on the axis, linear RGB.
        intensity: [f32; 3],
    },
    /// Parallel light from infinitely far away.
    Distant {
        /// Unit vector towards the light.
        direction: [f32; 3],
        /// Irradiance of a surface that faces the light, linear RGB.
        irradiance: [f32; 3],
    },
}

/// Light from infinitely far away in all directions.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    /// Rows of the orthogonal matrix from world space to light space.
    pub to_light: [[f32; 3]; 3],
    /// Radiance by direction.
    pub sky: SkyRadiance,
}

/// Radiance of an [`Environment`], linear RGB.
#[derive(Clone, Debug, PartialEq)]
pub enum SkyRadiance {
    /// The same in all directions.
    Constant([f32; 3]),
    /// An image, constant within each texel.
    Image {
        /// Number of columns.
        width: usize,
        /// How the image maps to directions.
        map: EnvironmentMap,
        /// Texels row by row; at least one channel is greater than 0.
        texels: Vec<[f32; 3]>,
    },
}

/// What a `LightSource` directive creates.
pub(super) enum Source {
    Delta(DeltaLight),
    Environment(Environment),
    /// Nothing, since the light emits nothing.
    Dark,
}

/// Greatest number of texels of an environment.
const MOST_TEXELS: usize = 1 << 26;

/// Reads a `LightSource`; `open` reads an image file.
pub(super) fn read(
    kind: &str,
    params: &mut Params,
    ctm: &Transform,
    open: &dyn Fn(&str) -> Result<Picture, FileError>,
    warnings: &mut Vec<Message>,
) -> Result<Source, Message> {
    if !["point", "spot", "distant", "infinite"].contains(&kind) {
        return Err(params.error("not supported, only \"point\", \"spot\", \"distant\" and \"infinite\""));
    }
    params.reject(&["power", "illuminance", "portal"])?;
    let scale = params.float("scale")?.unwrap_or(1.0);
    if scale < 0.0 {
        return Err(params.error(format!("\"scale\": must be at least 0, not {}", shown(scale))));
    }
    let file = if kind == "infinite" { params.text("filename")? } else { None };
    let name = if kind == "point" || kind == "spot" { "I" } else { "L" };
    let colour = params.rgb(name)?;
    let source = match file {
        Some(_) if colour.is_some() => return Err(params.error("\"filename\" and \"L\" cannot be combined")),
        Some(file) => {
            let to_light = turned(params, ctm)?;
            match picture(params, &file, open, scale, warnings)? {
                Some(sky) => Source::Environment(Environment { to_light, sky }),
                None => Source::Dark,
            }
        }
        None => {
            let colour = colour.unwrap_or([1.0; 3]).map(|x| x * scale);
            let most = if kind == "infinite" { MOST_RADIANCE } else { f32::MAX };
            let too_large =
                || params.error(format!("{name:?} times \"scale\" is {colour:?}: at most {most:e} is supported"));
            let colour = rounded(colour).filter(|rgb| rgb.iter().all(|x| *x <= most)).ok_or_else(too_large)?;
            warnings.extend(brightness(colour).map(|text| params.error(text)));
            let source = constant(kind, params, ctm, colour)?;
            if colour == [0.0; 3] { Source::Dark } else { source }
        }
    };
    if matches!(source, Source::Dark) {
        warnings.push(params.error("emits nothing"));
    }
    Ok(source)
}

fn constant(kind: &str, params: &mut Params, ctm: &Transform, colour: [f32; 3]) -> Result<Source, Message> {
    let mut point = |name: &str, default: [f64; 3]| -> Result<[f64; 3], Message> {
        let Some(p) = params.numbers(name, "point3", 3)? else { return Ok(default) };
        <[f64; 3]>::try_from(&p[..])
            .map_err(|_| params.error(format!("{name:?}: expected three numbers, found {}", p.len())))
    };
    if kind == "infinite" {
        return Ok(Source::Environment(Environment {
            to_light: turned(params, ctm)?,
            sky: SkyRadiance::Constant(colour),
        }));
    }
    let from = point("from", [0.0; 3])?;
    let position = ctm.point(from).map(|x| x as f32);
    if !position.iter().all(|x| x.is_finite()) {
        return Err(params.error(format!("its position {:?} is not finite in f32", ctm.point(from))));
    }
    if kind == "point" {
        return Ok(Source::Delta(DeltaLight::Point { position, intensity: colour }));
    }
    let to = point("to", [0.0, 0.0, 1.0])?;
    let axis = unit(ctm.vector(sub(to, from)));
    let axis = axis.ok_or_else(|| params.error(format!("\"from\" {from:?} and \"to\" {to:?} define no direction")))?;
    if kind == "distant" {
        let direction = axis.map(|x| -x as f32);
        return Ok(Source::Delta(DeltaLight::Distant { direction, irradiance: colour }));
    }
    if ctm.similarity().is_none() {
        return Err(params
            .error("its transform stretches its cone: only rotations, reflections and uniform scales are supported"));
    }
    let outer = params.float("coneangle")?.unwrap_or(30.0);
    let delta = params.float("conedeltaangle")?.unwrap_or(5.0);
    if !(outer > 0.0 && outer <= 180.0) {
        return Err(params
            .error(format!("\"coneangle\": must be greater than 0 and at most 180 degrees, not {}", shown(outer))));
    }
    if !(0.0..=outer).contains(&delta) {
        return Err(
            params.error(format!("\"conedeltaangle\": must be from 0 to the cone angle {outer}, not {}", shown(delta)))
        );
    }
    let cosine = |degrees: f64| libm::cos(degrees.to_radians()) as f32;
    let [cos_inner, cos_outer] = [outer - delta, outer].map(cosine);
    let axis = axis.map(|x| x as f32);
    Ok(Source::Delta(DeltaLight::Spot { position, axis, cos_inner, cos_outer, intensity: colour }))
}

/// The rotation from world space to light space.
fn turned(params: &Params, ctm: &Transform) -> Result<[[f32; 3]; 3], Message> {
    let stretched = || params.error("its transform may only consist of rotations, reflections and uniform scales");
    let factor = ctm.similarity().ok_or_else(stretched)?;
    // the inverse of an orthogonal matrix is its transpose
    Ok(std::array::from_fn(|i| std::array::from_fn(|j| (ctm.linear[j][i] / factor) as f32)))
}

/// The image of an environment; `None` if it is black.
fn picture(
    params: &Params,
    name: &str,
    open: &dyn Fn(&str) -> Result<Picture, FileError>,
    scale: f64,
    warnings: &mut Vec<Message>,
) -> Result<Option<SkyRadiance>, Message> {
    let image = open(name).map_err(|error| params.error(error.to_string()))?;
    let (width, height) = (image.width, image.height);
    let wrong = |what: String| params.error(format!("{}: {what}", shortened(name)));
    let map = match (width, height) {
        _ if width == height => EnvironmentMap::EqualArea,
        _ if width == 2 * height => EnvironmentMap::Equirectangular,
        _ => {
            return Err(wrong(format!(
                "{width}×{height} texels: must be square (equal-area octahedral) or 2:1 (equirectangular)"
            )));
        }
    };
    if width * height > MOST_TEXELS {
        return Err(wrong(format!("{width}×{height} texels: at most 2^26 are supported")));
    }
    let mut negative = 0;
    let mut texels = Vec::with_capacity(image.radiance.len());
    for (i, texel) in image.radiance.iter().enumerate() {
        let rgb = texel.map(|x| (f64::from(x) * scale) as f32);
        // texels are sampled in proportion to the sum of their channels
        if !(rgb.iter().sum::<f32>().is_finite() && rgb.iter().all(|&x| x <= MOST_RADIANCE)) {
            return Err(wrong(format!(
                "texel ({}, {}) is {texel:?}, times {scale}: must be finite, and at most {MOST_RADIANCE:e}",
                i % width,
                i / width
            )));
        }
        negative += usize::from(rgb.iter().any(|&x| x < 0.0));
        texels.push(rgb.map(|x| x.max(0.0)));
    }
    if negative > 0 {
        warnings.push(wrong(format!("negative values in {negative} texel(s) are replaced by 0")));
    }
    let black = texels.iter().all(|t| *t == [0.0; 3]);
    Ok((!black).then_some(SkyRadiance::Image { width, map, texels }))
}
