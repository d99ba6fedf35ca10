//! Daylight: the sky by CIE's formula, and where the sun is.

use crate::{EtendueStatus, refuse_null, value, values};
use core::mem::{align_of, size_of};
use etendue::light::{GeneralSky, Moment, SunPosition};

/// The sky by CIE's standard general sky (ISO 15469:2004): how bright it is in each direction, relative to the zenith. z is up.
///
/// What is inside does not concern callers: it may be copied, and used by any thread. An image of it is sampled in proportion to it, see
/// EtendueImageEnvironment; the sun itself is an EtendueSun.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueGeneralSky {
    data: [f64; 9],
}
const _: () = assert!(
    size_of::<GeneralSky>() == size_of::<EtendueGeneralSky>()
        && align_of::<GeneralSky>() <= align_of::<EtendueGeneralSky>()
);

/// Prepares the sky of a type from 1 to 15 with the sun in the direction `sun`, three numbers of any length. 1 is overcast, 5 uniform, 12 clear,
/// 15 turbid with a wide corona. Returns ETENDUE_STATUS_VALUE for another type, and if there is no direction.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_general_sky_prepare(
    kind: u32,
    sun: *const f64,
    out: *mut EtendueGeneralSky,
) -> EtendueStatus {
    refuse_null!(sun, out);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        let Some(sky) = GeneralSky::new(kind, sun.cast::<[f64; 3]>().read_unaligned()) else {
            return EtendueStatus::Value;
        };
        out.cast::<GeneralSky>().write(sky);
    }
    EtendueStatus::Ok
}

/// The luminance in the unit direction `w` over that of the zenith; 0 below the horizon, where the direction is NaN, and if a pointer is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_general_sky_luminance(sky: *const EtendueGeneralSky, w: *const f32) -> f32 {
    if sky.is_null() || w.is_null() {
        return 0.0;
    }
    // SAFETY: the pointers are not null, and `etendue_general_sky_prepare` wrote the sky
    unsafe { value(&sky.cast::<GeneralSky>().read(), w) }
}

/// The luminance in each unit direction over that of the zenith: three columns.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_general_sky_luminance_batch(
    sky: *const EtendueGeneralSky,
    n: usize,
    w: *const *const f32,
    out: *mut f32,
) -> EtendueStatus {
    if n == 0 {
        return EtendueStatus::Ok;
    }
    refuse_null!(sky, out);
    // SAFETY: the pointers are not null, and `etendue_general_sky_prepare` wrote the sky
    unsafe { values(&sky.cast::<GeneralSky>().read(), n, w, out) }
}

/// Illuminance of the horizontal plane over the luminance of the zenith, in steradians, without the sun's disk: within 2e-5. A sum over 512 x
/// 1024 directions. 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_general_sky_horizontal(sky: *const EtendueGeneralSky) -> f64 {
    // SAFETY: the pointer is not null, and `etendue_general_sky_prepare` wrote the sky
    if sky.is_null() { 0.0 } else { unsafe { sky.cast::<GeneralSky>().read().horizontal() } }
}

/// A time, in the Gregorian calendar and universal time.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueMoment {
    /// The year.
    pub year: i32,
    /// The month, from 1.
    pub month: u32,
    /// The day of the month, from 1.
    pub day: u32,
    /// Hours since midnight; any number: -1 is 23 o'clock of the day before.
    pub hours: f64,
}

/// Where the sun stands as seen from a place, without refraction.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueSunPosition {
    /// Angle above the horizon in radians.
    pub elevation: f64,
    /// Angle from north over east in radians, in [0, 2π).
    pub azimuth: f64,
}

/// Where the sun stands at a time, as seen from a latitude (north is positive) and longitude (east is positive) in degrees: to 0.01 degrees from
/// 1950 to 2050 (Michalsky 1988). Returns ETENDUE_STATUS_VALUE if the calendar does not have the day, if the hours are not finite, the
/// latitude is not in [-90, 90], or the longitude not in [-180, 180].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_sun_position(
    time: *const EtendueMoment,
    latitude: f64,
    longitude: f64,
    out: *mut EtendueSunPosition,
) -> EtendueStatus {
    refuse_null!(time, out);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        let EtendueMoment { year, month, day, hours } = time.read();
        let position = SunPosition::new(Moment { year, month, day, hours }, latitude, longitude);
        let Some(SunPosition { elevation, azimuth }) = position else { return EtendueStatus::Value };
        out.write(EtendueSunPosition { elevation, azimuth });
    }
    EtendueStatus::Ok
}

/// The unit direction to the sun, three numbers: +x is east, +y north and +z up.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_sun_position_direction(
    position: *const EtendueSunPosition,
    direction: *mut f64,
) -> EtendueStatus {
    refuse_null!(position, direction);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        let EtendueSunPosition { elevation, azimuth } = position.read();
        direction.cast::<[f64; 3]>().write_unaligned(SunPosition { elevation, azimuth }.direction());
    }
    EtendueStatus::Ok
}
