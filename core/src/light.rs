//! Light shapes, and the samplers that they are prepared into for a shading point.
//!
//! ```
//! use etendue::{LightSampler, Parallelogram, Vec2};
//! let panel = Parallelogram::new([-1.0, 2.0, -1.0].into(), [2.0, 0.0, 0.0].into(), [0.0, 0.0, 2.0_f32].into());
//! let sampler = panel.by_solid_angle([0.0; 3].into()); // once for a shading point
//! let s = sampler.sample(Vec2::new(0.3, 0.6)); // as often as needed
//! let irradiance = s.direction.y * s.weight(); // per unit of radiance, on a receiver that faces up
//! assert!((irradiance - s.direction.y / s.pdf).abs() < 1e-6 && sampler.pdf(s.direction) == s.pdf);
//! ```
//!
//! Each `by_…` method is one technique, and all return a [`LightSampler`], so that an integrator is generic over light and measure. The
//! estimator of reflected radiance is `f · L · cosθ · weight()`, once a shadow ray along `direction` has reached `distance`; the weight is
//! 0 in lanes without a sample.
//!
//! A shape with the same values in all lanes (`splat`) draws a packet of samples of one light. Lanes may as well hold different lights,
//! and the shading points may differ.
//!
//! | light | by area | by solid angle | by projected solid angle |
//! |---|---|---|---|
//! | [`Sphere`] | [`by_area`](Sphere::by_area) wastes all but (1−R/d)/2 of its samples | [`by_solid_angle`](Sphere::by_solid_angle), always better | [`by_projected_solid_angle`](Sphere::by_projected_solid_angle): diffuse surfaces |
//! | [`Triangle`] | [`by_area`](Triangle::by_area): small for its distance | [`by_solid_angle`](Triangle::by_solid_angle): all others | [`by_projected_solid_angle`](Triangle::by_projected_solid_angle), or [`by_cosine_warp`](Triangle::by_cosine_warp) |
//! | [`Parallelogram`] | [`by_area`](Parallelogram::by_area) | [`by_solid_angle`](Parallelogram::by_solid_angle) | [`by_projected_solid_angle`](Parallelogram::by_projected_solid_angle) |
//! | [`Rectangle`] | [`by_area`](Rectangle::by_area) | [`by_solid_angle`](Rectangle::by_solid_angle) | [`by_projected_solid_angle`](Rectangle::by_projected_solid_angle), or [`by_cosine_warp`](Rectangle::by_cosine_warp) |
//! | [`Polygon`], 3 to 8 corners | [`by_area`](Polygon::by_area) | [`by_solid_angle`](Polygon::by_solid_angle) | [`by_projected_solid_angle`](Polygon::by_projected_solid_angle) |
//! | [`BilinearPatch`] | [`by_area`](BilinearPatch::by_area) | | |
//! | [`Annulus`] | [`by_area`](Annulus::by_area) | | |
//! | [`Disk`] | [`by_area`](Disk::by_area) | [`by_solid_angle`](Disk::by_solid_angle) | |
//! | [`Cylinder`] | [`by_area`](Cylinder::by_area): more than half of it faces away | | |
//! | [`Line`] | [`by_length`](Line::by_length) | [`by_angle`](Line::by_angle) | [`by_projected_solid_angle`](Line::by_projected_solid_angle) |
//! | [`Sun`] | | [`by_solid_angle`](Sun::by_solid_angle) | |
//! | [`ConstantEnvironment`] | | [`by_solid_angle`](ConstantEnvironment::by_solid_angle) | [`by_projected_solid_angle`](ConstantEnvironment::by_projected_solid_angle) |
//! | [`ImageEnvironment`] | | [`by_radiance`](ImageEnvironment::by_radiance): in proportion to an image | |
//! | [`PointLight`], [`SpotLight`], [`DirectionalLight`] | `by_delta`: one direction, `delta` holds | | |
//!
//! Cells are empty where no map is here that keeps the contract at every size: for the solid angles of cylinders, annuli and bilinear
//! patches, and the projected solid angle of disks. A sun and a constant environment have no area.
//!
//! # Costs
//! Nanoseconds per sample on one core, of the call that a renderer makes: direction, distance, pdf, `emits` and `delta`, with the
//! preparation for a point of its own in each lane, and prepared once. The last column adds the normal and the surface coordinates,
//! which cost nothing unless they are used. (`cargo bench -p etendue-benches --bench summary -- --tables`)
//!
//! <!-- table: lights -->
//! AMD EPYC, x86-64-v3, 2026-11-24.
//!
//! | light | by | x1 | x8 | prepared, x1 | prepared, x8 | pdf, x8 | invert, x8 | all fields, x8 |
//! |---|---|---|---|---|---|---|---|---|
//! | sphere | area | 15.5 | 1.73 | 14.7 | 1.72 | 1.64 | 3.06 | 1.78 |
//! |  | solid angle | 29.2 | 3.15 | 7.88 | 0.92 | 0.23 | 0.93 | 8.40 |
//! |  | projected solid angle | 57.6 | 8.79 | 15.9 | 3.09 | 0.17 | 2.17 | 13.3 |
//! | triangle | area | 38.7 | 5.83 | 12.7 | 1.64 | 0.54 | 0.47 | 5.88 |
//! |  | solid angle | 119.4 | 15.1 | 21.5 | 2.75 | 0.21 | 3.05 | 18.3 |
//! |  | projected solid angle | 444.5 | 103.3 | 39.7 | 7.31 | 0.26 | 36.7 | 102.3 |
//! |  | cosine warp | 234.0 | 27.6 | 106.7 | 13.4 | 4.70 | 4.65 | 28.3 |
//! | parallelogram | area | 39.3 | 4.98 | 10.2 | 1.32 | 0.60 | 0.36 | 5.87 |
//! |  | solid angle | 164.8 | 23.0 | 26.4 | 3.58 | 0.27 | 5.29 | 22.9 |
//! |  | projected solid angle | 1121.6 | 294.7 | 70.1 | 12.2 | 0.30 | 52.5 | 297.2 |
//! | rectangle | area | 37.8 | 4.62 | 10.2 | 1.32 | 0.59 | 0.36 | 8.48 |
//! |  | solid angle | 171.2 | 26.2 | 34.5 | 4.77 | 0.26 | 6.26 | 29.1 |
//! |  | projected solid angle | 1224.9 | 273.7 | 69.6 | 12.1 | 0.30 | 53.5 | 271.3 |
//! |  | cosine warp | 330.2 | 44.4 | 154.6 | 20.0 | 7.75 | 7.65 | 45.6 |
//! | polygon, 5 corners | area | 67.7 | 9.96 | 17.6 | 2.48 | 0.67 | 4.06 | 10.7 |
//! |  | solid angle | 291.8 | 45.8 | 34.5 | 4.17 | 0.85 | 4.66 | 45.7 |
//! |  | projected solid angle | 1586.6 | 401.4 | 80.6 | 14.4 | 0.34 | 66.2 | 401.7 |
//! | disk | area | 19.2 | 2.59 | 17.8 | 2.33 | 0.54 | 2.92 | 2.64 |
//! |  | solid angle | 211.6 | 27.3 | 94.1 | 11.7 | 2.27 | 6.41 | 30.1 |
//! | annulus | area | 18.2 | 2.25 | 17.4 | 2.08 | 0.62 | 2.26 | 2.34 |
//! | cylinder | area | 15.0 | 1.76 | 14.3 | 1.77 | 2.78 | 2.56 | 1.82 |
//! | bilinear patch | area | 46.0 | 5.24 | 40.3 | 5.23 | 10.2 | 7.30 | 5.29 |
//! | line | length | 31.5 | 2.55 | 7.87 | 1.00 | 0.35 | 0.53 | 3.53 |
//! |  | angle | 102.7 | 8.42 | 12.6 | 1.52 | 0.32 | 1.48 | 8.91 |
//! |  | projected solid angle | 250.5 | 29.4 | 115.6 | 14.6 | 0.46 | 3.76 | 29.8 |
//! | sun | solid angle | 5.20 | 0.64 | 5.53 | 0.64 | 0.22 | 0.92 | 0.69 |
//! <!-- end of table -->
//!
//! Without compiler flags a packet of 8 is two registers, and software computes each fused multiply-add, with the same bits;
//! `CARGO_ENCODED_RUSTFLAGS= cargo bench -p etendue-benches --bench summary -- light` prints what that costs.

mod annulus;
mod cylinder;
mod delta;
mod disk;
mod distant;
mod environment;
mod flat;
mod line;
mod patch;
mod polygon;
mod sample;
mod sampler;
mod sphere;
mod surface;
mod techniques;

pub use annulus::{Annulus, AnnulusByArea, PlacedAnnulus};
pub use cylinder::{Cylinder, CylinderByArea, PlacedCylinder};
pub use delta::{
    DirectionalLight, DirectionalLightByDelta, PointLight, PointLightByDelta, SpotLight, SpotLightByDelta,
};
pub use disk::{Disk, DiskByArea, DiskBySolidAngle, PlacedDisk};
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
pub use polygon::{PlacedPolygon, Polygon, PolygonByArea, PolygonByProjectedSolidAngle, PolygonBySolidAngle};
pub use sample::{AreaSample, FAR, LightSample};
pub use sampler::{ByArea, ByCosineWarp, ByProjectedSolidAngle, BySolidAngle, LightSampler};
pub use sphere::{PlacedSphere, Sphere, SphereByArea, SphereByProjectedSolidAngle, SphereBySolidAngle};
pub use surface::{AreaSurface, PlacedParallelogram, PlacedTriangle, Surface, SurfaceHit, SurfacePoint};
