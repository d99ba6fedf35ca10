//! Samples, and what is done with prepared lights.

use crate::{EtendueStatus, columns, outputs, refuse_null};
use core::mem::size_of;
use core::ptr::{null, null_mut};
use etendue::{Vec2, Vec3};
use etendue_batch::{Batch, BatchSampler, BatchTechnique, EvaluationColumns, OneSample, SampleColumns, Views};

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

/// The fields of both samples are at the same places.
const _: () = {
    use core::mem::offset_of;
    assert!(size_of::<EtendueLightSample>() == size_of::<OneSample>());
    assert!(offset_of!(EtendueLightSample, direction) == offset_of!(OneSample, direction));
    assert!(offset_of!(EtendueLightSample, distance) == offset_of!(OneSample, distance));
    assert!(offset_of!(EtendueLightSample, pdf) == offset_of!(OneSample, pdf));
    assert!(offset_of!(EtendueLightSample, weight) == offset_of!(OneSample, weight));
    assert!(offset_of!(EtendueLightSample, normal) == offset_of!(OneSample, normal));
    assert!(offset_of!(EtendueLightSample, uv) == offset_of!(OneSample, uv));
    assert!(offset_of!(EtendueLightSample, emits) == offset_of!(OneSample, emits));
};

pub(crate) fn vec3<T>([x, y, z]: [T; 3]) -> Vec3<T> {
    Vec3::new(x, y, z)
}
pub(crate) fn vec2<T>([x, y]: [T; 2]) -> Vec2<T> {
    Vec2::new(x, y)
}
/// Three numbers in a row.
pub(crate) unsafe fn triple(numbers: *const f32) -> Vec3<f32> {
    // SAFETY: the caller's memory has them
    vec3(unsafe { numbers.cast::<[f32; 3]>().read_unaligned() })
}

