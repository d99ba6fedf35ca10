//! Light from all around as an image tells it.

use crate::memory::{build_table, refuse_null};
use crate::status::EtendueStatus;
use core::mem::{offset_of, size_of};
use core::slice::from_raw_parts;
use etendue::light::{EnvironmentMap, ImageEnvironment};
use etendue::owned::OwnedEnvironment;
use etendue_batch::memory::ImageMemory;

/// The most columns or rows.
const MOST: usize = 1 << 24;

/// How an image covers the sphere of directions. In both z is up and the first row of the image comes first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub enum EtendueEnvironmentMap {
    /// The octahedral map of equal areas, as in pbrt-v4: the texels of a square image all have the same solid angle.
    EqualArea = 0,
    /// Longitude and latitude: columns are the azimuth from +x in [0, 2π), rows the angle from +z in [0, π].
    Equirectangular = 1,
}

/// Light from all around as an image tells it, in memory of the caller: directions in proportion to the image, the same for all shading
/// points. The position in the image is `uv` of a sample.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueImageEnvironment {
    /// The table that [`etendue_image_environment_build`] wrote.
    pub table: *const f32,
    /// Number of columns of the image.
    pub width: usize,
    /// Number of its rows.
    pub height: usize,
    /// One of EtendueEnvironmentMap.
    pub map: u32,
}

fn map_of(map: u32) -> Option<EnvironmentMap> {
    match map {
        0 => Some(EnvironmentMap::EqualArea),
        1 => Some(EnvironmentMap::Equirectangular),
        _ => None,
    }
}

impl EtendueImageEnvironment {
    /// Whether the library can look into it.
    pub(crate) fn status(&self) -> EtendueStatus {
        refuse_null!(self.table);
        if map_of(self.map).is_none() {
            return EtendueStatus::Value;
        }
        if etendue_image_environment_table(self.width, self.height) == 0 {
            EtendueStatus::Count
        } else {
            EtendueStatus::Ok
        }
    }
}
/// A copy of an environment, if the library can look into it.
pub(crate) unsafe fn owned(environment: &EtendueImageEnvironment) -> Option<OwnedEnvironment> {
    let &EtendueImageEnvironment { table, width, height, map } = environment;
    if environment.status() != EtendueStatus::Ok {
        return None;
    }
    // SAFETY: the caller's table has the length for its size
    let table = unsafe { from_raw_parts(table, etendue_image_environment_table(width, height)) };
    OwnedEnvironment::from_table(table, width, map_of(map)?).ok()
}
const _: () = {
    assert!(size_of::<EtendueImageEnvironment>() == size_of::<ImageMemory<'_>>());
    assert!(offset_of!(EtendueImageEnvironment, map) == size_of::<ImageMemory<'_>>() - size_of::<usize>());
};

/// Number of floats in the table of an image; 0 for one without columns or rows, or with more than 2^24 of them.
#[unsafe(no_mangle)]
pub extern "C" fn etendue_image_environment_table(width: usize, height: usize) -> usize {
    let sizes = 1..=MOST;
    let floats = if sizes.contains(&width) && sizes.contains(&height) { (width + 1).checked_mul(height) } else { None };
    floats.unwrap_or(0)
}

/// Builds the table of an image, from a weight per steradian for each texel, row by row: its luminance, or a sum of its channels.
///
/// `weights` has width x height elements, `table` has [`etendue_image_environment_table`]; it must live as long as `environment` is used,
/// `weights` need not. `map` is one of EtendueEnvironmentMap. Returns ETENDUE_STATUS_COUNT for a size that is not allowed, and
/// ETENDUE_STATUS_VALUE for another `map`, if a weight is negative, infinite or NaN, and if all weights are 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_image_environment_build(
    weights: *const f32,
    width: usize,
    height: usize,
    map: u32,
    table: *mut f32,
    environment: *mut EtendueImageEnvironment,
) -> EtendueStatus {
    refuse_null!(weights, table, environment);
    let length = etendue_image_environment_table(width, height);
    if length == 0 {
        return EtendueStatus::Count;
    }
    let Some(known) = map_of(map) else { return EtendueStatus::Value };
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        let status = build_table(weights, width * height, table, length, |weights, table| {
            ImageEnvironment::build(weights, width, known, table).is_ok()
        });
        if status == EtendueStatus::Ok {
            environment.write(EtendueImageEnvironment { table, width, height, map });
        }
        status
    }
}
