//! The C interface, called with any counts, addresses, null pointers and numbers.

// an element is the same place in several columns
#![allow(clippy::needless_range_loop)]

use etendue_c::*;
use std::ptr::{null, null_mut};

/// Numbers of the largest light and of the largest sampler.
const LIGHT: usize = 24;
const SAMPLER: usize = 1100;
/// Columns of a sample: eleven of numbers and one of bytes.
const FIELDS: usize = 12;
const COUNTS: [usize; 7] = [0, 1, 7, 15, 16, 17, 100];
/// Bytes between columns, and what they hold.
const GAP: usize = 16;
const CANARY: u8 = 0xA5;

type Column = *const f32;
type Output = *mut f32;

/// The functions of a technique, with every struct as numbers or pointers in a row.
struct Technique {
    light: usize,
    sampler: usize,
    on_surface: bool,
    prepare: unsafe fn(Column, Column, Column, Output) -> EtendueStatus,
    sample: unsafe fn(Column, Column, *mut EtendueLightSample) -> EtendueStatus,
    pdf: unsafe fn(Column, Column) -> f32,
    invert: unsafe fn(Column, Column, Output) -> EtendueStatus,
    hit: unsafe fn(Column, Column, *mut EtendueLightSample) -> EtendueStatus,
    once: unsafe fn(Column, Column, Column, Column, *mut EtendueLightSample) -> EtendueStatus,
    sample_batch: unsafe fn(Column, usize, *const Column, *const EtendueSampleColumns) -> EtendueStatus,
    pdf_batch: unsafe fn(Column, usize, *const Column, Output) -> EtendueStatus,
    invert_batch: unsafe fn(Column, usize, *const Column, *const Output) -> EtendueStatus,
    hit_batch: unsafe fn(Column, usize, *const Column, *const EtendueSampleColumns) -> EtendueStatus,
    each: unsafe fn(
        *const Column,
        usize,
        *const Column,
        *const Column,
        *const Column,
        *const EtendueSampleColumns,
    ) -> EtendueStatus,
}

