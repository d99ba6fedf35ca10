//! Prepared lights over any kind of number: what a loop over packets needs to know of them.

use crate::sealed::Sealed;
use crate::table::{InTable, LightFunctions, SamplerFunctions, Table};
use etendue::light::*;
use etendue::reflection::Reflection;
use etendue::{Lanewise, LightSampler, Real, Vec3};

/// A light prepared for a shading point, or the same for all of them, in numbers of single precision.
pub trait BatchSampler: Copy + Sealed {
    /// The prepared light over packets.
    type Of<R: Real>: LightSampler<R>;
    /// The prepared light in every lane of a packet.
    fn splat<R: Real<Scalar = f32>>(&self) -> Self::Of<R>;
    /// The functions of the prepared light.
    fn sampler_functions(table: &'static Table) -> SamplerFunctions<Self>;
}

impl Sealed for ByRadiance<'_> {}
impl<'a> BatchSampler for ByRadiance<'a> {
    type Of<R: Real> = Self;
    #[inline(always)]
    fn splat<R: Real<Scalar = f32>>(&self) -> Self {
        *self
    }
    #[inline]
    fn sampler_functions(table: &'static Table) -> SamplerFunctions<Self> {
        // SAFETY: the types differ in how long the image lives, and the functions keep nothing of it
        unsafe { core::mem::transmute::<SamplerFunctions<ByRadiance<'static>>, SamplerFunctions<Self>>(table.image) }
    }
}

/// A light prepared for a shading point by one technique, in numbers of single precision.
pub trait BatchTechnique: BatchSampler {
    /// The light over numbers, packets of numbers, or columns.
    type Light<X: Copy>: Copy;
    /// True if the preparation needs the normal of the surface.
    const ON_SURFACE: bool;
    /// Prepares for the point `p` of a surface with the unit normal `n`.
    fn prepare<R: Real>(light: Self::Light<R>, p: Vec3<R>, n: Vec3<R>) -> Self::Of<R>;
    /// The light with `f` applied to each of its numbers.
    fn map<X: Copy, Y: Copy>(light: Self::Light<X>, f: impl FnMut(X) -> Y) -> Self::Light<Y>;
    /// One light, prepared for the point `p` of a surface with the unit normal `n`.
    fn prepared(light: Self::Light<f32>, p: Vec3<f32>, n: Vec3<f32>) -> Self;
    /// The functions of the technique.
    fn light_functions(table: &'static Table) -> LightFunctions<Self>;
}

/// A light, and the lobe of the surface that reflects it: what samplers `by_reflection` are prepared for.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Reflected<L, X> {
    /// The light.
    pub light: L,
    /// The lobe.
    pub reflection: Reflection<X>,
}

/// Whether a method takes a normal.
macro_rules! on_surface {
    ((p, n)) => {
        true
    };
    ($other:tt) => {
        false
    };
}

macro_rules! implement {
    ($(
        $(#[$light_doc:meta])* $light:ident $([$corners:literal])? = $light_c:ident, $columns_c:ident { $($fields:tt)* } $(reflected {
            $(#[$lobe_doc:meta])* $lobe:ident $([$lobe_n:literal])? $(= $lobe_c:ident, $lobe_name:ident[$lobe_size:literal])?;
        })? by $default:literal {
            $(
                $(#[$doc:meta])* $sampler:ident $([$n:literal])?
                    $(= $sampler_c:ident, $name:ident[$size:literal])?: $by:ident $place:tt $($measure:ident)?;
            )+
        }
    )+) => {
        $($(implement!(@ $light, $sampler $([$n])?, $by $place $(, $name)?);)+)+
        $($(implement!(# $light, $lobe $([$lobe_n])? $(, $lobe_name)?);)?)+
    };
    // the sampler of another light
    (@ $light:ident, $sampler:ident $([$n:literal])?, $by:ident $place:tt) => {};
    (# $light:ident, $sampler:ident $([$n:literal])?) => {};
    (@ $light:ident, $sampler:ident $([$n:literal])?, $by:ident $place:tt, $name:ident) => {
        implement!(sampler $sampler $([$n])?);
        impl BatchTechnique for $sampler<f32 $(, $n)?> {
            type Light<X: Copy> = $light<X $(, $n)?>;
            const ON_SURFACE: bool = on_surface!($place);
            #[inline(always)]
            fn prepare<R: Real>(light: Self::Light<R>, p: Vec3<R>, n: Vec3<R>) -> Self::Of<R> {
                let _ = (p, n);
                etendue::prepared!(light, $by $place, p, n)
            }
            #[inline(always)]
            fn map<X: Copy, Y: Copy>(light: Self::Light<X>, f: impl FnMut(X) -> Y) -> Self::Light<Y> {
                light.map(f)
            }
            implement!(technique);
        }
    };
    (# $light:ident, $sampler:ident $([$n:literal])?, $name:ident) => {
        implement!(sampler $sampler $([$n])?);
        impl BatchTechnique for $sampler<f32 $(, $n)?> {
            type Light<X: Copy> = Reflected<$light<X $(, $n)?>, X>;
            const ON_SURFACE: bool = false;
            #[inline(always)]
            fn prepare<R: Real>(Reflected { light, reflection }: Self::Light<R>, p: Vec3<R>, _: Vec3<R>) -> Self::Of<R> {
                light.by_reflection(p, &reflection)
            }
            #[inline(always)]
            fn map<X: Copy, Y: Copy>(reflected: Self::Light<X>, mut f: impl FnMut(X) -> Y) -> Self::Light<Y> {
                Reflected { light: reflected.light.map(&mut f), reflection: reflected.reflection.map(&mut f) }
            }
            implement!(technique);
        }
    };
    (sampler $sampler:ident $([$n:literal])?) => {
        impl Sealed for $sampler<f32 $(, $n)?> {}
        impl BatchSampler for $sampler<f32 $(, $n)?> {
            type Of<R: Real> = $sampler<R $(, $n)?>;
            #[inline(always)]
            fn splat<R: Real<Scalar = f32>>(&self) -> Self::Of<R> {
                Lanewise::splat(*self)
            }
            #[inline]
            fn sampler_functions(table: &'static Table) -> SamplerFunctions<Self> {
                Self::functions(table).sampler
            }
        }
    };
    (technique) => {
        #[inline(always)]
        fn prepared(light: Self::Light<f32>, p: Vec3<f32>, n: Vec3<f32>) -> Self {
            Self::prepare::<f32>(light, p, n)
        }
        #[inline]
        fn light_functions(table: &'static Table) -> LightFunctions<Self> {
            *Self::functions(table)
        }
    };
}
etendue::techniques!(implement! {});
