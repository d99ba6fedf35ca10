//! The one list of warps.

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