macro_rules! techniques {
    ($($sampler:ident $light:ident $place:ident $prepare:ident $sample:ident $pdf:ident $invert:ident $hit:ident $once:ident
       $sample_batch:ident $pdf_batch:ident $invert_batch:ident $hit_batch:ident $each:ident;)+) => {
        const TECHNIQUES: &[Technique] = &[$(
            // SAFETY of all: the caller's pointers are those that the functions demand
            Technique {
                light: size_of::<$light>() / 4,
                sampler: size_of::<$sampler>() / 4,
                on_surface: techniques!(@ $place, false, true),
                prepare: |light, p, n, out| unsafe {
                    let _ = n;
                    techniques!(@ $place, $prepare(light.cast(), p, out.cast()), $prepare(light.cast(), p, n, out.cast()))
                },
                sample: |s, u, out| unsafe { $sample(s.cast(), u, out) },
                pdf: |s, w| unsafe { $pdf(s.cast(), w) },
                invert: |s, w, u| unsafe { $invert(s.cast(), w, u) },
                hit: |s, w, out| unsafe { $hit(s.cast(), w, out) },
                once: |light, p, n, u, out| unsafe {
                    let _ = n;
                    techniques!(@ $place, $once(light.cast(), p, u, out), $once(light.cast(), p, n, u, out))
                },
                sample_batch: |s, n, u, out| unsafe { $sample_batch(s.cast(), n, u, out) },
                pdf_batch: |s, n, w, out| unsafe { $pdf_batch(s.cast(), n, w, out) },
                invert_batch: |s, n, w, u| unsafe { $invert_batch(s.cast(), n, w, u) },
                hit_batch: |s, n, w, out| unsafe { $hit_batch(s.cast(), n, w, out) },
                each: |lights, n, p, normals, u, out| unsafe {
                    let _ = normals;
                    techniques!(@ $place, $each(lights.cast(), n, p, u, out), $each(lights.cast(), n, p, normals, u, out))
                },
            },
        )+];
    };
    (@ anywhere, $anywhere:expr, $on_surface:expr) => { $anywhere };
    (@ on_surface, $anywhere:expr, $on_surface:expr) => { $on_surface };
}
#[rustfmt::skip]
techniques! {
    EtendueSphereByArea EtendueSphere anywhere etendue_sphere_by_area_prepare etendue_sphere_by_area_sample etendue_sphere_by_area_pdf etendue_sphere_by_area_invert etendue_sphere_by_area_hit etendue_sphere_by_area_sample_once etendue_sphere_by_area_sample_batch etendue_sphere_by_area_pdf_batch etendue_sphere_by_area_invert_batch etendue_sphere_by_area_hit_batch etendue_sphere_by_area_sample_each;
    EtendueSphereBySolidAngle EtendueSphere anywhere etendue_sphere_by_solid_angle_prepare etendue_sphere_by_solid_angle_sample etendue_sphere_by_solid_angle_pdf etendue_sphere_by_solid_angle_invert etendue_sphere_by_solid_angle_hit etendue_sphere_by_solid_angle_sample_once etendue_sphere_by_solid_angle_sample_batch etendue_sphere_by_solid_angle_pdf_batch etendue_sphere_by_solid_angle_invert_batch etendue_sphere_by_solid_angle_hit_batch etendue_sphere_by_solid_angle_sample_each;
    EtendueSphereByProjectedSolidAngle EtendueSphere on_surface etendue_sphere_by_projected_solid_angle_prepare etendue_sphere_by_projected_solid_angle_sample etendue_sphere_by_projected_solid_angle_pdf etendue_sphere_by_projected_solid_angle_invert etendue_sphere_by_projected_solid_angle_hit etendue_sphere_by_projected_solid_angle_sample_once etendue_sphere_by_projected_solid_angle_sample_batch etendue_sphere_by_projected_solid_angle_pdf_batch etendue_sphere_by_projected_solid_angle_invert_batch etendue_sphere_by_projected_solid_angle_hit_batch etendue_sphere_by_projected_solid_angle_sample_each;
    EtendueTriangleByArea EtendueTriangle anywhere etendue_triangle_by_area_prepare etendue_triangle_by_area_sample etendue_triangle_by_area_pdf etendue_triangle_by_area_invert etendue_triangle_by_area_hit etendue_triangle_by_area_sample_once etendue_triangle_by_area_sample_batch etendue_triangle_by_area_pdf_batch etendue_triangle_by_area_invert_batch etendue_triangle_by_area_hit_batch etendue_triangle_by_area_sample_each;
    EtendueTriangleBySolidAngle EtendueTriangle anywhere etendue_triangle_by_solid_angle_prepare etendue_triangle_by_solid_angle_sample etendue_triangle_by_solid_angle_pdf etendue_triangle_by_solid_angle_invert etendue_triangle_by_solid_angle_hit etendue_triangle_by_solid_angle_sample_once etendue_triangle_by_solid_angle_sample_batch etendue_triangle_by_solid_angle_pdf_batch etendue_triangle_by_solid_angle_invert_batch etendue_triangle_by_solid_angle_hit_batch etendue_triangle_by_solid_angle_sample_each;
    EtendueTriangleByProjectedSolidAngle EtendueTriangle on_surface etendue_triangle_by_projected_solid_angle_prepare etendue_triangle_by_projected_solid_angle_sample etendue_triangle_by_projected_solid_angle_pdf etendue_triangle_by_projected_solid_angle_invert etendue_triangle_by_projected_solid_angle_hit etendue_triangle_by_projected_solid_angle_sample_once etendue_triangle_by_projected_solid_angle_sample_batch etendue_triangle_by_projected_solid_angle_pdf_batch etendue_triangle_by_projected_solid_angle_invert_batch etendue_triangle_by_projected_solid_angle_hit_batch etendue_triangle_by_projected_solid_angle_sample_each;
    EtendueTriangleByCosineWarp EtendueTriangle on_surface etendue_triangle_by_cosine_warp_prepare etendue_triangle_by_cosine_warp_sample etendue_triangle_by_cosine_warp_pdf etendue_triangle_by_cosine_warp_invert etendue_triangle_by_cosine_warp_hit etendue_triangle_by_cosine_warp_sample_once etendue_triangle_by_cosine_warp_sample_batch etendue_triangle_by_cosine_warp_pdf_batch etendue_triangle_by_cosine_warp_invert_batch etendue_triangle_by_cosine_warp_hit_batch etendue_triangle_by_cosine_warp_sample_each;
    EtendueParallelogramByArea EtendueParallelogram anywhere etendue_parallelogram_by_area_prepare etendue_parallelogram_by_area_sample etendue_parallelogram_by_area_pdf etendue_parallelogram_by_area_invert etendue_parallelogram_by_area_hit etendue_parallelogram_by_area_sample_once etendue_parallelogram_by_area_sample_batch etendue_parallelogram_by_area_pdf_batch etendue_parallelogram_by_area_invert_batch etendue_parallelogram_by_area_hit_batch etendue_parallelogram_by_area_sample_each;
    EtendueParallelogramBySolidAngle EtendueParallelogram anywhere etendue_parallelogram_by_solid_angle_prepare etendue_parallelogram_by_solid_angle_sample etendue_parallelogram_by_solid_angle_pdf etendue_parallelogram_by_solid_angle_invert etendue_parallelogram_by_solid_angle_hit etendue_parallelogram_by_solid_angle_sample_once etendue_parallelogram_by_solid_angle_sample_batch etendue_parallelogram_by_solid_angle_pdf_batch etendue_parallelogram_by_solid_angle_invert_batch etendue_parallelogram_by_solid_angle_hit_batch etendue_parallelogram_by_solid_angle_sample_each;
    EtendueParallelogramByProjectedSolidAngle EtendueParallelogram on_surface etendue_parallelogram_by_projected_solid_angle_prepare etendue_parallelogram_by_projected_solid_angle_sample etendue_parallelogram_by_projected_solid_angle_pdf etendue_parallelogram_by_projected_solid_angle_invert etendue_parallelogram_by_projected_solid_angle_hit etendue_parallelogram_by_projected_solid_angle_sample_once etendue_parallelogram_by_projected_solid_angle_sample_batch etendue_parallelogram_by_projected_solid_angle_pdf_batch etendue_parallelogram_by_projected_solid_angle_invert_batch etendue_parallelogram_by_projected_solid_angle_hit_batch etendue_parallelogram_by_projected_solid_angle_sample_each;
    EtendueRectangleBySolidAngle EtendueRectangle anywhere etendue_rectangle_by_solid_angle_prepare etendue_rectangle_by_solid_angle_sample etendue_rectangle_by_solid_angle_pdf etendue_rectangle_by_solid_angle_invert etendue_rectangle_by_solid_angle_hit etendue_rectangle_by_solid_angle_sample_once etendue_rectangle_by_solid_angle_sample_batch etendue_rectangle_by_solid_angle_pdf_batch etendue_rectangle_by_solid_angle_invert_batch etendue_rectangle_by_solid_angle_hit_batch etendue_rectangle_by_solid_angle_sample_each;
    EtendueRectangleByCosineWarp EtendueRectangle on_surface etendue_rectangle_by_cosine_warp_prepare etendue_rectangle_by_cosine_warp_sample etendue_rectangle_by_cosine_warp_pdf etendue_rectangle_by_cosine_warp_invert etendue_rectangle_by_cosine_warp_hit etendue_rectangle_by_cosine_warp_sample_once etendue_rectangle_by_cosine_warp_sample_batch etendue_rectangle_by_cosine_warp_pdf_batch etendue_rectangle_by_cosine_warp_invert_batch etendue_rectangle_by_cosine_warp_hit_batch etendue_rectangle_by_cosine_warp_sample_each;
    EtendueDiskByArea EtendueDisk anywhere etendue_disk_by_area_prepare etendue_disk_by_area_sample etendue_disk_by_area_pdf etendue_disk_by_area_invert etendue_disk_by_area_hit etendue_disk_by_area_sample_once etendue_disk_by_area_sample_batch etendue_disk_by_area_pdf_batch etendue_disk_by_area_invert_batch etendue_disk_by_area_hit_batch etendue_disk_by_area_sample_each;
    EtendueDiskBySolidAngle EtendueDisk anywhere etendue_disk_by_solid_angle_prepare etendue_disk_by_solid_angle_sample etendue_disk_by_solid_angle_pdf etendue_disk_by_solid_angle_invert etendue_disk_by_solid_angle_hit etendue_disk_by_solid_angle_sample_once etendue_disk_by_solid_angle_sample_batch etendue_disk_by_solid_angle_pdf_batch etendue_disk_by_solid_angle_invert_batch etendue_disk_by_solid_angle_hit_batch etendue_disk_by_solid_angle_sample_each;
    EtendueCylinderByArea EtendueCylinder anywhere etendue_cylinder_by_area_prepare etendue_cylinder_by_area_sample etendue_cylinder_by_area_pdf etendue_cylinder_by_area_invert etendue_cylinder_by_area_hit etendue_cylinder_by_area_sample_once etendue_cylinder_by_area_sample_batch etendue_cylinder_by_area_pdf_batch etendue_cylinder_by_area_invert_batch etendue_cylinder_by_area_hit_batch etendue_cylinder_by_area_sample_each;
    EtenduePatchByArea EtendueBilinearPatch anywhere etendue_patch_by_area_prepare etendue_patch_by_area_sample etendue_patch_by_area_pdf etendue_patch_by_area_invert etendue_patch_by_area_hit etendue_patch_by_area_sample_once etendue_patch_by_area_sample_batch etendue_patch_by_area_pdf_batch etendue_patch_by_area_invert_batch etendue_patch_by_area_hit_batch etendue_patch_by_area_sample_each;
    EtenduePolygonByArea EtenduePolygon anywhere etendue_polygon_by_area_prepare etendue_polygon_by_area_sample etendue_polygon_by_area_pdf etendue_polygon_by_area_invert etendue_polygon_by_area_hit etendue_polygon_by_area_sample_once etendue_polygon_by_area_sample_batch etendue_polygon_by_area_pdf_batch etendue_polygon_by_area_invert_batch etendue_polygon_by_area_hit_batch etendue_polygon_by_area_sample_each;
    EtenduePolygonBySolidAngle EtenduePolygon anywhere etendue_polygon_by_solid_angle_prepare etendue_polygon_by_solid_angle_sample etendue_polygon_by_solid_angle_pdf etendue_polygon_by_solid_angle_invert etendue_polygon_by_solid_angle_hit etendue_polygon_by_solid_angle_sample_once etendue_polygon_by_solid_angle_sample_batch etendue_polygon_by_solid_angle_pdf_batch etendue_polygon_by_solid_angle_invert_batch etendue_polygon_by_solid_angle_hit_batch etendue_polygon_by_solid_angle_sample_each;
    EtenduePolygonByProjectedSolidAngle EtenduePolygon on_surface etendue_polygon_by_projected_solid_angle_prepare etendue_polygon_by_projected_solid_angle_sample etendue_polygon_by_projected_solid_angle_pdf etendue_polygon_by_projected_solid_angle_invert etendue_polygon_by_projected_solid_angle_hit etendue_polygon_by_projected_solid_angle_sample_once etendue_polygon_by_projected_solid_angle_sample_batch etendue_polygon_by_projected_solid_angle_pdf_batch etendue_polygon_by_projected_solid_angle_invert_batch etendue_polygon_by_projected_solid_angle_hit_batch etendue_polygon_by_projected_solid_angle_sample_each;
    EtendueLineByLength EtendueLine anywhere etendue_line_by_length_prepare etendue_line_by_length_sample etendue_line_by_length_pdf etendue_line_by_length_invert etendue_line_by_length_hit etendue_line_by_length_sample_once etendue_line_by_length_sample_batch etendue_line_by_length_pdf_batch etendue_line_by_length_invert_batch etendue_line_by_length_hit_batch etendue_line_by_length_sample_each;
    EtendueLineByAngle EtendueLine anywhere etendue_line_by_angle_prepare etendue_line_by_angle_sample etendue_line_by_angle_pdf etendue_line_by_angle_invert etendue_line_by_angle_hit etendue_line_by_angle_sample_once etendue_line_by_angle_sample_batch etendue_line_by_angle_pdf_batch etendue_line_by_angle_invert_batch etendue_line_by_angle_hit_batch etendue_line_by_angle_sample_each;
    EtendueLineByProjectedSolidAngle EtendueLine on_surface etendue_line_by_projected_solid_angle_prepare etendue_line_by_projected_solid_angle_sample etendue_line_by_projected_solid_angle_pdf etendue_line_by_projected_solid_angle_invert etendue_line_by_projected_solid_angle_hit etendue_line_by_projected_solid_angle_sample_once etendue_line_by_projected_solid_angle_sample_batch etendue_line_by_projected_solid_angle_pdf_batch etendue_line_by_projected_solid_angle_invert_batch etendue_line_by_projected_solid_angle_hit_batch etendue_line_by_projected_solid_angle_sample_each;
    EtendueSunBySolidAngle EtendueSun anywhere etendue_sun_by_solid_angle_prepare etendue_sun_by_solid_angle_sample etendue_sun_by_solid_angle_pdf etendue_sun_by_solid_angle_invert etendue_sun_by_solid_angle_hit etendue_sun_by_solid_angle_sample_once etendue_sun_by_solid_angle_sample_batch etendue_sun_by_solid_angle_pdf_batch etendue_sun_by_solid_angle_invert_batch etendue_sun_by_solid_angle_hit_batch etendue_sun_by_solid_angle_sample_each;
}

