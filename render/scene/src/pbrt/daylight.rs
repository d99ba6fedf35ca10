//! Reads `LightSource "infinite" "string sky" "cie"`: daylight by CIE's standard general sky, without a file.
//!
//! The sky is an image of 512 × 512 texels, each
//! of which has the mean of the formula at 16 places.

use super::params::Params;
use crate::radiance::{luminance, rounded};
use etendue::light::{EnvironmentMap, ImageEnvironment, Texel};
use etendue::{Real, Vec2, f32x8, u32x8};
use etendue_render::lights::sky::GeneralSky;
use etendue_render::scene::limits::MOST_RADIANCE;
use etendue_render::scene::{Message, SkyRadiance, SunDisk};
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// Columns and rows of the image, and places in a texel along each axis.
const SIDE: usize = 512;
const PLACES: usize = 4;
/// 1 − cosσ of the sun's radius as seen from the earth.
const SUN: f64 = 1.09e-5;
/// Types whose luminance does not depend on the sun.
const WITHOUT_SUN: [i64; 3] = [1, 3, 5];

/// A sky and its sun.
pub(super) type Daylight = (SkyRadiance, Option<SunDisk>);

/// Reads the sky of this kind; `colour` is the radiance of its zenith, unless the horizontal plane has the wanted illuminance, and `scale` a
/// factor of either. The rows of `to_light` turn the world to the light's space.
pub(super) fn read(
    kind: &str,
    params: &mut Params,
    colour: [f64; 3],
    scale: [f64; 3],
    wanted: Option<f64>,
    to_light: &[[f32; 3]; 3],
) -> Result<Option<Daylight>, Message> {
    params.require(kind == "cie", || format!("\"sky\": {kind:?} is not supported, only \"cie\""))?;
    let number = params.integer("type")?.unwrap_or(12);
    let sun = sun(params, WITHOUT_SUN.contains(&number))?;
    let sky = u32::try_from(number).ok().and_then(|number| GeneralSky::new(number, sun));
    let sky = sky.ok_or_else(|| params.error(format!("\"type\": must be from 1 to 15, not {number}")))?;
    let disk = params.float("sun")?.unwrap_or(0.0);
    params.bound("sun", disk, (0.0..=f64::MAX).contains(&disk), "at least 0")?;
    let brightness = luminance(colour);
    let factor = match wanted {
        Some(wanted) if brightness > 0.0 => wanted / (brightness * sky.horizontal()),
        _ => 1.0,
    };
    let zenith: [f64; 3] = std::array::from_fn(|k| colour[k] * scale[k] * factor);
    let too_large = |rgb: &dyn std::fmt::Debug| {
        params.error(format!("the radiance {rgb:?} of the sky or its sun: at most {MOST_RADIANCE:e} is supported"))
    };
    let (mut texels, mut is_dark) = (Vec::with_capacity(SIDE * SIDE), true);
    for relative in image(&sky) {
        let rgb = zenith.map(|x| x * relative);
        let rgb = rounded(rgb).filter(|rgb| rgb.iter().all(|x| *x <= MOST_RADIANCE)).ok_or_else(|| too_large(&rgb))?;
        is_dark &= rgb == [0.0; 3];
        texels.push(rgb);
    }
    // a surface that faces the disk gets π sin²σ times its radiance
    let radiance = disk / (PI * SUN * (2.0 - SUN));
    let narrow = rounded([radiance; 3]).filter(|rgb| rgb[0] <= MOST_RADIANCE).ok_or_else(|| too_large(&radiance))?;
    // the inverse of an orthogonal matrix is its transpose
    let direction = std::array::from_fn(|k| (0..3).map(|i| f64::from(to_light[i][k]) * sun[i]).sum::<f64>() as f32);
    let disk = (narrow[0] > 0.0).then_some(SunDisk { direction, one_minus_cos: SUN as f32, radiance: narrow });
    let sky = match is_dark {
        true => SkyRadiance::Constant([0.0; 3]),
        false => SkyRadiance::Image { width: SIDE, map: EnvironmentMap::EqualArea, texels },
    };
    Ok((!is_dark || disk.is_some()).then_some((sky, disk)))
}

/// Unit vector to the sun in the light's space, in which +x is east, +y north and +z up.
fn sun(params: &mut Params, may_lack: bool) -> Result<[f64; 3], Message> {
    let Some(elevation) = params.float("elevation")? else {
        return if may_lack { Ok([0.0, 0.0, 1.0]) } else { Err(params.error("needs \"elevation\" for its sun")) };
    };
    params.bound("elevation", elevation, (0.0..=90.0).contains(&elevation), "from 0 to 90 degrees")?;
    let azimuth = params.float("azimuth")?.unwrap_or(180.0);
    params.bound("azimuth", azimuth, azimuth.is_finite(), "finite")?;
    let [(s, c), (sin, cos)] = [elevation, azimuth].map(|degrees| (degrees.to_radians() / TAU).sin_cos_turns());
    Ok([c * sin, c * cos, s])
}

/// The mean of each texel, over the luminance of the zenith.
fn image(sky: &GeneralSky) -> Vec<f64> {
    let buffer = vec![0.0; ImageEnvironment::buffer(SIDE, SIDE)];
    let map = ImageEnvironment::from_buffer(&buffer, SIDE, EnvironmentMap::EqualArea).expect("a buffer of its size");
    // two packets of 4 columns and 2 rows
    let within = |k: usize| ((k as f64 + 0.5) / PLACES as f64) as f32;
    let places =
        [0, 1].map(|half| Vec2::new(f32x8::from_fn(|k| within(k % 4)), f32x8::from_fn(|k| within(2 * half + k / 4))));
    let mean = |i: usize| {
        let [x, y] = [i % SIDE, i / SIDE].map(|k| u32x8::splat(k as u32));
        let luminance = places.map(|offset| sky.luminance(map.direction(&Texel { x, y, offset })));
        (0..8).map(|lane| luminance[0].lane_f64(lane) + luminance[1].lane_f64(lane)).sum::<f64>() / 16.0
    };
    (0..SIDE * SIDE).into_par_iter().map(mean).collect()
}
