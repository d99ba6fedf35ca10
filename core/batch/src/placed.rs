//! Lights with memory beside their numbers, prepared for a shading point: with pictures, and the sky through portals.
//!
//! What is prepared over packets has no form in single precision that a caller could keep, so that the light and the point are kept, and
//! each call prepares anew: that takes as long as few samples.

use crate::kernel::Packet;
use crate::sealed::Sealed;
use crate::table::{LightFunctions, SamplerFunctions, Table};
use crate::technique::{BatchSampler, BatchTechnique};
use etendue::light::shapes::{PlacedPatch, PlacedSphere};
use etendue::light::{
    self, Area, BilinearPatch, ByPicture, Curved, Flat, Parallelogram, Pictured, PortalEnvironment, Projected,
    SolidAngle, Sphere,
};
use etendue::{Real, Vec3};

/// Columns `x`, or numbers, in the place of the light's own.
macro_rules! mapped {
    (pictured $light:ident, $f:ident) => {
        $light.picture.on($light.light.map($f))
    };
    (portals $light:ident, $f:ident) => {{
        let _ = $f;
        $light
    }};
}
macro_rules! on_surface {
    ((p, n)) => {
        true
    };
    ((p)) => {
        false
    };
}

macro_rules! placed {
    ($(
        $(#[$doc:meta])* $name:ident, $field:ident: $kind:ident $single:ty, [$x:ident] $light:ty,
        $by:ident $place:tt -> [$r:ident] $of:ty;
    )+) => {
        $(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name<'a> {
            light: $single,
            p: Vec3<f32>,
            n: Vec3<f32>,
        }
        impl Sealed for $name<'_> {}
        impl<'a> BatchSampler for $name<'a> {
            type Of<$r: Real> = $of;
            #[inline(always)]
            fn splat<R: Real<Scalar = f32>>(&self) -> Self::Of<R> {
                let light = Self::map(self.light, |x| R::splat(x));
                Self::prepare(light, Vec3::splat(self.p), Vec3::splat(self.n))
            }
            #[inline]
            fn sampler_functions(table: &'static Table) -> SamplerFunctions<Self> {
                Self::light_functions(table).sampler
            }
        }
        impl<'a> BatchTechnique for $name<'a> {
            type Light<$x: Copy> = $light;
            const ON_SURFACE: bool = on_surface!($place);
            #[inline(always)]
            fn prepare<R: Real>(light: Self::Light<R>, p: Vec3<R>, n: Vec3<R>) -> Self::Of<R> {
                let _ = n;
                etendue::prepared!(light, $by $place, p, n)
            }
            #[inline(always)]
            fn map<X: Copy, Y: Copy>(light: Self::Light<X>, f: impl FnMut(X) -> Y) -> Self::Light<Y> {
                mapped!($kind light, f)
            }
            #[inline(always)]
            fn prepared(light: Self::Light<f32>, p: Vec3<f32>, n: Vec3<f32>) -> Self {
                Self { light, p, n }
            }
            #[inline]
            fn light_functions(table: &'static Table) -> LightFunctions<Self> {
                // SAFETY: the types differ in how long the memory of the light lives, and the functions keep nothing of it
                unsafe { core::mem::transmute::<LightFunctions<$name<'static>>, LightFunctions<Self>>(table.placed.$field) }
            }
        }
        )+
        /// The functions of one level of instructions.
        #[repr(C)]
        pub(crate) struct PlacedTable {
            $($field: LightFunctions<$name<'static>>,)+
        }
        impl PlacedTable {
            pub(crate) const fn of<R: Packet>() -> Self {
                Self { $($field: LightFunctions::of::<R>(),)+ }
            }
        }
    };
}
placed! {
    /// A flat light with a picture, by radiance times area: [`Pictured::by_area`] of the parallelogram of its surface coordinates.
    PictureByArea, by_area: pictured Pictured<'a, Parallelogram<f32>>, [X] Pictured<'a, Parallelogram<X>>,
    by_area(p) -> [R] ByPicture<'a, Flat<R, Area>>;
    /// A flat light with a picture, by radiance times solid angle: [`Pictured::by_solid_angle`] of that parallelogram.
    PictureBySolidAngle, by_solid_angle: pictured Pictured<'a, Parallelogram<f32>>, [X] Pictured<'a, Parallelogram<X>>,
    by_solid_angle(p) -> [R] ByPicture<'a, Flat<R, SolidAngle<R>>>;
    /// A flat light with a picture, by radiance times projected solid angle: [`Pictured::by_projected_solid_angle`] of that parallelogram.
    PictureByProjectedSolidAngle, by_projected_solid_angle: pictured Pictured<'a, Parallelogram<f32>>, [X] Pictured<'a, Parallelogram<X>>,
    by_projected_solid_angle(p, n) -> [R] ByPicture<'a, Flat<R, Projected<R>>>;
    /// A sphere with a picture, by radiance times visible area: [`Pictured::by_visible_area`].
    PictureOnSphereByVisibleArea, sphere: pictured Pictured<'a, Sphere<f32>>, [X] Pictured<'a, Sphere<X>>,
    by_visible_area(p) -> [R] ByPicture<'a, Curved<PlacedSphere<R>>>;
    /// A bilinear patch with a picture, by radiance times visible area: [`Pictured::by_visible_area`].
    PictureOnPatchByVisibleArea, patch: pictured Pictured<'a, BilinearPatch<f32>>, [X] Pictured<'a, BilinearPatch<X>>,
    by_visible_area(p) -> [R] ByPicture<'a, Curved<PlacedPatch<R>>>;
    /// The sky through portals: [`PortalEnvironment::by_radiance`].
    PortalsByRadiance, portals: portals PortalEnvironment<'a>, [X] PortalEnvironment<'a>,
    by_radiance(p) -> [R] light::PortalsByRadiance<'a, R>;
}
