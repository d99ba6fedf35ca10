//! The one list of techniques.

use crate::real::Real;
use crate::vector::Vec3;

/// Expands `callback! { before… list }` for the list of all lights, each with its fields and the techniques that sample it.
///
/// A light is `Light [corners] = NameInC, ColumnsInC { field as argument: kind, … } by "default" { technique; … }`. A field is a `point`, an
/// `edge` (from one point to another), an edge to a `vertex` (hosts with constructors take the vertex, not the edge from the first one), a
/// `direction`, a `number` or `corners`.
///
/// A technique is `Name, name_in_c -> Sampler [corners] = SamplerInC[numbers]: method(arguments) measure;`. Its number is its place in the
/// list. A prepared sampler consists of so many numbers; one that another technique has already has no struct here, and the light converts
/// into that technique's. The arguments are `p`, the point, and at most one of `n`, the unit normal there, and `reflection`. The measure is
/// the sampler's method that returns what it is uniform over, if it has one.
///
/// Hosts without Rust read the documentation of each row, where the fields have other names: it does not name them.
#[doc(hidden)]
#[macro_export]
macro_rules! techniques {
    ($callback:ident! { $($before:tt)* }) => {
        $callback! { $($before)*
            /// A sphere that emits outwards. A radius ≤ 0 gives pdf 0; from inside, every direction hits it and it does not emit.
            Sphere = EtendueSphere, EtendueSphereColumns {
                /// Centre, in the coordinates of the scene.
                center as center: point,
                /// Radius, in the unit of the coordinates.
                radius as radius: number,
            } by "solid_angle" {
                /// Uniform over the surface: pdf distance²/(|cosθ'| 4πR²) per steradian, θ' at the light. More than half of the samples
                /// face away.
                SphereByArea, sphere_by_area -> SphereByArea = EtendueSphereByArea[4]: by_area(p) area;
                /// Uniform over the solid angle Ω at the point p: pdf 1/Ω per steradian. From inside, every direction.
                SphereBySolidAngle, sphere_by_solid_angle -> SphereBySolidAngle = EtendueSphereBySolidAngle[17]: by_solid_angle(p) solid_angle;
                /// Uniform over the projected solid angle Ω⊥ above the horizon of the unit normal n at the point p: pdf cosθ/Ω⊥ per
                /// steradian, 0 where nothing of the light is above the horizon.
                SphereByProjectedSolidAngle, sphere_by_projected_solid_angle -> SphereByProjectedSolidAngle = EtendueSphereByProjectedSolidAngle[36]: by_projected_solid_angle(p, n) projected_solid_angle;
                /// Nearly in proportion to the lobe of a rough surface at the point p: pdf per steradian; 0 where nothing of the light is above
                /// the horizon. From inside, every direction above the horizon.
                SphereByReflection, sphere_by_reflection -> SphereByReflection = EtendueSphereByReflection[41]: by_reflection(p, reflection) projected_solid_angle;
            }
            /// A triangle that emits from the side on which its vertices run counterclockwise. Without area, and from a point in its plane,
            /// the pdf is 0. uv: the barycentric coordinates of the second and the third vertex.
            Triangle = EtendueTriangle, EtendueTriangleColumns {
                /// First vertex, in the coordinates of the scene.
                v0 as v0: point,
                /// Second vertex, as the edge from the first one.
                e1 as v1: vertex,
                /// Third vertex, as the edge from the first one.
                e2 as v2: vertex,
            } by "solid_angle" {
                /// Uniform over the surface of area A: pdf distance²/(|cosθ'| A) per steradian, θ' at the light. For small, far and facing
                /// triangles.
                TriangleByArea, triangle_by_area -> TriangleByArea = EtendueTriangleByArea[33]: by_area(p) area;
                /// Uniform over the solid angle Ω at the point p: pdf 1/Ω per steradian.
                TriangleBySolidAngle, triangle_by_solid_angle -> TriangleBySolidAngle = EtendueTriangleBySolidAngle[81]: by_solid_angle(p) solid_angle;
                /// Uniform over the projected solid angle Ω⊥ above the horizon of the unit normal n at the point p: pdf cosθ/Ω⊥ per
                /// steradian, 0 where nothing of the light is above the horizon. It has no variance on an unoccluded diffuse surface.
                TriangleByProjectedSolidAngle, triangle_by_projected_solid_angle -> TriangleByProjectedSolidAngle = EtendueTriangleByProjectedSolidAngle[164]: by_projected_solid_angle(p, n) projected_solid_angle;
                /// In proportion to the lobe of a rough surface at the point p: pdf π times that of the reflection, over the projected solid
                /// angle after its map, per steradian; 0 where nothing of the light is above the horizon.
                TriangleByReflection, triangle_by_reflection -> TriangleByReflection = EtendueTriangleByReflection[177]: by_reflection(p, reflection) projected_solid_angle;
            }
            /// A parallelogram, of a corner and two edges from there, that emits from the side of the first edge × the second one. Without
            /// area, and from a point in its plane, the pdf is 0. uv: (s, t), the parts of the edges, in [0, 1].
            Parallelogram = EtendueParallelogram, EtendueParallelogramColumns {
                /// Corner, in the coordinates of the scene.
                corner as corner: point,
                /// Edge along s.
                edge_s as edge_s: edge,
                /// Edge along t.
                edge_t as edge_t: edge,
            } by "solid_angle" {
                /// Uniform over the surface of area A: pdf distance²/(|cosθ'| A) per steradian, θ' at the light.
                ParallelogramByArea, parallelogram_by_area -> ParallelogramByArea = EtendueParallelogramByArea[33]: by_area(p) area;
                /// Uniform over the solid angle Ω at the point p: pdf 1/Ω per steradian.
                ParallelogramBySolidAngle, parallelogram_by_solid_angle -> ParallelogramBySolidAngle = EtendueParallelogramBySolidAngle[129]: by_solid_angle(p) solid_angle;
                /// Uniform over the projected solid angle Ω⊥ above the horizon of the unit normal n at the point p: pdf cosθ/Ω⊥ per
                /// steradian, 0 where nothing of the light is above the horizon.
                ParallelogramByProjectedSolidAngle, parallelogram_by_projected_solid_angle -> ParallelogramByProjectedSolidAngle = EtendueParallelogramByProjectedSolidAngle[298]: by_projected_solid_angle(p, n) projected_solid_angle;
                /// In proportion to the lobe of a rough surface at the point p: pdf π times that of the reflection, over the projected solid
                /// angle after its map, per steradian; 0 where nothing of the light is above the horizon.
                ParallelogramByReflection, parallelogram_by_reflection -> ParallelogramByReflection = EtendueParallelogramByReflection[311]: by_reflection(p, reflection) projected_solid_angle;
            }
            /// A rectangle, of a corner and two perpendicular edges from there, that emits from the side of the first edge × the second one.
            /// Its strata follow the edges. Without area, and from a point in its plane, the pdf is 0. uv: (s, t), the parts of the edges,
            /// in [0, 1].
            Rectangle = EtendueRectangle, EtendueRectangleColumns {
                /// Corner, in the coordinates of the scene.
                corner as corner: point,
                /// Edge along s.
                edge_s as edge_s: edge,
                /// Edge along t, perpendicular to the other one.
                edge_t as edge_t: edge,
            } by "solid_angle" {
                /// Uniform over the surface of area A, as a parallelogram: pdf distance²/(|cosθ'| A) per steradian, θ' at the light.
                RectangleByArea, rectangle_by_area -> ParallelogramByArea: by_area(p) area;
                /// Uniform over the solid angle Ω at the point p: pdf 1/Ω per steradian.
                RectangleBySolidAngle, rectangle_by_solid_angle -> RectangleBySolidAngle = EtendueRectangleBySolidAngle[85]: by_solid_angle(p) solid_angle;
                /// Uniform over the projected solid angle Ω⊥ above the horizon of the unit normal n at the point p, as a parallelogram: pdf
                /// cosθ/Ω⊥ per steradian, 0 where nothing of the light is above the horizon.
                RectangleByProjectedSolidAngle, rectangle_by_projected_solid_angle -> ParallelogramByProjectedSolidAngle: by_projected_solid_angle(p, n) projected_solid_angle;
                /// In proportion to the lobe of a rough surface at the point p, as a parallelogram: pdf π times that of the reflection, over the
                /// projected solid angle after its map, per steradian; 0 where nothing of the light is above the horizon.
                RectangleByReflection, rectangle_by_reflection -> ParallelogramByReflection: by_reflection(p, reflection) projected_solid_angle;
            }
            /// A disk that emits from the side of its normal. A radius ≤ 0, and a point in its plane, give pdf 0. uv: (1 + q)/2 for the
            /// position q on the unit disk.
            Disk = EtendueDisk, EtendueDiskColumns {
                /// Centre, in the coordinates of the scene.
                center as center: point,
                /// Unit normal.
                normal as normal: direction,
                /// Radius, in the unit of the coordinates.
                radius as radius: number,
            } by "solid_angle" {
                /// Uniform over the surface of area A: pdf distance²/(|cosθ'| A) per steradian, θ' at the light.
                DiskByArea, disk_by_area -> DiskByArea = EtendueDiskByArea[14]: by_area(p) area;
                /// Uniform over the solid angle Ω at the point p: pdf 1/Ω per steradian.
                DiskBySolidAngle, disk_by_solid_angle -> DiskBySolidAngle = EtendueDiskBySolidAngle[39]: by_solid_angle(p) solid_angle;
            }
            /// A flat convex polygon of 3 to 8 corners that emits from the side on which they run counterclockwise. Without area, and from a
            /// point in its plane, the pdf is 0. uv: the parts of the edges from the first corner to the second and to the last, clamped to
            /// [0, 1].
            Polygon [8] = EtenduePolygon, EtenduePolygonColumns {
                /// Corners in order, in one plane, in the coordinates of the scene. A polygon with fewer than 8 corners repeats its last
                /// one.
                corners as corners: corners,
            } by "solid_angle" {
                /// Uniform over the surface of area A: pdf distance²/(|cosθ'| A) per steradian, θ' at the light.
                PolygonByArea, polygon_by_area -> PolygonByArea [8] = EtenduePolygonByArea[64]: by_area(p) area;
                /// Uniform over the solid angle Ω at the point p: pdf 1/Ω per steradian.
                PolygonBySolidAngle, polygon_by_solid_angle -> PolygonBySolidAngle [8] = EtenduePolygonBySolidAngle[449]: by_solid_angle(p) solid_angle;
                /// Uniform over the projected solid angle Ω⊥ above the horizon of the unit normal n at the point p: pdf cosθ/Ω⊥ per
                /// steradian, 0 where nothing of the light is above the horizon.
                PolygonByProjectedSolidAngle, polygon_by_projected_solid_angle -> PolygonByProjectedSolidAngle [8] = EtenduePolygonByProjectedSolidAngle[1097]: by_projected_solid_angle(p, n) projected_solid_angle;
                /// In proportion to the lobe of a rough surface at the point p: pdf π times that of the reflection, over the projected solid
                /// angle after its map, per steradian; 0 where nothing of the light is above the horizon.
                PolygonByReflection, polygon_by_reflection -> PolygonByReflection [8] = EtenduePolygonByReflection[1110]: by_reflection(p, reflection) projected_solid_angle;
            }
            /// A bilinear patch, of a corner and the vectors from there to the others, that emits from the side of ∂s × ∂t. Without area the
            /// pdf is 0. uv: (s, t), in [0, 1].
            BilinearPatch = EtendueBilinearPatch, EtendueBilinearPatchColumns {
                /// Corner, in the coordinates of the scene.
                corner as corner: point,
                /// From there to the next corner, s = 1.
                edge_s as edge_s: edge,
                /// From there to the other next corner, t = 1.
                edge_t as edge_t: edge,
                /// From there to the opposite corner.
                diagonal as diagonal: edge,
            } by "area" {
                /// Nearly uniform over the surface: the pdf per unit area, times distance²/|cosθ'|, is exact for the map.
                PatchByArea, patch_by_area -> PatchByArea = EtenduePatchByArea[25]: by_area(p) area;
            }
            /// A line: a cylinder so thin that only its width times its radiance counts, which emits in all directions. Samplers use the
            /// first random number alone. The pdf is in the measure sinγ ds/r² (γ from the line, s along it), so that the estimator is
            /// f · L · width · cosθ · weight. No direction hits a line. A length of 0, and a point on the line, give pdf 0. uv: the part of
            /// the length, and 0.
            Line = EtendueLine, EtendueLineColumns {
                /// One end, in the coordinates of the scene.
                start as start: point,
                /// From there to the other end.
                edge as edge: edge,
            } by "angle" {
                /// Uniform over the length: pdf r²/(length · sinγ).
                LineByLength, line_by_length -> LineByLength = EtendueLineByLength[11]: by_length(p);
                /// Uniform over the angle α that the line subtends at the point p: pdf r/α, with r its least distance.
                LineByAngle, line_by_angle -> LineByAngle = EtendueLineByAngle[28]: by_angle(p) angle;
                /// By projected solid angle above the horizon of the unit normal n at the point p; pdf 0 where nothing of the line is above
                /// it.
                LineByProjectedSolidAngle, line_by_projected_solid_angle -> LineByProjectedSolidAngle = EtendueLineByProjectedSolidAngle[43]: by_projected_solid_angle(p, n);
            }
            /// A sun: the same radiance from all directions within an angle σ of one direction, at every point. The distance is the
            /// largest number of single precision.
            Sun = EtendueSun, EtendueSunColumns {
                /// Unit vector towards the centre of the sun.
                direction as direction: direction,
                /// 1 − cosσ, in [0, 2]: 1.09e-5 for the sun from the earth.
                one_minus_cos as one_minus_cos: number,
            } by "solid_angle" {
                /// Uniform over the cone: pdf 1/(2π(1 − cosσ)) per steradian, 0 where the cone is empty.
                SunBySolidAngle, sun_by_solid_angle -> SunBySolidAngle = EtendueSunBySolidAngle[10]: by_solid_angle() solid_angle;
            }
            /// A point light, that emits the same intensity I in all directions. The estimator is f · I · cosθ · weight. No direction
            /// hits it: its weight in multiple importance sampling is 1.
            PointLight = EtenduePointLight, EtenduePointLightColumns {
                /// Position, in the coordinates of the scene.
                position as position: point,
            } by "delta" {
                /// Its one direction, whatever the random numbers. The pdf of a sample is distance², which is no density; that of a
                /// direction is 0.
                PointLightByDelta, point_light_by_delta -> PointLightByDelta = EtenduePointLightByDelta[5]: by_delta(p);
            }
            /// A spot light: a point light that emits into a cone, with the intensity I on its axis. The estimator is f · I · cosθ · weight.
            /// No direction hits it: its weight in multiple importance sampling is 1.
            SpotLight = EtendueSpotLight, EtendueSpotLightColumns {
                /// Position, in the coordinates of the scene.
                position as position: point,
                /// Unit vector along which the light travels.
                axis as axis: direction,
                /// 1 − cosθ of the angle to the axis up to which the intensity is I, in [0, 2].
                one_minus_cos_inner as one_minus_cos_inner: number,
                /// 1 − cosθ of the angle from which it is 0, in [0, 2]; at least the other one.
                one_minus_cos_outer as one_minus_cos_outer: number,
            } by "delta" {
                /// Its one direction, whatever the random numbers. The pdf of a sample is distance² over the part of I that is emitted
                /// there, which is no density, and 0 outside of the cone; that of a direction is 0.
                SpotLightByDelta, spot_light_by_delta -> SpotLightByDelta = EtendueSpotLightByDelta[5]: by_delta(p);
            }
            /// A directional light, that reaches every point from one direction with the irradiance E on a surface that faces it. The
            /// estimator is f · E · cosθ · weight. No direction hits it: its weight in multiple importance sampling is 1.
            DirectionalLight = EtendueDirectionalLight, EtendueDirectionalLightColumns {
                /// Unit vector towards the light.
                direction as direction: direction,
            } by "delta" {
                /// Its one direction, whatever the random numbers. The pdf of a sample is 1, which is no density; that of a direction is 0.
                DirectionalLightByDelta, directional_light_by_delta -> DirectionalLightByDelta = EtendueDirectionalLightByDelta[5]: by_delta();
            }
        }
    };
}

