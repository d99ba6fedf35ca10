//! Warps, and the functions of all of them, which are given by their numbers.

use crate::memory::{refuse_null, refuse_outside, skip_empty, vec3};
use crate::status::EtendueStatus;
use core::ffi::c_void;
use core::mem::size_of;
use core::ptr::{NonNull, null};
use etendue::Vec2;
use etendue::listed::warp::{ENTRIES, ListedWarp};
use etendue::reflection::Reflection;
use etendue::warp::{self, *};
use etendue_batch::{Batch, WarpFunctions};

/// The number of each warp.
macro_rules! warps {
    ($($(#[$doc:meta])* $warp:ident $([$r:tt] = $struct:ident)?, $module:ident: $coordinates:literal;)+) => {
        /// A map of two random numbers to points. The comments say how many coordinates there are, if not three.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(C)]
        pub enum EtendueWarp {
            $($(#[$doc])* $warp,)+
        }
        const _: () = {
            $(assert!(EtendueWarp::$warp as usize == <warps!(@ $warp $([$r])?) as ListedWarp>::ENTRY.index);)+
        };
    };
    (@ $warp:ident) => { $warp };
    (@ $warp:ident [$r:tt]) => { $warp<f32> };
}
etendue::warps!(warps! {});

/// The struct of a warp's parameters; the core's struct has the same fields.
macro_rules! parameters {
    ($($(#[$doc:meta])* $name:ident = $type:ty { $($(#[$field_doc:meta])* $field:ident: $kind:ty,)+ })+) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        #[repr(C)]
        pub struct $name {
            $($(#[$field_doc])* pub $field: $kind,)+
        }
        const _: () = assert!(size_of::<$name>() == size_of::<$type>());
    )+};
}
parameters! {
    /// Directions within an angle of +z, uniform in solid angle.
    EtendueCone = warp::Cone<f32> {
        /// 1 - cos of the angle, in [0, 2].
        one_minus_cos: f32,
    }
    /// Points of the unit square with a pdf that is bilinear between four corner values.
    EtendueBilinear = warp::Bilinear<f32> {
        /// Relative densities at (0, 0), (1, 0), (0, 1) and (1, 1): at least 0, in any unit.
        corners: [f32; 4],
    }
    /// Visible normals of a GGX microsurface, prepared for a view; in the frame whose z axis is the normal of the surface.
    EtendueGgxVisibleNormals = warp::GgxVisibleNormals<f32> {
        /// What is inside does not concern callers.
        data: [f32; 12],
    }
    /// Points of a bilinear patch, nearly uniform in area.
    EtenduePatchSurface = warp::PatchSurface<f32> {
        /// Corner.
        corner: [f32; 3],
        /// From there to the next corner, s = 1.
        edge_s: [f32; 3],
        /// From there to the other next corner, t = 1.
        edge_t: [f32; 3],
        /// From there to the opposite corner.
        diagonal: [f32; 3],
    }
}

/// Prepares the visible normals of a GGX microsurface: the roughnesses along x and y, and the unit direction to the viewer in the frame
/// whose z axis is the normal.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_ggx_visible_normals_prepare(
    alpha_x: f32,
    alpha_y: f32,
    wi: *const f32,
    out: *mut EtendueGgxVisibleNormals,
) -> EtendueStatus {
    refuse_null!(wi, out);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        let wi = vec3(wi.cast::<[f32; 3]>().read_unaligned());
        out.cast::<warp::GgxVisibleNormals<f32>>().write(warp::GgxVisibleNormals::new(alpha_x, alpha_y, wi));
    }
    EtendueStatus::Ok
}

/// The parameters of a warp; of one that has none, a pointer that is not null. None if there is no such warp, or it lacks its parameters.
fn checked(warp: u32, parameters: *const c_void) -> Result<*const c_void, EtendueStatus> {
    match ENTRIES.get(warp as usize).map(|entry| entry.numbers > 0) {
        None => Err(EtendueStatus::Value),
        Some(false) => Ok(NonNull::<f32>::dangling().as_ptr().cast()),
        Some(true) if parameters.is_null() => Err(EtendueStatus::NullPointer),
        Some(true) => Ok(parameters),
    }
}
/// A status unless the parameters are there.
macro_rules! given {
    ($warp:ident, $parameters:ident) => {
        match checked($warp, $parameters) {
            Ok(parameters) => parameters,
            Err(status) => return status,
        }
    };
}

/// Maps random numbers `u` to a point. `parameters` is the struct of the warp, or NULL if it has none. Returns ETENDUE_STATUS_VALUE for a warp that is
/// none, and for a number that is not in [0, 1).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_warp_sample(
    warp: u32,
    parameters: *const c_void,
    u: *const f32,
    point: *mut f32,
) -> EtendueStatus {
    refuse_null!(u, point);
    let parameters = given!(warp, parameters);
    refuse_outside!(u, 2);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe { (Batch::new().warp_of_one(warp as usize).one_sample)(parameters, u, point) };
    EtendueStatus::Ok
}
/// The pdf at a point, in the measure of the warp; 0 outside its range, and where the function cannot work.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_warp_pdf(warp: u32, parameters: *const c_void, point: *const f32) -> f32 {
    match checked(warp, parameters) {
        // SAFETY: the pointers are not null, and point to what the header says
        Ok(parameters) if !point.is_null() => unsafe {
            (Batch::new().warp_of_one(warp as usize).one_pdf)(parameters, point)
        },
        _ => 0.0,
    }
}
/// The random numbers that are mapped to a point; any in [0, 1)^2 outside the range of the warp.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_warp_invert(
    warp: u32,
    parameters: *const c_void,
    point: *const f32,
    u: *mut f32,
) -> EtendueStatus {
    refuse_null!(point, u);
    let parameters = given!(warp, parameters);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe { (Batch::new().warp_of_one(warp as usize).one_invert)(parameters, point, u) };
    EtendueStatus::Ok
}

/// Columns of points or random numbers, of which all `count` must be there if `needed`; the others repeat the last one, and are not touched.
unsafe fn few<const N: usize>(columns: *const *const f32, count: usize, needed: bool) -> Option<[*const f32; N]> {
    if columns.is_null() {
        return None;
    }
    let mut all = [null(); N];
    for (i, column) in all.iter_mut().enumerate() {
        // SAFETY: the caller's array has `count` pointers
        *column = unsafe { columns.add(i.min(count - 1)).read_unaligned() };
        if needed && column.is_null() {
            return None;
        }
    }
    Some(all)
}
fn outputs<const N: usize>(columns: [*const f32; N]) -> [*mut f32; N] {
    columns.map(<*const f32>::cast_mut)
}

/// A point for each u, in columns: as many as the warp has coordinates.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_warp_sample_batch(
    warp: u32,
    parameters: *const c_void,
    n: usize,
    u: *const *const f32,
    points: *const *mut f32,
) -> EtendueStatus {
    skip_empty!(n);
    let parameters = given!(warp, parameters);
    let WarpFunctions { sample, coordinates, .. } = *Batch::new().warp_functions(warp as usize);
    // SAFETY: the pointers are null, or point to what the header says
    unsafe {
        let (Some([x, y]), Some(points)) = (few(u, 2, true), few(points.cast(), coordinates, false)) else {
            return EtendueStatus::NullPointer;
        };
        sample(parameters, n, Vec2::new(x, y), &outputs(points));
    }
    EtendueStatus::Ok
}
/// The pdf at each point, in columns.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_warp_pdf_batch(
    warp: u32,
    parameters: *const c_void,
    n: usize,
    points: *const *const f32,
    out: *mut f32,
) -> EtendueStatus {
    skip_empty!(n);
    refuse_null!(out);
    let parameters = given!(warp, parameters);
    let WarpFunctions { pdf, coordinates, .. } = *Batch::new().warp_functions(warp as usize);
    // SAFETY: the pointers are null, or point to what the header says
    unsafe {
        let Some(points) = few(points, coordinates, true) else { return EtendueStatus::NullPointer };
        pdf(parameters, n, &points, out);
    }
    EtendueStatus::Ok
}
/// The random numbers of each point, in columns.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_warp_invert_batch(
    warp: u32,
    parameters: *const c_void,
    n: usize,
    points: *const *const f32,
    u: *const *mut f32,
) -> EtendueStatus {
    skip_empty!(n);
    let parameters = given!(warp, parameters);
    let WarpFunctions { invert, coordinates, .. } = *Batch::new().warp_functions(warp as usize);
    // SAFETY: the pointers are null, or point to what the header says
    unsafe {
        let (Some(points), Some(u)) = (few(points, coordinates, true), few(u.cast(), 2, false)) else {
            return EtendueStatus::NullPointer;
        };
        let [x, y] = outputs(u);
        invert(parameters, n, &points, Vec2::new(x, y));
    }
    EtendueStatus::Ok
}