/// The functions of a warp, with its parameters as numbers in a row, if it has any.
struct Warp {
    parameters: usize,
    numbers: usize,
    coordinates: usize,
    sample: unsafe fn(Column, Column, Output) -> EtendueStatus,
    pdf: unsafe fn(Column, Column) -> f32,
    invert: unsafe fn(Column, Column, Output) -> EtendueStatus,
    sample_batch: unsafe fn(Column, usize, *const Column, *const Output) -> EtendueStatus,
    pdf_batch: unsafe fn(Column, usize, *const Column, Output) -> EtendueStatus,
    invert_batch: unsafe fn(Column, usize, *const Column, *const Output) -> EtendueStatus,
}

macro_rules! warps {
    ($(($($type:ident)?) $numbers:literal $coordinates:literal $sample:ident $pdf:ident $invert:ident
       $sample_batch:ident $pdf_batch:ident $invert_batch:ident;)+) => {
        const WARPS: &[Warp] = &[$(
            // SAFETY of all: the caller's pointers are those that the functions demand
            Warp {
                parameters: 0 $(+ size_of::<$type>() / 4)?,
                numbers: $numbers,
                coordinates: $coordinates,
                sample: |_warp, u, out| unsafe { $sample($(_warp.cast::<$type>(),)? u, out) },
                pdf: |_warp, x| unsafe { $pdf($(_warp.cast::<$type>(),)? x) },
                invert: |_warp, x, out| unsafe { $invert($(_warp.cast::<$type>(),)? x, out) },
                sample_batch: |_warp, n, u, out| unsafe { $sample_batch($(_warp.cast::<$type>(),)? n, u, out) },
                pdf_batch: |_warp, n, x, out| unsafe { $pdf_batch($(_warp.cast::<$type>(),)? n, x, out) },
                invert_batch: |_warp, n, x, out| unsafe { $invert_batch($(_warp.cast::<$type>(),)? n, x, out) },
            },
        )+];
    };
}
#[rustfmt::skip]
warps! {
    () 2 2 etendue_concentric_disk_sample etendue_concentric_disk_pdf etendue_concentric_disk_invert etendue_concentric_disk_sample_batch etendue_concentric_disk_pdf_batch etendue_concentric_disk_invert_batch;
    () 2 2 etendue_polar_disk_sample etendue_polar_disk_pdf etendue_polar_disk_invert etendue_polar_disk_sample_batch etendue_polar_disk_pdf_batch etendue_polar_disk_invert_batch;
    () 2 3 etendue_uniform_hemisphere_sample etendue_uniform_hemisphere_pdf etendue_uniform_hemisphere_invert etendue_uniform_hemisphere_sample_batch etendue_uniform_hemisphere_pdf_batch etendue_uniform_hemisphere_invert_batch;
    () 2 3 etendue_uniform_sphere_sample etendue_uniform_sphere_pdf etendue_uniform_sphere_invert etendue_uniform_sphere_sample_batch etendue_uniform_sphere_pdf_batch etendue_uniform_sphere_invert_batch;
    () 2 3 etendue_cosine_hemisphere_sample etendue_cosine_hemisphere_pdf etendue_cosine_hemisphere_invert etendue_cosine_hemisphere_sample_batch etendue_cosine_hemisphere_pdf_batch etendue_cosine_hemisphere_invert_batch;
    () 2 3 etendue_octahedral_sample etendue_octahedral_pdf etendue_octahedral_invert etendue_octahedral_sample_batch etendue_octahedral_pdf_batch etendue_octahedral_invert_batch;
    () 2 2 etendue_area_triangle_sample etendue_area_triangle_pdf etendue_area_triangle_invert etendue_area_triangle_sample_batch etendue_area_triangle_pdf_batch etendue_area_triangle_invert_batch;
    () 2 2 etendue_low_distortion_triangle_sample etendue_low_distortion_triangle_pdf etendue_low_distortion_triangle_invert etendue_low_distortion_triangle_sample_batch etendue_low_distortion_triangle_pdf_batch etendue_low_distortion_triangle_invert_batch;
    (EtendueCone) 2 3 etendue_cone_sample etendue_cone_pdf etendue_cone_invert etendue_cone_sample_batch etendue_cone_pdf_batch etendue_cone_invert_batch;
    (EtendueBilinear) 2 2 etendue_bilinear_sample etendue_bilinear_pdf etendue_bilinear_invert etendue_bilinear_sample_batch etendue_bilinear_pdf_batch etendue_bilinear_invert_batch;
    (EtendueGgxVisibleNormals) 2 3 etendue_ggx_visible_normals_sample etendue_ggx_visible_normals_pdf etendue_ggx_visible_normals_invert etendue_ggx_visible_normals_sample_batch etendue_ggx_visible_normals_pdf_batch etendue_ggx_visible_normals_invert_batch;
    (EtendueDiskSurface) 2 3 etendue_disk_surface_sample etendue_disk_surface_pdf etendue_disk_surface_invert etendue_disk_surface_sample_batch etendue_disk_surface_pdf_batch etendue_disk_surface_invert_batch;
    (EtendueCylinderSide) 2 3 etendue_cylinder_side_sample etendue_cylinder_side_pdf etendue_cylinder_side_invert etendue_cylinder_side_sample_batch etendue_cylinder_side_pdf_batch etendue_cylinder_side_invert_batch;
    (EtendueSphereSurface) 2 3 etendue_sphere_surface_sample etendue_sphere_surface_pdf etendue_sphere_surface_invert etendue_sphere_surface_sample_batch etendue_sphere_surface_pdf_batch etendue_sphere_surface_invert_batch;
    (EtenduePatchSurface) 2 3 etendue_patch_surface_sample etendue_patch_surface_pdf etendue_patch_surface_invert etendue_patch_surface_sample_batch etendue_patch_surface_pdf_batch etendue_patch_surface_invert_batch;
    (EtendueLinear) 1 1 etendue_linear_sample etendue_linear_pdf etendue_linear_invert etendue_linear_sample_batch etendue_linear_pdf_batch etendue_linear_invert_batch;
    (EtendueTent) 1 1 etendue_tent_sample etendue_tent_pdf etendue_tent_invert etendue_tent_sample_batch etendue_tent_pdf_batch etendue_tent_invert_batch;
    (EtendueExponential) 1 1 etendue_exponential_sample etendue_exponential_pdf etendue_exponential_invert etendue_exponential_sample_batch etendue_exponential_pdf_batch etendue_exponential_invert_batch;
    (EtendueNormal) 1 1 etendue_normal_sample etendue_normal_pdf etendue_normal_invert etendue_normal_sample_batch etendue_normal_pdf_batch etendue_normal_invert_batch;
}

