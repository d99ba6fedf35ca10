//! What a mask chooses in each lane.

use super::Real;

/// Numbers that a mask chooses together, lane by lane: one, arrays and tuples of them, and structs over lanes.
pub trait Blend<R: Real>: Copy {
    /// Takes the lanes of another where the mask is true.
    fn take(&mut self, mask: R::Mask, other: &Self);
    /// The lanes of `yes` where the mask is true, and those of `no` elsewhere.
    #[inline(always)]
    fn blended(mask: R::Mask, yes: Self, mut no: Self) -> Self {
        no.take(mask, &yes);
        no
    }
}

impl<R: Real> Blend<R> for R {
    #[inline(always)]
    fn take(&mut self, mask: R::Mask, other: &Self) {
        *self = R::blend(mask, *other, *self);
    }
}
impl<R: Real, T: Blend<R>, const N: usize> Blend<R> for [T; N] {
    #[inline(always)]
    fn take(&mut self, mask: R::Mask, other: &Self) {
        self.iter_mut().zip(other).for_each(|(own, other)| own.take(mask, other));
    }
}
impl<R: Real, A: Blend<R>, B: Blend<R>> Blend<R> for (A, B) {
    #[inline(always)]
    fn take(&mut self, mask: R::Mask, other: &Self) {
        self.0.take(mask, &other.0);
        self.1.take(mask, &other.1);
    }
}
impl<R: Real, A: Blend<R>, B: Blend<R>, C: Blend<R>> Blend<R> for (A, B, C) {
    #[inline(always)]
    fn take(&mut self, mask: R::Mask, other: &Self) {
        self.0.take(mask, &other.0);
        self.1.take(mask, &other.1);
        self.2.take(mask, &other.2);
    }
}

/// Implements [`Blend`] of a struct by its fields.
macro_rules! blended {
    ($name:ident $([$($n:ident),+])? { $($field:tt),+ $(,)? }) => {
        impl<R: $crate::real::Real $(, $(const $n: usize),+)?> $crate::real::Blend<R> for $name<R $(, $($n),+)?> {
            #[inline(always)]
            fn take(&mut self, mask: R::Mask, other: &Self) {
                $($crate::real::Blend::<R>::take(&mut self.$field, mask, &other.$field);)+
            }
        }
    };
}
pub(crate) use blended;
