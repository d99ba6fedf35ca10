//! Generators, tolerances, and the properties that every sampler has.
//!
//! A property is a plain function of a [`Subject`](fixture::Subject) (a prepared [`Fixture`](fixture::Fixture): a light or a warp with its
//! parameters) and usually a point of the unit square. It panics when the property is broken, with the fixture, the argument and the figure.
//! The tests in `tests/tests` run the properties over the regimes of [`generators`]; the fuzz targets run them over arbitrary bytes.
//! `tests/README.md` says how to add a warp.
//!
//! - [`etendue_oracle`]: closed forms, double-double arithmetic and quadrature; nothing there calls the code under test.
//! - [`generators`]: arguments biased towards the places where methods fail.
//! - [`tolerances`]: the one table of tolerances, each with its reason.
//! - [`suite`]: all properties over all regimes.
//! - [`fuzz_bodies`]: the bodies of the fuzz targets.
//! - [`checks`]: properties of functions that are not samplers; [`light_tree`]: of trees of lights; [`occlusion`]: of lights behind occluders.
//! - [`stats`] has p-values.

#![allow(clippy::neg_cmp_op_on_partial_ord, reason = "what is NaN is wrong")]

pub mod area_lights;
#[cfg(feature = "checks")]
pub mod checks;
#[cfg(feature = "program")]
pub mod child;
#[cfg(feature = "checks")]
pub mod choices;
pub mod fixture;
pub mod fixtures;
#[cfg(feature = "program")]
pub mod foreign;
#[cfg(feature = "checks")]
pub mod fuzz_bodies;
pub mod generators;
#[cfg_attr(not(feature = "checks"), allow(dead_code, unused_imports, reason = "only its lamps remain"))]
pub mod light_tree;
pub mod lights;
#[cfg(feature = "checks")]
pub mod numbers;
#[cfg(feature = "occlusion")]
pub mod occlusion;
pub mod packets;
#[cfg(feature = "checks")]
pub mod page;
#[cfg(feature = "checks")]
pub mod proofs;
pub mod properties;
mod random;
#[cfg(feature = "checks")]
pub mod stats;
#[cfg(feature = "checks")]
pub mod suite;
pub mod textbook;
pub mod tolerances;
pub mod truths;
mod warps;