/// Techniques whose lights have a unit vector, and where in their numbers it is: disks and suns.
const UNITS: [(usize, usize); 3] = [(12, 3), (13, 3), (22, 0)];
/// The warp with a unit vector, a disk.
const DISK: usize = 11;
/// The warp whose parameters a function prepares.
const GGX: usize = 10;

/// Reads bytes as numbers; zeros follow the last.
struct Input<'a> {
    bytes: std::slice::Iter<'a, u8>,
    /// Whether numbers may be infinite or NaN.
    any: bool,
    /// Continues the numbers of long columns.
    state: u32,
}

impl Input<'_> {
    fn byte(&mut self) -> u8 {
        self.bytes.next().copied().unwrap_or(0)
    }
    fn below(&mut self, n: usize) -> usize {
        usize::from(self.byte()) % n
    }
    fn word(&mut self) -> u32 {
        u32::from_le_bytes([(); 4].map(|()| self.byte()))
    }
    fn next(&mut self) -> u32 {
        self.state = self.state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        self.state
    }
    fn ordinary(word: u32) -> f32 {
        (word >> 8) as f32 / 4_194_304.0 - 2.0
    }
    /// Often ordinary; else subnormal, huge, any bits.
    fn number(&mut self) -> f32 {
        let kind = self.below(8);
        let word = self.word();
        let x = match kind {
            0 => f32::from_bits(word),
            1 => f32::from_bits(word >> 9),
            2 => [0.0, -0.0, 1.0, f32::MAX, f32::MIN_POSITIVE, f32::INFINITY, f32::NAN, -f32::MAX][word as usize % 8],
            _ => Self::ordinary(word),
        };
        if x.is_finite() || self.any { x } else { 1.0 }
    }
    /// A column: the first numbers from the bytes, the others ordinary.
    fn column(&mut self, n: usize, map: impl Fn(f32) -> f32) -> Vec<f32> {
        self.state = self.word();
        let odd = self.below(4);
        (0..n)
            .map(|i| {
                map(if i < odd {
                    self.number()
                } else {
                    let word = self.next();
                    Self::ordinary(word)
                })
            })
            .collect()
    }
    fn columns<const N: usize>(&mut self, n: usize, map: impl Fn(f32) -> f32 + Copy) -> [Vec<f32>; N] {
        std::array::from_fn(|_| self.column(n, map))
    }
}

