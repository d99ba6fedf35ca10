//! Lights.

use core::mem::{align_of, size_of};
use etendue::light;

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
/// The struct of a technique's sampler, unless another technique has it.
macro_rules! sampler {
    ($type:ty) => {};
    ($type:ty, $sampler:ident[$size:literal]) => {
        /// What the technique of this name prepares. What is inside does not concern callers: it may be copied, and used by any thread.
        #[derive(Clone, Copy, Debug)]
        #[repr(C)]
        pub struct $sampler {
            data: [f32; $size],
        }
        const _: () =
            assert!(size_of::<$type>() == size_of::<$sampler>() && align_of::<$type>() <= align_of::<$sampler>());
    };
}

/// The structs of all lights and their samplers, whose fields are those of the core's.
macro_rules! lights {
    ($(
        $(#[$light_doc:meta])* $light:ident $([$corners:literal])? = $light_c:ident, $columns:ident {
            $($(#[$field_doc:meta])* $field:ident as $argument:ident: $kind:ident,)+
        } by $default:literal {
            $(
                $(#[$doc:meta])* $technique:ident, $name:ident -> $sampler:ident $([$n:literal])? $(= $sampler_c:ident[$size:literal])?: $by:ident $place:tt $($measure:ident)?;
            )+
        }
    )+) => {
        $($(#[$light_doc])*
        #[derive(Clone, Copy, Debug)]
        #[repr(C)]
        pub struct $light_c {
            $($(#[$field_doc])* pub $field: field!($kind f32),)+
        }
        /// Columns of lights: the fields are those of the light.
        #[derive(Clone, Copy, Debug)]
        #[repr(C)]
        #[allow(missing_docs)]
        pub struct $columns {
            $(pub $field: field!($kind *const f32),)+
        }
        const _: () = assert!(size_of::<$light_c>() == size_of::<light::$light<f32 $(, $corners)?>>());
        const _: () = assert!(size_of::<$columns>() == size_of::<light::$light<*const f32 $(, $corners)?>>());
        $(sampler!(light::$sampler<f32 $(, $n)?> $(, $sampler_c[$size])?);)+)+
    };
}
etendue::techniques!(lights! {});
