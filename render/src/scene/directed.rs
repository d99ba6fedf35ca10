//! Reads point lights whose intensity differs by direction: `LightSource "goniometric"` and `"projection"`.

use super::ies;
use super::lights::{DeltaLight, Files, MOST_TEXELS, scale, turned};
use super::message::{Message, Notes};
use super::params::{Params, brightness, rounded, shown};
use super::spectrum::luminance;
use super::transform::Transform;
use crate::image::Picture;
use crate::intensity::Intensity;
use etendue::light::{EnvironmentMap, Projector};

/// Axes of the images of directions, in light space: pbrt has y up, and images have z.
const UP: [ies::Axis; 3] = [(0, 1.0), (2, 1.0), (1, 1.0)];
/// Axes of projected images.
const FORWARD: [ies::Axis; 3] = [(0, 1.0), (1, 1.0), (2, 1.0)];

/// An intensity, its greatest value, and its axes.
type Shape = (Intensity, f64, [ies::Axis; 3]);

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
    let tint = params.light("I", files.resolve)?.unwrap_or([1.0; 3]);
    let scale = scale(params)?;
    let power = params.float("power")?;
    if let Some(x) = power.filter(|&x| x <= 0.0) {
        return Err(params.error(format!("\"power\": must be greater than 0, not {}", shown(x))));
    }
    let found = if kind == "projection" {
        let fov = params.float("fov")?.unwrap_or(90.0);
        if !(fov > 0.0 && fov < 180.0) {
            return Err(params.error(format!("\"fov\": must be between 0 and 180 degrees, not {}", shown(fov))));
        }
        projected(&picture(params, &name, files)?, fov).map_err(|what| params.error(format!("{name}: {what}")))?
    } else if name.to_ascii_lowercase().ends_with(".ies") {
        let ies::Photometry { intensity, greatest, axes, warnings } =
            ies::read(&(files.resolve)(&name), &name).map_err(|what| params.error(what))?;
        warnings.into_iter().for_each(|what| notes.warn(params.error(what)));
        (greatest > 0.0).then_some((intensity, greatest, axes))
    } else {
        sphere(&picture(params, &name, files)?).map_err(|what| params.error(format!("{name}: {what}")))?
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
    let mut color: [f64; 3] = std::array::from_fn(|k| tint[k] * scale[k] * greatest);
    if let Some(power) = power {
        let flux = shape.flux();
        let emitted = luminance(std::array::from_fn(|k| color[k] * flux[k]));
        color = color.map(|x| if emitted > 0.0 { x * power / emitted } else { 0.0 });
    }
    let too_large =
        || params.error(format!("its greatest intensity is {color:?}: at most {:e} is supported", f32::MAX));
    let intensity = rounded(color).filter(|rgb| rgb.iter().all(|x| *x <= f32::MAX)).ok_or_else(too_large)?;
    brightness(intensity).into_iter().for_each(|text| notes.warn(params.error(text)));
    if intensity == [0.0; 3] {
        notes.warn(params.error("emits nothing"));
        return Ok(None);
    }
    let to_light = axes.map(|(axis, sign)| to_light[axis].map(|x| x * sign as f32));
    Ok(Some((DeltaLight::Directed { position, to_light, intensity, table }, shape)))
}

/// Reads an image without what no light can have.
fn picture(params: &Params, name: &str, files: &Files<'_>) -> Result<Picture, Message> {
    let image = (files.open)(name).map_err(|error| params.error(error.to_string()))?;
    let (width, height) = (image.width, image.height);
    if width * height > MOST_TEXELS {
        return Err(params.error(format!("{name}: {width}×{height} texels: at most 2^26 are supported")));
    }
    let is_wrong = |rgb: &[f32; 3]| !rgb.iter().all(|x| (0.0..=f32::MAX).contains(x));
    if let Some(i) = image.radiance.iter().position(is_wrong) {
        let (x, y, texel) = (i % width, i / width, image.radiance[i]);
        return Err(params.error(format!("{name}: texel ({x}, {y}) is {texel:?}: must be finite, and at least 0")));
    }
    Ok(image)
}

/// The means of the channels as an image of all directions; `None` if it is black.
fn sphere(image: &Picture) -> Result<Option<Shape>, String> {
    let map = if image.width == image.height {
        EnvironmentMap::EqualArea
    } else if image.width == 2 * image.height {
        EnvironmentMap::Equirectangular
    } else {
        return Err(format!("{}×{} texels: must be square, or twice as wide as high", image.width, image.height));
    };
    let means: Vec<f64> =
        image.radiance.iter().map(|rgb| rgb.iter().map(|&x| f64::from(x)).sum::<f64>() / 3.0).collect();
    let greatest = means.iter().fold(0.0, |most: f64, &x| most.max(x));
    let texels = means.iter().map(|x| (x / greatest.max(f64::MIN_POSITIVE)) as f32).collect();
    Ok(Intensity::sphere(map, image.width, texels).map(|shape| (shape, greatest, UP)))
}

/// A projected image, of which `fov` is the full angle of the shorter side in degrees; `None` if it is black.
fn projected(image: &Picture, fov: f64) -> Result<Option<Shape>, String> {
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
