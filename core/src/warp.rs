//! Maps from the unit square to a shape, with no viewpoint: the density and the inverse stand beside each map.
//!
//! | warp | point | density | notes |
//! |---|---|---|---|
//! | [`ConcentricDisk`] | unit disk | 1/π | keeps strata compact |
//! | [`PolarDisk`] | unit disk | 1/π | cheaper; strata become long near the centre |
//! | [`Cone`] | directions within σ of +z | 1/(2π(1−cosσ)) | any σ from 1e−19 to π |
//! | [`UniformHemisphere`] | directions, z ≥ 0 | 1/(2π) | a cone |
//! | [`UniformSphere`] | directions | 1/(4π) | a cone |
//! | [`CosineHemisphere`] | directions, z ≥ 0 | z/π | concentric |
//! | [`AreaTriangle`] | barycentrics of a triangle | 2 | per unit of barycentric area |

mod cone;
mod disk;
mod hemisphere;
mod triangle;

pub use cone::{Cone, UniformHemisphere, UniformSphere};
pub use disk::{ConcentricDisk, PolarDisk};
pub(crate) use disk::{concentric, invert_concentric};
pub use hemisphere::CosineHemisphere;
pub use triangle::AreaTriangle;

use crate::real::Real;
use crate::vector::Vec2;

/// A bijection between the unit square and a shape (up to sets of measure 0), together with its density.
///
/// What holds for everything that implements it, and is tested by one suite of laws:
/// `invert(sample(u)) = u`; the integral of `pdf` over the shape is 1; samples of uniform `u` have that density;
/// scalars and packets give the same bits; no finite input gives NaN, infinity or a panic.
pub trait Warp<R: Real> {
    /// [`Vec2`] on a plane, [`Vec3`](crate::Vec3) for a direction.
    type Point;
    /// The point for `u` in [0, 1)²; `u` up to and including 1 is tolerated.
    fn sample(&self, u: Vec2<R>) -> Self::Point;
    /// Density at a point, per unit area or per steradian; 0 outside the shape.
    fn pdf(&self, point: Self::Point) -> R;
    /// The `u` in [0, 1)² that `sample` maps to the point; any value in [0, 1)² for a point outside the shape.
    fn invert(&self, point: Self::Point) -> Vec2<R>;
}

/// Into [0, 1 − 2⁻²⁴], the range of `u`; NaN becomes 0.
#[inline]
pub(crate) fn unit_interval<R: Real>(x: R) -> R {
    x.clamp(R::lit(0.0), R::below_one())
}
