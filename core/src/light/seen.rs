//! Traits shared by the shapes that are seen from a point.

use super::direction::DirectionSample;
use crate::math::quotient;
use crate::real::Real;
use crate::vector::{Vec2, Vec3};
use crate::warp::Warp;

/// A shape as seen from a point, sampled uniformly by solid angle.
pub trait SphericalShape<R: Real>: Warp<R, Point = Vec3<R>> + Copy {
    /// The direction for `u` in [0, 1)², the distance to the shape along it, and the surface coordinates of the point, each in [0, 1], if the
    /// map knows them without intersecting the shape: of a triangle, the barycentric coordinates of its second and third vertex; otherwise
    /// the parts of both edges.
    fn sample_point(&self, u: Vec2<R>) -> (DirectionSample<R>, Option<Vec2<R>>);
    /// Solid angle in steradians, in [0, 4π].
    fn solid_angle(&self) -> R;
    /// The pdf of every direction that hits the shape, per steradian: 1/Ω, and 0 where Ω is 0.
    #[inline(always)]
    fn uniform_pdf(&self) -> R {
        quotient(R::lit(1.0), self.solid_angle())
    }
    /// True where the point is on the side to which the shape's normal points; for a sphere, outside it.
    fn in_front(&self) -> R::Mask;
}

/// A shape as seen from a point on a surface, sampled uniformly by projected solid angle above the horizon.
pub trait ProjectedShape<R: Real>: Warp<R, Point = Vec3<R>> + Copy {
    /// The direction for `u` in [0, 1)², and the distance to the shape along it.
    fn sample_direction(&self, u: Vec2<R>) -> DirectionSample<R>;
    /// Projected solid angle Ω⊥, in [0, π]: irradiance per unit of radiance.
    fn projected_solid_angle(&self) -> R;
    /// The pdf per steradian of a direction that hits the shape, given its cosine to the surface normal: cosθ/Ω⊥.
    #[inline(always)]
    fn pdf_at_cosine(&self, cos: R) -> R {
        cos.greater(R::lit(0.0)) * quotient(R::lit(1.0), self.projected_solid_angle())
    }
    /// True where a direction hits the shape, to within the rounding of the direction. The horizon is not tested.
    fn contains(&self, w: Vec3<R>) -> R::Mask;
    /// True where the point is on the side to which the shape's normal points; for a sphere, outside it.
    fn in_front(&self) -> R::Mask;
}
