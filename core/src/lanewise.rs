//! Structs whose fields are lanes.

/// Defines a struct over lanes, with the operations that work field by field: `map`, `splat` and `blend`.
macro_rules! lanewise {
    ($(#[$doc:meta])* $struct_vis:vis struct $name:ident {
        $($(#[$field_doc:meta])* $vis:vis $field:ident: $kind:ident $(<$lane:ident>)?),+ $(,)?
    }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default)]
        #[repr(C)]
        $struct_vis struct $name<R> {
            $($(#[$field_doc])* $vis $field: $kind $(<$lane>)?,)+
        }
        // of a private struct they are not reachable
        #[allow(unreachable_pub)]
        impl<R> $name<R> {
            /// Replaces each number x by `f(x)`: to widen, to take one lane, or to load columns of numbers into packets.
            #[inline(always)]
            pub fn map<S>(self, mut f: impl FnMut(R) -> S) -> $name<S> {
                $name { $($field: $crate::lanewise::mapped!(self.$field, f, $kind)),+ }
            }
        }
        // of a private struct they are not reachable, nor are all of them used
        #[allow(unreachable_pub, dead_code)]
        impl<R: $crate::real::Real> $name<R> {
            /// Repeats one scalar value in every lane.
            #[inline]
            pub fn splat(s: $name<R::Scalar>) -> Self {
                s.map(R::splat)
            }
            /// Takes the lanes of `yes` where the mask is true, and those of `no` elsewhere.
            #[inline(always)]
            pub fn blend(mask: R::Mask, yes: Self, no: Self) -> Self {
                Self { $($field: <$kind $(<$lane>)?>::blend(mask, yes.$field, no.$field)),+ }
            }
        }
    };
}
pub(crate) use lanewise;

/// A field with `f` applied to its numbers.
macro_rules! mapped {
    ($field:expr, $f:ident, R) => {
        $f($field)
    };
    ($field:expr, $f:ident, $kind:ident) => {
        $field.map(&mut $f)
    };
}
pub(crate) use mapped;
