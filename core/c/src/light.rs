//! Lights.

use crate::reflected::{EtendueReflection, EtendueReflectionColumns};
use crate::sampler::*;
use crate::{EtendueStatus, columns, outputs, refuse_null};
use core::mem::{align_of, size_of};
use etendue::{Vec3, light};
use etendue_batch::{Batch, BatchTechnique};

/// The struct of a technique's sampler, and its functions, in a module of their own.
macro_rules! technique {
    // the sampler of another light
    ($(#[$doc:meta])* $type:ty, $light:ident, $columns:ident, $place:tt) => {};
    ($(#[$doc:meta])* $type:ty, $light:ident, $columns:ident, (p, n), $sampler:ident[$size:literal], $module:ident) => {
        technique!(@ $(#[$doc])* $sampler[$size] = $type, $light, $columns, $light, $columns, (n: normals), $module);
    };
    ($(#[$doc:meta])* $type:ty, $light:ident, $columns:ident, (p, reflection), $sampler:ident[$size:literal], $module:ident) => {
        technique!(@ $(#[$doc])* $sampler[$size] = $type, $light, $columns,
            Reflected<$light, EtendueReflection>, Reflected<$columns, EtendueReflectionColumns>, (reflection => reflections), $module);
    };
    ($(#[$doc:meta])* $type:ty, $light:ident, $columns:ident, $place:tt, $sampler:ident[$size:literal], $module:ident) => {
        technique!(@ $(#[$doc])* $sampler[$size] = $type, $light, $columns, $light, $columns, (), $module);
    };
    (@ $(#[$doc:meta])* $sampler:ident[$size:literal] = $type:ty, $light:ident, $columns:ident, $of_one:ty, $of_many:ty,
     $place:tt, $module:ident) => {
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
        impl Technique for $sampler {
            type Light = $of_one;
            type Columns = $of_many;
            #[inline(always)]
            unsafe fn prepare(light: *const $of_one, p: Vec3<f32>, n: Vec3<f32>, out: *mut Self) -> EtendueStatus {
                // SAFETY: the caller's; the structs of the light have the same fields
                unsafe { out.cast::<$type>().write(Batch::new().prepare::<$type>(&*light.cast(), p, n)) };
                EtendueStatus::Ok
            }
            #[inline(always)]
            unsafe fn with_light(
                light: *const $of_one,
                f: impl FnOnce(&<$type as BatchTechnique>::Light<f32>),
            ) -> EtendueStatus {
                // SAFETY: the caller's; the structs of the light have the same fields
                f(unsafe { &*light.cast() });
                EtendueStatus::Ok
            }
            #[inline(always)]
            unsafe fn with_lights(
                lights: *const $of_many,
                f: impl FnOnce(<$type as BatchTechnique>::Light<*const f32>),
            ) -> EtendueStatus {
                // SAFETY: the caller's; the structs of columns have the same fields
                unsafe {
                    if !all_there(&*lights) {
                        return EtendueStatus::NullPointer;
                    }
                    f(*lights.cast::<<$type as BatchTechnique>::Light<*const f32>>());
                }
                EtendueStatus::Ok
            }
        }

        #[doc = concat!("The functions of [`", stringify!($sampler), "`]: their names in C begin with `etendue_", stringify!($module), "_`.")]
        pub mod $module {
            use super::*;

            technique_functions!($sampler, $light, $columns, $module, $place);
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
        } $(reflected {
            $(#[$lobe_doc:meta])* $lobe:ident $([$lobe_n:literal])? $(= $lobe_name:ident, $lobe_module:ident[$lobe_size:literal])?;
        })? by $default:literal {
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
        const _: () = assert!(size_of::<$name>() == size_of::<light::$light<f32 $(, $corners)?>>());
        const _: () = assert!(size_of::<$columns>() == size_of::<light::$light<*const f32 $(, $corners)?>>());
        $(technique!(
            $(#[$doc])* light::$sampler<f32 $(, $n)?>, $name, $columns, $place $(, $sampler_name[$size], $technique)?
        );)+
        $(technique!(
            $(#[$lobe_doc])* light::$lobe<f32 $(, $lobe_n)?>, $name, $columns, (p, reflection) $(, $lobe_name[$lobe_size], $lobe_module)?
        );)?
    )+};
}

etendue::techniques!(lights! {});
