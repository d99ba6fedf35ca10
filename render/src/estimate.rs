//! The light that surfaces reflect towards the camera: one file for each way to estimate it.
//!
//! Direct light is ∫ f · L · V · cosθ dω over the directions ω: the BSDF f, the radiance L of the lights, and whether they are visible, V.
//! [`by_light`] draws a direction to a light, [`by_surface`] draws one from the BSDF or over the hemisphere, and [`sampled`] adds both, with
//! the weights of [`mis`]. What they integrate is what the [ledger](crate::ledger) leaves: all of the light, if nothing is known.
//!
//! Eight packets of eight shading points form a [`Group`], so that their shadow rays are traced together.

mod by_light;
mod by_surface;
mod group;
mod mis;
mod points;
mod sampled;
mod tracer;
mod which_light;

pub(crate) use group::{Group, Know, Numbers, Outlook};
#[cfg(feature = "analytic")]
pub(crate) use points::Place;
pub(crate) use points::{Points, keep, product};
pub(crate) use sampled::Sampled;
pub use tracer::RayCount;
pub(crate) use tracer::Tracer;
