//! Prepared lights over any kind of number: what a loop over packets needs to know of them.

use etendue::light::*;
use etendue::{LightSampler, Real, Vec3};

/// A light prepared for a shading point by one technique, in numbers of single precision.
pub trait Technique: LightSampler<f32> + Copy + 'static {
    /// The light over numbers, packets of numbers, or columns.
    type Light<X: Copy>: Copy;
    /// The prepared light over packets.
    type Of<R: Real>: LightSampler<R>;
    /// True if the preparation needs the normal of the surface.
    const ON_SURFACE: bool;
    /// Prepares for the point `p` of a surface with the unit normal `n`.
    fn prepare<R: Real>(light: Self::Light<R>, p: Vec3<R>, n: Vec3<R>) -> Self::Of<R>;
    /// The light with `f` applied to each of its numbers.
    fn map<X: Copy, Y: Copy>(light: Self::Light<X>, f: impl FnMut(X) -> Y) -> Self::Light<Y>;
    /// The prepared light in every lane of a packet.
    fn splat<R: Real<Scalar = f32>>(&self) -> Self::Of<R>;
    /// What was prepared in single precision.
    fn of(sampler: Self::Of<f32>) -> Self;
}

macro_rules! techniques {
    ($($sampler:ident $(<$n:literal>)?: $light:ident $on_surface:literal |$l:ident, $p:tt, $normal:tt| $prepare:expr;)+) => {$(
        impl Technique for $sampler<f32 $(, $n)?> {
            type Light<X: Copy> = $light<X $(, $n)?>;
            type Of<R: Real> = $sampler<R $(, $n)?>;
            const ON_SURFACE: bool = $on_surface;
            #[inline(always)]
            fn prepare<R: Real>($l: Self::Light<R>, $p: Vec3<R>, $normal: Vec3<R>) -> Self::Of<R> {
                $prepare
            }
            #[inline(always)]
            fn map<X: Copy, Y: Copy>(light: Self::Light<X>, f: impl FnMut(X) -> Y) -> Self::Light<Y> {
                light.map(f)
            }
            #[inline(always)]
            fn splat<R: Real<Scalar = f32>>(&self) -> Self::Of<R> {
                Self::Of::<R>::splat(*self)
            }
            #[inline(always)]
            fn of(sampler: Self::Of<f32>) -> Self {
                sampler
            }
        }
    )+};
}
techniques! {
    SphereByArea: Sphere false |light, p, _| light.by_area(p);
    SphereBySolidAngle: Sphere false |light, p, _| light.by_solid_angle(p);
    SphereByProjectedSolidAngle: Sphere true |light, p, n| light.by_projected_solid_angle(p, n);
    TriangleByArea: Triangle false |light, p, _| light.by_area(p);
    TriangleBySolidAngle: Triangle false |light, p, _| light.by_solid_angle(p);
    TriangleByProjectedSolidAngle: Triangle true |light, p, n| light.by_projected_solid_angle(p, n);
    TriangleByCosineWarp: Triangle true |light, p, n| light.by_cosine_warp(p, n);
    ParallelogramByArea: Parallelogram false |light, p, _| light.by_area(p);
    ParallelogramBySolidAngle: Parallelogram false |light, p, _| light.by_solid_angle(p);
    ParallelogramByProjectedSolidAngle: Parallelogram true |light, p, n| light.by_projected_solid_angle(p, n);
    RectangleBySolidAngle: Rectangle false |light, p, _| light.by_solid_angle(p);
    RectangleByCosineWarp: Rectangle true |light, p, n| light.by_cosine_warp(p, n);
    DiskByArea: Disk false |light, p, _| light.by_area(p);
    DiskBySolidAngle: Disk false |light, p, _| light.by_solid_angle(p);
    CylinderByArea: Cylinder false |light, p, _| light.by_area(p);
    PatchByArea: BilinearPatch false |light, p, _| light.by_area(p);
    PolygonByArea<8>: Polygon false |light, p, _| light.by_area(p);
    PolygonBySolidAngle<8>: Polygon false |light, p, _| light.by_solid_angle(p);
    PolygonByProjectedSolidAngle<8>: Polygon true |light, p, n| light.by_projected_solid_angle(p, n);
    LineByLength: Line false |light, p, _| light.by_length(p);
    LineByAngle: Line false |light, p, _| light.by_angle(p);
    LineByProjectedSolidAngle: Line true |light, p, n| light.by_projected_solid_angle(p, n);
    SunBySolidAngle: Sun false |light, _, _| light.by_solid_angle();
}
