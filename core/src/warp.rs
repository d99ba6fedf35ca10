//! Maps from the unit square to a shape that has no viewpoint, each with its pdf and its inverse.
//!
//! | warp | point | pdf | notes |
//! |---|---|---|---|
//! | [`ConcentricDisk`] | unit disk | 1/π | keeps strata compact |
//! | [`Cone`] | directions within σ of +z | 1/(2π(1−cosσ)) | any σ from 1e−19 to π |
//! | [`UniformHemisphere`] | directions, z ≥ 0 | 1/(2π) | a cone |
//! | [`UniformSphere`] | directions | 1/(4π) | a cone |
//! | [`Octahedral`] | directions | 1/(4π) | nearly continuous: suits images of the sphere |
//! | [`CosineHemisphere`] | directions, z ≥ 0 | z/π | concentric |
//! | [`AreaTriangle`] | barycentrics of a triangle | 2 | per unit of barycentric area |
//! | [`LowDistortionTriangle`] | barycentrics of a triangle | 2 | keeps strata compact; cheaper |
//! | [`GgxVisibleNormals`] | normals of a microsurface | D_v | anisotropic; also gives the pdf of the reflected direction |
//! | [`Bilinear`] | unit square | bilinear in the point | for textured or tilted emitters |
//! | [`PatchSurface`] | points of a bilinear patch | nearly 1/area | [`BilinearPatch`](crate::BilinearPatch) is the light |

mod bilinear;
mod cone;
mod disk;
mod hemisphere;
mod linear;
mod octahedral;
mod patch;
mod triangle;
mod visible_normals;
mod warps;

pub use bilinear::Bilinear;
pub use cone::{Cone, UniformHemisphere, UniformSphere};
pub use disk::ConcentricDisk;
pub(crate) use disk::{concentric, invert_concentric};
pub use hemisphere::CosineHemisphere;
pub(crate) use linear::Linear;
pub use octahedral::Octahedral;
pub use patch::PatchSurface;
pub use triangle::{AreaTriangle, LowDistortionTriangle};
pub use visible_normals::GgxVisibleNormals;

use crate::real::Real;
use crate::vector::Vec2;

/// A bijection between the unit square and a shape (up to sets of measure 0), together with its pdf.
///
/// Every implementation keeps these properties, and one test suite checks them all: `invert(sample(u)) = u`; `pdf` integrates
/// to 1 over the shape; uniform `u` gives samples with that pdf; scalars and packets give the same bits; no finite input gives
/// NaN, infinity or a panic.
pub trait Warp<R: Real> {
    /// [`Vec2`] for a point of a plane, [`Vec3`](crate::Vec3) for a direction or a point in space.
    type Point;
    /// Maps `u` in [0, 1)² to a point of the shape; also accepts a coordinate of exactly 1.
    fn sample(&self, u: Vec2<R>) -> Self::Point;
    /// The pdf at a point, per unit area or per steradian as the implementation states; 0 outside the shape.
    fn pdf(&self, point: Self::Point) -> R;
    /// Returns the `u` in [0, 1)² that `sample` maps to the point; for a point outside the shape, some value in [0, 1)².
    fn invert(&self, point: Self::Point) -> Vec2<R>;
}
