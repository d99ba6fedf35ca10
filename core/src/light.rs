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
//! | [`PointLight`], [`SpotLight`], [`DirectionalLight`] | `prepare`: one direction, `delta` holds | | |
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
//! AMD EPYC, x86-64-v3, 2026-11-23.
//!
//! | light | by | x1 | x8 | prepared, x1 | prepared, x8 | pdf, x8 | invert, x8 | all fields, x8 |
//! |---|---|---|---|---|---|---|---|---|
//! | sphere | area | 18.2 | 2.50 | 18.1 | 2.30 | 2.08 | 3.38 | 2.50 |
//! |  | solid angle | 35.9 | 4.39 | 10.1 | 1.32 | 0.28 | 1.19 | 10.4 |
//! |  | projected solid angle | 75.2 | 10.0 | 17.2 | 3.05 | 0.21 | 2.37 | 14.8 |
//! | triangle | area | 55.6 | 7.44 | 15.6 | 1.97 | 0.75 | 0.59 | 7.54 |
//! |  | solid angle | 153.8 | 27.1 | 26.2 | 3.58 | 0.25 | 3.51 | 22.2 |
//! |  | projected solid angle | 539.2 | 127.7 | 58.8 | 9.96 | 0.30 | 52.9 | 129.2 |
//! |  | cosine warp | 289.9 | 44.0 | 124.2 | 16.2 | 5.48 | 5.12 | 42.3 |
//! | parallelogram | area | 55.5 | 7.28 | 12.8 | 1.70 | 0.82 | 0.44 | 7.74 |
//! |  | solid angle | 216.7 | 34.7 | 33.0 | 4.39 | 0.33 | 7.06 | 34.9 |
//! |  | projected solid angle | 1359.3 | 474.1 | 92.8 | 14.3 | 0.35 | 72.5 | 478.3 |
//! | rectangle | area | 54.8 | 7.27 | 12.8 | 1.68 | 0.81 | 0.44 | 7.58 |
//! |  | solid angle | 247.5 | 36.6 | 43.7 | 5.85 | 0.31 | 7.75 | 38.4 |
//! |  | cosine warp | 404.5 | 59.9 | 173.8 | 22.4 | 8.80 | 8.66 | 58.2 |
//! | polygon, 5 corners | area | 97.1 | 14.6 | 21.8 | 3.02 | 0.94 | 5.91 | 14.4 |
//! |  | solid angle | 398.2 | 63.5 | 39.4 | 5.56 | 0.99 | 6.67 | 63.6 |
//! |  | projected solid angle | 1875.4 | 673.3 | 117.9 | 20.3 | 0.51 | 91.9 | 675.2 |
//! | disk | area | 25.1 | 3.45 | 22.3 | 2.81 | 0.69 | 3.29 | 3.53 |
//! |  | solid angle | 273.6 | 36.0 | 119.3 | 15.1 | 2.70 | 7.04 | 37.5 |
//! | cylinder | area | 18.6 | 2.45 | 18.0 | 2.36 | 3.35 | 2.77 | 2.59 |
//! | bilinear patch | area | 51.4 | 5.93 | 46.1 | 6.09 | 10.0 | 7.65 | 6.11 |
//! | line | length | 34.6 | 3.25 | 10.6 | 1.26 | 0.43 | 0.65 | 4.49 |
//! |  | angle | 109.9 | 9.80 | 14.5 | 1.97 | 0.43 | 2.08 | 10.6 |
//! |  | projected solid angle | 279.8 | 35.6 | 123.2 | 16.0 | 0.62 | 4.23 | 36.5 |
//! | sun | solid angle | 6.04 | 0.79 | 6.49 | 0.77 | 0.28 | 1.19 | 0.82 |
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
pub use delta::{DeltaSampler, DirectionalLight, PointLight, SpotLight};
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
