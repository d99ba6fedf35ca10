//! A set of lights of any kind, chosen and sampled by one call.
//!
//! ```
//! use etendue::lights::{Emitter, Lights, Receiver, Side};
//! use etendue::{ConstantEnvironment, PointLight, Sphere, Vec3};
//! // lights of any kind, each with its radiance or intensity
//! let lamps: [(Emitter<f32>, f32); 3] = [
//!     (Sphere::new(Vec3::lit([0.0, 2.0, 0.0]), 0.3).into(), 8.0),
//!     (PointLight::new(Vec3::lit([2.0, 1.0, 0.0])).into(), 1.5),
//!     (ConstantEnvironment.into(), 0.2),
//! ];
//! let lights = Lights::new(lamps)?;
//! let (point, normal) = (Vec3::lit([0.5, 0.0, 0.0]), Vec3::lit([0.0, 1.0, 0.0]));
//! let at = lights.at(Receiver { point, side: Side::Surface(normal), on: None });
//! let s = at.sample([0.3, 0.6, 0.2]);
//! // here a renderer traces a shadow ray along s.direction up to s.reach()
//! let radiance = [8.0, 1.5, 0.2][s.which.light as usize];
//! let irradiance = radiance * normal.dot(s.direction).max(0.0) * s.weight();
//! assert!(irradiance > 0.0 && (s.delta || at.pdf(s.which, s.direction) == s.pdf));
//! # Ok::<(), etendue::select::LightsError>(())
//! ```
//!
//! [`Lights`] are of `f32` or `f64`, and compiled with this library: a debug build of a host with `opt-level = 3` for its dependencies calls
//! optimised code.

mod emission;
mod emitter;
mod mixture;
mod prepared;
mod receiver;
mod set;

pub use emission::Emission;
pub use emitter::Emitter;
pub use mixture::{Mixture, MixtureAt, Source};
pub use receiver::{LightsSample, Receiver, Side, Which};
pub use set::{Lights, LightsAt, Number};
