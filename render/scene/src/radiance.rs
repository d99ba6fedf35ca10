//! The radiance of colours and of images, as lights have it.

use crate::message::shortened;
use etendue::light::EnvironmentMap;
use etendue_render::film::image::Picture;
use etendue_render::scene::SkyRadiance;
use etendue_render::scene::limits::MOST_RADIANCE;

/// Luminance of linear sRGB, as Y of CIE XYZ.
pub(super) fn luminance([r, g, b]: [f64; 3]) -> f64 {
    0.212_639 * r + 0.715_168_7 * g + 0.072_192_3 * b
}

/// Above this, the variance of a pixel may be more than single precision holds.
const BRIGHT: f32 = 1e18;

/// What to say of a light that may be too bright for the error of the image to be known.
pub(super) fn brightness(rgb: [f32; 3]) -> Option<String> {
    let is_bright = rgb.iter().any(|&x| x > BRIGHT);
    is_bright
        .then(|| format!("{rgb:?} is so bright that variances may overflow: the error of the image may not be known"))
}

/// A colour rounded to f32; `None` if a channel overflows.
pub(super) fn rounded(rgb: [f64; 3]) -> Option<[f32; 3]> {
    let rgb = rgb.map(|x| x as f32);
    rgb.iter().all(|x| x.is_finite()).then_some(rgb)
}

/// Greatest number of texels of an environment, or of the picture of a light.
pub(super) const MOST_TEXELS: usize = 1 << 26;

/// The sky that an image shows, unless it is black, and a warning if some of it is negative.
pub(super) fn sky_of(
    image: &Picture,
    name: &str,
    scale: [f64; 3],
) -> Result<(Option<SkyRadiance>, Option<String>), String> {
    // pbrt-v4's maps are square, those of others show longitude and latitude
    let map = if image.width == image.height { EnvironmentMap::EqualArea } else { EnvironmentMap::Equirectangular };
    let (texels, warning) = radiances(image, name, scale)?;
    let black = texels.iter().all(|t| *t == [0.0; 3]);
    Ok(((!black).then_some(SkyRadiance::Image { width: image.width, map, texels }), warning))
}

/// What the texels of an image emit, and a warning if some of it is negative. Fails if there are too many, or if one is not finite.
pub(super) fn radiances(
    image: &Picture,
    name: &str,
    scale: [f64; 3],
) -> Result<(Vec<[f32; 3]>, Option<String>), String> {
    let (width, height) = (image.width, image.height);
    let told = |what: String| format!("{}: {what}", shortened(name));
    if width * height > MOST_TEXELS {
        return Err(told(format!("{width}×{height} texels: at most 2^26 are supported")));
    }
    let mut negative = 0;
    let mut texels = Vec::with_capacity(image.radiance.len());
    for (i, texel) in image.radiance.iter().enumerate() {
        let rgb: [f32; 3] = std::array::from_fn(|k| (f64::from(texel[k]) * scale[k]) as f32);
        // texels are sampled in proportion to the sum of their channels
        if !(rgb.iter().sum::<f32>().is_finite() && rgb.iter().all(|&x| x <= MOST_RADIANCE)) {
            let scaled = if scale == [1.0; 3] { String::new() } else { format!(", times {scale:?}") };
            return Err(told(format!(
                "texel ({}, {}) is {texel:?}{scaled}: must be finite, and at most {MOST_RADIANCE:e}",
                i % width,
                i / width
            )));
        }
        negative += usize::from(rgb.iter().any(|&x| x < 0.0));
        texels.push(rgb.map(|x| x.max(0.0)));
    }
    let warning = (negative > 0).then(|| told(format!("negative values in {negative} texel(s) are replaced by 0")));
    Ok((texels, warning))
}
