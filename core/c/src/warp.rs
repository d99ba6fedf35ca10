//! Warps.

use crate::{EtendueStatus, columns, each, each_mut, outputs, refuse_null};
use core::mem::size_of;
use etendue::warp;
use etendue::{Vec2, Vec3};
use etendue_batch::{Batch, BatchWarp};

/// Three columns from N of them; a warp does not touch the others.
fn three<T: Copy, const N: usize>(columns: [T; N]) -> [T; 3] {
    core::array::from_fn(|i| columns[i.min(N - 1)])
}
fn two<T: Copy, const N: usize>(columns: [T; N]) -> Vec2<T> {
    Vec2::new(columns[0], columns[N - 1])
}

/// The functions of one warp: `$numbers` random numbers to `$coordinates` coordinates.
macro_rules! warp {
    ($(#[$doc:meta])* $type:ty, $numbers:literal -> $coordinates:literal, ($($warp:ident: $struct:ident)?), $value:expr,
     $sample:ident $pdf:ident $invert:ident $sample_batch:ident $pdf_batch:ident $invert_batch:ident) => {
        const _: () = assert!(<$type as BatchWarp>::NUMBERS == $numbers && <$type as BatchWarp>::COORDINATES == $coordinates);
        $(#[$doc])*
        ///
        /// Maps random numbers `u` to a point.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $sample($($warp: *const $struct,)? u: *const f32, point: *mut f32) -> EtendueStatus {
            refuse_null!($($warp,)? u, point);
            // SAFETY: the pointers are not null, and point to what the header says
            unsafe {
                let out = three(each_mut::<$coordinates>(point));
                (Batch::new().functions::<$type>().sample)($value, 1, two(each::<$numbers>(u)), &out);
            }
            EtendueStatus::Ok
        }
        /// The pdf at a point, in the measure of the warp; 0 outside its range, and if a pointer is NULL.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $pdf($($warp: *const $struct,)? point: *const f32) -> f32 {
            let mut pdf = 0.0;
            if $(!$warp.is_null() &&)? !point.is_null() {
                // SAFETY: the pointers are not null, and point to what the header says
                unsafe { (Batch::new().functions::<$type>().pdf)($value, 1, &three(each::<$coordinates>(point)), &mut pdf) };
            }
            pdf
        }
        /// The random numbers that are mapped to a point; any in [0, 1)^2 outside the range of the warp.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $invert($($warp: *const $struct,)? point: *const f32, u: *mut f32) -> EtendueStatus {
            refuse_null!($($warp,)? point, u);
            // SAFETY: the pointers are not null, and point to what the header says
            unsafe {
                let (point, u) = (three(each::<$coordinates>(point)), two(each_mut::<$numbers>(u)));
                (Batch::new().functions::<$type>().invert)($value, 1, &point, u);
            }
            EtendueStatus::Ok
        }
        /// A point for each u, in columns.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $sample_batch(
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
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $pdf_batch(
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
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $invert_batch(
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
    /// Points of a disk in space, uniform in area.
    EtendueDiskSurface = warp::DiskSurface<f32> {
        /// Centre.
        center: [f32; 3],
        /// Unit normal.
        normal: [f32; 3],
        /// Radius, in the unit of the coordinates.
        radius: f32,
    }
}
parameters! {
    /// Points of the side of a cylinder, uniform in area.
    EtendueCylinderSide = warp::CylinderSide<f32> {
        /// Centre of one end.
        p: [f32; 3],
        /// From there to the centre of the other end.
        axis: [f32; 3],
        /// Radius, in the unit of the coordinates.
        radius: f32,
    }
}
parameters! {
    /// Points of a sphere, uniform in area.
    EtendueSphereSurface = warp::SphereSurface<f32> {
        /// Centre.
        center: [f32; 3],
        /// Radius, in the unit of the coordinates.
        radius: f32,
    }
}
parameters! {
    /// Points of a bilinear patch, nearly uniform in area.
    EtenduePatchSurface = warp::PatchSurface<f32> {
        /// Corner.
        p: [f32; 3],
        /// From there to the next corner, s = 1.
        u: [f32; 3],
        /// From there to the other next corner, t = 1.
        v: [f32; 3],
        /// From there to the opposite corner.
        w: [f32; 3],
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
warp!(
    /// Points of the unit disk, uniform in area (pdf 1/pi), by concentric squares: keeps strata compact.
    warp::ConcentricDisk, 2 -> 2, (), &warp::ConcentricDisk,
    etendue_concentric_disk_sample etendue_concentric_disk_pdf etendue_concentric_disk_invert etendue_concentric_disk_sample_batch etendue_concentric_disk_pdf_batch etendue_concentric_disk_invert_batch
);
warp!(
    /// Points of the unit disk, uniform in area (pdf 1/pi), by radius and angle.
    warp::PolarDisk, 2 -> 2, (), &warp::PolarDisk,
    etendue_polar_disk_sample etendue_polar_disk_pdf etendue_polar_disk_invert etendue_polar_disk_sample_batch etendue_polar_disk_pdf_batch etendue_polar_disk_invert_batch
);
warp!(
    /// Directions with z >= 0, uniform in solid angle: pdf 1/(2 pi) per steradian.
    warp::UniformHemisphere, 2 -> 3, (), &warp::UniformHemisphere,
    etendue_uniform_hemisphere_sample etendue_uniform_hemisphere_pdf etendue_uniform_hemisphere_invert etendue_uniform_hemisphere_sample_batch etendue_uniform_hemisphere_pdf_batch etendue_uniform_hemisphere_invert_batch
);
warp!(
    /// Directions, uniform in solid angle: pdf 1/(4 pi) per steradian.
    warp::UniformSphere, 2 -> 3, (), &warp::UniformSphere,
    etendue_uniform_sphere_sample etendue_uniform_sphere_pdf etendue_uniform_sphere_invert etendue_uniform_sphere_sample_batch etendue_uniform_sphere_pdf_batch etendue_uniform_sphere_invert_batch
);
warp!(
    /// Directions with z >= 0 and the pdf z/pi per steradian.
    warp::CosineHemisphere, 2 -> 3, (), &warp::CosineHemisphere,
    etendue_cosine_hemisphere_sample etendue_cosine_hemisphere_pdf etendue_cosine_hemisphere_invert etendue_cosine_hemisphere_sample_batch etendue_cosine_hemisphere_pdf_batch etendue_cosine_hemisphere_invert_batch
);
warp!(
    /// Directions, uniform in solid angle, by a nearly continuous map: pdf 1/(4 pi) per steradian.
    warp::Octahedral, 2 -> 3, (), &warp::Octahedral,
    etendue_octahedral_sample etendue_octahedral_pdf etendue_octahedral_invert etendue_octahedral_sample_batch etendue_octahedral_pdf_batch etendue_octahedral_invert_batch
);
warp!(
    /// Barycentric coordinates of the second and third vertex of a triangle, uniform in area: pdf 2.
    warp::AreaTriangle, 2 -> 2, (), &warp::AreaTriangle,
    etendue_area_triangle_sample etendue_area_triangle_pdf etendue_area_triangle_invert etendue_area_triangle_sample_batch etendue_area_triangle_pdf_batch etendue_area_triangle_invert_batch
);
warp!(
    /// The same by a map that keeps strata compact: pdf 2.
    warp::LowDistortionTriangle, 2 -> 2, (), &warp::LowDistortionTriangle,
    etendue_low_distortion_triangle_sample etendue_low_distortion_triangle_pdf etendue_low_distortion_triangle_invert etendue_low_distortion_triangle_sample_batch etendue_low_distortion_triangle_pdf_batch etendue_low_distortion_triangle_invert_batch
);
warp!(
    /// Directions of a cone: pdf 1/(2 pi one_minus_cos) per steradian.
    warp::Cone<f32>, 2 -> 3, (warp: EtendueCone), &*warp.cast(),
    etendue_cone_sample etendue_cone_pdf etendue_cone_invert etendue_cone_sample_batch etendue_cone_pdf_batch etendue_cone_invert_batch
);
warp!(
    /// Points of the unit square, bilinear.
    warp::Bilinear<f32>, 2 -> 2, (warp: EtendueBilinear), &*warp.cast(),
    etendue_bilinear_sample etendue_bilinear_pdf etendue_bilinear_invert etendue_bilinear_sample_batch etendue_bilinear_pdf_batch etendue_bilinear_invert_batch
);
warp!(
    /// Visible normals of a GGX microsurface, per steradian.
    warp::GgxVisibleNormals<f32>, 2 -> 3, (warp: EtendueGgxVisibleNormals), &*warp.cast(),
    etendue_ggx_visible_normals_sample etendue_ggx_visible_normals_pdf etendue_ggx_visible_normals_invert etendue_ggx_visible_normals_sample_batch etendue_ggx_visible_normals_pdf_batch etendue_ggx_visible_normals_invert_batch
);
warp!(
    /// Points of a disk in space: pdf 1/(pi radius^2) per unit area.
    warp::DiskSurface<f32>, 2 -> 3, (warp: EtendueDiskSurface), &*warp.cast(),
    etendue_disk_surface_sample etendue_disk_surface_pdf etendue_disk_surface_invert etendue_disk_surface_sample_batch etendue_disk_surface_pdf_batch etendue_disk_surface_invert_batch
);
warp!(
    /// Points of the side of a cylinder: pdf 1/area.
    warp::CylinderSide<f32>, 2 -> 3, (warp: EtendueCylinderSide), &*warp.cast(),
    etendue_cylinder_side_sample etendue_cylinder_side_pdf etendue_cylinder_side_invert etendue_cylinder_side_sample_batch etendue_cylinder_side_pdf_batch etendue_cylinder_side_invert_batch
);
warp!(
    /// Points of a sphere: pdf 1/(4 pi radius^2) per unit area.
    warp::SphereSurface<f32>, 2 -> 3, (warp: EtendueSphereSurface), &*warp.cast(),
    etendue_sphere_surface_sample etendue_sphere_surface_pdf etendue_sphere_surface_invert etendue_sphere_surface_sample_batch etendue_sphere_surface_pdf_batch etendue_sphere_surface_invert_batch
);
warp!(
    /// Points of a bilinear patch: pdf nearly 1/area.
    warp::PatchSurface<f32>, 2 -> 3, (warp: EtenduePatchSurface), &*warp.cast(),
    etendue_patch_surface_sample etendue_patch_surface_pdf etendue_patch_surface_invert etendue_patch_surface_sample_batch etendue_patch_surface_pdf_batch etendue_patch_surface_invert_batch
);
warp!(
    /// Numbers in [0, 1), linear. `u` and `point` are one number each.
    warp::Linear<f32>, 1 -> 1, (warp: EtendueLinear), &*warp.cast(),
    etendue_linear_sample etendue_linear_pdf etendue_linear_invert etendue_linear_sample_batch etendue_linear_pdf_batch etendue_linear_invert_batch
);
warp!(
    /// Numbers in [-r, r], a tent. `u` and `point` are one number each.
    warp::Tent<f32>, 1 -> 1, (warp: EtendueTent), &*warp.cast(),
    etendue_tent_sample etendue_tent_pdf etendue_tent_invert etendue_tent_sample_batch etendue_tent_pdf_batch etendue_tent_invert_batch
);