/// Whether none of the pointers of which a struct of columns consists is null.
pub(crate) unsafe fn all_there<C>(columns: &C) -> bool {
    // SAFETY: the caller's struct consists of pointers
    let pointers = unsafe {
        core::slice::from_raw_parts(
            (&raw const *columns).cast::<*const f32>(),
            size_of::<C>() / size_of::<*const f32>(),
        )
    };
    !pointers.iter().any(|column| column.is_null())
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

/// A struct of this interface that holds a light prepared for a shading point by one technique.
pub(crate) trait Technique: Sampler<Core: BatchTechnique> {
    /// The struct of the light.
    type Light;
    /// The struct of columns of lights.
    type Columns;
    /// Prepares a light for the point `p` of a surface with the unit normal `n`, unless the struct is not valid.
    unsafe fn prepare(light: *const Self::Light, p: Vec3<f32>, n: Vec3<f32>, out: *mut Self) -> EtendueStatus;
    /// Calls `f` with the core's light, unless the struct is not valid.
    unsafe fn with_light(
        light: *const Self::Light,
        f: impl FnOnce(&<Self::Core as BatchTechnique>::Light<f32>),
    ) -> EtendueStatus;
    /// Calls `f` with columns of lights, unless one is missing or the struct is not valid.
    unsafe fn with_lights(
        lights: *const Self::Columns,
        f: impl FnOnce(<Self::Core as BatchTechnique>::Light<*const f32>),
    ) -> EtendueStatus;
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
            unsafe { with(sampler, |sampler| (Batch::new().one().sample)(sampler, u, out.cast())) }
        }
        /// The pdf with which a unit direction `w` is drawn; 0 where it misses the light, and if a pointer is NULL.
        #[unsafe(export_name = concat!("etendue_", stringify!($module), "_pdf"))]
        pub unsafe extern "C" fn pdf(sampler: *const $sampler, w: *const f32) -> f32 {
            let mut pdf = 0.0;
            if !w.is_null() {
                // SAFETY: the pointers are not null, and point to what the header says
                unsafe { with(sampler, |sampler| pdf = (Batch::new().one().pdf)(sampler, w)) };
            }
            pdf
        }
        /// The random numbers `u` that are mapped to a unit direction `w`; any in [0, 1)^2 where it misses the light.
        #[unsafe(export_name = concat!("etendue_", stringify!($module), "_invert"))]
        pub unsafe extern "C" fn invert(sampler: *const $sampler, w: *const f32, u: *mut f32) -> EtendueStatus {
            refuse_null!(w, u);
            // SAFETY: the pointers are not null, and point to what the header says
            unsafe { with(sampler, |sampler| (Batch::new().one().invert)(sampler, w, u)) }
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
            unsafe { with(sampler, |sampler| (Batch::new().one().hit)(sampler, w, out.cast())) }
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

/// Calls `f` with lights, shading points and normals in columns. Techniques that need no normals do not read them.
unsafe fn with_views<S: Technique>(
    lights: *const S::Columns,
    p: *const *const f32,
    normals: *const *const f32,
    f: impl FnOnce(&Views<S::Core>),
) -> EtendueStatus {
    refuse_null!(lights);
    // SAFETY: the caller's pointers are null or point to what the header says
    unsafe {
        let normals = if S::Core::ON_SURFACE { columns(normals) } else { Some([null(); 3]) };
        let (Some(points), Some(normals)) = (columns(p), normals) else { return EtendueStatus::NullPointer };
        S::with_lights(lights, |lights| f(&Views { lights, points: vec3(points), normals: vec3(normals) }))
    }
}
/// Draws a direction for each u, to a light of its own.
pub(crate) unsafe fn sample_lights<S: Technique>(
    lights: *const S::Columns,
    n: usize,
    p: *const *const f32,
    normals: *const *const f32,
    u: *const *const f32,
    out: *const EtendueSampleColumns,
) -> EtendueStatus {
    if n == 0 {
        return EtendueStatus::Ok;
    }
    refuse_null!(out);
    // SAFETY: the caller's
    unsafe {
        let Some(u) = columns(u) else { return EtendueStatus::NullPointer };
        with_views::<S>(lights, p, normals, |views| {
            (Batch::new().technique::<S::Core>().sample_each)(views, n, vec2(u), &(*out).columns());
        })
    }
}
/// Evaluates a light of its own for each direction.
pub(crate) unsafe fn evaluate_lights<S: Technique>(
    lights: *const S::Columns,
    n: usize,
    p: *const *const f32,
    normals: *const *const f32,
    w: *const *const f32,
    out: Option<EvaluationColumns>,
) -> EtendueStatus {
    if n == 0 {
        return EtendueStatus::Ok;
    }
    // SAFETY: the caller's
    unsafe {
        let (Some(w), Some(out)) = (columns(w), out) else { return EtendueStatus::NullPointer };
        with_views::<S>(lights, p, normals, |views| {
            (Batch::new().technique::<S::Core>().evaluate_each)(views, n, vec3(w), &out);
        })
    }
}
/// Columns for the pdf alone, for the random numbers alone, and for hits alone.
pub(crate) fn pdf_alone(pdf: *mut f32) -> Option<EvaluationColumns> {
    (!pdf.is_null()).then_some(EvaluationColumns { pdf, ..NOTHING })
}
pub(crate) unsafe fn numbers_alone(u: *const *mut f32) -> Option<EvaluationColumns> {
    // SAFETY: the caller's
    unsafe { outputs(u).map(|u| EvaluationColumns { u, ..NOTHING }) }
}
pub(crate) unsafe fn hits_alone(out: *const EtendueSampleColumns) -> Option<EvaluationColumns> {
    // SAFETY: the caller's
    (!out.is_null()).then(|| EvaluationColumns { hit: unsafe { (*out).columns() }, ..NOTHING })
}

/// A light and the reflection that it is prepared for, or columns of them.
#[derive(Clone, Copy)]
#[repr(C)]
pub(crate) struct Reflected<L, X> {
    light: L,
    reflection: X,
}

impl<L: Copy, X: Copy> Reflected<L, X> {
    /// None if a pointer is null.
    pub(crate) unsafe fn new(light: *const L, reflection: *const X) -> Option<Self> {
        // SAFETY: the caller's pointers are null or point to what the header says
        unsafe { Some(Self { light: *light.as_ref()?, reflection: *reflection.as_ref()? }) }
    }
}

/// A pdf of a light that is prepared for this call alone.
macro_rules! pdf_once {
    ($kind:ident $light:ident, $module:ident, $name:ident, $suffix:literal, $which:ident, ($($one:ident: $of_one:ty)?), $sampler:ident,
     $(#[$doc:meta])*) => {
        $(#[$doc])*
        #[unsafe(export_name = concat!("etendue_", stringify!($module), $suffix))]
        pub unsafe extern "C" fn $name(light: *const $light, p: *const f32, $($one: $of_one,)? w: *const f32) -> f32 {
            let mut pdf = 0.0;
            if !light.is_null() && !p.is_null() $(&& !$one.is_null())? && !w.is_null() {
                // SAFETY: the pointers are not null, and point to what the header says
                unsafe {
                    let normal = technique_functions!(@normal $kind p $(, $one)?);
                    <$sampler as Technique>::with_light(technique_functions!(@lights $kind light $(, $one)?), |light| {
                        pdf = (Batch::new().once::<<$sampler as Sampler>::Core>().$which)(light, p, normal.cast(), w);
                    });
                }
            }
            pdf
        }
    };
}
pub(crate) use pdf_once;

/// What is done with the sampler of a technique, and with lights of their own. `(n: normals)` is there if it needs the normal, and
/// `(reflection => reflections)` if it needs what a surface reflects.
macro_rules! technique_functions {
    ($sampler:ident, $light:ident, $columns:ident, $module:ident, ()) => {
        technique_functions!(anywhere $sampler, $light, $columns, $module, ());
    };
    ($sampler:ident, $light:ident, $columns:ident, $module:ident, ($n:ident: $normals:ident)) => {
        technique_functions!(surface $sampler, $light, $columns, $module, ($n: *const f32, $normals: *const *const f32));
    };
    ($sampler:ident, $light:ident, $columns:ident, $module:ident, ($one:ident => $many:ident)) => {
        technique_functions!(reflected $sampler, $light, $columns, $module,
            ($one: *const EtendueReflection, $many: *const EtendueReflectionColumns));
    };
    ($kind:ident $sampler:ident, $light:ident, $columns:ident, $module:ident, ($($one:ident: $of_one:ty, $many:ident: $of_many:ty)?)) => {
        /// Prepares the light for a shading point.
        #[unsafe(export_name = concat!("etendue_", stringify!($module), "_prepare"))]
        pub unsafe extern "C" fn prepare(
            light: *const $light,
            p: *const f32,
            $($one: $of_one,)?
            out: *mut $sampler,
        ) -> EtendueStatus {
            refuse_null!(light, p, $($one,)? out);
            // SAFETY: the pointers are not null, and point to what the header says
            unsafe {
                let normal = triple(technique_functions!(@normal $kind p $(, $one)?));
                <$sampler as Technique>::prepare(technique_functions!(@lights $kind light $(, $one)?), triple(p), normal, out)
            }
        }
        sampler_functions!($sampler, $module);
        /// Prepares the light for a shading point and draws one direction.
        #[unsafe(export_name = concat!("etendue_", stringify!($module), "_sample_once"))]
        pub unsafe extern "C" fn sample_once(
            light: *const $light,
            p: *const f32,
            $($one: $of_one,)?
            u: *const f32,
            out: *mut EtendueLightSample,
        ) -> EtendueStatus {
            refuse_null!(light, p, $($one,)? u, out);
            // SAFETY: the pointers are not null, and point to what the header says
            unsafe {
                let normal = technique_functions!(@normal $kind p $(, $one)?);
                <$sampler as Technique>::with_light(technique_functions!(@lights $kind light $(, $one)?), |light| {
                    (Batch::new().once::<<$sampler as Sampler>::Core>().sample)(light, p, normal.cast(), u, out.cast());
                })
            }
        }
        pdf_once!($kind $light, $module, pdf_once, "_pdf_once", pdf, ($($one: $of_one)?), $sampler,
            /// Prepares the light for a shading point, and returns the pdf with which a unit direction `w` is drawn; 0 where it misses the light,
            /// and if a pointer is NULL. What the pdf does not need is not prepared.
        );
        pdf_once!($kind $light, $module, pdf_of_hit_once, "_pdf_of_hit_once", pdf_of_hit, ($($one: $of_one)?), $sampler,
            /// The same for a unit direction `w` that is known to hit the light, as where a ray of the host has hit it: the light is not
            /// intersected again. Where `w` misses the light, the result is finite, and of no meaning.
        );
        /// Prepares a light of its own for each shading point, and draws a direction for each u: all in columns.
        #[unsafe(export_name = concat!("etendue_", stringify!($module), "_sample_each"))]
        pub unsafe extern "C" fn sample_each(
            lights: *const $columns,
            n: usize,
            p: *const *const f32,
            $($many: $of_many,)?
            u: *const *const f32,
            out: *const EtendueSampleColumns,
        ) -> EtendueStatus {
            // SAFETY: the pointers are null, or point to what the header says
            unsafe { sample_lights::<$sampler>(technique_functions!(@lights $kind lights $(, $many)?), n, p, technique_functions!(@normals $kind $($many)?), u, out) }
        }
        /// The pdf of a unit direction for each shading point, towards a light of its own: all in columns.
        #[unsafe(export_name = concat!("etendue_", stringify!($module), "_pdf_each"))]
        pub unsafe extern "C" fn pdf_each(
            lights: *const $columns,
            n: usize,
            p: *const *const f32,
            $($many: $of_many,)?
            w: *const *const f32,
            out: *mut f32,
        ) -> EtendueStatus {
            // SAFETY: the pointers are null, or point to what the header says
            unsafe { evaluate_lights::<$sampler>(technique_functions!(@lights $kind lights $(, $many)?), n, p, technique_functions!(@normals $kind $($many)?), w, pdf_alone(out)) }
        }
        /// The random numbers of a unit direction for each shading point, towards a light of its own: all in columns.
        #[unsafe(export_name = concat!("etendue_", stringify!($module), "_invert_each"))]
        pub unsafe extern "C" fn invert_each(
            lights: *const $columns,
            n: usize,
            p: *const *const f32,
            $($many: $of_many,)?
            w: *const *const f32,
            u: *const *mut f32,
        ) -> EtendueStatus {
            // SAFETY: the pointers are null, or point to what the header says
            unsafe { evaluate_lights::<$sampler>(technique_functions!(@lights $kind lights $(, $many)?), n, p, technique_functions!(@normals $kind $($many)?), w, numbers_alone(u)) }
        }
        /// The nearest point of a light of its own for each shading point in a unit direction: all in columns.
        #[unsafe(export_name = concat!("etendue_", stringify!($module), "_hit_each"))]
        pub unsafe extern "C" fn hit_each(
            lights: *const $columns,
            n: usize,
            p: *const *const f32,
            $($many: $of_many,)?
            w: *const *const f32,
            out: *const EtendueSampleColumns,
        ) -> EtendueStatus {
            // SAFETY: the pointers are null, or point to what the header says
            unsafe { evaluate_lights::<$sampler>(technique_functions!(@lights $kind lights $(, $many)?), n, p, technique_functions!(@normals $kind $($many)?), w, hits_alone(out)) }
        }
    };
    // of techniques without a normal, anything that can be read
    (@normal surface $p:ident, $n:ident) => { $n };
    (@normal $kind:ident $p:ident $(, $one:ident)?) => { $p };
    (@normals surface $normals:ident) => { $normals };
    (@normals $kind:ident $($many:ident)?) => { core::ptr::null() };
    (@lights reflected $lights:ident, $reflections:ident) => {
        Reflected::new($lights, $reflections).as_ref().map_or(core::ptr::null(), core::ptr::from_ref)
    };
    (@lights $kind:ident $lights:ident $(, $many:ident)?) => { $lights };
}
pub(crate) use technique_functions;
