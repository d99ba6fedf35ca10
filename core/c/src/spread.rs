//! Flat lights that emit within an angle of their normal.

use crate::light::EtendueParallelogram;
use crate::memory::{columns, each, map, refuse_null, skip_empty, vec3};
use crate::status::EtendueStatus;
use core::mem::size_of;
use etendue::light::{Parallelogram, Spread};

/// How a flat light emits within a cone about its normal, as through a honeycomb before it: the spread of Cycles. A host multiplies the
/// radiance of the light by the attenuation, which leaves its power as it is. A point sees only a disk of the plane of the light, which
/// the techniques by spread sample.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueSpread {
    /// The tangent of half the angle.
    pub tan_half: f32,
    /// 1/(tan_half - half the angle).
    pub gain: f32,
}
const _: () = assert!(size_of::<EtendueSpread>() == size_of::<Spread<f32>>());

/// Columns of spreads.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueSpreadColumns {
    /// The tangent of half the angle.
    pub tan_half: *const f32,
    /// 1/(tan_half - half the angle).
    pub gain: *const f32,
}

impl EtendueSpread {
    fn spread(self) -> Spread<f32> {
        Spread { tan_half: self.tan_half, gain: self.gain }
    }
}

/// Prepares a spread with this full angle in radians, which is taken to be from 1e-3 to pi. Returns ETENDUE_STATUS_VALUE if it is NaN.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_spread_prepare(angle: f64, out: *mut EtendueSpread) -> EtendueStatus {
    refuse_null!(out);
    if angle.is_nan() {
        return EtendueStatus::Value;
    }
    let Spread { tan_half, gain } = Spread::<f32>::new(angle);
    // SAFETY: the pointer is not null, and points to what the header says
    unsafe { out.write(EtendueSpread { tan_half, gain }) };
    EtendueStatus::Ok
}

/// The factor of the radiance in or against the unit direction `w` of a light with the unit normal `n`, on either side:
/// (tanσ - tanθ)/(tanσ - σ) at the angle θ < σ to the normal, with σ half of the spread; 0 beyond, and if a pointer is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_spread_attenuation(spread: *const EtendueSpread, w: *const f32, n: *const f32) -> f32 {
    let mut factor = 0.0;
    if !spread.is_null() && !w.is_null() && !n.is_null() {
        // SAFETY: the pointers are not null, and point to what the header says
        unsafe { attenuations(spread, 1, each(w), each(n), &mut factor) };
    }
    factor
}

/// The factor of the radiance for each unit direction and unit normal of a light: three columns each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_spread_attenuation_batch(
    spread: *const EtendueSpread,
    n: usize,
    w: *const *const f32,
    normals: *const *const f32,
    out: *mut f32,
) -> EtendueStatus {
    skip_empty!(n);
    refuse_null!(spread, out);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        let (Some(w), Some(normals)) = (columns(w), columns(normals)) else { return EtendueStatus::NullPointer };
        attenuations(spread, n, w, normals, out);
    }
    EtendueStatus::Ok
}

unsafe fn attenuations(
    spread: *const EtendueSpread,
    n: usize,
    [x, y, z]: [*const f32; 3],
    [nx, ny, nz]: [*const f32; 3],
    out: *mut f32,
) {
    // SAFETY: the caller's
    unsafe { map(spread.cast::<Spread<f32>>(), n, [x, y, z, nx, ny, nz], out) };
}

/// The part of a parallelogram with this spread that a point sees: the smallest parallelogram with edges along its own about what of its plane
/// is within the angle. It is without area where the point sees nothing, and the light itself where it sees all.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_parallelogram_visible_part(
    light: *const EtendueParallelogram,
    p: *const f32,
    spread: *const EtendueSpread,
    out: *mut EtendueParallelogram,
) -> EtendueStatus {
    refuse_null!(light, p, spread, out);
    // SAFETY: the pointers are not null, and point to what the header says; the structs of the light have the same fields
    unsafe {
        let p = vec3(p.cast::<[f32; 3]>().read_unaligned());
        let light = light.cast::<Parallelogram<f32>>().read();
        out.cast::<Parallelogram<f32>>().write(light.visible_part(p, &(*spread).spread()));
    }
    EtendueStatus::Ok
}
