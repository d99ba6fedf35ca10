//! The functions of all techniques, which are given by their numbers.

use crate::environment::EtendueImageEnvironment;
use crate::list::{self, EtendueTechnique, WITHOUT_MEMORY};
use crate::memory::{are_there, columns, count_of, outputs, refuse_null, refuse_outside, skip_empty, vec2, vec3};
use crate::picture::{EtenduePicture, EtenduePicturedParallelogramColumns, EtenduePicturedSphereColumns};
use crate::portal::EtenduePortalEnvironment;
use crate::sample::{EtendueLightSample, EtendueSampleColumns};
use crate::status::EtendueStatus;
use core::ffi::c_void;
use core::mem::size_of;
use etendue_batch::{Batch, EvaluationColumns, Evaluations, SamplerFunctions, TechniqueFunctions, Views};

/// Numbers of techniques with memory.
const PICTURES: core::ops::Range<usize> =
    EtendueTechnique::PictureByArea as usize..EtendueTechnique::PortalsByRadiance as usize;
const PORTALS: usize = EtendueTechnique::PortalsByRadiance as usize;

/// Whether the memory with which a light, columns of it or its sampler begin is one that the library can look into.
#[inline(always)]
unsafe fn memory(technique: usize, light: *const c_void) -> EtendueStatus {
    if technique < WITHOUT_MEMORY {
        return EtendueStatus::Ok;
    }
    // SAFETY: the caller's pointer is to a struct of this technique
    unsafe {
        if PICTURES.contains(&technique) {
            light.cast::<EtenduePicture>().read().status()
        } else if technique == PORTALS {
            light.cast::<EtenduePortalEnvironment>().read().status()
        } else {
            light.cast::<EtendueImageEnvironment>().read().status()
        }
    }
}
/// Returns the status of a light's memory, unless it is fine.
macro_rules! refuse_memory {
    ($technique:expr, $light:expr) => {
        match memory($technique as usize, $light.cast()) {
            EtendueStatus::Ok => {}
            status => return status,
        }
    };
}
/// The functions of a technique that a method of [`Batch`] returns, or a status.
macro_rules! functions {
    ($method:ident, $technique:expr) => {
        match Batch::new().$method($technique as usize) {
            Some(functions) => functions,
            None => return EtendueStatus::Value,
        }
    };
}
/// Whether what a light is prepared for is there, where the technique takes it.
fn is_given(technique: u32, with: *const c_void) -> bool {
    !with.is_null() || list::columns_of(technique as usize).1 == 0
}

