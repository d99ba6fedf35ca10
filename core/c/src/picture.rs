//! Pictures on lights.

use crate::light::{
    EtendueBilinearPatch, EtendueBilinearPatchColumns, EtendueDisk, EtendueParallelogram, EtendueParallelogramColumns,
    EtendueRectangle, EtendueSphere, EtendueSphereColumns, EtendueTriangle,
};
use crate::sampler::*;
use crate::{EtendueStatus, columns, outputs, refuse_null};
use core::slice::{from_raw_parts, from_raw_parts_mut};
use etendue::light::{self, FlatLight, Picture, Pictured, Region};
use etendue::{Vec3, light::mean_of_bilinear};
use etendue_batch::{
    Batch, BatchTechnique, PictureByArea, PictureByProjectedSolidAngle, PictureBySolidAngle,
    PictureOnPatchByVisibleArea, PictureOnSphereByVisibleArea,
};

/// The most columns or rows, and the most texels.
const MOST: usize = 1 << 24;
const MOST_TEXELS: usize = u32::MAX as usize / 2;

/// The part of the unit square of surface coordinates that a light covers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub enum EtenduePictureRegion {
    /// All of it: rectangles, parallelograms, spheres and bilinear patches.
    Square = 0,
    /// The half where u + v < 1: triangles.
    Triangle = 1,
    /// The inscribed disk: disks.
    Disk = 2,
}

/// A picture for lights, in memory of the caller: texels are drawn in proportion to their radiance times their area, solid angle or projected
/// solid angle as seen from a shading point. Columns are u, rows v, of the surface coordinates of the light; of a sphere, columns are heights
/// from -1 to 1, and rows azimuths.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtenduePicture {
    /// The table that [`etendue_picture_build`] or [`etendue_picture_interpolate`] wrote.
    pub table: *const f32,
    /// The radiance at the centres of texels, between which the picture is interpolated; NULL for one that is constant in each texel.
    pub values: *const f32,
    /// Number of columns of the image.
    pub width: usize,
    /// Number of its rows.
    pub height: usize,
    /// One of EtenduePictureRegion.
    pub region: u32,
}

fn region_of(region: u32) -> Option<Region> {
    match region {
        0 => Some(Region::Square),
        1 => Some(Region::Triangle),
        2 => Some(Region::Disk),
        _ => None,
    }
}

impl EtenduePicture {
    /// Calls `f` with the core's picture, unless the struct is not valid.
    unsafe fn with(&self, f: impl FnOnce(Picture<'static>)) -> EtendueStatus {
        let Self { table, values, width, height, region } = *self;
        refuse_null!(table);
        let Some(region) = region_of(region) else { return EtendueStatus::Value };
        let is_smooth = !values.is_null();
        let length = if is_smooth {
            etendue_picture_interpolated_table(width, height)
        } else {
            etendue_picture_table(width, height)
        };
        if length == 0 && width.saturating_mul(height) != 1 {
            return EtendueStatus::Count;
        }
        // SAFETY: `etendue_picture_build` or `etendue_picture_interpolate` wrote the table, and `f` keeps nothing of either
        let picture = unsafe {
            let table = from_raw_parts(table, length);
            if is_smooth {
                Picture::interpolated_from_buffer(from_raw_parts(values, width * height), width, table)
            } else {
                Picture::from_buffer(table, [width, height], region)
            }
        };
        match picture {
            Ok(picture) => f(picture),
            Err(_) => return EtendueStatus::Count,
        }
        EtendueStatus::Ok
    }
}

fn is_size(width: usize, height: usize) -> bool {
    let sizes = 1..=MOST;
    sizes.contains(&width) && sizes.contains(&height) && width <= MOST_TEXELS / height
}

/// Number of floats in the table of a picture; 0 for a single texel, and for a picture without columns or rows, with more than 2^24 of them,
/// or with 2^31 texels or more.
#[unsafe(no_mangle)]
pub extern "C" fn etendue_picture_table(width: usize, height: usize) -> usize {
    if is_size(width, height) { Picture::buffer(width, height) } else { 0 }
}

/// Number of floats in the table of a picture that is interpolated between the centres of its texels; 0 for a picture without columns or
/// rows, with 2^24 of them or more, or with 2^31 texels or more between centres.
#[unsafe(no_mangle)]
pub extern "C" fn etendue_picture_interpolated_table(width: usize, height: usize) -> usize {
    if width == 0 || height == 0 || width >= MOST || height >= MOST {
        return 0;
    }
    etendue_picture_table(width + 1, height + 1)
}

/// Builds the table of a picture that is constant in each texel, from the mean radiance of each texel, row by row: its luminance, or a sum of
/// its channels, in any unit. [`etendue_picture_means_of_bilinear`] gives these means where the host interpolates.
///
/// `weights` has width x height elements, `table` has [`etendue_picture_table`] (a single texel needs none, but not NULL); the table must
/// live as long as `picture` is used, `weights` need not. `region` is one of EtenduePictureRegion. Returns ETENDUE_STATUS_COUNT for a size
/// that is not allowed, and ETENDUE_STATUS_VALUE for another `region`, if a weight is negative, infinite or NaN, and if all weights in the
/// region are 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_picture_build(
    weights: *const f32,
    width: usize,
    height: usize,
    region: u32,
    table: *mut f32,
    picture: *mut EtenduePicture,
) -> EtendueStatus {
    refuse_null!(weights, table, picture);
    if !is_size(width, height) {
        return EtendueStatus::Count;
    }
    let Some(known) = region_of(region) else { return EtendueStatus::Value };
    // SAFETY: the pointers are not null, and point to what the header says; every float of the table is written before it is read
    unsafe {
        let weights = from_raw_parts(weights, width * height);
        // before the table is written
        if !are_radiance(weights) {
            return EtendueStatus::Value;
        }
        let length = etendue_picture_table(width, height);
        table.write_bytes(0, length);
        if Picture::build(weights, width, known, from_raw_parts_mut(table, length)).is_err() {
            return EtendueStatus::Value;
        }
        picture.write(EtenduePicture { table, values: core::ptr::null(), width, height, region });
    }
    EtendueStatus::Ok
}

