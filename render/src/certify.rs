//! Light that is computed without samples, where geometry tells what can occlude it.
//!
//! A [`Certifier`] proves, in double precision, what may lie between a [`Patch`] of a surface and a light: nothing, something that hides it
//! all, or a few convex blockers. `Analytic` asks it for what a tile of the image sees, adds the closed forms of the lights of which
//! something is proved, and leaves the rest of the integrand to another estimator.

mod analytic;
mod bodies;
mod certifiable;
mod certificates;
mod certifier;
mod closed_forms;
mod diffuse;
mod picture_irradiance;
mod residual;
mod rough;
mod trial;
mod visible;

pub(crate) use analytic::Analytic;
pub use bodies::Bodies;
pub(crate) use certifiable::Certifiable;
pub use certifier::{Certifier, patch};
