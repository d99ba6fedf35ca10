//! Warps.

use crate::reflected::EtendueReflection;
use crate::{EtendueStatus, columns, outputs, refuse_null};
use core::mem::size_of;
use etendue::reflection::Reflection;
use etendue::warp::{self, *};
use etendue::{Vec2, Vec3};
use etendue_batch::{Batch, BatchWarp};

/// Three columns from N of them; a warp does not touch the others.
fn three<T: Copy, const N: usize>(columns: [T; N]) -> [T; 3] {
    core::array::from_fn(|i| columns[i.min(N - 1)])
}
fn two<T: Copy, const N: usize>(columns: [T; N]) -> Vec2<T> {
    Vec2::new(columns[0], columns[N - 1])
}
/// The functions of one warp, in a module of their own.
macro_rules! warp {
    ($(#[$doc:meta])* $warp:ident, $module:ident, $numbers:literal, $coordinates:literal) => {
        warp!(@ $(#[$doc])* $warp, $module, $numbers, $coordinates, (), &$warp);
    };
    ($(#[$doc:meta])* $warp:ident, $module:ident, $numbers:literal, $coordinates:literal, $struct:ident) => {
        warp!(@ $(#[$doc])* $warp<f32>, $module, $numbers, $coordinates, (warp: $struct), &*warp.cast());
    };
    (@ $(#[$doc:meta])* $type:ty, $module:ident, $numbers:literal, $coordinates:literal, ($($warp:ident: $struct:ident)?), $value:expr) => {
        #[doc = concat!("The functions of a warp: their names in C begin with `etendue_", stringify!($module), "_`.")]
        pub mod $module {
            use super::*;

            const _: () = assert!(<$type as BatchWarp>::NUMBERS == $numbers && <$type as BatchWarp>::COORDINATES == $coordinates);
            $(#[$doc])*
            ///
            /// Maps random numbers `u` to a point.
            #[unsafe(export_name = concat!("etendue_", stringify!($module), "_sample"))]
            pub unsafe extern "C" fn sample($($warp: *const $struct,)? u: *const f32, point: *mut f32) -> EtendueStatus {
                refuse_null!($($warp,)? u, point);
                // SAFETY: the pointers are not null, and point to what the header says
                unsafe { (Batch::new().one_warp::<$type>().sample)($value, u, point) };
                EtendueStatus::Ok
            }
            /// The pdf at a point, in the measure of the warp; 0 outside its range, and if a pointer is NULL.
            #[unsafe(export_name = concat!("etendue_", stringify!($module), "_pdf"))]
            pub unsafe extern "C" fn pdf($($warp: *const $struct,)? point: *const f32) -> f32 {
                let mut pdf = 0.0;
                if $(!$warp.is_null() &&)? !point.is_null() {
                    // SAFETY: the pointers are not null, and point to what the header says
                    unsafe { pdf = (Batch::new().one_warp::<$type>().pdf)($value, point) };
                }
                pdf
            }
            /// The random numbers that are mapped to a point; any in [0, 1)^2 outside the range of the warp.
            #[unsafe(export_name = concat!("etendue_", stringify!($module), "_invert"))]
            pub unsafe extern "C" fn invert($($warp: *const $struct,)? point: *const f32, u: *mut f32) -> EtendueStatus {
                refuse_null!($($warp,)? point, u);
                // SAFETY: the pointers are not null, and point to what the header says
                unsafe { (Batch::new().one_warp::<$type>().invert)($value, point, u) };
                EtendueStatus::Ok
            }
            /// A point for each u, in columns.
            #[unsafe(export_name = concat!("etendue_", stringify!($module), "_sample_batch"))]
            pub unsafe extern "C" fn sample_batch(
                $($warp: *const $struct,)? n: usize, u: *const *const f32, points: *const *mut f32,
            ) -> EtendueStatus {
                if n == 0 {
                    return EtendueStatus::Ok;
                }
                $(refuse_null!($warp);)?
                // SAFETY: the pointers are not null, and point to what the header says
                unsafe {
                    let (Some(u), Some(points)) = (columns::<$numbers>(u), outputs::<$coordinates>(points)) else {
                        return EtendueStatus::NullPointer;
                    };
                    (Batch::new().functions::<$type>().sample)($value, n, two(u), &three(points));
                }
                EtendueStatus::Ok
            }
            /// The pdf at each point, in columns.
            #[unsafe(export_name = concat!("etendue_", stringify!($module), "_pdf_batch"))]
            pub unsafe extern "C" fn pdf_batch(
                $($warp: *const $struct,)? n: usize, points: *const *const f32, out: *mut f32,
            ) -> EtendueStatus {
                if n == 0 {
                    return EtendueStatus::Ok;
                }
                refuse_null!($($warp,)? out);
                // SAFETY: the pointers are not null, and point to what the header says
                unsafe {
                    let Some(points) = columns::<$coordinates>(points) else { return EtendueStatus::NullPointer };
                    (Batch::new().functions::<$type>().pdf)($value, n, &three(points), out);
                }
                EtendueStatus::Ok
            }
            /// The random numbers of each point, in columns.
            #[unsafe(export_name = concat!("etendue_", stringify!($module), "_invert_batch"))]
            pub unsafe extern "C" fn invert_batch(
                $($warp: *const $struct,)? n: usize, points: *const *const f32, u: *const *mut f32,
            ) -> EtendueStatus {
                if n == 0 {
                    return EtendueStatus::Ok;
                }
                $(refuse_null!($warp);)?
                // SAFETY: the pointers are not null, and point to what the header says
                unsafe {
                    let (Some(points), Some(u)) = (columns::<$coordinates>(points), outputs::<$numbers>(u)) else {
                        return EtendueStatus::NullPointer;
                    };
                    (Batch::new().functions::<$type>().invert)($value, n, &three(points), two(u));
                }
                EtendueStatus::Ok
            }
        }
    };
}
macro_rules! warps {
    ($($(#[$doc:meta])* $warp:ident $([R] = $struct:ident)?, $module:ident: $numbers:literal -> $coordinates:literal;)+) => {
        $(warp!($(#[$doc])* $warp, $module, $numbers, $coordinates $(, $struct)?);)+
    };
}

/// The struct of a warp's parameters; the core's struct has the same fields.
macro_rules! parameters {
    ($(#[$doc:meta])* $name:ident = $type:ty { $($(#[$field_doc:meta])* $field:ident: $kind:ty,)+ }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        #[repr(C)]
        pub struct $name {
            $($(#[$field_doc])* pub $field: $kind,)+
        }
        const _: () = assert!(size_of::<$name>() == size_of::<$type>());
    };
}
parameters! {
    /// Directions within an angle of +z, uniform in solid angle.
    EtendueCone = warp::Cone<f32> {
        /// 1 - cos of the angle, in [0, 2].
        one_minus_cos: f32,
    }
}
parameters! {
    /// Points of the unit square with a pdf that is bilinear between four corner values.
    EtendueBilinear = warp::Bilinear<f32> {
        /// Relative densities at (0, 0), (1, 0), (0, 1) and (1, 1): at least 0, in any unit.
        corners: [f32; 4],
    }
}
parameters! {
    /// Visible normals of a GGX microsurface, prepared for a view; in the frame whose z axis is the normal of the surface.
    EtendueGgxVisibleNormals = warp::GgxVisibleNormals<f32> {
        /// What is inside does not concern callers.
        data: [f32; 12],
    }
}
parameters! {
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
parameters! {
    /// Numbers in [0, 1) with a pdf linear between two end values.
    EtendueLinear = warp::Linear<f32> {
        /// Relative density at 0: at least 0, in any unit.
        a: f32,
        /// Relative density at 1, in the unit of `a`.
        b: f32,
    }
}
parameters! {
    /// Numbers in [-r, r] with the pdf (r - |x|)/r^2.
    EtendueTent = warp::Tent<f32> {
        /// The radius r.
        radius: f32,
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
        let [x, y, z] = wi.cast::<[f32; 3]>().read_unaligned();
        out.cast::<warp::GgxVisibleNormals<f32>>().write(warp::GgxVisibleNormals::new(
            alpha_x,
            alpha_y,
            Vec3::new(x, y, z),
        ));
    }
    EtendueStatus::Ok
}
etendue::warps!(warps! {});
