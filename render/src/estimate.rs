//! The light that surfaces reflect towards the camera: one file for each way to estimate it.
//!
//! Direct light is ∫ f · L · V · cosθ dω over the directions ω: the BSDF f, the radiance L of the lights, and whether they are visible, V.
//! [`by_light`] draws a direction to a light, [`by_surface`] draws one from the BSDF or over the hemisphere, and [`sampled`] adds both, with
//! the weights of [`mis`]. What they integrate is what the [`Ledger`](crate::know::Ledger) leaves: all of the light, if nothing is known.
//!
//! Eight packets of eight shading points form a [`Group`](crate::camera::Group), so that their shadow rays are traced together.

mod by_light;
mod by_surface;
mod mis;
mod sampled;
mod unoccluded;
mod which_light;

pub(crate) use sampled::Sampled;
