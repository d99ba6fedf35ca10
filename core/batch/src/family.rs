//! Prepared lights and warps over any kind of number: what a loop over packets needs to know of them.

use etendue::light::*;
use etendue::warp::*;
use etendue::{LightSampler, Real, Vec2, Vec3};

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

/// A warp in numbers of single precision.
pub trait Map: Copy + 'static {
    /// The warp over packets.
    type Of<R: Real>: Copy;
    /// How many random numbers it maps.
    const NUMBERS: usize;
    /// How many coordinates a point has; those beyond are 0.
    const COORDINATES: usize;
    /// The warp in every lane of a packet.
    fn splat<R: Real<Scalar = f32>>(&self) -> Self::Of<R>;
    /// Maps random numbers to a point.
    fn sample<R: Real>(warp: &Self::Of<R>, u: Vec2<R>) -> [R; 3];
    /// The pdf of a point.
    fn pdf<R: Real>(warp: &Self::Of<R>, point: [R; 3]) -> R;
    /// The random numbers that map to a point.
    fn invert<R: Real>(warp: &Self::Of<R>, point: [R; 3]) -> Vec2<R>;
}

/// A point as coordinates, and back.
trait Point<R: Real> {
    fn coordinates(self) -> [R; 3];
    fn from_coordinates(coordinates: [R; 3]) -> Self;
}
impl<R: Real> Point<R> for Vec2<R> {
    #[inline(always)]
    fn coordinates(self) -> [R; 3] {
        [self.x, self.y, R::lit(0.0)]
    }
    #[inline(always)]
    fn from_coordinates([x, y, _]: [R; 3]) -> Self {
        Self::new(x, y)
    }
}
impl<R: Real> Point<R> for Vec3<R> {
    #[inline(always)]
    fn coordinates(self) -> [R; 3] {
        [self.x, self.y, self.z]
    }
    #[inline(always)]
    fn from_coordinates([x, y, z]: [R; 3]) -> Self {
        Self::new(x, y, z)
    }
}

macro_rules! maps {
    ($($name:ident $([$packets:tt])?: $coordinates:literal;)+) => {$(
        maps!(@ $name $([$packets])?; $coordinates, 2;
            |warp, u| Point::coordinates(Warp::sample(warp, u)),
            |warp, point| Warp::pdf(warp, Point::from_coordinates(point)),
            |warp, point| Warp::invert(warp, Point::from_coordinates(point)));
    )+};
    (@ $name:ident; $($rest:tt)+) => {
        impl Map for $name {
            type Of<R: Real> = $name;
            #[inline(always)]
            fn splat<R: Real<Scalar = f32>>(&self) -> Self {
                *self
            }
            maps!(# $($rest)+);
        }
    };
    (@ $name:ident [R]; $($rest:tt)+) => {
        impl Map for $name<f32> {
            type Of<R: Real> = $name<R>;
            #[inline(always)]
            fn splat<R: Real<Scalar = f32>>(&self) -> $name<R> {
                $name::splat(*self)
            }
            maps!(# $($rest)+);
        }
    };
    (# $coordinates:literal, $numbers:literal; |$w:ident, $u:ident| $sample:expr, |$pw:ident, $pp:ident| $pdf:expr, |$iw:ident, $ip:ident| $invert:expr) => {
        const NUMBERS: usize = $numbers;
        const COORDINATES: usize = $coordinates;
        #[inline(always)]
        fn sample<R: Real>($w: &Self::Of<R>, $u: Vec2<R>) -> [R; 3] {
            $sample
        }
        #[inline(always)]
        fn pdf<R: Real>($pw: &Self::Of<R>, $pp: [R; 3]) -> R {
            $pdf
        }
        #[inline(always)]
        fn invert<R: Real>($iw: &Self::Of<R>, $ip: [R; 3]) -> Vec2<R> {
            $invert
        }
    };
}
maps! {
    ConcentricDisk: 2;
    PolarDisk: 2;
    UniformHemisphere: 3;
    UniformSphere: 3;
    CosineHemisphere: 3;
    Octahedral: 3;
    AreaTriangle: 2;
    LowDistortionTriangle: 2;
    Cone [R]: 3;
    Bilinear [R]: 2;
    GgxVisibleNormals [R]: 3;
    DiskSurface [R]: 3;
    CylinderSide [R]: 3;
    SphereSurface [R]: 3;
    PatchSurface [R]: 3;
}
macro_rules! lines {
    ($($name:ident)+) => {$(
        maps!(@ $name [R]; 1, 1;
            |warp, u| [Warp1::sample(warp, u.x), R::lit(0.0), R::lit(0.0)],
            |warp, point| Warp1::pdf(warp, point[0]),
            |warp, point| Vec2::new(Warp1::invert(warp, point[0]), R::lit(0.0)));
    )+};
}
lines!(Linear Tent Exponential Normal);
