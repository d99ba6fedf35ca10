//! What vectors of each number type have besides: products with a scalar before them, and conversions to and from arrays and, with the
//! features `glam` and `mint`, their vectors. Only this file names these.
//!
//! A single vector also converts to a packet, whose lanes it fills.

use crate::real::Real;
use crate::vector::{Vec2, Vec3};
use core::ops::Mul;
use wide::{f32x4, f32x8, f32x16, f64x4, f64x8};

macro_rules! arrays {
    ($scalar:ident, $($real:ident),+) => {
        $(
            impl Mul<Vec2<$real>> for $real {
                type Output = Vec2<$real>;
                #[inline(always)]
                fn mul(self, v: Vec2<$real>) -> Vec2<$real> {
                    v * self
                }
            }
            impl Mul<Vec3<$real>> for $real {
                type Output = Vec3<$real>;
                #[inline(always)]
                fn mul(self, v: Vec3<$real>) -> Vec3<$real> {
                    v * self
                }
            }
            impl From<[$scalar; 2]> for Vec2<$real> {
                #[inline]
                fn from([x, y]: [$scalar; 2]) -> Self {
                    Self { x: Real::splat(x), y: Real::splat(y) }
                }
            }
            impl From<[$scalar; 3]> for Vec3<$real> {
                #[inline]
                fn from([x, y, z]: [$scalar; 3]) -> Self {
                    Self { x: Real::splat(x), y: Real::splat(y), z: Real::splat(z) }
                }
            }
        )+
        impl From<Vec2<$scalar>> for [$scalar; 2] {
            #[inline]
            fn from(v: Vec2<$scalar>) -> Self {
                [v.x, v.y]
            }
        }
        impl From<Vec3<$scalar>> for [$scalar; 3] {
            #[inline]
            fn from(v: Vec3<$scalar>) -> Self {
                [v.x, v.y, v.z]
            }
        }
    };
}
arrays!(f32, f32, f32x4, f32x8, f32x16);
arrays!(f64, f64, f64x4, f64x8);

/// By their components.
#[cfg(any(feature = "glam", feature = "mint"))]
macro_rules! vectors {
    ($($own:ident of $scalar:ident = $other:ty, $($real:ident),+;)+) => {$(
        $(impl From<$other> for $own<$real> {
            #[inline]
            fn from(v: $other) -> Self {
                <[$scalar; _]>::from(v).into()
            }
        })+
        impl From<$own<$scalar>> for $other {
            #[inline]
            fn from(v: $own<$scalar>) -> Self {
                Self::from(<[$scalar; _]>::from(v))
            }
        }
    )+};
}
#[cfg(feature = "glam")]
vectors! {
    Vec2 of f32 = glam::Vec2, f32, f32x4, f32x8, f32x16;
    Vec3 of f32 = glam::Vec3, f32, f32x4, f32x8, f32x16;
    Vec3 of f32 = glam::Vec3A, f32, f32x4, f32x8, f32x16;
    Vec2 of f64 = glam::DVec2, f64, f64x4, f64x8;
    Vec3 of f64 = glam::DVec3, f64, f64x4, f64x8;
}
#[cfg(feature = "mint")]
vectors! {
    Vec2 of f32 = mint::Vector2<f32>, f32, f32x4, f32x8, f32x16;
    Vec2 of f32 = mint::Point2<f32>, f32, f32x4, f32x8, f32x16;
    Vec3 of f32 = mint::Vector3<f32>, f32, f32x4, f32x8, f32x16;
    Vec3 of f32 = mint::Point3<f32>, f32, f32x4, f32x8, f32x16;
    Vec2 of f64 = mint::Vector2<f64>, f64, f64x4, f64x8;
    Vec2 of f64 = mint::Point2<f64>, f64, f64x4, f64x8;
    Vec3 of f64 = mint::Vector3<f64>, f64, f64x4, f64x8;
    Vec3 of f64 = mint::Point3<f64>, f64, f64x4, f64x8;
}
#[cfg(feature = "mint")]
macro_rules! into_mint {
    ($($number:ident),+) => {$(
        impl mint::IntoMint for Vec2<$number> {
            type MintType = mint::Vector2<$number>;
        }
        impl mint::IntoMint for Vec3<$number> {
            type MintType = mint::Vector3<$number>;
        }
    )+};
}
#[cfg(feature = "mint")]
into_mint!(f32, f64);

#[cfg(test)]
mod tests {
    #[cfg(any(feature = "glam", feature = "mint"))]
    use super::*;

    #[cfg(feature = "mint")]
    #[test]
    fn vectors_of_mint_convert_both_ways() {
        let there: mint::Point3<f64> = Vec3::new(1.0, 2.0, 3.0_f64).into();
        assert_eq!((there, Vec3::from(there)), ([1.0, 2.0, 3.0].into(), Vec3::new(1.0, 2.0, 3.0_f64)));
        let packet = Vec3::<f32x8>::from(mint::Vector3::from([4.0_f32, 5.0, 6.0]));
        assert_eq!(mint::Vector3::from(packet.lane(7)), mint::Vector3 { x: 4.0_f32, y: 5.0, z: 6.0 });
    }
    #[cfg(feature = "glam")]
    #[test]
    fn vectors_of_glam_convert_both_ways() {
        let there = glam::Vec3A::from(Vec3::new(1.0, 2.0, 3.0_f32));
        assert_eq!((there, Vec3::from(there)), (glam::Vec3A::new(1.0, 2.0, 3.0), Vec3::new(1.0, 2.0, 3.0_f32)));
        let packet = Vec3::<f32x8>::from(glam::Vec3::new(4.0, 5.0, 6.0));
        assert_eq!(glam::Vec3::from(packet.lane(7)), glam::Vec3::new(4.0, 5.0, 6.0));
        assert_eq!(<[f64; 2]>::from(Vec2::from(glam::DVec2::new(7.0, 8.0))), [7.0, 8.0]);
    }
}
