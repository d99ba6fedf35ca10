//! The light that surfaces reflect towards the camera: one file for each way to estimate it.
//!
//! Direct light is ∫ f · L · V · cosθ dω over the directions ω: the BSDF f, the radiance L of the lights, and whether they are visible, V.
//! [`by_light`] draws a direction to a light, [`by_surface`] draws one from the BSDF or over the hemisphere, and [`sampled`] adds both, with
//! the weights of [`mis`]. They take what they integrate from an [`Integrand`]: all of the light, or what something else has left of it.
//!
//! Eight packets of eight shading points form a [`Group`], so that their shadow rays are traced together.

mod by_light;
mod by_surface;
mod group;
mod integrand;
mod mis;
mod points;
mod sampled;
mod tracer;
mod which_light;

#[cfg(feature = "analytic")]
pub(crate) use group::Estimator;
pub(crate) use group::{Group, Numbers, Reflected, TileEstimator};
#[cfg(feature = "analytic")]
pub(crate) use integrand::{Integrand, Plain, Proof};
#[cfg(feature = "analytic")]
pub(crate) use points::Place;
pub(crate) use points::{Points, keep, product};
pub(crate) use sampled::Sampled;
pub use tracer::RayCount;
pub(crate) use tracer::Tracer;
