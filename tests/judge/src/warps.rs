//! The one list of maps from the square: every warp, and every shape by its solid and by its projected solid angle.

/// Expands `callback! { before… list }` for the list.
///
/// A row is `name Points random: Fixture;` for a warp without parameters, and `name Points random = cases;` for one that has some: what points
/// are (of the plane, of space, or of shapes that are seen at a distance), and at how many random points of the square it is tested.
#[macro_export]
macro_rules! warps {
    ($callback:ident! { $($before:tt)* }) => {
        $callback! { $($before)*
            concentric_disk Plane 4000: $crate::fixtures::ConcentricDisk;
            area_triangle Plane 4000: $crate::fixtures::AreaTriangle;
            low_distortion_triangle Plane 4000: $crate::fixtures::LowDistortionTriangle;
            bilinear Plane 1000 = $crate::generators::bilinears();
            ggx_visible_normals Space 500 = $crate::generators::microsurfaces();
            cosine_hemisphere Space 4000: $crate::fixtures::CosineHemisphere;
            uniform_hemisphere Space 4000: $crate::fixtures::UniformHemisphere;
            uniform_sphere Space 4000: $crate::fixtures::UniformSphere;
            octahedral Space 4000: $crate::fixtures::Octahedral;
            cone Space 1000 = $crate::generators::cones();
            patch_surface Space 200 = $crate::generators::patch_surfaces();
            spherical_cap Seen 200 = $crate::warps!(@shapes Sphere SolidAngle 3 11);
            spherical_triangle Seen 60 = $crate::warps!(@shapes Triangle SolidAngle 4 12);
            spherical_parallelogram Seen 200 = $crate::warps!(@shapes Parallelogram SolidAngle 4 13);
            spherical_rectangle Seen 200 = $crate::warps!(@shapes Rectangle SolidAngle 4 14);
            spherical_polygon Seen 60 = $crate::generators::hexagons(3, 15);
            spherical_disk Seen 100 = $crate::warps!(@shapes Disk SolidAngle 3 31);
            spherical_segment Seen 200 = $crate::generators::segments(3, 21)[0].clone();
            projected_cap Seen 100 = $crate::warps!(@shapes Sphere ProjectedSolidAngle 3 14);
            projected_triangle Seen 60 = $crate::warps!(@shapes Triangle ProjectedSolidAngle 3 16);
            projected_parallelogram Seen 40 = $crate::warps!(@shapes Parallelogram ProjectedSolidAngle 1 17);
            projected_polygon Seen 40 = $crate::generators::projected_pentagons(2, 18);
            projected_segment Seen 60 = $crate::generators::segments(1, 22)[1].clone();
        }
    };
    (@cases : $warp:path) => { vec![("whole", $warp)] };
    (@cases = $cases:expr) => { $cases };
    (@shapes $shape:ident $by:ident $each:literal $seed:literal) => {
        $crate::generators::lights($crate::area_lights::LightShape::$shape, $crate::area_lights::Measure::$by, $each, $seed)
    };
}
