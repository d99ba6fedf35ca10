//! Intensity by direction, as photometry tells it.

use crate::light::{EtenduePointLight, EtenduePointLightByDelta};
use crate::sampler::vec3;
use crate::{EtendueStatus, refuse_null, value, values};
use core::ffi::c_void;
use core::mem::{align_of, size_of};
use core::slice::{from_raw_parts, from_raw_parts_mut};
use etendue::Vec3;
use etendue::light::{PointLight, PointLightByDelta, Profile, ProfileError};

/// The radiant intensity of a light by direction: a table over two angles, between which it is bilinear, as photometry interpolates.
///
/// Directions are those in which light travels, in the space of the profile: the polar angle is that from +z, and the azimuth that from +x
/// towards +y. IES files (LM-63) of type C have the nadir as +z; those of types A and B have their axis as z, and the polar angle is their
/// vertical angle plus 90 degrees. What is inside does not concern callers: it may be copied, and used by any thread, while the arrays that it
/// was prepared from live.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueProfile {
    data: [usize; 8],
}
const _: () = assert!(
    size_of::<Profile<'static>>() <= size_of::<EtendueProfile>()
        && align_of::<Profile<'static>>() <= align_of::<EtendueProfile>()
);

impl EtendueProfile {
    unsafe fn profile(this: *const Self) -> Profile<'static> {
        // SAFETY: `etendue_profile_prepare` wrote it, and the caller's pointer is not null
        unsafe { this.cast::<Profile<'static>>().read() }
    }
}

/// Prepares a profile from polar angles and azimuths in degrees, and a value for each pair: all polar angles of the first azimuth come first.
///
/// There are 2 or more polar angles that ascend in [0, 180], and azimuths that ascend from one in (-360, 0] over at most 360; a single azimuth
/// stands for all. `values` has polar_count x azimuth_count elements from 0 to 1e37, in any unit. Below the first and above the last polar
/// angle, and outside the azimuths, the light is dark. The arrays must live as long as the profile is used. Returns ETENDUE_STATUS_COUNT for
/// too few angles, and ETENDUE_STATUS_VALUE if angles do not ascend or are out of their range, and if a value is negative, NaN or too large.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_profile_prepare(
    polar: *const f32,
    polar_count: usize,
    azimuth: *const f32,
    azimuth_count: usize,
    values: *const f32,
    out: *mut EtendueProfile,
) -> EtendueStatus {
    refuse_null!(polar, azimuth, values, out);
    let Some(count) = polar_count.checked_mul(azimuth_count) else { return EtendueStatus::Count };
    // SAFETY: the pointers are not null, and point to what the header says
    let profile = unsafe {
        let angles = [from_raw_parts(polar, polar_count), from_raw_parts(azimuth, azimuth_count)];
        Profile::new(angles[0], angles[1], from_raw_parts(values, count))
    };
    match profile {
        // SAFETY: as above
        Ok(profile) => unsafe {
            out.write(EtendueProfile { data: [0; 8] });
            out.cast::<Profile<'static>>().write(profile);
            EtendueStatus::Ok
        },
        Err(ProfileError::Length) => EtendueStatus::Count,
        Err(ProfileError::Angle | ProfileError::Value) => EtendueStatus::Value,
    }
}

/// The intensity in the unit direction `w` in which light travels, in the unit of the values; 0 if a pointer is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_profile_intensity(profile: *const EtendueProfile, w: *const f32) -> f32 {
    if profile.is_null() || w.is_null() {
        return 0.0;
    }
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe { value(&EtendueProfile::profile(profile), w) }
}

/// The intensity in each unit direction in which light travels: three columns.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_profile_intensity_batch(
    profile: *const EtendueProfile,
    n: usize,
    w: *const *const f32,
    out: *mut f32,
) -> EtendueStatus {
    if n == 0 {
        return EtendueStatus::Ok;
    }
    refuse_null!(profile, out);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe { values(&EtendueProfile::profile(profile), n, w, out) }
}

/// The integral of the intensity over all directions: the power, for intensities per steradian. Exact to some 1e-14; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_profile_power(profile: *const EtendueProfile) -> f64 {
    // SAFETY: the pointer is not null, and points to what the header says
    if profile.is_null() { 0.0 } else { unsafe { EtendueProfile::profile(profile).power() } }
}

/// Cosine of the angle from +z from which on the light is dark, at most 1: for EtendueLightBound. -1 if it may shine in all directions, and
/// for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_profile_cos_cone(profile: *const EtendueProfile) -> f32 {
    // SAFETY: the pointer is not null, and points to what the header says
    if profile.is_null() { -1.0 } else { unsafe { EtendueProfile::profile(profile).cos_cone() } }
}

/// Fills an image of width x height texels with the mean of the intensity over each texel of an equirectangular map, row by row, which is
/// greater than 0 where there is light. etendue_image_environment_build samples what the light emits with these weights. Returns
/// ETENDUE_STATUS_COUNT for an image without columns or rows.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_profile_means(
    profile: *const EtendueProfile,
    width: usize,
    height: usize,
    means: *mut f32,
) -> EtendueStatus {
    refuse_null!(profile, means);
    let Some(count @ 1..) = width.checked_mul(height) else { return EtendueStatus::Count };
    // SAFETY: the pointers are not null, and point to what the header says; every float is written before it is read
    let filled = unsafe {
        means.write_bytes(0, count);
        EtendueProfile::profile(profile).means(width, from_raw_parts_mut(means, count))
    };
    if filled.is_ok() { EtendueStatus::Ok } else { EtendueStatus::Count }
}

/// Prepares a point light whose intensity differs by direction for a shading point. `intensity` is called once, with the unit direction in
/// which light travels, in the coordinates of the scene, and with `context`, and returns the intensity there, relative to the I of the
/// estimator: of a profile, of a projected image, or of anything else. The pdf of a sample is distance^2 over it, which is no density, and 0
/// where the intensity is 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_point_light_by_profile_prepare(
    light: *const EtenduePointLight,
    p: *const f32,
    intensity: Option<unsafe extern "C" fn(w: *const f32, context: *mut c_void) -> f32>,
    context: *mut c_void,
    out: *mut EtenduePointLightByDelta,
) -> EtendueStatus {
    refuse_null!(light, p, out);
    let Some(intensity) = intensity else { return EtendueStatus::NullPointer };
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        let p = vec3(p.cast::<[f32; 3]>().read_unaligned());
        let light: PointLight<f32> = light.cast::<PointLight<f32>>().read();
        let sampler = light.by_profile(p, |w: Vec3<f32>| intensity([w.x, w.y, w.z].as_ptr(), context));
        out.cast::<PointLightByDelta<f32>>().write(sampler);
    }
    EtendueStatus::Ok
}