/// Prepares a light for a shading point.
///
/// `light` is the struct of the light of the technique. `with` is what it is prepared for beside the point: the unit normal there (three numbers)
/// by projected solid angle, or an EtendueReflection by reflection; else it may be NULL. `sampler` is the struct of the technique. Returns ETENDUE_STATUS_VALUE for a technique that is none, or that this library was built without.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_prepare(
    technique: u32,
    light: *const c_void,
    p: *const f32,
    with: *const c_void,
    sampler: *mut c_void,
) -> EtendueStatus {
    refuse_null!(light, p, sampler);
    let functions = functions!(technique_to_prepare, technique);
    if !is_given(technique, with) {
        return EtendueStatus::NullPointer;
    }
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        refuse_memory!(technique, light);
        (functions.prepare)(light, p, with, sampler);
    }
    EtendueStatus::Ok
}
/// Calls `f` with the functions for one element of what begins with `from`: a light, which is prepared for `with`, or a sampler, which needs no more
/// and stands for both.
#[inline(always)]
unsafe fn one(
    technique: u32,
    from: *const c_void,
    with: *const c_void,
    f: impl FnOnce(&TechniqueFunctions),
) -> EtendueStatus {
    let functions = functions!(technique_of_one, technique);
    if !is_given(technique, with) {
        return EtendueStatus::NullPointer;
    }
    // SAFETY: the caller's pointer is to a struct of this technique
    unsafe { refuse_memory!(technique, from) };
    f(functions);
    EtendueStatus::Ok
}
/// Draws a direction from a prepared light, for u. Returns ETENDUE_STATUS_VALUE for a number that is not in [0, 1).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_sample(
    technique: u32,
    sampler: *const c_void,
    u: *const f32,
    out: *mut EtendueLightSample,
) -> EtendueStatus {
    refuse_null!(sampler, u, out);
    refuse_outside!(u, 2);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe { one(technique, sampler, sampler, |functions| (functions.sampler.one_sample)(sampler, u, out.cast())) }
}
/// The pdf with which a prepared light draws a unit direction `w`; 0 where it misses the light, and where the function cannot work.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_pdf(technique: u32, sampler: *const c_void, w: *const f32) -> f32 {
    let mut pdf = 0.0;
    if !sampler.is_null() && !w.is_null() {
        // SAFETY: the pointers are not null, and point to what the header says
        unsafe { one(technique, sampler, sampler, |functions| pdf = (functions.sampler.one_pdf)(sampler, w)) };
    }
    pdf
}
/// The random numbers `u` that a prepared light maps to a unit direction `w`; any in [0, 1)^2 where it misses the light.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_invert(
    technique: u32,
    sampler: *const c_void,
    w: *const f32,
    u: *mut f32,
) -> EtendueStatus {
    refuse_null!(sampler, w, u);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe { one(technique, sampler, sampler, |functions| (functions.sampler.one_invert)(sampler, w, u)) }
}
/// The nearest point of a prepared light in a unit direction `w`, with the pdf of that direction; pdf 0 where it misses the light.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_hit(
    technique: u32,
    sampler: *const c_void,
    w: *const f32,
    out: *mut EtendueLightSample,
) -> EtendueStatus {
    refuse_null!(sampler, w, out);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe { one(technique, sampler, sampler, |functions| (functions.sampler.one_hit)(sampler, w, out.cast())) }
}
/// Calls `f` with the functions of a prepared light and with columns of what they read; it returns `None` where a column that it needs is null.
unsafe fn batch<const N: usize>(
    technique: u32,
    sampler: *const c_void,
    n: usize,
    read: *const *const f32,
    f: impl FnOnce(&SamplerFunctions, [*const f32; N]) -> Option<()>,
) -> EtendueStatus {
    skip_empty!(n);
    refuse_null!(sampler);
    let functions = functions!(technique, technique);
    // SAFETY: the pointers are null, or point to what the header says
    unsafe {
        let Some(read) = columns(read) else { return EtendueStatus::NullPointer };
        refuse_memory!(technique, sampler);
        f(&functions.sampler, read).map_or(EtendueStatus::NullPointer, |()| EtendueStatus::Ok)
    }
}
/// Draws a direction from a prepared light for each u: two columns. The numbers are not asked whether they are in [0, 1): where one is NaN, the pdf
/// is 0 unless the technique does not use it; where one is outside, the sample has no meaning, and may have numbers that are not finite.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_sample_batch(
    technique: u32,
    sampler: *const c_void,
    n: usize,
    u: *const *const f32,
    out: *const EtendueSampleColumns,
) -> EtendueStatus {
    // SAFETY: the pointers are null, or point to what the header says
    unsafe {
        batch(technique, sampler, n, u, |functions, u| {
            (functions.sample)(sampler, n, vec2(u), &out.as_ref()?.columns());
            Some(())
        })
    }
}
/// The pdf of each unit direction: three columns.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_pdf_batch(
    technique: u32,
    sampler: *const c_void,
    n: usize,
    w: *const *const f32,
    out: *mut f32,
) -> EtendueStatus {
    // SAFETY: the pointers are null, or point to what the header says
    unsafe {
        batch(technique, sampler, n, w, |functions, w| {
            (!out.is_null()).then(|| (functions.pdf)(sampler, n, vec3(w), out))
        })
    }
}
/// The random numbers of each unit direction: three columns in, two out.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_invert_batch(
    technique: u32,
    sampler: *const c_void,
    n: usize,
    w: *const *const f32,
    u: *const *mut f32,
) -> EtendueStatus {
    // SAFETY: the pointers are null, or point to what the header says
    unsafe {
        batch(technique, sampler, n, w, |functions, w| {
            (functions.invert)(sampler, n, vec3(w), vec2(outputs(u)?));
            Some(())
        })
    }
}
/// The nearest point of a prepared light in each unit direction: three columns.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_hit_batch(
    technique: u32,
    sampler: *const c_void,
    n: usize,
    w: *const *const f32,
    out: *const EtendueSampleColumns,
) -> EtendueStatus {
    // SAFETY: the pointers are null, or point to what the header says
    unsafe {
        batch(technique, sampler, n, w, |functions, w| {
            (functions.hit)(sampler, n, vec3(w), &out.as_ref()?.columns());
            Some(())
        })
    }
}

