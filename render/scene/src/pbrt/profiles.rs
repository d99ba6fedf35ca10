//! Reads intensities by direction from IES files and images, and aims them along the axes of lights.

use super::given::Given;
use super::ies;
use crate::distribution::{Aim, Axis};
use crate::radiance::MOST_TEXELS;
use etendue::light::EnvironmentMap;
use etendue_render::film::image::Picture;
use etendue_render::scene::Message;
use etendue_render::scene::intensity::Intensity;

/// An intensity by direction.
#[derive(Debug)]
pub(super) struct Profile {
    pub(super) intensity: Intensity,
    /// The greatest intensity.
    pub(super) greatest: f64,
    pub(super) aim: Aim,
}

/// Axes of the images of directions: pbrt has y up, and images have z.
const UP: [Axis; 3] = [(0, 1.0), (2, 1.0), (1, 1.0)];
/// Reads an IES file, or pbrt's square image of directions, or an older one of longitude and latitude; `None` if it is dark.
pub(super) fn read(name: &str, given: &mut Given<'_>) -> Result<Option<Profile>, Message> {
    if !name.to_ascii_lowercase().ends_with(".ies") {
        let image = picture(given, name)?;
        return sphere(&image).map_err(|what| given.error(format!("{name}: {what}")));
    }
    let ies::Photometry { intensity, greatest, aim, warnings } =
        ies::read(name, &given.files).map_err(|what| given.error(what))?;
    warnings.into_iter().for_each(|what| given.warn(what));
    Ok((greatest > 0.0).then_some(Profile { intensity, greatest, aim }))
}

/// Reads an image without what no light can have.
fn picture(given: &Given<'_>, name: &str) -> Result<Picture, Message> {
    let image = given.files.image(name).map_err(|error| given.error(error.to_string()))?;
    let (width, height) = (image.width, image.height);
    given.require(width * height <= MOST_TEXELS, || {
        format!("{name}: {width}×{height} texels: at most 2^26 are supported")
    })?;
    let is_wrong = |rgb: &[f32; 3]| !rgb.iter().all(|x| (0.0..=f32::MAX).contains(x));
    if let Some(i) = image.radiance.iter().position(is_wrong) {
        let (x, y, texel) = (i % width, i / width, image.radiance[i]);
        return Err(given.error(format!("{name}: texel ({x}, {y}) is {texel:?}: must be finite, and at least 0")));
    }
    Ok(image)
}

/// The means of the channels as an image of all directions; `None` if it is black.
fn sphere(image: &Picture) -> Result<Option<Profile>, String> {
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
    let profile = |intensity| Profile { intensity, greatest, aim: Aim { axes: UP } };
    Ok(Intensity::sphere(map, image.width, texels).map(profile))
}
