//! Conversions to and from `glam` and arrays. Only this file names `glam`.
//!
//! A single vector also converts to a packet, whose lanes it fills.

use crate::real::Real;
use crate::vector::{Vec2, Vec3};
use wide::{f32x4, f32x8, f32x16, f64x4, f64x8};

macro_rules! splats {
    ($scalar:ident, $vec2:ty, $vec3:ty, $($real:ident),+) => {
        $(
            impl From<$vec2> for Vec2<$real> {
                #[inline]
                fn from(v: $vec2) -> Self {
                    Self::splat(Vec2 { x: v.x, y: v.y })
                }
            }
            impl From<$vec3> for Vec3<$real> {
                #[inline]
                fn from(v: $vec3) -> Self {
                    Self::splat(Vec3 { x: v.x, y: v.y, z: v.z })
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
        impl From<Vec2<$scalar>> for $vec2 {
            #[inline]
            fn from(v: Vec2<$scalar>) -> Self {
                Self::new(v.x, v.y)
            }
        }
        impl From<Vec3<$scalar>> for $vec3 {
            #[inline]
            fn from(v: Vec3<$scalar>) -> Self {
                Self::new(v.x, v.y, v.z)
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
splats!(f32, glam::Vec2, glam::Vec3, f32, f32x4, f32x8, f32x16);
splats!(f64, glam::DVec2, glam::DVec3, f64, f64x4, f64x8);

impl From<glam::Vec3A> for Vec3<f32> {
    #[inline]
    fn from(v: glam::Vec3A) -> Self {
        Self { x: v.x, y: v.y, z: v.z }
    }
}