/// Where the columns of a light begin in its struct, and how many there are.
fn columns_of(technique: usize) -> (usize, usize) {
    let panel = count_of::<EtenduePicturedParallelogramColumns>();
    let pictured = [panel, panel, panel, count_of::<EtenduePicturedSphereColumns>()];
    if PICTURES.contains(&technique) {
        let first = size_of::<EtenduePicture>() / size_of::<*const f32>();
        (first, pictured[technique - PICTURES.start] - first)
    } else {
        (0, list::columns_of(technique).0)
    }
}
/// Calls `f` with lights, shading points and what they are prepared for in columns, of which none may be null.
unsafe fn with_views(
    technique: u32,
    lights: *const c_void,
    p: *const *const f32,
    with: *const c_void,
    f: impl FnOnce(&TechniqueFunctions, &Views),
) -> EtendueStatus {
    refuse_null!(lights);
    let functions = functions!(technique_of_each, technique);
    let ((first, count), withs) = (columns_of(technique as usize), list::columns_of(technique as usize).1);
    // SAFETY: the caller's pointers are null or point to what the header says
    unsafe {
        let Some(points) = columns(p) else { return EtendueStatus::NullPointer };
        if !are_there(lights.cast::<*const f32>().add(first), count) || !are_there(with.cast(), withs) {
            return EtendueStatus::NullPointer;
        }
        refuse_memory!(technique, lights);
        f(functions, &Views { lights, points: vec3(points), with });
    }
    EtendueStatus::Ok
}
/// Prepares a light of its own for each shading point, and draws a direction for each u: all in columns. `lights` is the struct of columns of the
/// technique's light. `with` is what etendue_prepare takes, in columns: an array of three pointers to coordinates of unit normals, an
/// EtendueReflectionColumns, or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_sample_each(
    technique: u32,
    lights: *const c_void,
    n: usize,
    p: *const *const f32,
    with: *const c_void,
    u: *const *const f32,
    out: *const EtendueSampleColumns,
) -> EtendueStatus {
    skip_empty!(n);
    refuse_null!(out);
    // SAFETY: the pointers are null, or point to what the header says
    unsafe {
        let Some(u) = columns(u) else { return EtendueStatus::NullPointer };
        with_views(technique, lights, p, with, |functions, views| {
            (functions.sample_each)(views, n, vec2(u), &(*out).columns());
        })
    }
}
/// Evaluates a light of its own for each direction.
unsafe fn evaluate_each(
    technique: u32,
    lights: *const c_void,
    n: usize,
    p: *const *const f32,
    with: *const c_void,
    w: *const *const f32,
    out: Option<EvaluationColumns>,
) -> EtendueStatus {
    skip_empty!(n);
    // SAFETY: the caller's
    unsafe {
        let (Some(w), Some(out)) = (columns(w), out) else { return EtendueStatus::NullPointer };
        with_views(technique, lights, p, with, |functions, views| (functions.evaluate_each)(views, n, vec3(w), &out))
    }
}
/// The pdf of a unit direction for each shading point, towards a light of its own: all in columns, as etendue_sample_each takes them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_pdf_each(
    technique: u32,
    lights: *const c_void,
    n: usize,
    p: *const *const f32,
    with: *const c_void,
    w: *const *const f32,
    out: *mut f32,
) -> EtendueStatus {
    let wanted = (!out.is_null()).then_some(EvaluationColumns { pdf: out, ..Evaluations::default().columns(0) });
    // SAFETY: the pointers are null, or point to what the header says
    unsafe { evaluate_each(technique, lights, n, p, with, w, wanted) }
}
/// The random numbers of a unit direction for each shading point, towards a light of its own: all in columns.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_invert_each(
    technique: u32,
    lights: *const c_void,
    n: usize,
    p: *const *const f32,
    with: *const c_void,
    w: *const *const f32,
    u: *const *mut f32,
) -> EtendueStatus {
    // SAFETY: the pointers are null, or point to what the header says
    unsafe {
        let wanted = if n == 0 {
            None
        } else {
            outputs(u).map(|u| EvaluationColumns { u, ..Evaluations::default().columns(0) })
        };
        evaluate_each(technique, lights, n, p, with, w, wanted)
    }
}
/// The nearest point of a light of its own for each shading point in a unit direction: all in columns.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_hit_each(
    technique: u32,
    lights: *const c_void,
    n: usize,
    p: *const *const f32,
    with: *const c_void,
    w: *const *const f32,
    out: *const EtendueSampleColumns,
) -> EtendueStatus {
    // SAFETY: the pointers are null, or point to what the header says
    unsafe {
        let is_wanted = n > 0 && !out.is_null();
        let wanted =
            is_wanted.then(|| EvaluationColumns { hit: (*out).columns(), ..Evaluations::default().columns(0) });
        evaluate_each(technique, lights, n, p, with, w, wanted)
    }
}
