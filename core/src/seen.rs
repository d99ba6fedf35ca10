//! Shapes seen from a point: maps from the unit square to the directions in which the shape lies.
//!
//! Everything here is prepared once for a shape and a point (`new`, with the shape given relative to the point) and then
//! sampled as often as wanted. Prepared in scalars, it is widened by `splat` to draw packets of samples from one point; prepared
//! in packets, it serves as many points as there are lanes. The maps are threshold-free: one formula at every size and
//! distance, and scaling all lengths by a power of two changes no bit.
//!
//! | shape | type | density | degenerate input |
//! |---|---|---|---|
//! | sphere | [`SphereCap`] | 1/Ω, Ω = 2π(1−cosσ) | radius ≤ 0: pdf 0; inside: all directions |
//! | sphere | [`ProjectedCap`] | cosθ/Ω⊥ | radius ≤ 0, below the horizon: pdf 0; inside: the hemisphere |
//! | triangle | [`SphericalTriangle`] | 1/Ω | point in the plane or on a vertex, zero area: pdf 0 |
//! | parallelogram | [`SphericalParallelogram`] | 1/Ω | as the triangle |
//! | rectangle | [`SphericalRectangle`] | 1/Ω | as the triangle |
//! | convex polygon, 3 to 8 corners | [`SphericalPolygon`] | 1/Ω | as the triangle |
//! | triangle | [`ProjectedTriangle`] | cosθ/Ω⊥ | as the triangle; below the horizon: pdf 0 |
//! | convex polygon, 3 to 8 corners | [`ProjectedPolygon`] | cosθ/Ω⊥ | as the triangle; below the horizon: pdf 0 |
//! | disk | [`SphericalDisk`] | 1/Ω | point in the plane, radius ≤ 0: pdf 0 |
//! | triangle, rectangle | [`CosineWarped`] | about ∝ cosθ | as the shape |
//! | line segment | [`SphericalSegment`] | 1/α per radian | point on its line: pdf 0 |
//! | line segment | [`ProjectedSegment`] | ∝ sinγ cosθ per radian | as that; below the horizon: pdf 0 |
//!
//! Solid angles Ω in steradians; Ω⊥ projected on the surface at the viewpoint, above its horizon, at most π.

mod cosine_warped;
mod disk;
mod line;
mod parallelogram;
mod polygon;
mod projected_cap;
mod projected_polygon;
mod rectangle;
mod sphere;
mod triangle;

pub use cosine_warped::CosineWarped;
pub use disk::SphericalDisk;
pub use line::{ProjectedSegment, SphericalSegment};
pub use parallelogram::SphericalParallelogram;
pub use polygon::SphericalPolygon;
pub use projected_cap::ProjectedCap;
pub use projected_polygon::{ProjectedPolygon, ProjectedTriangle};
pub use rectangle::SphericalRectangle;
pub use sphere::SphereCap;
pub use triangle::SphericalTriangle;

use crate::math::two_sum;
use crate::real::Real;
use crate::vector::Vec3;

/// A point of a shape as it is seen: in which direction, and how far.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sighting<R> {
    /// Unit direction from the viewpoint.
    pub direction: Vec3<R>,
    /// Distance from the viewpoint.
    pub distance: R,
}

/// 1/Ω, or 0 where Ω is 0 or so small (1e−37) that its reciprocal would not be finite.
#[inline(always)]
pub(crate) fn uniform_density<R: Real>(solid_angle: R) -> R {
    let some = solid_angle.gt(R::lit(1e-37));
    (R::lit(1.0) / R::select(some, solid_angle, R::lit(1.0))).keep(some)
}

/// u×v as an unevaluated sum of two: as if computed in twice the working precision.
#[inline(always)]
pub(crate) fn exact_cross<R: Real>(u: Vec3<R>, v: Vec3<R>) -> [Vec3<R>; 2] {
    let cross = |a: R, b: R, c: R, d: R| {
        let (ab, cd) = (a * b, c * d);
        let (sum, error) = two_sum(ab, -cd);
        (sum, error + (R::product_error(a, b, ab) - R::product_error(c, d, cd)))
    };
    let ((x, ex), (y, ey), (z, ez)) = (cross(u.y, v.z, u.z, v.y), cross(u.z, v.x, u.x, v.z), cross(u.x, v.y, u.y, v.x));
    [Vec3::new(x, y, z), Vec3::new(ex, ey, ez)]
}

/// a + b of two such sums.
#[inline(always)]
pub(crate) fn exact_sum<R: Real>([a, ra]: [Vec3<R>; 2], [b, rb]: [Vec3<R>; 2]) -> [Vec3<R>; 2] {
    let ((x, ex), (y, ey), (z, ez)) = (two_sum(a.x, b.x), two_sum(a.y, b.y), two_sum(a.z, b.z));
    [Vec3::new(x, y, z), Vec3::new(ex, ey, ez) + (ra + rb)]
}

/// p·n for an n that is a sum of two, rounded once: the height of a far point over a plane is a small difference.
#[inline(always)]
pub(crate) fn exact_height<R: Real>(p: Vec3<R>, n: [Vec3<R>; 2]) -> R {
    let [sum, rest] = exact_height_pair(p, n);
    sum + rest
}

/// The same as an unevaluated sum of two.
#[inline(always)]
pub(crate) fn exact_height_pair<R: Real>(p: Vec3<R>, [n, rest]: [Vec3<R>; 2]) -> [R; 2] {
    let term = |a: R, b: R| (a * b, R::product_error(a, b, a * b));
    let ((a, ea), (b, eb), (c, ec)) = (term(p.x, n.x), term(p.y, n.y), term(p.z, n.z));
    let (sum, e1) = two_sum(a, b);
    let (sum, e2) = two_sum(sum, c);
    [sum, ((e1 + e2) + ((ea + eb) + ec) + p.dot(rest))]
}

/// A struct whose fields are lanes, with the operations that go field by field.
macro_rules! lanewise {
    ($(#[$doc:meta])* $name:ident { $($(#[$field_doc:meta])* $vis:vis $field:ident: $kind:ty),+ $(,)? }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default)]
        pub struct $name<R> {
            $($(#[$field_doc])* $vis $field: $kind,)+
        }
        impl<R: $crate::real::Real> $name<R> {
            /// Prepared for one point: the same in every lane.
            #[inline]
            pub fn splat(s: $name<R::Scalar>) -> Self {
                Self { $($field: <$kind>::splat(s.$field)),+ }
            }
        }
    };
}
pub(crate) use lanewise;
