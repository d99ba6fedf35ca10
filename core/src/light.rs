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
//! | [`Rectangle`] | [`by_area`](Rectangle::by_area) | [`by_solid_angle`](Rectangle::by_solid_angle) | [`by_cosine_warp`](Rectangle::by_cosine_warp) |
//! | [`Polygon`], 3 to 8 corners | [`by_area`](Polygon::by_area) | [`by_solid_angle`](Polygon::by_solid_angle) | [`by_projected_solid_angle`](Polygon::by_projected_solid_angle) |
//! | [`BilinearPatch`] | [`by_area`](BilinearPatch::by_area) | | |
//! | [`Disk`] | [`by_area`](Disk::by_area) | [`by_solid_angle`](Disk::by_solid_angle) | |
//! | [`Cylinder`] | [`by_area`](Cylinder::by_area): more than half of it faces away | | |
//! | [`Line`] | [`by_length`](Line::by_length) | [`by_angle`](Line::by_angle) | [`by_projected_solid_angle`](Line::by_projected_solid_angle) |
//! | [`Sun`] | | [`by_solid_angle`](Sun::by_solid_angle) | |
//! | [`ConstantEnvironment`] | | [`by_solid_angle`](ConstantEnvironment::by_solid_angle) | [`by_projected_solid_angle`](ConstantEnvironment::by_projected_solid_angle) |
//! | [`ImageEnvironment`] | | [`by_radiance`](ImageEnvironment::by_radiance): in proportion to an image | |
//! | [`PointLight`], [`SpotLight`], [`DirectionalLight`] | `prepare`: one direction, `delta` holds | | |
//!
//! # Costs
//! Nanoseconds per sample on one core, of the call that a renderer makes: direction, distance, pdf, `emits` and `delta`, with the
//! preparation for a point of its own in each lane, and prepared once. The last column adds the normal and the surface coordinates,
//! which cost nothing unless they are used. (`cargo bench -p etendue-benches --bench summary -- --tables`)
//!
//! <!-- table: lights -->
//! Intel(R) Xeon(R) Processor, x86-64-v3, 2026-11-22.
//!
//! | light | by | x1 | x8 | prepared, x1 | prepared, x8 | pdf, x8 | invert, x8 | all fields, x8 |
//! |---|---|---|---|---|---|---|---|---|
//! | sphere | area | 30.3 | 3.77 | 29.8 | 3.58 | 2.85 | 5.08 | 3.98 |
//! |  | solid angle | 52.2 | 6.45 | 16.6 | 2.18 | 0.47 | 2.10 | 15.6 |
//! |  | projected solid angle | 185.6 | 30.3 | 26.8 | 5.06 | 0.28 | 4.01 | 36.9 |
//! | triangle | area | 78.2 | 10.6 | 24.3 | 2.65 | 1.37 | 1.01 | 11.2 |
//! |  | solid angle | 243.0 | 33.9 | 39.7 | 5.97 | 0.43 | 4.82 | 35.0 |
//! |  | projected solid angle | 695.4 | 132.8 | 63.8 | 14.4 | 0.54 | 20.6 | 137.1 |
//! |  | cosine warp | 443.8 | 61.1 | 176.7 | 23.0 | 7.50 | 7.44 | 51.3 |
//! | parallelogram | area | 74.0 | 8.63 | 19.1 | 1.93 | 1.10 | 0.65 | 10.4 |
//! |  | solid angle | 294.9 | 49.6 | 54.7 | 8.20 | 0.61 | 10.2 | 47.3 |
//! |  | projected solid angle | 1282.0 | 339.7 | 173.7 | 44.0 | 0.60 | 32.6 | 302.3 |
//! | rectangle | area | 81.7 | 10.8 | 19.4 | 1.95 | 1.46 | 0.82 | 11.1 |
//! |  | solid angle | 365.0 | 53.9 | 70.3 | 9.86 | 0.57 | 11.3 | 55.2 |
//! |  | cosine warp | 556.8 | 84.4 | 256.4 | 36.5 | 14.9 | 13.5 | 76.4 |
//! | polygon, 5 corners | area | 132.3 | 17.3 | 37.0 | 5.26 | 1.23 | 9.50 | 21.0 |
//! |  | solid angle | 545.2 | 94.8 | 53.9 | 8.83 | 1.44 | 8.34 | 84.3 |
//! |  | projected solid angle | 2089.7 | 662.4 | 236.9 | 54.8 | 0.69 | 53.5 | 655.9 |
//! | disk | area | 55.2 | 5.08 | 43.5 | 4.90 | 0.90 | 5.40 | 5.42 |
//! |  | solid angle | 361.0 | 47.8 | 144.8 | 20.8 | 3.49 | 10.9 | 49.1 |
//! | cylinder | area | 24.2 | 2.95 | 29.6 | 3.74 | 4.18 | 3.89 | 3.10 |
//! | bilinear patch | area | 69.8 | 9.03 | 65.7 | 9.01 | 13.7 | 10.3 | 9.07 |
//! | line | length | 55.0 | 5.17 | 16.1 | 1.72 | 0.70 | 1.04 | 6.77 |
//! |  | angle | 317.7 | 15.2 | 25.9 | 3.78 | 0.60 | 2.80 | 14.4 |
//! |  | projected solid angle | 421.8 | 56.6 | 198.8 | 26.3 | 0.94 | 6.62 | 57.7 |
//! <!-- end of table -->
//!
//! Without compiler flags a packet of 8 is two registers, and software computes each fused multiply-add, with the same bits;
//! `CARGO_ENCODED_RUSTFLAGS= cargo bench -p etendue-benches --bench summary -- light` prints what that costs.

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
