//! What is known of the lights before any is sampled, and the light that follows from it, where geometry tells what can hide them.
//!
//! `etendue-visible` proves what may lie between a patch of a surface and a light: nothing, something that hides it all, or a few convex
//! solids. [`Certifier`] asks it with this renderer's tree and shapes. `Knowledge` asks that for what a tile of the image sees, writes what
//! is proved into the ledger, and adds the closed forms of the lights that are known; estimators sample the rest.

mod bodies;
mod certifiable;
mod certificates;
mod certifier;
mod closed_forms;
mod diffuse;
mod knowledge;
mod picture_irradiance;
mod rough;
mod trial;
mod visible;

pub use bodies::Bodies;
pub(crate) use certifiable::Certifiable;
pub use certifier::{Certifier, patch};
pub(crate) use knowledge::Knowledge;
