//! Judges samplers of lights: anybody's.
//!
//! [`sampler`] says what a sampler is, [`scene`] where it is tried, [`definition`] what it is compared with, [`observe`] what it is asked,
//! [`figures`] how each of the list in [`measured`] is measured, and [`verdict`] what is said; [`shrink`] makes the inputs small that show it.

pub mod definition;
#[cfg(feature = "checks")]
pub mod figures;
#[cfg(feature = "checks")]
mod grid;
#[cfg(feature = "checks")]
pub mod measured;
#[cfg(feature = "checks")]
pub mod observe;
pub mod sampler;
#[cfg(feature = "checks")]
pub mod scene;
#[cfg(feature = "checks")]
pub mod shrink;
#[cfg(feature = "checks")]
pub mod verdict;
