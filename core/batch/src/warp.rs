//! Warps over any kind of number: what a loop over packets needs to know of them.

use crate::sealed::Sealed;
use etendue::reflection::Reflection;
use etendue::warp::*;
use etendue::{Real, Vec2, Vec3};

/// A warp in numbers of single precision.
pub trait BatchWarp: Copy + Sealed {
    /// Its number: its place in the core's list.
    const INDEX: usize;
    /// The warp over packets.
    type Of<R: Real>: Copy;
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

macro_rules! warps {
    ($($(#[$doc:meta])* $name:ident $([$packets:tt] = $struct:ident)?, $module:ident: $coordinates:literal;)+) => {
        /// The number of each warp.
        #[derive(Clone, Copy)]
        enum Number {
            $($name,)+
        }
        /// How many warps there are.
        pub const WARPS: usize = [$(Number::$name),+].len();
        $(warps!(@ $name $([$packets])?; $coordinates);)+
    };
    (@ $name:ident; $coordinates:literal) => {
        impl Sealed for $name {}
        impl BatchWarp for $name {
            const INDEX: usize = Number::$name as usize;
            type Of<R: Real> = $name;
            #[inline(always)]
            fn splat<R: Real<Scalar = f32>>(&self) -> Self {
                *self
            }
            warps!(# $coordinates);
        }
    };
    (@ $name:ident [R]; $coordinates:literal) => {
        impl Sealed for $name<f32> {}
        impl BatchWarp for $name<f32> {
            const INDEX: usize = Number::$name as usize;
            type Of<R: Real> = $name<R>;
            #[inline(always)]
            fn splat<R: Real<Scalar = f32>>(&self) -> $name<R> {
                $name::splat(*self)
            }
            warps!(# $coordinates);
        }
    };
    (# $coordinates:literal) => {
        const COORDINATES: usize = $coordinates;
        #[inline(always)]
        fn sample<R: Real>(warp: &Self::Of<R>, u: Vec2<R>) -> [R; 3] {
            Point::coordinates(Warp::sample(warp, u))
        }
        #[inline(always)]
        fn pdf<R: Real>(warp: &Self::Of<R>, point: [R; 3]) -> R {
            Warp::pdf(warp, Point::from_coordinates(point))
        }
        #[inline(always)]
        fn invert<R: Real>(warp: &Self::Of<R>, point: [R; 3]) -> Vec2<R> {
            Warp::invert(warp, Point::from_coordinates(point))
        }
    };
}
etendue::warps!(warps! {});
