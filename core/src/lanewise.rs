//! Structs whose fields are lanes.

use crate::real::{Real, Uint};

/// A struct over numbers `R`, which may be numbers, packets of numbers, or columns.
pub trait Lanewise<R>: Sized {
    /// The same struct over other numbers.
    type With<S>: Lanewise<S>;
    /// Replaces each number x by `f(x)`.
    fn map<S>(self, f: impl FnMut(R) -> S) -> Self::With<S>;
    /// Repeats one scalar value in every lane of a packet: a sampler that was prepared for one point draws packets of samples.
    #[inline(always)]
    fn splat<P: Real<Scalar = R>>(self) -> Self::With<P> {
        self.map(P::splat)
    }
    /// Gathers elements of a slice: lane `i` has the one at `index.lane(i)`. Past the end of the slice it has the default, which is a light
    /// that emits nothing.
    ///
    /// ```
    /// use etendue::{Lanewise, LightSampler, Sphere, Vec2, Vec3, f32x4, u32x4};
    /// let lamps = [1.0_f32, 2.0, 3.0].map(|x| Sphere::new(Vec3::new(x, 2.0, 0.0), 0.5));
    /// let chosen: Sphere<f32x4> = Sphere::gather(&lamps, u32x4::from([2, 0, 0, u32::MAX]));
    /// assert_eq!(chosen.center.x.to_array(), [3.0, 1.0, 1.0, 0.0]);
    /// let s = chosen.by_solid_angle(Vec3::default()).sample(Vec2::lit([0.3, 0.6]));
    /// assert!(s.lane(0).valid() && s.lane(1).valid() && !s.lane(3).valid());
    /// ```
    #[inline(always)]
    fn gather<P: Real<Scalar = R>>(from: &[Self], index: P::Uint) -> Self::With<P>
    where
        Self: Copy + Default,
        R: Real,
    {
        let element = |lane: usize| from.get(index.lane(lane) as usize).copied().unwrap_or_default();
        let mut numbers = 0..;
        Self::default().map(|none| {
            let Some(number) = numbers.next() else { return P::splat(none) };
            P::from_fn(|lane| {
                let (mut found, mut k) = (none, 0_u32);
                element(lane).map(|x| {
                    found = if k == number { x } else { found };
                    k += 1;
                });
                found
            })
        })
    }
}

/// Implements [`Lanewise`], and `splat` without the trait, by the method `map` of a struct over numbers alone, or over numbers and constants.
macro_rules! lanewise_by_map {
    ($name:ident $(, $n:ident)*) => {
        impl<R $(, const $n: usize)*> $crate::lanewise::Lanewise<R> for $name<R $(, $n)*> {
            type With<S> = $name<S $(, $n)*>;
            #[inline(always)]
            fn map<S>(self, f: impl FnMut(R) -> S) -> $name<S $(, $n)*> {
                self.map(f)
            }
        }
        // of a private struct it is not reachable, nor is it always used
        #[allow(unreachable_pub, dead_code)]
        impl<R: $crate::real::Real $(, const $n: usize)*> $name<R $(, $n)*> {
            /// Repeats one scalar value in every lane.
            #[inline]
            pub fn splat(s: $name<R::Scalar $(, $n)*>) -> Self {
                s.map(R::splat)
            }
        }
    };
}
pub(crate) use lanewise_by_map;

/// Defines a struct over lanes, with the operations that work field by field: `map`, `splat` and `blend`.
macro_rules! lanewise {
    ($(#[$doc:meta])* $struct_vis:vis struct $name:ident {
        $($(#[$field_doc:meta])* $vis:vis $field:ident: $kind:ident $(<$lane:ident>)?),+ $(,)?
    }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
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
        $crate::lanewise::lanewise_by_map!($name);
        $crate::real::blended!($name { $($field),+ });
        // of a private struct they are not reachable, nor are all of them used
        #[allow(unreachable_pub, dead_code)]
        impl<R: $crate::real::Real> $name<R> {
            /// Takes the lanes of `yes` where the mask is true, and those of `no` elsewhere.
            #[inline(always)]
            pub fn blend(mask: R::Mask, yes: Self, no: Self) -> Self {
                $crate::real::Blend::<R>::blended(mask, yes, no)
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

/// Implements `only` of a struct over lanes in memory: one of them, in all lanes of a packet. It reads through a reference, because
/// memory broadcasts for nothing what registers do not.
macro_rules! only {
    ($name:ident { $($field:ident: $kind:ident),+ $(,)? }) => {
        impl $name<[f32; 8]> {
            #[inline(always)]
            pub(crate) fn only<R: $crate::real::Real<Scalar = f32>>(&self, lane: usize) -> $name<R> {
                $name { $($field: $crate::lanewise::only_of!(self.$field, lane, R, $kind)),+ }
            }
        }
    };
}
pub(crate) use only;

/// The same of a field.
macro_rules! only_of {
    ($field:expr, $lane:ident, $packet:ident, R) => {
        $packet::splat($field[$lane & 7])
    };
    ($field:expr, $lane:ident, $packet:ident, $kind:ident) => {
        $field.only($lane)
    };
}
pub(crate) use only_of;