/// A number in [0, 1) from any; NaN remains.
fn fraction(x: f32) -> f32 {
    let x = x - x.floor();
    if x < 1.0 || x.is_nan() { x } else { 0.0 }
}
fn unit([x, y, z]: [f32; 3]) -> [f32; 3] {
    let v = [x, y, z].map(f64::from);
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length > 0.0 || length.is_nan() { v.map(|x| (x / length) as f32) } else { [0.0, 0.0, 1.0] }
}
/// The same columns with unit vectors across them.
fn units(columns: [Vec<f32>; 3]) -> [Vec<f32>; 3] {
    let mut out = columns;
    for i in 0..out[0].len() {
        let v = unit([out[0][i], out[1][i], out[2][i]]);
        for (column, x) in out.iter_mut().zip(v) {
            column[i] = x;
        }
    }
    out
}

/// Columns of any alignment, with canaries around them.
struct Memory {
    bytes: Vec<u8>,
    starts: Vec<usize>,
    n: usize,
}

impl Memory {
    fn new(input: &mut Input<'_>, columns: usize, n: usize) -> Self {
        let shift = input.below(4);
        let starts = (0..columns).map(|k| GAP + shift + k * (4 * n + GAP + shift)).collect();
        Self { bytes: vec![CANARY; columns * (4 * n + GAP + shift) + 2 * GAP], starts, n }
    }
    fn of(input: &mut Input<'_>, columns: &[&[f32]]) -> Self {
        let mut memory = Self::new(input, columns.len(), columns[0].len());
        for (k, column) in columns.iter().enumerate() {
            for (i, x) in column.iter().enumerate() {
                let at = memory.starts[k] + 4 * i;
                memory.bytes[at..at + 4].copy_from_slice(&x.to_ne_bytes());
            }
        }
        memory
    }
    fn outputs<const N: usize>(&mut self) -> [Output; N] {
        let bytes = self.bytes.as_mut_ptr();
        std::array::from_fn(|k| bytes.wrapping_add(self.starts[k]).cast())
    }
    fn inputs<const N: usize>(&self) -> [Column; N] {
        std::array::from_fn(|k| self.bytes.as_ptr().wrapping_add(self.starts[k]).cast())
    }
    fn get(&self, column: usize, i: usize) -> f32 {
        let at = self.starts[column] + 4 * i;
        f32::from_ne_bytes(self.bytes[at..at + 4].try_into().unwrap())
    }
    /// Asserts that only the first bytes of those columns changed: `widths` are bytes per element.
    fn only(&self, widths: &[usize]) {
        let mut written = vec![false; self.bytes.len()];
        for (start, width) in self.starts.iter().zip(widths) {
            written[*start..start + width * self.n].fill(true);
        }
        assert!(
            self.bytes.iter().zip(written).all(|(byte, written)| written || *byte == CANARY),
            "a byte beyond the outputs"
        );
    }
}

/// Equal bits, or both NaN, whose bits depend on the order of operands.
fn same(a: f32, b: f32) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}
/// Every result is finite where all numbers are.
fn total(is_finite: bool, results: impl IntoIterator<Item = f32>) {
    if is_finite {
        for x in results {
            assert!(x.is_finite(), "{x} from finite input");
        }
    }
}
fn fields(s: &EtendueLightSample) -> [f32; 11] {
    let ([a, b, c], [d, e, f], [g, h]) = (s.direction, s.normal, s.uv);
    [a, b, c, s.distance, s.pdf, s.weight, d, e, f, g, h]
}
fn sample_columns(c: [Output; FIELDS]) -> EtendueSampleColumns {
    EtendueSampleColumns {
        direction: [c[0], c[1], c[2]],
        distance: c[3],
        pdf: c[4],
        weight: c[5],
        normal: [c[6], c[7], c[8]],
        uv: [c[9], c[10]],
        emits: c[11].cast(),
    }
}
fn all_finite(columns: &[&[f32]]) -> bool {
    columns.iter().all(|column| column.iter().all(|x| x.is_finite()))
}
fn expected(n: usize, is_null: bool) -> EtendueStatus {
    if n > 0 && is_null { EtendueStatus::NullPointer } else { EtendueStatus::Ok }
}

/// Any call of the C interface returns the documented status, writes what it should and nothing else, gives finite results for finite
/// numbers, and a batch gives the bits of its elements.
pub fn c_interface(bytes: &[u8]) {
    let mut input = Input { bytes: bytes.iter(), any: false, state: 0 };
    input.any = input.below(2) == 1;
    match input.below(TECHNIQUES.len() + WARPS.len() + 2) {
        k if k < TECHNIQUES.len() => technique(&mut input, k),
        k if k < TECHNIQUES.len() + WARPS.len() => warp(&mut input, k - TECHNIQUES.len()),
        k if k == TECHNIQUES.len() + WARPS.len() => sequence(&mut input),
        _ => tree(&mut input),
    }
}