/// Builds the table of a picture that is interpolated bilinearly between the centres of its texels, and continued by its outermost ones: the
/// pdf is in proportion to the interpolated radiance. For lights that cover the whole unit square.
///
/// `values` has width x height elements, the radiance at the centres, row by row; `table` has [`etendue_picture_interpolated_table`]. Both
/// must live as long as `picture` is used. Returns ETENDUE_STATUS_COUNT for a size that is not allowed, and ETENDUE_STATUS_VALUE if a value is
/// negative, infinite or NaN, and if all of them are 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_picture_interpolate(
    values: *const f32,
    width: usize,
    height: usize,
    table: *mut f32,
    picture: *mut EtenduePicture,
) -> EtendueStatus {
    refuse_null!(values, table, picture);
    let length = etendue_picture_interpolated_table(width, height);
    if length == 0 {
        return EtendueStatus::Count;
    }
    // SAFETY: as in `etendue_picture_build`
    unsafe {
        let known = from_raw_parts(values, width * height);
        if !are_radiance(known) {
            return EtendueStatus::Value;
        }
        table.write_bytes(0, length);
        if Picture::interpolated(known, width, from_raw_parts_mut(table, length)).is_err() {
            return EtendueStatus::Value;
        }
        let region = EtenduePictureRegion::Square as u32;
        picture.write(EtenduePicture { table, values, width, height, region });
    }
    EtendueStatus::Ok
}

/// Whether numbers are radiance: none is negative, infinite or NaN, and not all are 0.
fn are_radiance(weights: &[f32]) -> bool {
    weights.iter().all(|w| (0.0..f32::INFINITY).contains(w)) && weights.iter().any(|&w| w > 0.0)
}

/// Fills `means` with the mean over each texel of an image that is interpolated bilinearly between the centres of its texels, and continued
/// by its outermost ones: 1/8, 3/4 and 1/8 of a texel and its neighbours, in both directions. Both have width x height elements, and are not
/// the same memory. Returns ETENDUE_STATUS_COUNT for an image without columns or rows, or with more than 2^24 of them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_picture_means_of_bilinear(
    values: *const f32,
    width: usize,
    height: usize,
    means: *mut f32,
) -> EtendueStatus {
    refuse_null!(values, means);
    if !is_size(width, height) {
        return EtendueStatus::Count;
    }
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        let values = from_raw_parts(values, width * height);
        for (i, y) in (0..width * height).map(|i| (i, i / width)) {
            means.add(i).write_unaligned(mean_of_bilinear(values, width, [i - y * width, y]));
        }
    }
    EtendueStatus::Ok
}

