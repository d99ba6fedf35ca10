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

/// Expands `callback! { before… list }` for the list of all warps.
///
/// A row is `Warp [R] = ParametersInC, name_in_c: coordinates;` and maps two random numbers to a point of so many coordinates. A warp without
/// parameters has no `[R]` and no struct in C.
#[doc(hidden)]
#[macro_export]
macro_rules! warps {
    ($callback:ident! { $($before:tt)* }) => {
        $callback! { $($before)*
            /// Points of the unit disk, uniform in area (pdf 1/π), by concentric squares: keeps strata compact.
            ConcentricDisk, concentric_disk: 2;
            /// Directions with z ≥ 0, uniform in solid angle: pdf 1/(2π) per steradian.
            UniformHemisphere, uniform_hemisphere: 3;
            /// Directions, uniform in solid angle: pdf 1/(4π) per steradian.
            UniformSphere, uniform_sphere: 3;
            /// Directions with z ≥ 0 and the pdf z/π per steradian.
            CosineHemisphere, cosine_hemisphere: 3;
            /// Directions, uniform in solid angle, by a nearly continuous map: pdf 1/(4π) per steradian.
            Octahedral, octahedral: 3;
            /// Barycentric coordinates of the second and third vertex of a triangle, uniform in area: pdf 2.
            AreaTriangle, area_triangle: 2;
            /// Barycentric coordinates of the second and third vertex of a triangle, by a map that keeps strata compact: pdf 2.
            LowDistortionTriangle, low_distortion_triangle: 2;
            /// Directions of a cone: pdf 1/(2π one_minus_cos) per steradian.
            Cone [R] = EtendueCone, cone: 3;
            /// Points of the unit square, bilinear.
            Bilinear [R] = EtendueBilinear, bilinear: 2;
            /// Visible normals of a GGX microsurface, per steradian.
            GgxVisibleNormals [R] = EtendueGgxVisibleNormals, ggx_visible_normals: 3;
            /// Directions in which a rough surface reflects a view, per steradian.
            Reflection [R] = EtendueReflection, reflection: 3;
            /// Points of a bilinear patch: pdf nearly 1/area.
            PatchSurface [R] = EtenduePatchSurface, patch_surface: 3;
        }
    };
}