fn technique(input: &mut Input<'_>, index: usize) {
    let t = &TECHNIQUES[index];
    let call = input.below(6);
    let n = COUNTS[input.below(COUNTS.len())];
    // the pointer that is null, if any
    let null_at = input.below(64);
    let absent = u16::from(input.byte()) << 8 | u16::from(input.byte());
    let mut light: Vec<f32> = (0..t.light).map(|_| input.number()).collect();
    let unit_at = UNITS.iter().find(|(of, _)| *of == index).map(|(_, at)| *at);
    if let Some(at) = unit_at {
        let vector = unit([light[at], light[at + 1], light[at + 2]]);
        light[at..at + 3].copy_from_slice(&vector);
    }
    let (p, normal) = ([(); 3].map(|()| input.number()), unit([(); 3].map(|()| input.number())));
    let u: [Vec<f32>; 2] = input.columns(n, fraction);
    let w: [Vec<f32>; 3] = units(input.columns(n, |x| x));
    let mut is_finite = all_finite(&[&light, &p, &normal, &u[0], &u[1], &w[0], &w[1], &w[2]]);
    let mut sampler = [f32::from_bits(0xA5A5_A5A5); SAMPLER];
    // SAFETY of all calls: pointers are null or to as many numbers as the header demands
    unsafe {
        let out = sampler.as_mut_ptr();
        assert_eq!((t.prepare)(null(), p.as_ptr(), normal.as_ptr(), out), EtendueStatus::NullPointer);
        assert_eq!((t.prepare)(light.as_ptr(), null(), normal.as_ptr(), out), EtendueStatus::NullPointer);
        assert!(sampler.iter().all(|x| x.to_bits() == 0xA5A5_A5A5));
        let out = sampler.as_mut_ptr();
        assert_eq!((t.prepare)(light.as_ptr(), p.as_ptr(), normal.as_ptr(), out), EtendueStatus::Ok);
        assert!(sampler[t.sampler..].iter().all(|x| x.to_bits() == 0xA5A5_A5A5));
        let (sampler, mut memory) = (sampler.as_ptr(), Memory::new(input, FIELDS, n));
        let (u_memory, w_memory) = (Memory::of(input, &[&u[0], &u[1]]), Memory::of(input, &[&w[0], &w[1], &w[2]]));
        let (mut u_in, mut w_in): ([Column; 2], [Column; 3]) = (u_memory.inputs(), w_memory.inputs());
        let self_in = if null_at == 0 { null() } else { sampler };
        if (1..3).contains(&null_at) {
            u_in[null_at - 1] = null();
        }
        if (1..4).contains(&null_at) {
            w_in[null_at - 1] = null();
        }
        let (u_null, w_null) = (null_at < 3, null_at < 4);
        let mut outputs: [Output; FIELDS] = memory.outputs();
        let mut widths = [4; FIELDS];
        widths[11] = 1;
        for (k, output) in outputs.iter_mut().enumerate() {
            if absent >> k & 1 == 1 {
                (*output, widths[k]) = (null_mut(), 0);
            }
        }
        let columns = sample_columns(outputs);
        let check = |memory: &Memory, i: usize, one: &EtendueLightSample| {
            for (k, field) in fields(one).into_iter().enumerate() {
                assert!(
                    widths[k] == 0 || same(memory.get(k, i), field),
                    "column {k} of element {i}: {} is not {field}",
                    memory.get(k, i)
                );
            }
            assert!(
                widths[11] == 0 || memory.bytes[memory.starts[11] + i] == one.emits,
                "the last column of element {i}"
            );
        };
        let mut one = EtendueLightSample::default();
        match call {
            0 | 1 => {
                let (is_null, status) = if call == 0 {
                    (u_null, (t.sample_batch)(self_in, n, u_in.as_ptr(), &columns))
                } else {
                    (w_null, (t.hit_batch)(self_in, n, w_in.as_ptr(), &columns))
                };
                assert_eq!(status, expected(n, is_null));
                memory.only(if status == EtendueStatus::Ok { &widths } else { &[] });
                for i in 0..if is_null { 0 } else { n } {
                    let status = if call == 0 {
                        (t.sample)(sampler, [u[0][i], u[1][i]].as_ptr(), &mut one)
                    } else {
                        (t.hit)(sampler, [w[0][i], w[1][i], w[2][i]].as_ptr(), &mut one)
                    };
                    assert_eq!(status, EtendueStatus::Ok);
                    check(&memory, i, &one);
                    total(is_finite, fields(&one));
                    if call == 0 {
                        let mut once = EtendueLightSample::default();
                        let u = [u[0][i], u[1][i]];
                        (t.once)(light.as_ptr(), p.as_ptr(), normal.as_ptr(), u.as_ptr(), &mut once);
                        assert!(
                            fields(&one).into_iter().zip(fields(&once)).all(|(a, b)| same(a, b))
                                && one.emits == once.emits
                        );
                    }
                }
            }
            2 => {
                let out = memory.outputs::<1>()[0];
                let status = (t.pdf_batch)(self_in, n, w_in.as_ptr(), out);
                assert_eq!(status, expected(n, w_null));
                memory.only(if w_null { &[] } else { &[4] });
                for i in 0..if w_null { 0 } else { n } {
                    let pdf = (t.pdf)(sampler, [w[0][i], w[1][i], w[2][i]].as_ptr());
                    assert!(same(memory.get(0, i), pdf));
                    total(is_finite, [pdf]);
                }
            }
            3 => {
                let status = (t.invert_batch)(self_in, n, w_in.as_ptr(), outputs.as_ptr());
                assert_eq!(status, expected(n, w_null));
                memory.only(if w_null { &[] } else { &widths[..2] });
                for i in 0..if w_null { 0 } else { n } {
                    let mut back = [0.0; 2];
                    assert_eq!(
                        (t.invert)(sampler, [w[0][i], w[1][i], w[2][i]].as_ptr(), back.as_mut_ptr()),
                        EtendueStatus::Ok
                    );
                    for k in 0..2 {
                        assert!(widths[k] == 0 || same(memory.get(k, i), back[k]));
                    }
                    total(is_finite, back);
                    assert!(!is_finite || back.iter().all(|x| (0.0..1.0).contains(x)), "{back:?} is not in [0, 1)^2");
                }
            }
            4 => {
                // results over inputs
                let both = Memory::of(input, &[&u[0], &u[1], &w[0], &w[1], &w[2]]);
                let mut over = both;
                let [a, b, c, d, e]: [Output; 5] = over.outputs();
                let mut fields = [null_mut(); FIELDS];
                (fields[1], fields[5]) = (a, b);
                let columns = sample_columns(fields);
                assert_eq!(
                    (t.sample_batch)(sampler, n, [a.cast_const(), b.cast_const()].as_ptr(), &columns),
                    EtendueStatus::Ok
                );
                let w_in = [c.cast_const(), d.cast_const(), e.cast_const()];
                assert_eq!((t.invert_batch)(sampler, n, w_in.as_ptr(), [e, c].as_ptr()), EtendueStatus::Ok);
                for i in 0..n {
                    let mut back = [0.0; 2];
                    (t.sample)(sampler, [u[0][i], u[1][i]].as_ptr(), &mut one);
                    (t.invert)(sampler, [w[0][i], w[1][i], w[2][i]].as_ptr(), back.as_mut_ptr());
                    let results = [over.get(0, i), over.get(1, i), over.get(4, i), over.get(2, i)];
                    for (a, b) in results.into_iter().zip([one.direction[1], one.weight, back[0], back[1]]) {
                        assert!(same(a, b));
                    }
                }
            }
            _ => {
                let mut lights: [Vec<f32>; LIGHT] = input.columns(n, |x| x);
                if let Some(at) = unit_at {
                    let vectors = units([0, 1, 2].map(|k| lights[at + k].clone()));
                    lights[at..at + 3].clone_from_slice(&vectors);
                }
                let (points, normals): ([Vec<f32>; 3], _) = (input.columns(n, |x| x), units(input.columns(n, |x| x)));
                for column in lights.iter().chain(&points).chain(&normals) {
                    is_finite &= all_finite(&[column]);
                }
                let [light_memory, p_memory, n_memory] = [&lights[..], &points, &normals]
                    .map(|columns| Memory::of(input, &columns.iter().map(|c| &c[..]).collect::<Vec<_>>()));
                let mut light_in: [Column; LIGHT] = light_memory.inputs();
                let (mut p_in, mut n_in): ([Column; 3], [Column; 3]) = (p_memory.inputs(), n_memory.inputs());
                let mut is_null = (1..3).contains(&null_at);
                match null_at {
                    3..6 => (p_in[null_at - 3], is_null) = (null(), true),
                    6..9 => (n_in[null_at - 6], is_null) = (null(), t.on_surface),
                    9..33 => (light_in[null_at - 9], is_null) = (null(), null_at - 9 < t.light),
                    _ => (),
                }
                let status = (t.each)(light_in.as_ptr(), n, p_in.as_ptr(), n_in.as_ptr(), u_in.as_ptr(), &columns);
                assert_eq!(status, expected(n, is_null));
                memory.only(if status == EtendueStatus::Ok { &widths } else { &[] });
                for i in 0..if is_null { 0 } else { n } {
                    let light: [f32; LIGHT] = std::array::from_fn(|k| lights[k][i]);
                    let [p, normal] = [&points, &normals].map(|c| [c[0][i], c[1][i], c[2][i]]);
                    let u = [u[0][i], u[1][i]];
                    (t.once)(light.as_ptr(), p.as_ptr(), normal.as_ptr(), u.as_ptr(), &mut one);
                    check(&memory, i, &one);
                    total(is_finite, fields(&one));
                }
            }
        }
    }
}