/// A light prepared by a method of the list, with those of the named arguments that it takes.
#[doc(hidden)]
#[macro_export]
macro_rules! prepared {
    ($light:expr, $by:ident(), $($values:tt)*) => {
        $light.$by()
    };
    ($light:expr, $by:ident(p), p: $p:expr $(, $($values:tt)*)?) => {
        $light.$by($p)
    };
    ($light:expr, $by:ident(p, n), p: $p:expr, n: $n:expr $(, $($values:tt)*)?) => {
        $light.$by($p, $n)
    };
    ($light:expr, $by:ident(p, reflection), p: $p:expr, n: $n:expr, reflection: $reflection:expr) => {
        $light.$by($p, $reflection)
    };
}

/// Fields of a light above the origin, in turn, by their kinds in the list; what has no place is below. What tests and benchmarks do with every
/// light begins with `etendue::example!(Light { fields })`.
#[doc(hidden)]
#[derive(Debug, Default)]
pub struct Example {
    vectors: usize,
    numbers: u8,
}
impl Example {
    const VERTICES: [[f64; 3]; 2] = [[2.5, 0.5, 0.5], [1.2, 1.0, 1.5]];
    pub fn point<R: Real>(&mut self) -> Vec3<R> {
        Vec3::lit([-1.0, 2.0, -0.5])
    }
    fn next<R: Real>(&mut self, all: &[[f64; 3]]) -> Vec3<R> {
        self.vectors += 1;
        Vec3::lit(all[self.vectors - 1])
    }
    pub fn vertex<R: Real>(&mut self) -> Vec3<R> {
        self.next(&Self::VERTICES)
    }
    /// The first two are perpendicular.
    pub fn edge<R: Real>(&mut self) -> Vec3<R> {
        self.next(&[[2.0, 0.5, 0.0], [-0.25, 1.0, 1.5], [1.75, 1.8, 1.5]])
    }
    pub fn direction<R: Real>(&mut self) -> Vec3<R> {
        Vec3::lit([0.0, -1.0, 0.0])
    }
    pub fn number<R: Real>(&mut self) -> R {
        self.numbers += 1;
        R::lit(0.5 + 0.2 * f64::from(self.numbers))
    }
    pub fn corners<R: Real, const N: usize>(&mut self) -> [Vec3<R>; N] {
        let ([e1, e2], a) = (Self::VERTICES.map(Vec3::<R>::lit), self.point::<R>());
        let half = R::lit(0.5);
        let corners = [a, a + e1, a + e1 + e2 * half, a + e1 * half + e2, a + e2];
        core::array::from_fn(|i| corners[i.min(4)])
    }
}
/// See `Example`.
#[doc(hidden)]
#[macro_export]
macro_rules! example {
    ($light:ident { $($(#[$doc:meta])* $field:ident as $argument:ident: $kind:ident,)* }) => {{
        let mut fields = $crate::light::Example::default();
        $crate::light::$light { $($field: fields.$kind()),* }
    }};
}
