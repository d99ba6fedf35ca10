//! Light shapes: for one technique, a sample with all that an estimator needs.
//!
//! A shape whose lanes are equal (`splat`) draws a packet of samples of one light; lanes may as well hold different lights, and
//! `p` different shading points. Each method is one technique. The estimator of reflected radiance is
//! `f · L · cosθ / pdf` where `emits` holds, else 0; with a shadow ray of length `distance` along `direction`.
//!
//! | shape | by area | by solid angle | by projected solid angle |
//! |---|---|---|---|
//! | [`Sphere`] | [`by_area`](Sphere::by_area) wastes all but (1−R/d)/2 of its samples | [`by_solid_angle`](Sphere::by_solid_angle), always better | [`by_projected_solid_angle`](Sphere::by_projected_solid_angle): for diffuse surfaces |
//! | [`Triangle`] | [`by_area`](Triangle::by_area): cheap; fine for a light that is small for its distance | [`by_solid_angle`](Triangle::by_solid_angle): for all others | [`by_projected_solid_angle`](Triangle::by_projected_solid_angle): for diffuse surfaces |
//! | [`Parallelogram`] | [`by_area`](Parallelogram::by_area) | [`by_solid_angle`](Parallelogram::by_solid_angle) | [`by_projected_solid_angle`](Parallelogram::by_projected_solid_angle) |
//! | [`Rectangle`] | [`by_area`](Rectangle::by_area) | [`by_solid_angle`](Rectangle::by_solid_angle) | |
//! | [`Polygon`], 3 to 8 corners | [`by_area`](Polygon::by_area) | [`by_solid_angle`](Polygon::by_solid_angle) | [`by_projected_solid_angle`](Polygon::by_projected_solid_angle) |
//! | [`Triangle`], [`Rectangle`] | | [`by_cosine_warp`](Rectangle::by_cosine_warp), times about the cosine | |
//! | [`BilinearPatch`] | [`by_area`](BilinearPatch::by_area) | | |
//! | [`Disk`] | [`by_area`](Disk::by_area) | [`by_solid_angle`](Disk::by_solid_angle) | |
//! | [`Cylinder`] | [`by_area`](Cylinder::by_area): half of it and more faces away | | |
//! | [`Line`] | by [length](Line::by_length) | by [angle](Line::by_angle) | [`by_projected_solid_angle`](Line::by_projected_solid_angle) |
//! | [`Sun`] | | [`by_solid_angle`](Sun::by_solid_angle) | |
//! | [`ConstantEnvironment`] | | [`by_solid_angle`](ConstantEnvironment::by_solid_angle), or by the cosine | |
//! | [`ImageEnvironment`] | | [`by_radiance`](ImageEnvironment::by_radiance): in proportion to an image | |
//! | [`PointLight`], [`SpotLight`], [`DirectionalLight`] | one direction: `delta` holds | | |

mod cylinder;
mod delta;
mod distant;
mod environment;
mod flat;
mod line;
mod patch;
mod polygon;
mod round;
mod sample;
mod sampler;
mod surface;

pub use cylinder::PlacedCylinder;
pub use delta::{DeltaSampler, DirectionalLight, PointLight, SpotLight};
pub use distant::{
    ConstantEnvironment, EnvironmentByProjectedSolidAngle, EnvironmentBySolidAngle, Sun, SunBySolidAngle,
};
pub use environment::{ByRadiance, EnvironmentMap, EnvironmentSample, ImageEnvironment, Texel};
pub use flat::{
    Parallelogram, ParallelogramByArea, ParallelogramByProjectedSolidAngle, ParallelogramBySolidAngle, Rectangle,
    RectangleByCosineWarp, RectangleBySolidAngle, Triangle, TriangleByArea, TriangleByCosineWarp,
    TriangleByProjectedSolidAngle, TriangleBySolidAngle,
};
pub use line::{Line, LineByAngle, LineByLength, LineByProjectedSolidAngle, PlacedLine};
pub use patch::{BilinearPatch, PatchByArea, PlacedPatch};
pub use polygon::{Polygon, PolygonByArea, PolygonByProjectedSolidAngle, PolygonBySolidAngle};
pub use round::{
    Cylinder, CylinderByArea, Disk, DiskByArea, DiskBySolidAngle, Sphere, SphereByArea, SphereByProjectedSolidAngle,
    SphereBySolidAngle,
};
pub use sample::{AreaSample, FAR, LightSample};
pub use sampler::{ByArea, ByCosineWarp, ByProjectedSolidAngle, BySolidAngle, LightSampler};
pub use surface::{
    AreaSurface, PlacedDisk, PlacedParallelogram, PlacedPolygon, PlacedSphere, PlacedTriangle, Surface, SurfaceHit,
    SurfacePoint,
};
