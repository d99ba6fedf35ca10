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
//! A host that stores a sampler names its type by the light and the method, such as `light::TriangleBySolidAngle<f32>`: a [`ByArea`],
//! [`BySolidAngle`], [`ByProjectedSolidAngle`] or [`ByReflection`], which also tell the size of what they sample.
//!
//! A shape with the same values in all lanes (`splat`) draws a packet of samples of one light. Lanes may as well hold different lights,
//! and the shading points may differ.
//!
//! | light | by area | by solid angle | by projected solid angle |
//! |---|---|---|---|
//! | [`Sphere`] | [`by_area`](Sphere::by_area) wastes all but (1−R/d)/2 of its samples | [`by_solid_angle`](Sphere::by_solid_angle), always better | [`by_projected_solid_angle`](Sphere::by_projected_solid_angle): diffuse surfaces |
//! | [`Triangle`] | [`by_area`](Triangle::by_area): small for its distance | [`by_solid_angle`](Triangle::by_solid_angle): all others | [`by_projected_solid_angle`](Triangle::by_projected_solid_angle) |
//! | [`Parallelogram`] | [`by_area`](Parallelogram::by_area) | [`by_solid_angle`](Parallelogram::by_solid_angle) | [`by_projected_solid_angle`](Parallelogram::by_projected_solid_angle) |
//! | [`Rectangle`] | [`by_area`](Rectangle::by_area) | [`by_solid_angle`](Rectangle::by_solid_angle) | [`by_projected_solid_angle`](Rectangle::by_projected_solid_angle) |
//! | [`Polygon`], 3 to 8 corners | [`by_area`](Polygon::by_area) | [`by_solid_angle`](Polygon::by_solid_angle) | [`by_projected_solid_angle`](Polygon::by_projected_solid_angle) |
//! | [`BilinearPatch`] | [`by_area`](BilinearPatch::by_area) | | |
//! | [`Disk`] | [`by_area`](Disk::by_area) | [`by_solid_angle`](Disk::by_solid_angle) | |
//! | an [`Affine`] sphere or disk: ellipsoids | | [`by_solid_angle`](Affine::by_solid_angle), nearly | |
//! | [`Line`] | [`by_length`](Line::by_length) | [`by_angle`](Line::by_angle) | [`by_projected_solid_angle`](Line::by_projected_solid_angle) |
//! | [`Sun`] | | [`by_solid_angle`](Sun::by_solid_angle) | |
//! | [`ConstantEnvironment`] | | [`by_solid_angle`](ConstantEnvironment::by_solid_angle) | [`by_projected_solid_angle`](ConstantEnvironment::by_projected_solid_angle) |
//! | [`ImageEnvironment`] | | [`by_radiance`](ImageEnvironment::by_radiance): in proportion to an image, [`Rotated`] where its axes are others | |
//! | [`PortalEnvironment`] | | [`by_radiance`](PortalEnvironment::by_radiance): what is seen of an image through portals | |
//! | a flat light with a [`Picture`] | [`by_area`](PicturedLight::by_area) | [`by_solid_angle`](PicturedLight::by_solid_angle) | [`by_projected_solid_angle`](PicturedLight::by_projected_solid_angle) |
//! | a [`Sphere`] with a [`Picture`] | [`by_visible_area`](PicturedLight::by_visible_area) | | |
//! | [`PointLight`], [`SpotLight`], [`DirectionalLight`] | `by_delta`: one direction, `delta` holds | | |
//!
//! Where the intensity of a light differs by direction, multiply the weight by it.
//!
//! Cells are empty where no map is here that keeps the contract at every size: for the solid angle of bilinear patches, and the projected
//! solid angle of disks. A sun and a constant environment have no area.
//!
//! # Costs
//! Nanoseconds per sample on one core, of the call that a renderer makes: direction, distance, pdf, `emits` and `delta`, with the
//! preparation for a point of its own in each lane, and prepared once. The last column adds the normal and the surface coordinates,
//! which cost nothing unless they are used. (`cargo bench -p etendue-benches --bench summary -- --tables`)
//!
//! <!-- table: lights -->
//! AMD EPYC, x86-64-v3, 2026-11-25.
//!
//! | light | by | x1 | x8 | prepared, x1 | prepared, x8 | pdf, x8 | invert, x8 | all fields, x8 |
//! |---|---|---|---|---|---|---|---|---|
//! | sphere | area | 15.1 | 1.69 | 14.5 | 1.72 | 1.61 | 3.01 | 1.81 |
//! |  | solid angle | 28.6 | 3.09 | 7.54 | 0.87 | 0.22 | 0.91 | 8.02 |
//! |  | projected solid angle | 55.4 | 8.45 | 15.4 | 3.01 | 0.16 | 2.10 | 12.8 |
//! |  | reflection | 606.8 | 84.0 | 245.9 | 35.9 | 14.9 | 14.0 | 84.2 |
//! | triangle | area | 37.1 | 7.15 | 12.3 | 1.59 | 0.53 | 0.47 | 7.23 |
//! |  | solid angle | 125.3 | 17.0 | 21.5 | 2.73 | 0.21 | 3.00 | 17.9 |
//! |  | projected solid angle | 454.1 | 104.9 | 40.3 | 7.44 | 0.25 | 32.4 | 109.2 |
//! |  | reflection | 552.9 | 113.2 | 160.4 | 27.3 | 0.82 | 15.6 | 112.8 |
//! | parallelogram | area | 38.5 | 7.18 | 10.2 | 1.33 | 0.63 | 0.36 | 7.40 |
//! |  | solid angle | 170.2 | 23.1 | 27.6 | 3.66 | 0.26 | 5.31 | 24.1 |
//! |  | projected solid angle | 1351.6 | 321.5 | 67.3 | 14.1 | 0.37 | 41.2 | 322.0 |
//! |  | reflection | 998.2 | 321.2 | 183.5 | 34.6 | 0.95 | 18.5 | 318.6 |
//! | rectangle | area | 37.5 | 7.11 | 10.2 | 1.32 | 0.59 | 0.36 | 7.30 |
//! |  | solid angle | 170.1 | 29.0 | 34.2 | 4.73 | 0.26 | 6.22 | 28.7 |
//! |  | projected solid angle | 1220.2 | 307.3 | 68.0 | 12.1 | 0.30 | 44.9 | 307.3 |
//! |  | reflection | 988.7 | 318.8 | 186.0 | 35.6 | 0.92 | 18.2 | 321.0 |
//! | polygon, 5 corners | area | 68.4 | 10.1 | 18.0 | 2.46 | 0.66 | 4.00 | 10.7 |
//! |  | solid angle | 287.0 | 44.8 | 33.7 | 4.06 | 0.83 | 4.58 | 45.5 |
//! |  | projected solid angle | 1558.5 | 396.2 | 82.8 | 14.8 | 0.35 | 49.6 | 418.3 |
//! |  | reflection | 1308.1 | 376.6 | 191.2 | 36.6 | 1.07 | 22.3 | 377.9 |
//! | disk | area | 19.9 | 2.63 | 18.0 | 2.36 | 0.54 | 2.96 | 2.69 |
//! |  | solid angle | 214.1 | 27.6 | 95.9 | 11.9 | 2.31 | 6.48 | 30.6 |
//! | bilinear patch | area | 46.2 | 5.28 | 40.2 | 5.28 | 10.3 | 7.40 | 5.33 |
//! | line | length | 31.6 | 2.56 | 8.04 | 1.02 | 0.36 | 0.53 | 3.57 |
//! |  | angle | 104.6 | 8.57 | 13.1 | 1.58 | 0.34 | 1.55 | 9.44 |
//! |  | projected solid angle | 261.0 | 31.1 | 119.1 | 15.0 | 0.51 | 3.94 | 31.2 |
//! | sun | solid angle | 5.39 | 0.67 | 5.75 | 0.66 | 0.23 | 0.97 | 0.71 |
//! | point light | delta | 5.42 | 0.62 | 0.50 | 0.11 | 0.05 | 0.05 | 0.70 |
//! | spot light | delta | 10.7 | 1.26 | 0.51 | 0.11 | 0.04 | 0.04 | 1.38 |
//! | directional light | delta | 0.54 | 0.11 | 0.50 | 0.11 | 0.05 | 0.04 | 0.19 |
//! <!-- end of table -->
//!
//! Parallelograms, and inverses by projected solid angle and by reflection, are of 2026-11-28.
//!
//! Without compiler flags a packet of 8 is two registers, and a product and sum two instructions;
//! `CARGO_ENCODED_RUSTFLAGS= cargo bench -p etendue-benches --bench summary -- light` prints what that costs.

