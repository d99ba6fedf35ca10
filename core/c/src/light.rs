//! Lights.

use crate::{EtendueStatus, columns, each, each_mut, outputs, refuse_null};
use core::mem::{align_of, size_of};
use core::ptr::null_mut;
use etendue::light;
use etendue::{Vec2, Vec3};
use etendue_batch::{Batch, BatchSampler, BatchTechnique, EvaluationColumns, SampleColumns, Views};

/// One sample of a light as seen from a shading point, or the point of a light that a ray hits.
///
/// The estimator of reflected radiance is f L cos(theta) weight, once a shadow ray along `direction` has reached `distance`.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub struct EtendueLightSample {
    /// Unit direction from the shading point to the light.
    pub direction: [f32; 3],
    /// Distance to the light along it, in the unit of the coordinates; FLT_MAX for lights at infinity.
    pub distance: f32,
    /// Probability density of the direction, per steradian (lines: per unit of their measure); 0 where there is no sample.
    pub pdf: f32,
    /// 1/pdf where there is a sample and the light emits towards the shading point, 0 elsewhere.
    pub weight: f32,
    /// Unit normal of the light at the sampled point. Not meaningful where the pdf is 0.
    pub normal: [f32; 3],
    /// Surface coordinates of the sampled point in [0, 1]^2, for textures: of a triangle, the barycentric coordinates of its second and
    /// third vertex. Not meaningful where the pdf is 0.
    pub uv: [f32; 2],
    /// 1 where the shading point is on the side of the light that emits, which is the side of the normal, else 0.
    pub emits: u8,
}

/// Columns of samples, each NULL or of as many elements as the batch has. The fields are those of [`EtendueLightSample`].
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueSampleColumns {
    /// Unit direction from the shading point to the light.
    pub direction: [*mut f32; 3],
    /// Distance to the light along it, in the unit of the coordinates.
    pub distance: *mut f32,
    /// Probability density of the direction, per steradian; 0 where there is no sample.
    pub pdf: *mut f32,
    /// 1/pdf where there is a sample and the light emits towards the shading point, 0 elsewhere.
    pub weight: *mut f32,
    /// Unit normal of the light at the sampled point.
    pub normal: [*mut f32; 3],
    /// Surface coordinates of the sampled point.
    pub uv: [*mut f32; 2],
    /// 1 where the shading point is on the side of the light that emits, else 0.
    pub emits: *mut u8,
}

impl EtendueSampleColumns {
    pub(crate) fn columns(&self) -> SampleColumns {
        let Self { direction, distance, pdf, weight, normal, uv, emits } = *self;
        SampleColumns { direction, distance, pdf, weight, normal, uv, emits }
    }
}

impl EtendueLightSample {
    /// The fields of one sample as columns of one element.
    pub(crate) unsafe fn columns(this: *mut Self) -> SampleColumns {
        // SAFETY: the caller's memory has room for a sample
        unsafe {
            SampleColumns {
                direction: each_mut((&raw mut (*this).direction).cast()),
                distance: &raw mut (*this).distance,
                pdf: &raw mut (*this).pdf,
                weight: &raw mut (*this).weight,
                normal: each_mut((&raw mut (*this).normal).cast()),
                uv: each_mut((&raw mut (*this).uv).cast()),
                emits: &raw mut (*this).emits,
            }
        }
    }
}

pub(crate) fn vec3<T>([x, y, z]: [T; 3]) -> Vec3<T> {
    Vec3::new(x, y, z)
}
pub(crate) fn vec2<T>([x, y]: [T; 2]) -> Vec2<T> {
    Vec2::new(x, y)
}

/// Columns of which none is wanted.
const NOTHING: EvaluationColumns = EvaluationColumns { pdf: null_mut(), u: [null_mut(); 2], hit: NO_SAMPLES };
const NO_SAMPLES: SampleColumns = SampleColumns {
    direction: [null_mut(); 3],
    distance: null_mut(),
    pdf: null_mut(),
    weight: null_mut(),
    normal: [null_mut(); 3],
    uv: [null_mut(); 2],
    emits: null_mut(),
};

