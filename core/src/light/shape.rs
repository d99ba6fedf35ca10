//! Traits shared by the shapes that are seen from a point.

use super::direction::DirectionSample;
use crate::real::Real;
use crate::vector::{Vec2, Vec3};
use crate::warp::Warp;

/// A shape as seen from a point, sampled uniformly by solid angle.
pub trait SphericalShape<R: Real>: Warp<R, Point = Vec3<R>> + Copy {
    /// The direction for `u` in [0, 1)², and the distance to the shape along it.
    fn sample_direction(&self, u: Vec2<R>) -> DirectionSample<R>;
    /// The same with the surface coordinates of the point, each in [0, 1], if the map knows them without intersecting the shape: of a
    /// triangle, the barycentric coordinates of its second and third vertex; otherwise the parts of both edges.
    #[inline(always)]
    fn sample_point(&self, u: Vec2<R>) -> (DirectionSample<R>, Option<Vec2<R>>) {
        (self.sample_direction(u), None)
    }
    /// Solid angle in steradians.
    fn solid_angle(&self) -> R;
    /// The pdf of every direction that hits the shape, per steradian: 1/Ω, and 0 where Ω is 0.
    fn uniform_pdf(&self) -> R;
    /// True where the point is on the side to which the shape's normal points; for a sphere, outside it.
    fn in_front(&self) -> R::Mask;
}

/// A shape as seen from a point on a surface, sampled uniformly by projected solid angle above the horizon.
pub trait ProjectedShape<R: Real>: Warp<R, Point = Vec3<R>> + Copy {
    /// The direction for `u` in [0, 1)², and the distance to the shape along it.
    fn sample_direction(&self, u: Vec2<R>) -> DirectionSample<R>;
    /// Projected solid angle, in [0, π].
    fn projected_solid_angle(&self) -> R;
    /// The pdf per steradian of a direction that hits the shape, given its cosine to the surface normal: cosθ/Ω⊥.
    fn pdf_at_cosine(&self, cos: R) -> R;
    /// True where a direction hits the shape, to within the rounding of the direction. The horizon is not tested.
    fn contains(&self, w: Vec3<R>) -> R::Mask;
    /// True where the point is on the side to which the shape's normal points; for a sphere, outside it.
    fn in_front(&self) -> R::Mask;
}

/// Gives a shape its trait by its own methods, and by another one for the points of its surface.
macro_rules! spherical {
    ($name:ident $(, $n:ident)?; $this:ident => $front:expr $(, $point:ident)?) => {
        impl<R: $crate::real::Real $(, const $n: usize)?> $crate::light::shape::SphericalShape<R> for $name<R $(, $n)?> {
            #[inline(always)]
            fn sample_direction(&self, u: $crate::vector::Vec2<R>) -> $crate::light::direction::DirectionSample<R> {
                Self::sample_direction(self, u)
            }
            $(#[inline(always)]
            fn sample_point(&self, u: $crate::vector::Vec2<R>) -> ($crate::light::direction::DirectionSample<R>, Option<$crate::vector::Vec2<R>>) {
                let (sample, coordinates) = self.$point(u);
                (sample, Some(coordinates))
            })?
            #[inline(always)]
            fn solid_angle(&self) -> R {
                Self::solid_angle(self)
            }
            #[inline(always)]
            fn uniform_pdf(&self) -> R {
                Self::uniform_pdf(self)
            }
            #[inline(always)]
            fn in_front(&self) -> R::Mask {
                let $this = self;
                $front
            }
        }
    };
}
pub(super) use spherical;

/// The same above the horizon.
macro_rules! projected {
    ($name:ident $(, $n:ident)*; $this:ident => $front:expr) => {
        impl<R: $crate::real::Real $(, const $n: usize)*> $crate::light::shape::ProjectedShape<R> for $name<R $(, $n)*> {
            #[inline(always)]
            fn sample_direction(&self, u: $crate::vector::Vec2<R>) -> $crate::light::direction::DirectionSample<R> {
                Self::sample_direction(self, u)
            }
            #[inline(always)]
            fn projected_solid_angle(&self) -> R {
                Self::projected_solid_angle(self)
            }
            #[inline(always)]
            fn pdf_at_cosine(&self, cos: R) -> R {
                Self::pdf_at_cosine(self, cos)
            }
            #[inline(always)]
            fn contains(&self, w: $crate::vector::Vec3<R>) -> R::Mask {
                Self::contains(self, w)
            }
            #[inline(always)]
            fn in_front(&self) -> R::Mask {
                let $this = self;
                $front
            }
        }
    };
}
pub(super) use projected;
