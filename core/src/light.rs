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
//! | sphere | area | 26.2 | 3.32 | 29.6 | 3.58 | 2.80 | 5.04 | 4.04 |
//! |  | solid angle | 56.7 | 6.72 | 18.2 | 2.35 | 0.53 | 2.29 | 16.0 |
//! |  | projected solid angle | 190.0 | 31.8 | 26.3 | 4.80 | 0.39 | 4.44 | 40.1 |
//! | triangle | area | 73.5 | 5.33 | 26.6 | 2.80 | 1.44 | 1.18 | 5.41 |
//! |  | solid angle | 165.8 | 24.9 | 40.8 | 5.98 | 0.49 | 4.98 | 33.4 |
//! |  | projected solid angle | 653.4 | 124.2 | 57.0 | 11.3 | 0.51 | 20.3 | 106.0 |
//! |  | cosine warp | 435.6 | 61.0 | 175.8 | 21.8 | 6.45 | 6.60 | 59.9 |
//! | parallelogram | area | 70.2 | 4.95 | 21.2 | 2.37 | 1.47 | 0.77 | 4.95 |
//! |  | solid angle | 322.3 | 47.1 | 47.9 | 7.91 | 0.49 | 7.48 | 48.0 |
//! |  | projected solid angle | 1402.4 | 410.0 | 219.3 | 49.0 | 0.66 | 38.3 | 370.7 |
//! | rectangle | area | 71.2 | 4.98 | 21.4 | 2.41 | 1.51 | 0.82 | 5.21 |
//! |  | solid angle | 357.9 | 51.6 | 73.8 | 10.3 | 0.59 | 11.7 | 53.3 |
//! |  | cosine warp | 578.9 | 88.1 | 249.0 | 36.0 | 14.8 | 14.0 | 83.0 |
//! | polygon, 5 corners | area | 127.4 | 18.8 | 37.6 | 5.34 | 1.57 | 5.59 | 15.3 |
//! |  | solid angle | 598.3 | 101.5 | 63.8 | 10.5 | 1.67 | 8.09 | 101.1 |
//! |  | projected solid angle | 2016.9 | 645.1 | 248.6 | 56.5 | 0.72 | 58.0 | 658.9 |
//! | disk | area | 30.4 | 3.83 | 37.2 | 4.23 | 1.21 | 5.40 | 3.95 |
//! |  | solid angle | 343.9 | 49.1 | 138.3 | 19.4 | 3.99 | 10.8 | 46.0 |
//! | cylinder | area | 29.2 | 3.62 | 28.7 | 3.50 | 5.59 | 5.40 | 3.77 |
//! | bilinear patch | area | 73.4 | 9.76 | 79.0 | 9.98 | 14.3 | 12.1 | 9.51 |
//! | line | length | 49.8 | 5.94 | 13.9 | 1.81 | 0.76 | 1.03 | 5.94 |
//! |  | angle | 294.8 | 14.3 | 28.2 | 3.53 | 0.65 | 3.06 | 20.5 |
//! |  | projected solid angle | 412.3 | 56.4 | 202.4 | 26.3 | 0.85 | 7.06 | 55.0 |
//! <!-- end of table -->
//!
//! Without compiler flags a packet of 8 is two registers, and the error of a product takes seventeen operations instead of one;
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
