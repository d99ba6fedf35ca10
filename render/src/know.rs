//! What is known of the lights before any is sampled, and the light that follows from it, where geometry tells what can hide them.
//!
//! `etendue-visible` proves what may lie between a patch of a surface and a light: nothing, something that hides it all, or a few convex
//! solids. [`Certifier`] asks it with this renderer's tree and shapes. `Knowledge` asks that for what a tile of the image sees, writes what
//! is proved into the ledger, and adds the closed forms of the lights that are known; estimators sample the rest.

#[cfg(feature = "analytic")]
mod bodies;
#[cfg(feature = "analytic")]
mod certifiable;
#[cfg(feature = "analytic")]
mod certificates;
#[cfg(feature = "analytic")]
mod certifier;
#[cfg(feature = "analytic")]
mod closed_forms;
#[cfg(feature = "analytic")]
mod diffuse;
#[cfg(feature = "analytic")]
mod knowledge;
mod ledger;
#[cfg(feature = "analytic")]
mod picture_irradiance;
#[cfg(feature = "analytic")]
mod rough;
#[cfg(feature = "analytic")]
mod trial;

#[cfg(feature = "analytic")]
pub use bodies::Bodies;
#[cfg(feature = "analytic")]
pub(crate) use certifiable::Certifiable;
#[cfg(feature = "analytic")]
pub use certifier::{Certifier, patch};
#[cfg(feature = "analytic")]
pub(crate) use knowledge::Knowledge;
pub(crate) use ledger::{Know, Ledger, Outlook};
#[cfg(feature = "analytic")]
pub use picture_irradiance::PictureIrradiance;
