//! Maps from the unit square to a shape, with no viewpoint: the density and the inverse stand beside each map.
//!
//! | warp | point | density | notes |
//! |---|---|---|---|
//! | [`ConcentricDisk`] | unit disk | 1/π | keeps strata compact |
//! | [`PolarDisk`] | unit disk | 1/π | cheaper; strata become long near the centre |
//! | [`Cone`] | directions within σ of +z | 1/(2π(1−cosσ)) | any σ from 1e−19 to π |
//! | [`UniformHemisphere`] | directions, z ≥ 0 | 1/(2π) | a cone |
//! | [`UniformSphere`] | directions | 1/(4π) | a cone |
//! | [`Octahedral`] | directions | 1/(4π) | nearly continuous: for images of the sphere |
//! | [`CosineHemisphere`] | directions, z ≥ 0 | z/π | concentric |
//! | [`AreaTriangle`] | barycentrics of a triangle | 2 | per unit of barycentric area |
//! | [`LowDistortionTriangle`] | the same | 2 | keeps strata compact; cheaper |
//! | [`GgxVisibleNormals`] | normals of a microsurface | D_v | anisotropic; reflected density too |
//! | [`Bilinear`] | unit square | bilinear in the point | for textured or tilted emitters |
//! | [`DiskSurface`] | points of a disk in space | 1/(πR²) | [`per_steradian`] converts |
//! | [`CylinderSide`] | points of a cylinder's side | 1/(2πRL) | as that |
//! | [`SphereSurface`] | points of a sphere | 1/(4πR²) | as that |
//! | [`PatchSurface`] | points of a bilinear patch | nearly 1/area | as that |
//!
//! On a line, as [`Warp1`]:
//!
//! | warp | point | density | notes |
//! |---|---|---|---|
//! | [`Linear`] | [0, 1) | linear between two end values | a = b too |
//! | [`Tent`] | [−r, r] | (r − \|x\|)/r² | pixel filters |
//! | [`Exponential`] | [0, ∞) | λ exp(−λx) | distances in a medium |
//! | [`Normal`] | the line | Gaussian | by inverse erf: keeps strata, has an inverse |

mod bilinear;
mod cone;
mod disk;
mod exponential;
mod hemisphere;
mod linear;
mod normal;
mod octahedral;
mod surface;
mod triangle;
mod visible_normals;

pub use bilinear::Bilinear;
pub use cone::{Cone, UniformHemisphere, UniformSphere};
pub use disk::{ConcentricDisk, PolarDisk};
pub(crate) use disk::{concentric, invert_concentric};
pub use exponential::Exponential;
pub use hemisphere::CosineHemisphere;
pub use linear::{Linear, Tent};
pub use normal::Normal;
pub use octahedral::Octahedral;
pub use surface::{CylinderSide, DiskSurface, PatchSurface, SphereSurface, per_steradian};
pub use triangle::{AreaTriangle, LowDistortionTriangle};
pub use visible_normals::GgxVisibleNormals;

use crate::real::Real;
use crate::vector::Vec2;

/// A bijection between the unit square and a shape (up to sets of measure 0), together with its density.
///
/// What holds for everything that implements it, and is tested by one suite of properties:
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

/// A monotone bijection between the unit interval and a part of the line, together with its density: [`Warp`] in one dimension,
/// under the same properties.
pub trait Warp1<R: Real> {
    /// The point for `u` in [0, 1); `u` up to and including 1 is tolerated.
    fn sample(&self, u: R) -> R;
    /// Density at a point, per unit length; 0 outside.
    fn pdf(&self, x: R) -> R;
    /// The `u` in [0, 1) that `sample` maps to the point; any value in [0, 1) for a point outside.
    fn invert(&self, x: R) -> R;
}