fn warp(input: &mut Input<'_>, index: usize) {
    let t = &WARPS[index];
    let call = input.below(3);
    let n = COUNTS[input.below(COUNTS.len())];
    let null_at = input.below(16);
    let mut parameters: Vec<f32> = (0..t.parameters.max(1)).map(|_| input.number()).collect();
    if index == DISK {
        let normal = unit([parameters[3], parameters[4], parameters[5]]);
        parameters[3..6].copy_from_slice(&normal);
    }
    let u: [Vec<f32>; 2] = input.columns(n, fraction);
    let x: [Vec<f32>; 3] = input.columns(n, |x| x);
    let is_finite = all_finite(&[&parameters, &u[0], &u[1], &x[0], &x[1], &x[2]]);
    let (u_memory, x_memory) = (Memory::of(input, &[&u[0], &u[1]]), Memory::of(input, &[&x[0], &x[1], &x[2]]));
    let mut memory = Memory::new(input, 3, n);
    // SAFETY of all calls: pointers are null or to as many numbers as the header demands
    unsafe {
        if index == GGX {
            let (roughness, wi) = ([parameters[0], parameters[1]], unit([parameters[2], parameters[3], parameters[4]]));
            let out = parameters.as_mut_ptr().cast();
            assert_eq!(
                etendue_ggx_visible_normals_prepare(roughness[0], roughness[1], wi.as_ptr(), out),
                EtendueStatus::Ok
            );
        }
        let own = parameters.as_ptr();
        let (mut u_in, mut x_in): ([Column; 2], [Column; 3]) = (u_memory.inputs(), x_memory.inputs());
        let self_in = if null_at == 0 { null() } else { own };
        let self_null = null_at == 0 && t.parameters > 0;
        if (1..3).contains(&null_at) {
            u_in[null_at - 1] = null();
        }
        if (1..4).contains(&null_at) {
            x_in[null_at - 1] = null();
        }
        let missing = |most: usize| self_null || (1..=most).contains(&null_at);
        let mut outputs: [Output; 3] = memory.outputs();
        let mut widths = [4; 3];
        if null_at > 12 {
            (outputs[null_at - 13], widths[null_at - 13]) = (null_mut(), 0);
        }
        let written = match call {
            0 => {
                let status = (t.sample_batch)(self_in, n, u_in.as_ptr(), outputs.as_ptr());
                assert_eq!(status, expected(n, missing(t.numbers)));
                if status == EtendueStatus::Ok { t.coordinates } else { 0 }
            }
            1 => {
                let status = (t.invert_batch)(self_in, n, x_in.as_ptr(), outputs.as_ptr());
                assert_eq!(status, expected(n, missing(t.coordinates)));
                if status == EtendueStatus::Ok { t.numbers } else { 0 }
            }
            _ => {
                let status = (t.pdf_batch)(self_in, n, x_in.as_ptr(), outputs[0]);
                assert_eq!(status, expected(n, missing(t.coordinates) || widths[0] == 0));
                usize::from(status == EtendueStatus::Ok)
            }
        };
        memory.only(&widths[..written]);
        for i in 0..if written > 0 { n } else { 0 } {
            let (u_i, x_i) = ([u[0][i], u[1][i]], [x[0][i], x[1][i], x[2][i]]);
            let mut one = [0.0; 3];
            match call {
                0 => assert_eq!((t.sample)(own, u_i.as_ptr(), one.as_mut_ptr()), EtendueStatus::Ok),
                1 => assert_eq!((t.invert)(own, x_i.as_ptr(), one.as_mut_ptr()), EtendueStatus::Ok),
                _ => one[0] = (t.pdf)(own, x_i.as_ptr()),
            }
            for k in 0..written {
                assert!(widths[k] == 0 || same(memory.get(k, i), one[k]), "column {k} of element {i}");
            }
            total(is_finite, one);
        }
    }
}