mod affine;
pub(crate) mod bound;
mod cells;
mod delta;
mod direction;
mod disk;
mod distant;
mod environment;
mod hierarchy;
mod line;
mod on_surface;
mod parallelogram;
#[doc(hidden)]
pub mod parts;
mod patch;
mod picture;
mod pictured;
mod pictured_flat;
mod pictured_sphere;
mod plane;
mod polygon;
mod portal;
mod rectangle;
mod rotated;
mod sample;
mod sampler;
mod seen;
mod sphere;
mod surface;
mod techniques;
mod triangle;

pub use affine::Affine;
#[doc(hidden)]
pub use affine::AffineSampler;
pub use cells::Region;
pub use delta::{DirectionalLight, PointLight, SpotLight};
#[doc(hidden)]
pub use delta::{DirectionalLightByDelta, PointLightByDelta, SpotLightByDelta};
#[doc(hidden)]
pub use direction::DirectionSample;
pub use disk::Disk;
#[doc(hidden)]
pub use disk::{DiskByArea, DiskBySolidAngle};
pub use distant::{ConstantEnvironment, Sun};
#[doc(hidden)]
pub use distant::{EnvironmentByProjectedSolidAngle, EnvironmentBySolidAngle, SunBySolidAngle};
#[doc(hidden)]
pub use environment::{ByRadiance, EnvironmentMap, ImageEnvironment, Texel};
pub use line::Line;
#[doc(hidden)]
pub use line::{LineByAngle, LineByLength, LineByProjectedSolidAngle};
pub use parallelogram::Parallelogram;
#[doc(hidden)]
pub use parallelogram::{
    ParallelogramByArea, ParallelogramByProjectedSolidAngle, ParallelogramByReflection, ParallelogramBySolidAngle,
};
pub use patch::BilinearPatch;
#[doc(hidden)]
pub use patch::PatchByArea;
pub use picture::Picture;
pub use pictured::{PicturedLight, PicturedSampler};
#[doc(hidden)]
pub use pictured_flat::{Area, Flat, FlatLight, Projected, SolidAngle};
#[doc(hidden)]
pub use pictured_sphere::VisibleSphere;
pub use polygon::Polygon;
#[doc(hidden)]
pub use polygon::{PolygonByArea, PolygonByProjectedSolidAngle, PolygonByReflection, PolygonBySolidAngle};
pub use portal::{Portal, PortalEnvironment, PortalError, PortalMap, PortalTable, PortalsByRadiance};
pub use rectangle::Rectangle;
#[doc(hidden)]
pub use rectangle::RectangleBySolidAngle;
pub use rotated::Rotated;
pub use sample::{FAR, LightSample, TexelSample};
#[doc(hidden)]
pub use sampler::SeenShape;
pub use sampler::{ByArea, ByProjectedSolidAngle, ByReflection, BySolidAngle, LightSampler};
#[doc(hidden)]
pub use seen::SphericalShape;
pub use sphere::Sphere;
#[doc(hidden)]
pub use sphere::{SphereByArea, SphereByProjectedSolidAngle, SphereByReflection, SphereBySolidAngle};
#[cfg(feature = "alloc")]
pub(crate) use surface::{AreaSurface, SurfacePoint};
#[doc(hidden)]
pub use techniques::Example;
pub use triangle::Triangle;
#[doc(hidden)]
pub use triangle::{TriangleByArea, TriangleByProjectedSolidAngle, TriangleByReflection, TriangleBySolidAngle};
