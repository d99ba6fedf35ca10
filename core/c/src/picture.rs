//! Pictures on lights.

use crate::light::{
    EtendueDisk, EtendueParallelogram, EtendueParallelogramColumns, EtendueRectangle, EtendueSphere,
    EtendueSphereColumns, EtendueTriangle,
};
use crate::memory::{build_table, refuse_null};
use crate::status::EtendueStatus;
use core::mem::{offset_of, size_of};
use core::slice::from_raw_parts;
use etendue::light::{self, FlatLight, Picture, Region};
use etendue_batch::memory::PictureMemory;

/// The most columns or rows, and the most texels.
const MOST: usize = 1 << 24;
const MOST_TEXELS: usize = u32::MAX as usize / 2;

/// The part of the unit square of surface coordinates that a light covers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub enum EtenduePictureRegion {
    /// All of it: rectangles, parallelograms and spheres.
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
    /// Whether the library can look into it.
    pub(crate) fn status(&self) -> EtendueStatus {
        let Self { table, values, width, height, region } = *self;
        refuse_null!(table);
        if region_of(region).is_none() {
            return EtendueStatus::Value;
        }
        let is_size = if values.is_null() { is_size(width, height) } else { is_interpolated_size(width, height) };
        if is_size { EtendueStatus::Ok } else { EtendueStatus::Count }
    }
}
const _: () = {
    assert!(size_of::<EtenduePicture>() == size_of::<PictureMemory<'_>>());
    assert!(offset_of!(EtenduePicture, region) == size_of::<PictureMemory<'_>>() - size_of::<usize>());
};

fn is_size(width: usize, height: usize) -> bool {
    let sizes = 1..=MOST;
    sizes.contains(&width) && sizes.contains(&height) && width <= MOST_TEXELS / height
}

fn is_interpolated_size(width: usize, height: usize) -> bool {
    let sizes = 1..MOST;
    sizes.contains(&width) && sizes.contains(&height) && is_size(width + 1, height + 1)
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
    if is_interpolated_size(width, height) { Picture::buffer(width + 1, height + 1) } else { 0 }
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
    let length = etendue_picture_table(width, height);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        let status = build_table(weights, width * height, table, length, |weights, table| {
            Picture::build(weights, width, known, table).is_ok()
        });
        if status == EtendueStatus::Ok {
            picture.write(EtenduePicture { table, values: core::ptr::null(), width, height, region });
        }
        status
    }
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
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        let status = build_table(values, width * height, table, length, |values, table| {
            Picture::interpolated(values, width, table).is_ok()
        });
        if status == EtendueStatus::Ok {
            let region = EtenduePictureRegion::Square as u32;
            picture.write(EtenduePicture { table, values, width, height, region });
        }
        status
    }
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
            means.add(i).write_unaligned(Picture::mean_of_bilinear(values, width, [i - y * width, y]));
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

/// A light with a picture, and columns of lights with one picture.
macro_rules! pictured {
    ($($(#[$doc:meta])* $name:ident, $columns:ident: $light:ident, $light_columns:ident;)+) => {$(
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
    )+};
}
pictured! {
    /// A parallelogram with a picture: a flat light of any shape, by its surface coordinates. Those of a parallelogram are itself;
    /// [`etendue_rectangle_coordinates`], [`etendue_triangle_coordinates`] and [`etendue_disk_coordinates`] give those of others.
    EtenduePicturedParallelogram, EtenduePicturedParallelogramColumns: EtendueParallelogram, EtendueParallelogramColumns;
    /// A sphere with a picture.
    EtenduePicturedSphere, EtenduePicturedSphereColumns: EtendueSphere, EtendueSphereColumns;
}

/// The struct of a technique with pictures.
macro_rules! samplers {
    ($($sampler:ident: $light:ident $($n:ident)?;)+) => {$(
        /// What the technique of this name prepares. It has no data of its own beside the light and the point: each call prepares the light,
        /// which takes as long as few samples.
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
    )+};
}
samplers! {
    EtenduePictureByArea: EtenduePicturedParallelogram;
    EtenduePictureBySolidAngle: EtenduePicturedParallelogram;
    EtenduePictureByProjectedSolidAngle: EtenduePicturedParallelogram n;
    EtenduePictureOnSphereByVisibleArea: EtenduePicturedSphere;
}