/// The functions that return a flat light as the parallelogram of its surface coordinates, on which pictures are.
macro_rules! coordinates {
    ($($(#[$doc:meta])* $function:ident($light:ident = $core:ident);)+) => {$(
        $(#[$doc])*
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $function(light: *const $light, out: *mut EtendueParallelogram) -> EtendueStatus {
            refuse_null!(light, out);
            // SAFETY: the pointers are not null, and point to what the header says; the structs have the same fields
            unsafe { out.cast::<light::Parallelogram<f32>>().write((*light.cast::<light::$core<f32>>()).coordinates()) };
            EtendueStatus::Ok
        }
    )+};
}
coordinates! {
    /// The parallelogram of a rectangle's surface coordinates, for pictures of the region ETENDUE_PICTURE_REGION_SQUARE.
    etendue_rectangle_coordinates(EtendueRectangle = Rectangle);
    /// The parallelogram of a triangle's surface coordinates, for pictures of the region ETENDUE_PICTURE_REGION_TRIANGLE.
    etendue_triangle_coordinates(EtendueTriangle = Triangle);
    /// The square around a disk, for pictures of the region ETENDUE_PICTURE_REGION_DISK. A radius < 0 counts as 0.
    etendue_disk_coordinates(EtendueDisk = Disk);
}

/// A light with a picture, and columns of lights with one picture: the core's light is the same over numbers or pointers.
macro_rules! pictured {
    ($($(#[$doc:meta])* $name:ident, $columns:ident: $light:ident, $light_columns:ident = $core:ident;)+) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        #[repr(C)]
        pub struct $name {
            /// The picture.
            pub picture: EtenduePicture,
            /// The light that it is on.
            pub light: $light,
        }
        /// Columns of lights with one picture.
        #[derive(Clone, Copy, Debug)]
        #[repr(C)]
        pub struct $columns {
            /// The picture of all of them.
            pub picture: EtenduePicture,
            /// The lights.
            pub lights: $light_columns,
        }
        impl $name {
            unsafe fn with(&self, f: impl FnOnce(Pictured<'static, light::$core<f32>>)) -> EtendueStatus {
                // SAFETY: the caller's; the structs of the light have the same fields
                unsafe { self.picture.with(|picture| f(picture.on(*(&raw const self.light).cast::<light::$core<f32>>()))) }
            }
        }
        impl $columns {
            unsafe fn with(&self, f: impl FnOnce(Pictured<'static, light::$core<*const f32>>)) -> EtendueStatus {
                // SAFETY: the columns of lights consist of pointers
                if !unsafe { all_there(&self.lights) } {
                    return EtendueStatus::NullPointer;
                }
                // SAFETY: the caller's; the structs of columns have the same fields
                unsafe { self.picture.with(|picture| f(picture.on(*(&raw const self.lights).cast::<light::$core<*const f32>>()))) }
            }
        }
    )+};
}
pictured! {
    /// A parallelogram with a picture: a flat light of any shape, by its surface coordinates. Those of a parallelogram are itself;
    /// [`etendue_rectangle_coordinates`], [`etendue_triangle_coordinates`] and [`etendue_disk_coordinates`] give those of others.
    EtenduePicturedParallelogram, EtenduePicturedParallelogramColumns: EtendueParallelogram, EtendueParallelogramColumns = Parallelogram;
    /// A sphere with a picture.
    EtenduePicturedSphere, EtenduePicturedSphereColumns: EtendueSphere, EtendueSphereColumns = Sphere;
    /// A bilinear patch with a picture.
    EtenduePicturedPatch, EtenduePicturedPatchColumns: EtendueBilinearPatch, EtendueBilinearPatchColumns = BilinearPatch;
}

/// The struct of a technique with pictures, and its functions.
macro_rules! techniques {
    ($($(#[$doc:meta])* $sampler:ident = $core:ident: $light:ident, $columns:ident, $module:ident($($n:ident: $normals:ident)?);)+) => {$(
        $(#[$doc])*
        ///
        /// It has no data of its own beside the light and the point: each call prepares the light, which takes as long as few samples. The
        /// fields are set by `prepare`.
        #[derive(Clone, Copy, Debug)]
        #[repr(C)]
        pub struct $sampler {
            /// The light with its picture.
            pub light: $light,
            /// The shading point.
            pub p: [f32; 3],
            $(/// The unit normal there.
            pub $n: [f32; 3],)?
        }
        impl Sampler for $sampler {
            type Core = $core<'static>;
            #[inline(always)]
            unsafe fn with(this: *const Self, f: impl FnOnce(&$core<'static>)) -> EtendueStatus {
                refuse_null!(this);
                // SAFETY: the caller's
                unsafe {
                    let Self { light, p, $($n)? } = this.read();
                    let normal = Vec3::new(0.0, 0.0, 0.0);
                    $(let normal = { let _ = normal; vec3($n) };)?
                    light.with(|light| f(&$core::prepared(light, vec3(p), normal)))
                }
            }
        }
        impl Technique for $sampler {
            type Light = $light;
            type Columns = $columns;
            #[inline(always)]
            unsafe fn prepare(light: *const $light, p: Vec3<f32>, normal: Vec3<f32>, out: *mut Self) -> EtendueStatus {
                // SAFETY: the caller's
                unsafe {
                    let light = light.read();
                    let status = light.with(|_| ());
                    if status == EtendueStatus::Ok {
                        let _ = normal;
                        out.write(Self { light, p: [p.x, p.y, p.z], $($n: [normal.x, normal.y, normal.z])? });
                    }
                    status
                }
            }
            #[inline(always)]
            unsafe fn with_light(
                light: *const $light,
                f: impl FnOnce(&<$core<'static> as BatchTechnique>::Light<f32>),
            ) -> EtendueStatus {
                // SAFETY: the caller's
                unsafe { light.read().with(|light| f(&light)) }
            }
            #[inline(always)]
            unsafe fn with_lights(
                lights: *const $columns,
                f: impl FnOnce(<$core<'static> as BatchTechnique>::Light<*const f32>),
            ) -> EtendueStatus {
                // SAFETY: the caller's
                unsafe { (*lights).with(f) }
            }
        }
        #[doc = concat!("The functions of [`", stringify!($sampler), "`]: their names in C begin with `etendue_", stringify!($module), "_`.")]
        pub mod $module {
            use super::*;

            technique_functions!($sampler, $light, $columns, $module, ($($n: $normals)?));
        }
    )+};
}
techniques! {
    /// A flat light with a picture, by radiance times area, for lights that are small for their distance: the pdf is the pmf of the texel, over
    /// its area, times distance²/|cosθ'| per steradian, θ' at the light. 0 where the radiance is, and beyond the rim of triangles and disks.
    EtenduePictureByArea = PictureByArea: EtenduePicturedParallelogram, EtenduePicturedParallelogramColumns, picture_by_area();
    /// A flat light with a picture, by radiance times solid angle at the point: the pdf is the pmf of the texel over its solid angle, per
    /// steradian. 0 where the radiance is, and beyond the rim of triangles and disks.
    EtenduePictureBySolidAngle = PictureBySolidAngle: EtenduePicturedParallelogram, EtenduePicturedParallelogramColumns, picture_by_solid_angle();
    /// A flat light with a picture, by radiance times projected solid angle above the horizon of the unit normal n at the point: the pdf is the
    /// pmf of the texel over its projected solid angle, times cosθ, per steradian. 0 where nothing of the light is above the horizon, where
    /// the radiance is 0, and beyond the rim of triangles and disks.
    EtenduePictureByProjectedSolidAngle = PictureByProjectedSolidAngle: EtenduePicturedParallelogram, EtenduePicturedParallelogramColumns,
    picture_by_projected_solid_angle(n: normals);
    /// A sphere with a picture, by radiance times the area that is visible from the point, over the squared distance: the pdf is the pmf of the
    /// texel, over its area, times distance²/|cosθ'| per steradian, θ' at the light. From inside, texels are drawn by radiance alone.
    EtenduePictureOnSphereByVisibleArea = PictureOnSphereByVisibleArea: EtenduePicturedSphere, EtenduePicturedSphereColumns,
    picture_on_sphere_by_visible_area();
    /// A bilinear patch with a picture, by radiance times the area that is visible from the point, over the squared distance; in a texel,
    /// uniform in (s, t). The pdf is per steradian.
    EtenduePictureOnPatchByVisibleArea = PictureOnPatchByVisibleArea: EtenduePicturedPatch, EtenduePicturedPatchColumns,
    picture_on_patch_by_visible_area();
}