/// A struct of this interface that holds a prepared light, or a light that is the same for all shading points.
pub(crate) trait Sampler {
    /// The core's sampler.
    type Core: BatchSampler;
    /// Calls `f` with the core's sampler, unless the pointer is null or the struct is not valid.
    unsafe fn with(this: *const Self, f: impl FnOnce(&Self::Core)) -> EtendueStatus;
}
pub(crate) unsafe fn with<S: Sampler>(sampler: *const S, f: impl FnOnce(&S::Core)) -> EtendueStatus {
    // SAFETY: the caller's
    unsafe { S::with(sampler, f) }
}

/// What is done with a sampler.
macro_rules! sampler_functions {
    ($sampler:ident, $module:ident) => {
        /// Draws a direction for u.
        #[unsafe(export_name = concat!("etendue_", stringify!($module), "_sample"))]
        pub unsafe extern "C" fn sample(
            sampler: *const $sampler,
            u: *const f32,
            out: *mut EtendueLightSample,
        ) -> EtendueStatus {
            refuse_null!(u, out);
            // SAFETY: the pointers are not null, and point to what the header says
            unsafe {
                let out = EtendueLightSample::columns(out);
                with(sampler, |sampler| (Batch::new().sampler().sample)(sampler, 1, vec2(each(u)), &out))
            }
        }
        /// The pdf with which a unit direction `w` is drawn; 0 where it misses the light, and if a pointer is NULL.
        #[unsafe(export_name = concat!("etendue_", stringify!($module), "_pdf"))]
        pub unsafe extern "C" fn pdf(sampler: *const $sampler, w: *const f32) -> f32 {
            let mut pdf = 0.0;
            if !w.is_null() {
                // SAFETY: the pointers are not null, and point to what the header says
                unsafe { with(sampler, |sampler| (Batch::new().sampler().pdf)(sampler, 1, vec3(each(w)), &mut pdf)) };
            }
            pdf
        }
        /// The random numbers `u` that are mapped to a unit direction `w`; any in [0, 1)^2 where it misses the light.
        #[unsafe(export_name = concat!("etendue_", stringify!($module), "_invert"))]
        pub unsafe extern "C" fn invert(sampler: *const $sampler, w: *const f32, u: *mut f32) -> EtendueStatus {
            refuse_null!(w, u);
            // SAFETY: the pointers are not null, and point to what the header says
            unsafe {
                with(sampler, |sampler| (Batch::new().sampler().invert)(sampler, 1, vec3(each(w)), vec2(each_mut(u))))
            }
        }
        /// The nearest point of the light in a unit direction `w`, with the pdf of that direction; pdf 0 where it misses the light.
        #[unsafe(export_name = concat!("etendue_", stringify!($module), "_hit"))]
        pub unsafe extern "C" fn hit(
            sampler: *const $sampler,
            w: *const f32,
            out: *mut EtendueLightSample,
        ) -> EtendueStatus {
            refuse_null!(w, out);
            // SAFETY: the pointers are not null, and point to what the header says
            unsafe {
                let out = EtendueLightSample::columns(out);
                with(sampler, |sampler| (Batch::new().sampler().hit)(sampler, 1, vec3(each(w)), &out))
            }
        }
        /// Draws a direction for each u: two columns.
        #[unsafe(export_name = concat!("etendue_", stringify!($module), "_sample_batch"))]
        pub unsafe extern "C" fn sample_batch(
            sampler: *const $sampler,
            n: usize,
            u: *const *const f32,
            out: *const EtendueSampleColumns,
        ) -> EtendueStatus {
            if n == 0 {
                return EtendueStatus::Ok;
            }
            refuse_null!(out);
            // SAFETY: the pointers are not null, and point to what the header says
            unsafe {
                let Some(u) = columns(u) else { return EtendueStatus::NullPointer };
                with(sampler, |sampler| (Batch::new().sampler().sample)(sampler, n, vec2(u), &(*out).columns()))
            }
        }
        /// The pdf of each unit direction: three columns.
        #[unsafe(export_name = concat!("etendue_", stringify!($module), "_pdf_batch"))]
        pub unsafe extern "C" fn pdf_batch(
            sampler: *const $sampler,
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
                with(sampler, |sampler| (Batch::new().sampler().pdf)(sampler, n, vec3(w), out))
            }
        }
        /// The random numbers of each unit direction: three columns in, two out.
        #[unsafe(export_name = concat!("etendue_", stringify!($module), "_invert_batch"))]
        pub unsafe extern "C" fn invert_batch(
            sampler: *const $sampler,
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
                with(sampler, |sampler| (Batch::new().sampler().invert)(sampler, n, vec3(w), vec2(u)))
            }
        }
        /// The nearest point of the light in each unit direction: three columns.
        #[unsafe(export_name = concat!("etendue_", stringify!($module), "_hit_batch"))]
        pub unsafe extern "C" fn hit_batch(
            sampler: *const $sampler,
            n: usize,
            w: *const *const f32,
            out: *const EtendueSampleColumns,
        ) -> EtendueStatus {
            if n == 0 {
                return EtendueStatus::Ok;
            }
            refuse_null!(out);
            // SAFETY: the pointers are not null, and point to what the header says
            unsafe {
                let Some(w) = columns(w) else { return EtendueStatus::NullPointer };
                with(sampler, |sampler| (Batch::new().sampler().hit)(sampler, n, vec3(w), &(*out).columns()))
            }
        }
    };
}
pub(crate) use sampler_functions;

