//! What a mask chooses in each lane.

use super::Real;

/// Numbers that a mask chooses together, lane by lane: one, arrays and tuples of them, and structs over lanes.
pub trait Blend<R: Real>: Copy {
    /// The lanes of `yes` where the mask is true, and those of `no` elsewhere.
    fn blended(mask: R::Mask, yes: Self, no: Self) -> Self;
}

impl<R: Real> Blend<R> for R {
    #[inline(always)]
    fn blended(mask: R::Mask, yes: Self, no: Self) -> Self {
        R::blend(mask, yes, no)
    }
}
impl<R: Real, T: Blend<R>, const N: usize> Blend<R> for [T; N] {
    #[inline(always)]
    fn blended(mask: R::Mask, yes: Self, no: Self) -> Self {
        core::array::from_fn(|i| T::blended(mask, yes[i], no[i]))
    }
}
impl<R: Real, A: Blend<R>, B: Blend<R>> Blend<R> for (A, B) {
    #[inline(always)]
    fn blended(mask: R::Mask, yes: Self, no: Self) -> Self {
        (A::blended(mask, yes.0, no.0), B::blended(mask, yes.1, no.1))
    }
}
impl<R: Real, A: Blend<R>, B: Blend<R>, C: Blend<R>> Blend<R> for (A, B, C) {
    #[inline(always)]
    fn blended(mask: R::Mask, (a, b, c): Self, no: Self) -> Self {
        (A::blended(mask, a, no.0), B::blended(mask, b, no.1), C::blended(mask, c, no.2))
    }
}

/// Implements [`Blend`] of a struct by its fields.
macro_rules! blended {
    ($name:ident $([$($n:ident),+])? { $($field:tt),+ $(,)? }) => {
        impl<R: $crate::real::Real $(, $(const $n: usize),+)?> $crate::real::Blend<R> for $name<R $(, $($n),+)?> {
            #[inline(always)]
            fn blended(mask: R::Mask, yes: Self, no: Self) -> Self {
                Self { $($field: $crate::real::Blend::<R>::blended(mask, yes.$field, no.$field)),+ }
            }
        }
    };
}
pub(crate) use blended;
