//! Images that a light projects through a pinhole.

use crate::sampler::vec2;
use crate::{EtendueStatus, columns, each, each_mut, outputs, refuse_null};
use core::ptr::null_mut;
use core::slice::{from_raw_parts, from_raw_parts_mut};
use etendue::light::{ProjectedImage, Projector};
use etendue_batch::{Batch, DirectionOfImage, PlaceInImage};

/// A light that projects a rectangular image through a pinhole, as a slide projector does.
///
/// Directions are those in which light travels, in the space of the projector: +z is the axis, +x the right and +y the upper edge of the
/// image. Positions in the image run from the upper left corner, in [0, 1]^2.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueProjector {
    /// Tangents of half the horizontal and vertical angle of view, greater than 0. With others, no direction is in the image.
    pub tan_half: [f32; 2],
}

impl EtendueProjector {
    fn projector(self) -> Projector {
        Projector { tan_half: self.tan_half }
    }
}

/// The position `uv` in the image of the unit direction `w`, and whether it is there: where it is not, `inside` is 0, and so is the position.
///
/// u = (1 + x/(z tx))/2, v = (1 - y/(z ty))/2, with the tangents tx and ty of half the angles of view.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_projector_place(
    projector: *const EtendueProjector,
    w: *const f32,
    uv: *mut f32,
    inside: *mut u8,
) -> EtendueStatus {
    refuse_null!(projector, w, uv, inside);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe { places(projector, 1, each(w), each_mut(uv), inside) };
    EtendueStatus::Ok
}

/// The position in the image of each unit direction, and whether it is there: three columns in, two and one out.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_projector_place_batch(
    projector: *const EtendueProjector,
    n: usize,
    w: *const *const f32,
    uv: *const *mut f32,
    inside: *mut u8,
) -> EtendueStatus {
    if n == 0 {
        return EtendueStatus::Ok;
    }
    refuse_null!(projector);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        let (Some(w), Some(uv)) = (columns(w), outputs(uv)) else { return EtendueStatus::NullPointer };
        places(projector, n, w, uv, inside);
    }
    EtendueStatus::Ok
}

unsafe fn places(
    projector: *const EtendueProjector,
    n: usize,
    [x, y, z]: [*const f32; 3],
    [u, v]: [*mut f32; 2],
    inside: *mut u8,
) {
    // SAFETY: the caller's
    unsafe {
        let map = PlaceInImage((*projector).projector());
        (Batch::new().map_functions().map)(&map, n, &[x, y, z, x, x, x], &[u, v, null_mut(), null_mut()], inside);
    }
}

/// The unit direction `w` in which the light of a position `uv` in the image travels.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_projector_direction(
    projector: *const EtendueProjector,
    uv: *const f32,
    w: *mut f32,
) -> EtendueStatus {
    refuse_null!(projector, uv, w);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe { directions(projector, 1, each(uv), each_mut(w)) };
    EtendueStatus::Ok
}

/// The unit direction in which the light of each position in the image travels: two columns in, three out.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_projector_direction_batch(
    projector: *const EtendueProjector,
    n: usize,
    uv: *const *const f32,
    w: *const *mut f32,
) -> EtendueStatus {
    if n == 0 {
        return EtendueStatus::Ok;
    }
    refuse_null!(projector);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        let (Some(uv), Some(w)) = (columns(uv), outputs(w)) else { return EtendueStatus::NullPointer };
        directions(projector, n, uv, w);
    }
    EtendueStatus::Ok
}

unsafe fn directions(projector: *const EtendueProjector, n: usize, [u, v]: [*const f32; 2], [x, y, z]: [*mut f32; 3]) {
    // SAFETY: the caller's
    unsafe {
        let map = DirectionOfImage((*projector).projector());
        (Batch::new().map_functions().map)(&map, n, &[u, v, u, u, u, u], &[x, y, z, null_mut()], null_mut());
    }
}

/// A cosine of the angle to the axis from which on the light is dark, for EtendueLightBound: that of the corners, less a rounding. -1 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_projector_cos_cone(projector: *const EtendueProjector) -> f32 {
    // SAFETY: the pointer is not null, and points to what the header says
    if projector.is_null() { -1.0 } else { unsafe { (*projector).projector().cos_cone() } }
}

/// Solid angle of the texel in column `x` and row `y` of an image of width x height texels, in steradians: exact to some 1e-16. 0 for NULL, and
/// for a texel beyond the image.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_projector_texel_solid_angle(
    projector: *const EtendueProjector,
    width: usize,
    height: usize,
    x: usize,
    y: usize,
) -> f64 {
    if projector.is_null() || x >= width || y >= height {
        return 0.0;
    }
    // SAFETY: the pointer is not null, and points to what the header says
    unsafe { (*projector).projector().texel_solid_angle([width, height], [x, y]) }
}

/// What a projector emits of an image, for light tracing, in memory of the caller: a texel by its weight times its solid angle, and in the
/// texel uniform in the plane of the image. The pdf is the probability of the texel times the number of texels, over
/// 4 tx ty cosθ^3, per steradian, with the tangents tx and ty; 0 where the weight is 0, and outside the image.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueProjectedImage {
    /// The table that [`etendue_projected_image_build`] wrote.
    pub table: *const f32,
    /// Number of columns of the image.
    pub width: usize,
    /// Number of its rows.
    pub height: usize,
    /// The projector.
    pub projector: EtendueProjector,
}