/// The struct of a technique's sampler, and its functions, in a module of their own.
macro_rules! technique {
    // the sampler of another light
    ($(#[$doc:meta])* $type:ty, $light:ident, $columns:ident, $place:tt) => {};
    ($(#[$doc:meta])* $type:ty, $light:ident, $columns:ident, (p, n), $sampler:ident[$size:literal], $module:ident) => {
        technique!(@ $(#[$doc])* $sampler[$size] = $type, $light, $columns, (n: normals), $module);
    };
    ($(#[$doc:meta])* $type:ty, $light:ident, $columns:ident, $place:tt, $sampler:ident[$size:literal], $module:ident) => {
        technique!(@ $(#[$doc])* $sampler[$size] = $type, $light, $columns, (), $module);
    };
    (@ $(#[$doc:meta])* $sampler:ident[$size:literal] = $type:ty, $light:ident, $columns:ident,
     ($($n:ident: $normals:ident)?), $module:ident) => {
        $(#[$doc])*
        ///
        /// What is inside does not concern callers: it may be copied, and used by any thread.
        #[derive(Clone, Copy, Debug)]
        #[repr(C)]
        pub struct $sampler {
            data: [f32; $size],
        }
        const _: () = assert!(size_of::<$type>() == size_of::<$sampler>() && align_of::<$type>() <= align_of::<$sampler>());

        impl Sampler for $sampler {
            type Core = $type;
            #[inline(always)]
            unsafe fn with(this: *const Self, f: impl FnOnce(&$type)) -> EtendueStatus {
                refuse_null!(this);
                // SAFETY: `prepare` wrote it
                f(unsafe { &*this.cast() });
                EtendueStatus::Ok
            }
        }

        #[doc = concat!("The functions of [`", stringify!($sampler), "`]: their names in C begin with `etendue_", stringify!($module), "_`.")]
        pub mod $module {
            use super::*;

            /// Prepares the light for a shading point.
            #[unsafe(export_name = concat!("etendue_", stringify!($module), "_prepare"))]
            pub unsafe extern "C" fn prepare(light: *const $light, p: *const f32, $($n: *const f32,)? out: *mut $sampler) -> EtendueStatus {
                refuse_null!(light, p, $($n,)? out);
                #[allow(unused_mut, unused_assignments)]
                let mut normal = Vec3::new(0.0, 0.0, 0.0);
                // SAFETY: the pointers are not null, and point to what the header says
                unsafe {
                    $(normal = vec3($n.cast::<[f32; 3]>().read_unaligned());)?
                    let p = vec3(p.cast::<[f32; 3]>().read_unaligned());
                    out.cast::<$type>().write(Batch::new().prepare::<$type>(&*light.cast(), p, normal));
                }
                EtendueStatus::Ok
            }
            sampler_functions!($sampler, $module);
            /// Prepares the light for a shading point and draws one direction.
            #[unsafe(export_name = concat!("etendue_", stringify!($module), "_sample_once"))]
            pub unsafe extern "C" fn sample_once(
                light: *const $light, p: *const f32, $($n: *const f32,)? u: *const f32, out: *mut EtendueLightSample,
            ) -> EtendueStatus {
                refuse_null!(light, p, $($n,)? u, out);
                let mut sampler = core::mem::MaybeUninit::<$sampler>::uninit();
                // SAFETY: the pointers are not null, and point to what the header says; `prepare` writes the sampler
                unsafe {
                    prepare(light, p, $($n,)? sampler.as_mut_ptr());
                    sample(sampler.as_ptr(), u, out)
                }
            }
            /// Prepares a light of its own for each shading point, and draws a direction for each u: all in columns.
            #[unsafe(export_name = concat!("etendue_", stringify!($module), "_sample_each"))]
            pub unsafe extern "C" fn sample_each(
                lights: *const $columns, n: usize, p: *const *const f32, $($normals: *const *const f32,)? u: *const *const f32,
                out: *const EtendueSampleColumns,
            ) -> EtendueStatus {
                if n == 0 {
                    return EtendueStatus::Ok;
                }
                refuse_null!(lights, out);
                // SAFETY: the pointers are not null, and point to what the header says
                unsafe {
                    let (Some(views), Some(u)) = (views(lights, p, $($normals,)?), columns(u)) else {
                        return EtendueStatus::NullPointer;
                    };
                    (Batch::new().functions::<$type>().sample_each)(&views, n, vec2(u), &(*out).columns());
                }
                EtendueStatus::Ok
            }
            /// The pdf of a unit direction for each shading point, towards a light of its own: all in columns.
            #[unsafe(export_name = concat!("etendue_", stringify!($module), "_pdf_each"))]
            pub unsafe extern "C" fn pdf_each(
                lights: *const $columns, n: usize, p: *const *const f32, $($normals: *const *const f32,)? w: *const *const f32,
                out: *mut f32,
            ) -> EtendueStatus {
                if n == 0 {
                    return EtendueStatus::Ok;
                }
                refuse_null!(lights, out);
                // SAFETY: the pointers are not null, and point to what the header says
                unsafe { evaluate_each(lights, n, p, $($normals,)? w, &EvaluationColumns { pdf: out, ..NOTHING }) }
            }
            /// The random numbers of a unit direction for each shading point, towards a light of its own: all in columns.
            #[unsafe(export_name = concat!("etendue_", stringify!($module), "_invert_each"))]
            pub unsafe extern "C" fn invert_each(
                lights: *const $columns, n: usize, p: *const *const f32, $($normals: *const *const f32,)? w: *const *const f32,
                u: *const *mut f32,
            ) -> EtendueStatus {
                if n == 0 {
                    return EtendueStatus::Ok;
                }
                refuse_null!(lights);
                // SAFETY: the pointers are not null, and point to what the header says
                unsafe {
                    let Some(u) = outputs(u) else { return EtendueStatus::NullPointer };
                    evaluate_each(lights, n, p, $($normals,)? w, &EvaluationColumns { u, ..NOTHING })
                }
            }
            /// The nearest point of a light of its own for each shading point in a unit direction: all in columns.
            #[unsafe(export_name = concat!("etendue_", stringify!($module), "_hit_each"))]
            pub unsafe extern "C" fn hit_each(
                lights: *const $columns, n: usize, p: *const *const f32, $($normals: *const *const f32,)? w: *const *const f32,
                out: *const EtendueSampleColumns,
            ) -> EtendueStatus {
                if n == 0 {
                    return EtendueStatus::Ok;
                }
                refuse_null!(lights, out);
                // SAFETY: the pointers are not null, and point to what the header says
                unsafe { evaluate_each(lights, n, p, $($normals,)? w, &EvaluationColumns { hit: (*out).columns(), ..NOTHING }) }
            }
            unsafe fn evaluate_each(
                lights: *const $columns, n: usize, p: *const *const f32, $($normals: *const *const f32,)? w: *const *const f32,
                out: &EvaluationColumns,
            ) -> EtendueStatus {
                // SAFETY: the caller's
                unsafe {
                    let (Some(views), Some(w)) = (views(lights, p, $($normals,)?), columns(w)) else {
                        return EtendueStatus::NullPointer;
                    };
                    (Batch::new().functions::<$type>().evaluate_each)(&views, n, vec3(w), out);
                }
                EtendueStatus::Ok
            }
            /// What the columns point to, unless one is missing.
            unsafe fn views(
                lights: *const $columns, p: *const *const f32, $($normals: *const *const f32,)?
            ) -> Option<Views<$type>> {
                // SAFETY: the caller's pointers are null or point to what the header says
                unsafe {
                    let (lights, points, there) = (lights.cast::<<$type as BatchTechnique>::Light<*const f32>>(), columns(p)?, (*lights).all_there());
                    #[allow(unused_variables)]
                    let normals = Vec3::new(core::ptr::null::<f32>(), core::ptr::null(), core::ptr::null());
                    $(let normals = vec3(columns($normals)?);)?
                    there.then(|| Views { lights: *lights, points: vec3(points), normals })
                }
            }
        }
    };
}

/// The type of a light's field whose numbers are of a type.
macro_rules! field {
    (number $type:ty) => {
        $type
    };
    (corners $type:ty) => {
        [[$type; 3]; 8]
    };
    ($vector:ident $type:ty) => {
        [$type; 3]
    };
}

/// The structs of all lights, whose fields are those of the core's, and the functions of their techniques.
macro_rules! lights {
    ($(
        $(#[$light_doc:meta])* $light:ident $([$corners:literal])? = $name:ident, $columns:ident {
            $($(#[$field_doc:meta])* $field:ident as $argument:ident: $kind:ident,)+
        } by $default:literal {
            $(
                $(#[$doc:meta])* $sampler:ident $([$n:literal])?
                    $(= $sampler_name:ident, $technique:ident[$size:literal])?: $by:ident $place:tt $($measure:ident)?;
            )+
        }
    )+) => {$(
        $(#[$light_doc])*
        #[derive(Clone, Copy, Debug)]
        #[repr(C)]
        pub struct $name {
            $($(#[$field_doc])* pub $field: field!($kind f32),)+
        }
        /// Columns of lights: the fields are those of the light.
        #[derive(Clone, Copy, Debug)]
        #[repr(C)]
        pub struct $columns {
            $($(#[$field_doc])* pub $field: field!($kind *const f32),)+
        }
        impl $columns {
            fn all_there(&self) -> bool {
                // SAFETY: the struct consists of pointers
                let pointers = unsafe {
                    core::slice::from_raw_parts((&raw const *self).cast::<*const f32>(), size_of::<Self>() / size_of::<*const f32>())
                };
                !pointers.iter().any(|column| column.is_null())
            }
        }
        const _: () = assert!(size_of::<$name>() == size_of::<light::$light<f32 $(, $corners)?>>());
        const _: () = assert!(size_of::<$columns>() == size_of::<light::$light<*const f32 $(, $corners)?>>());
        $(technique!(
            $(#[$doc])* light::$sampler<f32 $(, $n)?>, $name, $columns, $place $(, $sampler_name[$size], $technique)?
        );)+
    )+};
}

etendue::techniques!(lights! {});
