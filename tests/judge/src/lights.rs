//! Judges samplers of lights: anybody's.
//!
//! [`sampler`] says what a sampler is, [`scene`] where it is tried, [`definition`] what it is compared with, [`observe`] what it is asked,
//! [`figures`] what is measured, and [`verdict`] what is said; [`shrink`] makes the inputs small that show it.

pub mod definition;
pub mod figures;
pub mod observe;
pub mod sampler;
pub mod scene;
pub mod shrink;
pub mod verdict;