impl EtendueProjectedImage {
    unsafe fn with(this: *const Self, f: impl FnOnce(&ProjectedImage<'static>)) -> EtendueStatus {
        refuse_null!(this);
        // SAFETY: the caller's pointer is not null
        let Self { table, width, height, projector } = unsafe { this.read() };
        refuse_null!(table);
        let length = etendue_projected_image_table(width, height);
        // SAFETY: `etendue_projected_image_build` wrote it, and `f` keeps nothing of it
        let table = unsafe { from_raw_parts(table, length) };
        match ProjectedImage::from_buffer(projector.projector(), table, width) {
            Ok(image) => f(&image),
            Err(_) => return EtendueStatus::Count,
        }
        EtendueStatus::Ok
    }
}

/// Number of floats in the table of an image; 0 for one without columns or rows, or with more than 2^24 of them.
#[unsafe(no_mangle)]
pub extern "C" fn etendue_projected_image_table(width: usize, height: usize) -> usize {
    let sizes = 1..=1 << 24;
    let floats = if sizes.contains(&width) && sizes.contains(&height) { (width + 1).checked_mul(height) } else { None };
    floats.unwrap_or(0)
}

/// Builds the table of an image, from a weight per steradian for each texel, row by row from the top.
///
/// `weights` has width x height elements, `table` has [`etendue_projected_image_table`]; it must live as long as `image` is used, `weights`
/// need not. Returns ETENDUE_STATUS_COUNT for a size that is not allowed, and ETENDUE_STATUS_VALUE if a weight is negative, infinite or NaN, if
/// all weights are 0, and if a tangent of the projector is not positive and finite.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_projected_image_build(
    projector: *const EtendueProjector,
    weights: *const f32,
    width: usize,
    height: usize,
    table: *mut f32,
    image: *mut EtendueProjectedImage,
) -> EtendueStatus {
    refuse_null!(projector, weights, table, image);
    let length = etendue_projected_image_table(width, height);
    if length == 0 {
        return EtendueStatus::Count;
    }
    // SAFETY: the pointers are not null, and point to what the header says; every float of the table is written before it is read
    unsafe {
        let (projector, weights) = (projector.read(), from_raw_parts(weights, width * height));
        // before the table is written
        let is_view = projector.tan_half.iter().all(|&t| t > 0.0 && t < f32::INFINITY);
        let are_weights = weights.iter().all(|w| (0.0..f32::INFINITY).contains(w)) && weights.iter().any(|&w| w > 0.0);
        if !is_view || !are_weights {
            return EtendueStatus::Value;
        }
        table.write_bytes(0, length);
        if ProjectedImage::build(projector.projector(), weights, width, from_raw_parts_mut(table, length)).is_err() {
            return EtendueStatus::Value;
        }
        image.write(EtendueProjectedImage { table, width, height, projector });
    }
    EtendueStatus::Ok
}

/// Maps random numbers `u` to a unit direction `w` in which light travels.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_projected_image_sample(
    image: *const EtendueProjectedImage,
    u: *const f32,
    w: *mut f32,
) -> EtendueStatus {
    refuse_null!(u, w);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe { EtendueProjectedImage::with(image, |image| (Batch::new().one_warp().sample)(image, u, w)) }
}

/// The pdf of a unit direction `w`, per steradian; 0 outside the image, and if a pointer is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_projected_image_pdf(image: *const EtendueProjectedImage, w: *const f32) -> f32 {
    let mut pdf = 0.0;
    if !w.is_null() {
        // SAFETY: the pointers are not null, and point to what the header says
        unsafe { EtendueProjectedImage::with(image, |image| pdf = (Batch::new().one_warp().pdf)(image, w)) };
    }
    pdf
}

/// The random numbers that are mapped to a unit direction `w`; any in [0, 1)^2 outside the image.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_projected_image_invert(
    image: *const EtendueProjectedImage,
    w: *const f32,
    u: *mut f32,
) -> EtendueStatus {
    refuse_null!(w, u);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe { EtendueProjectedImage::with(image, |image| (Batch::new().one_warp().invert)(image, w, u)) }
}

/// A direction for each u, in columns.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_projected_image_sample_batch(
    image: *const EtendueProjectedImage,
    n: usize,
    u: *const *const f32,
    w: *const *mut f32,
) -> EtendueStatus {
    if n == 0 {
        return EtendueStatus::Ok;
    }
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        let (Some(u), Some(w)) = (columns(u), outputs(w)) else { return EtendueStatus::NullPointer };
        EtendueProjectedImage::with(image, |image| (Batch::new().warp_functions().sample)(image, n, vec2(u), &w))
    }
}

/// The pdf of each unit direction, in columns.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_projected_image_pdf_batch(
    image: *const EtendueProjectedImage,
    n: usize,
    w: *const *const f32,
    out: *mut f32,
) -> EtendueStatus {
    if n == 0 {
        return EtendueStatus::Ok;
    }
    refuse_null!(out);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        let Some(w) = columns(w) else { return EtendueStatus::NullPointer };
        EtendueProjectedImage::with(image, |image| (Batch::new().warp_functions().pdf)(image, n, &w, out))
    }
}

/// The random numbers of each unit direction, in columns.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_projected_image_invert_batch(
    image: *const EtendueProjectedImage,
    n: usize,
    w: *const *const f32,
    u: *const *mut f32,
) -> EtendueStatus {
    if n == 0 {
        return EtendueStatus::Ok;
    }
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        let (Some(w), Some(u)) = (columns(w), outputs(u)) else { return EtendueStatus::NullPointer };
        EtendueProjectedImage::with(image, |image| (Batch::new().warp_functions().invert)(image, n, &w, vec2(u)))
    }
}