fn sequence(input: &mut Input<'_>) {
    let kind = input.below(7);
    let n = COUNTS[input.below(COUNTS.len())];
    let null_at = input.below(8);
    let (seed, count) = (u64::from(input.word()), input.word());
    let counters = EtendueCounters {
        pixel: input.word(),
        sample: input.word(),
        dimension: input.word(),
        pixels: null(),
        samples: null(),
    };
    let words: [Vec<f32>; 2] = input.columns(n, |x| x);
    let words_memory = Memory::of(input, &[&words[0], &words[1]]);
    let [pixels, samples]: [Column; 2] = words_memory.inputs();
    let has = [input.below(2) == 1, input.below(2) == 1];
    let given = EtendueCounters {
        pixels: if has[0] { pixels.cast() } else { null() },
        samples: if has[1] { samples.cast() } else { null() },
        ..counters
    };
    let mut memory = Memory::new(input, 2, n);
    // SAFETY: pointers are null or to as many numbers as the header demands
    let pairs = |counters: *const EtendueCounters, n: usize, u: *const Output| unsafe {
        match kind {
            0 => etendue_independent_pairs(seed, counters, n, u),
            1 => etendue_owen_sobol_pairs(seed, counters, n, u),
            2 => etendue_joint_sobol_pairs(seed, counters, n, u),
            3 => etendue_r2_pairs(seed, counters, n, u),
            4 => etendue_stratified_pairs(seed, count, counters, n, u),
            5 => etendue_latin_hypercube_pairs(seed, count, counters, n, u),
            _ => etendue_fibonacci_pairs(seed, count, counters, n, u),
        }
    };
    let mut outputs: [Output; 2] = memory.outputs();
    let mut widths = [4; 2];
    if (2..4).contains(&null_at) {
        (outputs[null_at - 2], widths[null_at - 2]) = (null_mut(), 0);
    }
    let status = match null_at {
        0 => pairs(null(), n, outputs.as_ptr()),
        1 => pairs(&given, n, null()),
        _ => pairs(&given, n, outputs.as_ptr()),
    };
    assert_eq!(status, expected(n, null_at < 2));
    memory.only(if null_at < 2 { &[] } else { &widths });
    for i in 0..if null_at < 2 { 0 } else { n } {
        let one = EtendueCounters {
            pixel: if has[0] { words[0][i].to_bits() } else { counters.pixel },
            sample: if has[1] { words[1][i].to_bits() } else { counters.sample.wrapping_add(i as u32) },
            ..counters
        };
        let mut u = [0.0_f32; 2];
        let [x, y] = &mut u;
        assert_eq!(pairs(&one, 1, [&raw mut *x, &raw mut *y].as_ptr()), EtendueStatus::Ok);
        for k in 0..2 {
            assert!((0.0..1.0).contains(&u[k]) && (widths[k] == 0 || same(memory.get(k, i), u[k])));
        }
    }
}

fn tree(input: &mut Input<'_>) {
    let light_count = input.below(40);
    let n = COUNTS[input.below(COUNTS.len())];
    let null_at = input.below(24);
    let mut lights: Vec<EtendueLightBound> = (0..light_count)
        .map(|_| EtendueLightBound {
            center: [(); 3].map(|()| input.number()),
            radius: input.number(),
            normal: if input.below(2) == 0 { [0.0; 3] } else { unit([(); 3].map(|()| input.number())) },
            cos_cone: 0.0,
            two_sided: u8::from(input.below(4) == 0),
            power: input.number(),
        })
        .collect();
    // SAFETY: a node is 90 words
    let canary: EtendueLightTreeNode = unsafe { std::mem::transmute([0xA5A5_A5A5_u32; 90]) };
    let node_count = etendue_light_tree_nodes(light_count);
    let (mut nodes, mut places) = (vec![canary; node_count + 1], vec![0xA5A5_A5A5_u32; light_count + 1]);
    let mut tree = EtendueLightTree { nodes: null(), node_count: 0, places: null(), light_count: 0 };
    let (p, normals): ([Vec<f32>; 3], _) = (input.columns(n, |x| x), units(input.columns(n, |x| x)));
    let [u]: [Vec<f32>; 1] = input.columns(n, fraction);
    // SAFETY of all calls: pointers are null or to as many numbers as the header demands
    unsafe {
        if light_count > 0 && input.below(8) == 0 {
            lights[light_count - 1].two_sided = 2 + input.byte() % 254;
            let status = etendue_light_tree_build(
                lights.as_ptr(),
                light_count,
                nodes.as_mut_ptr(),
                places.as_mut_ptr(),
                &mut tree,
            );
            assert_eq!(status, EtendueStatus::Value);
            assert!(tree.nodes.is_null() && places.iter().all(|x| *x == 0xA5A5_A5A5));
            lights[light_count - 1].two_sided = 0;
        }
        let status =
            etendue_light_tree_build(lights.as_ptr(), light_count, nodes.as_mut_ptr(), places.as_mut_ptr(), &mut tree);
        assert_eq!(status, EtendueStatus::Ok);
        assert_eq!(places[light_count], 0xA5A5_A5A5);
        let last: [u32; 90] = std::mem::transmute(nodes[node_count]);
        assert_eq!(last, [0xA5A5_A5A5; 90]);

        let memory_in = Memory::of(input, &[&p[0], &p[1], &p[2], &normals[0], &normals[1], &normals[2], &u]);
        let mut columns: [Column; 7] = memory_in.inputs();
        let is_null = null_at < 7;
        if is_null {
            columns[null_at] = null();
        }
        let mut memory = Memory::new(input, 4, n);
        let mut outputs: [Output; 4] = memory.outputs();
        let chosen = outputs[0];
        let mut widths = [4; 3];
        if (7..10).contains(&null_at) {
            (outputs[null_at - 7], widths[null_at - 7]) = (null_mut(), 0);
        }
        let out = EtendueChoiceColumns { light: outputs[0].cast(), pmf: outputs[1], u: outputs[2] };
        let (p_in, n_in) = (columns.as_ptr(), columns[3..].as_ptr());
        assert_eq!(etendue_light_tree_choose_batch(&tree, n, p_in, n_in, columns[6], &out), expected(n, is_null));
        memory.only(if is_null { &[] } else { &widths });
        if is_null {
            return;
        }
        // without the column of lights, its canaries are indices of no light
        assert_eq!(etendue_light_tree_pmf_batch(&tree, n, p_in, n_in, chosen.cast(), outputs[3]), EtendueStatus::Ok);
        for i in 0..n {
            let (mut light, mut pmf, mut rest, mut again) = (0_u32, 0.0_f32, 0.0_f32, 0.0_f32);
            let one = EtendueChoiceColumns { light: &mut light, pmf: &mut pmf, u: &mut rest };
            let at: [Column; 7] = std::array::from_fn(|k| {
                [&p[0], &p[1], &p[2], &normals[0], &normals[1], &normals[2], &u][k][i..].as_ptr()
            });
            let (p_in, n_in) = (at.as_ptr(), at[3..].as_ptr());
            assert_eq!(etendue_light_tree_choose_batch(&tree, 1, p_in, n_in, at[6], &one), EtendueStatus::Ok);
            assert_eq!(etendue_light_tree_pmf_batch(&tree, 1, p_in, n_in, &light, &mut again), EtendueStatus::Ok);
            assert!(same(pmf, again) && (0.0..=1.0).contains(&pmf), "chosen with {pmf}, which is {again}");
            assert!(if light == u32::MAX {
                pmf == 0.0
            } else {
                (light as usize) < light_count && lights[light as usize].power > 0.0
            });
            assert!(widths[0] == 0 || memory.get(0, i).to_bits() == light);
            assert!(widths[1] == 0 || same(memory.get(1, i), pmf));
            assert!(widths[2] == 0 || same(memory.get(2, i), rest));
            assert!(same(memory.get(3, i), if widths[0] == 0 { 0.0 } else { pmf }));
        }
    }
}
