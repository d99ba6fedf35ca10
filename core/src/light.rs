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
//! `benches/RESULTS.md` has nanoseconds per sample on one core, of the call that a renderer makes: direction, distance, pdf, `emits` and
//! `delta`, with the preparation for a point of its own in each lane, and prepared once. The normal and the surface coordinates cost
//! nothing unless they are used.
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
