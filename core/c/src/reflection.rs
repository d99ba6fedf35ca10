//! The light that rough surfaces reflect.

use crate::memory::{columns, each, map, refuse_null, skip_empty, vec3};
use crate::status::EtendueStatus;
use core::mem::size_of;
use etendue::reflection::Reflection;
use etendue_batch::{Batch, ReflectedSphere};

/// The lobe of a GGX surface of the same roughness in all directions, seen from one direction: a cosine after a linear map of directions, which
/// keeps the horizon. It is a warp from random numbers to directions above the surface, with the pdf of the fit per steradian, and lights are
/// prepared for it `by_reflection`. Of light from all directions alike it reflects albedo (F0 + (1 - F0) schlick), with the reflectance F0 at
/// normal incidence.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueReflection {
    /// What is inside does not concern callers.
    pub data: [f32; 14],
    /// The part of light from all directions alike that the surface reflects with a Fresnel factor of 1, in [0, 1].
    pub albedo: f32,
    /// The mean of Schlick's weight (1 - v·m)^5 over the lobe, in [0, 1].
    pub schlick: f32,
}
const _: () = assert!(size_of::<EtendueReflection>() == size_of::<Reflection<f32>>());

/// Columns of reflections: the fields are those of [`EtendueReflection`].
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueReflectionColumns {
    /// What is inside does not concern callers.
    pub data: [*mut f32; 14],
    /// The part of light from all directions alike that the surface reflects with a Fresnel factor of 1, in [0, 1].
    pub albedo: *mut f32,
    /// The mean of Schlick's weight (1 - v·m)^5 over the lobe, in [0, 1].
    pub schlick: *mut f32,
}
const _: () = assert!(size_of::<EtendueReflectionColumns>() == size_of::<Reflection<*mut f32>>());

/// Prepares the reflection of a surface of this roughness alpha, taken to be from 3e-4 to 1, with the unit normal n, towards the viewer in the
/// unit direction view. A view below the horizon counts as one on the horizon, and has albedo 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_reflection_prepare(
    alpha: f32,
    n: *const f32,
    view: *const f32,
    out: *mut EtendueReflection,
) -> EtendueStatus {
    refuse_null!(n, view, out);
    // SAFETY: the pointers are not null, and point to what the header says; the struct holds the core's
    unsafe {
        let [n, view] = [n, view].map(|v| vec3(v.cast::<[f32; 3]>().read_unaligned()));
        out.cast::<Reflection<f32>>().write(Reflection::new(alpha, n, view));
    }
    EtendueStatus::Ok
}

/// Prepares a reflection for each roughness, unit normal and unit direction to the viewer: all in columns. Lights are prepared for all columns of
/// `out`, of which any may be NULL here.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_reflection_prepare_batch(
    n: usize,
    alphas: *const f32,
    normals: *const *const f32,
    views: *const *const f32,
    out: *const EtendueReflectionColumns,
) -> EtendueStatus {
    skip_empty!(n);
    refuse_null!(alphas, out);
    // SAFETY: the pointers are not null, and point to what the header says; the struct has the fields of the core's
    unsafe {
        let (Some(normals), Some(views)) = (columns(normals), columns(views)) else {
            return EtendueStatus::NullPointer;
        };
        Batch::new().reflections_function()(n, alphas, vec3(normals), vec3(views), &*out.cast());
    }
    EtendueStatus::Ok
}

/// The projected solid angle after the map, in [0, pi], of the part above the horizon of a sphere with this centre relative to the point: about
/// pi times the part of the lobe that the sphere covers. 0 for a radius <= 0 and if a pointer is NULL, and pi from inside.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_reflection_sphere(
    reflection: *const EtendueReflection,
    center: *const f32,
    radius: f32,
) -> f32 {
    let mut found = 0.0;
    if !reflection.is_null() && !center.is_null() {
        // SAFETY: the pointers are not null, and point to what the header says
        unsafe { spheres(reflection, 1, each(center), &radius, &mut found) };
    }
    found
}

/// The projected solid angle after the map of each sphere, with centres in three columns, relative to the point, and radii in one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_reflection_sphere_batch(
    reflection: *const EtendueReflection,
    n: usize,
    centers: *const *const f32,
    radii: *const f32,
    out: *mut f32,
) -> EtendueStatus {
    skip_empty!(n);
    refuse_null!(reflection, radii, out);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        let Some(centers) = columns(centers) else { return EtendueStatus::NullPointer };
        spheres(reflection, n, centers, radii, out);
    }
    EtendueStatus::Ok
}

unsafe fn spheres(
    reflection: *const EtendueReflection,
    n: usize,
    [x, y, z]: [*const f32; 3],
    radii: *const f32,
    out: *mut f32,
) {
    // SAFETY: the caller's
    unsafe { map(reflection.cast::<ReflectedSphere>(), n, [x, y, z, radii, x, x], out) };
}
