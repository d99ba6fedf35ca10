//! Structs whose fields are lanes.

/// Defines a struct over lanes, with the operations that work field by field: `splat` and `blend`.
macro_rules! lanewise {
    ($(#[$doc:meta])* $struct_vis:vis struct $name:ident { $($(#[$field_doc:meta])* $vis:vis $field:ident: $kind:ty),+ $(,)? }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default)]
        $struct_vis struct $name<R> {
            $($(#[$field_doc])* $vis $field: $kind,)+
        }
        // of a private struct they are not reachable
        #[allow(unreachable_pub)]
        impl<R: $crate::real::Real> $name<R> {
            /// Repeats one scalar value in every lane.
            #[inline]
            pub fn splat(s: $name<R::Scalar>) -> Self {
                Self { $($field: <$kind>::splat(s.$field)),+ }
            }
            /// Takes the lanes of `yes` where the mask is true, and those of `no` elsewhere.
            #[inline(always)]
            pub fn blend(mask: R::Mask, yes: Self, no: Self) -> Self {
                Self { $($field: <$kind>::blend(mask, yes.$field, no.$field)),+ }
            }
        }
    };
}
pub(crate) use lanewise;
