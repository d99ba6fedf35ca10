//! Techniques over any kind of number: what a loop over packets needs to know of them.

use crate::memory::{ImageMemory, PictureMemory, PortalMemory};
use crate::sealed::{Samplers, Sealed, Techniques};
use core::marker::PhantomData;
use etendue::light::{self, Area, Flat, PicturedSampler, Projected, SolidAngle, VisibleSphere};
use etendue::listed::light as listed;
use etendue::{LightSampler, Real, Vec3};

/// A light prepared for a shading point, or the same for all of them, in numbers of single precision.
pub trait Prepared: Copy + Sealed<Samplers> {
    /// The number of a technique that prepares it.
    const INDEX: usize;
    /// The prepared light over packets.
    type Of<'a, R: Real>: LightSampler<R>;
    /// Calls `f` with the prepared light in every lane of a packet.
    fn over<R: Real<Scalar = f32>, T>(&self, f: impl FnOnce(&Self::Of<'_, R>) -> T) -> T;
}

/// A light by one technique.
pub trait Technique: Sized + Sealed<Techniques> {
    /// Its number: its place in the core's list, and after that in this module's list of lights with memory.
    const INDEX: usize;
    /// The light over numbers, packets of numbers, or columns.
    type Light<X: Copy>: Copy;
    /// What it is prepared for beside the point: nothing, the unit normal of the surface there, or a [`Reflection`](etendue::reflection::Reflection).
    type With<X: Copy>: Copy;
    /// The prepared light.
    type Prepared: Prepared;
    /// The light with `f` applied to each of its numbers.
    fn map_light<X: Copy, Y: Copy>(light: Self::Light<X>, f: impl FnMut(X) -> Y) -> Self::Light<Y>;
    /// What it is prepared for, with `f` applied to each of its numbers.
    fn map_with<X: Copy, Y: Copy>(with: Self::With<X>, f: impl FnMut(X) -> Y) -> Self::With<Y>;
    /// Prepares one light for the point `p`.
    fn prepare(light: Self::Light<f32>, p: Vec3<f32>, with: Self::With<f32>) -> Self::Prepared;
    /// Calls `f` with a light that is prepared for the point `p`.
    fn prepared<R: Real, T>(
        light: Self::Light<R>,
        p: Vec3<R>,
        with: Self::With<R>,
        f: impl FnOnce(&<Self::Prepared as Prepared>::Of<'_, R>) -> T,
    ) -> T;
}

/// The type of what a light with a picture is prepared for, over numbers `X`, and how these change.
macro_rules! with {
    ((p, n), $x:ident) => {
        Vec3<$x>
    };
    ((p), $x:ident) => {
        ()
    };
    (map (p, n), $with:ident, $f:ident) => {
        $with.map($f)
    };
    (map (p), $with:ident, $f:ident) => {{
        let _ = ($with, $f);
    }};
}
#[doc(inline)]
pub use etendue::listed::light::technique::*;

/// The numbers of techniques of lights with memory, after those of the core's list.
#[derive(Clone, Copy)]
enum Number {
    PictureByArea = listed::TECHNIQUES as isize,
    PictureBySolidAngle,
    PictureByProjectedSolidAngle,
    PictureOnSphereByVisibleArea,
    PortalsByRadiance,
    ImageByRadiance,
}
/// How many techniques there are.
pub const TECHNIQUES: usize = Number::ImageByRadiance as usize + 1;

impl<T: listed::Technique> Sealed<Techniques> for T {}
impl<T: listed::Technique> Technique for T {
    const INDEX: usize = T::ENTRY.index;
    type Light<X: Copy> = T::Light<X>;
    type With<X: Copy> = T::With<X>;
    type Prepared = T::Sampler;
    #[inline(always)]
    fn map_light<X: Copy, Y: Copy>(light: T::Light<X>, f: impl FnMut(X) -> Y) -> T::Light<Y> {
        T::map_light(light, f)
    }
    #[inline(always)]
    fn map_with<X: Copy, Y: Copy>(with: T::With<X>, f: impl FnMut(X) -> Y) -> T::With<Y> {
        T::map_with(with, f)
    }
    #[inline(always)]
    fn prepare(light: T::Light<f32>, p: Vec3<f32>, with: T::With<f32>) -> T::Sampler {
        T::prepare_one(light, p, with)
    }
    #[inline(always)]
    fn prepared<R: Real, X>(
        light: T::Light<R>,
        p: Vec3<R>,
        with: T::With<R>,
        f: impl FnOnce(&listed::Prepared<T, R>) -> X,
    ) -> X {
        f(&T::prepare(light, p, with))
    }
}
impl<S: listed::ListedSampler> Sealed<Samplers> for S {}
impl<S: listed::ListedSampler> Prepared for S {
    const INDEX: usize = S::INDEX;
    type Of<'a, R: Real> = S::Over<R>;
    #[inline(always)]
    fn over<R: Real<Scalar = f32>, T>(&self, f: impl FnOnce(&S::Over<R>) -> T) -> T {
        f(&listed::ListedSampler::over(*self))
    }
}

/// A light with memory, prepared for a shading point. What is prepared over packets has no form in single precision that a caller could keep, so
/// that the light and the point are kept, and each call prepares anew: that takes as long as few samples.
#[derive(Debug)]
#[repr(C)]
pub struct Placed<T: InMemory> {
    light: T::Light<f32>,
    p: Vec3<f32>,
    with: T::With<f32>,
}
impl<T: InMemory> Clone for Placed<T> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<T: InMemory> Copy for Placed<T> {}
impl<T: InMemory> Sealed<Samplers> for Placed<T> {}
impl<T: InMemory> Prepared for Placed<T> {
    const INDEX: usize = T::INDEX;
    type Of<'a, R: Real> = T::At<'a, R>;
    #[inline(always)]
    fn over<R: Real<Scalar = f32>, X>(&self, f: impl FnOnce(&Self::Of<'_, R>) -> X) -> X {
        let (light, with) = (T::map_light(self.light, |x| R::splat(x)), T::map_with(self.with, |x| R::splat(x)));
        T::prepared::<R, X>(light, Vec3::splat(self.p), with, f)
    }
}
/// A technique of a light with memory.
pub trait InMemory:
    Technique<Prepared = Placed<Self>, Light<f32>: core::fmt::Debug, With<f32>: core::fmt::Debug>
{
    /// The prepared light over packets.
    type At<'a, R: Real>: LightSampler<R>;
}

/// A light with a picture.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct OnPicture<'a, L> {
    /// The picture.
    pub picture: PictureMemory<'a>,
    /// The light that it is on.
    pub light: L,
}

/// The techniques of lights with pictures.
macro_rules! pictured {
    ($($(#[$doc:meta])* $technique:ident: $light:ident, $by:ident $place:tt -> [$a:lifetime $r:ident] $of:ty;)+) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $technique<'m>(PhantomData<&'m PictureMemory<'m>>);
        impl Sealed<Techniques> for $technique<'_> {}
        impl<'m> Technique for $technique<'m> {
            const INDEX: usize = Number::$technique as usize;
            type Light<X: Copy> = OnPicture<'m, light::$light<X>>;
            type With<X: Copy> = with!($place, X);
            type Prepared = Placed<Self>;
            #[inline(always)]
            fn map_light<X: Copy, Y: Copy>(light: Self::Light<X>, f: impl FnMut(X) -> Y) -> Self::Light<Y> {
                OnPicture { picture: light.picture, light: light.light.map(f) }
            }
            #[inline(always)]
            fn map_with<X: Copy, Y: Copy>(with: Self::With<X>, f: impl FnMut(X) -> Y) -> Self::With<Y> {
                with!(map $place, with, f)
            }
            #[inline(always)]
            fn prepare(light: Self::Light<f32>, p: Vec3<f32>, with: Self::With<f32>) -> Placed<Self> {
                Placed { light, p, with }
            }
            #[inline(always)]
            fn prepared<R: Real, T>(
                light: Self::Light<R>,
                p: Vec3<R>,
                with: Self::With<R>,
                f: impl FnOnce(&<Self as InMemory>::At<'_, R>) -> T,
            ) -> T {
                let _ = with;
                let on = light.picture.view().expect("the memory is that of a picture").on(light.light);
                f(&etendue::prepared!(on, $by $place, p: p, n: with))
            }
        }
        impl<'m> InMemory for $technique<'m> {
            type At<$a, $r: Real> = $of;
        }
    )+};
}
pictured! {
    /// A flat light with a picture, by radiance times area: [`Pictured::by_area`](light::PicturedLight::by_area) of the parallelogram of its
    /// surface coordinates.
    PictureByArea: Parallelogram, by_area(p) -> ['a R] PicturedSampler<'a, Flat<R, Area>>;
    /// A flat light with a picture, by radiance times solid angle: [`Pictured::by_solid_angle`](light::PicturedLight::by_solid_angle) of that
    /// parallelogram.
    PictureBySolidAngle: Parallelogram, by_solid_angle(p) -> ['a R] PicturedSampler<'a, Flat<R, SolidAngle<R>>>;
    /// A flat light with a picture, by radiance times projected solid angle:
    /// [`Pictured::by_projected_solid_angle`](light::PicturedLight::by_projected_solid_angle) of that parallelogram.
    PictureByProjectedSolidAngle: Parallelogram, by_projected_solid_angle(p, n) -> ['a R] PicturedSampler<'a, Flat<R, Projected<R>>>;
    /// A sphere with a picture, by radiance times visible area: [`Pictured::by_visible_area`](light::PicturedLight::by_visible_area).
    PictureOnSphereByVisibleArea: Sphere, by_visible_area(p) -> ['a R] PicturedSampler<'a, VisibleSphere<R>>;
}

/// The techniques of lights that are memory alone, which take nothing beside the point.
macro_rules! from_memory {
    ($($(#[$doc:meta])* $technique:ident: $memory:ident -> $prepared:ty, |$light:ident, $p:ident| $prepare:expr, |$f:ident| $call:expr;)+) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $technique<'m>(PhantomData<&'m $memory<'m>>);
        impl Sealed<Techniques> for $technique<'_> {}
        impl<'m> Technique for $technique<'m> {
            const INDEX: usize = Number::$technique as usize;
            type Light<X: Copy> = $memory<'m>;
            type With<X: Copy> = ();
            type Prepared = $prepared;
            #[inline(always)]
            fn map_light<X: Copy, Y: Copy>(light: $memory<'m>, _: impl FnMut(X) -> Y) -> $memory<'m> {
                light
            }
            #[inline(always)]
            fn map_with<X: Copy, Y: Copy>((): (), _: impl FnMut(X) -> Y) {}
            #[inline(always)]
            fn prepare($light: $memory<'m>, $p: Vec3<f32>, (): ()) -> $prepared {
                $prepare
            }
            #[inline(always)]
            fn prepared<R: Real, T>(
                $light: $memory<'m>,
                $p: Vec3<R>,
                (): (),
                $f: impl FnOnce(&<$prepared as Prepared>::Of<'_, R>) -> T,
            ) -> T {
                $call
            }
        }
    )+};
}
from_memory! {
    /// The sky through portals: [`PortalEnvironment::by_radiance`](light::PortalEnvironment::by_radiance).
    PortalsByRadiance: PortalMemory -> Placed<Self>, |light, p| Placed { light, p, with: () },
    |f| light.with(|sky| f(&sky.by_radiance(p))).expect("the memory is that of portals");
    /// An image of the sky: [`ImageEnvironment::by_radiance`](light::ImageEnvironment::by_radiance), the same at every point.
    ImageByRadiance: ImageMemory -> ImageMemory<'m>, |light, _p| light,
    |f| f(&light.view().expect("the memory is that of an image").by_radiance());
}
impl InMemory for PortalsByRadiance<'_> {
    type At<'a, R: Real> = light::PortalsByRadiance<'a, R>;
}
impl Sealed<Samplers> for ImageMemory<'_> {}
impl<'m> Prepared for ImageMemory<'m> {
    const INDEX: usize = Number::ImageByRadiance as usize;
    type Of<'a, R: Real> = light::ByRadiance<'a>;
    #[inline(always)]
    fn over<R: Real<Scalar = f32>, T>(&self, f: impl FnOnce(&Self::Of<'_, R>) -> T) -> T {
        f(&self.view().expect("the memory is that of an image").by_radiance())
    }
}
