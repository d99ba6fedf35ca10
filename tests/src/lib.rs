//! Oracles, domains, tolerances, and the properties that every warp obeys.
//!
//! A property is a plain function of a [`Fixture`](properties::Fixture) (a warp with its parameters) and perhaps a point of the unit square;
//! it panics with the fixture, the argument and the figure when it is broken. The tests in `tests/` run the properties over
//! the regimes of [`generators`]; fuzz targets run them over arbitrary bits. A new warp needs a `Fixture` and a line in a list.
//!
//! - [`oracle`]: closed forms, double-double arithmetic and quadrature; nothing here calls the code under test.
//! - [`generators`]: arguments biased to where methods fail.
//! - [`tolerances`]: the one table of tolerances, each with its reason.
//! - [`suite`]: all properties over all regimes.
//! - [`fuzz_bodies`]: the bodies of the fuzz targets.
//! - [`checks`]: the same for functions that are no warps; [`techniques`]: for lights.
//! - [`mutants`]: defects of well-known renderers, which the properties must notice.
//! - [`stats`]: probabilities of what was observed.

pub mod checks;
pub mod fuzz_bodies;
pub mod generators;
// the atlas's own file: this library does without the renderer, and so do the fuzz targets that call it
#[path = "../../render/src/atlas/double_double.rs"]
pub mod double_double;
pub mod fixtures;
pub mod mutants;
pub mod oracle;
pub mod properties;
pub mod stats;
pub mod suite;
pub mod techniques;
pub mod tolerances;

/// The README's example, compiled and run with the documentation's.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
pub struct Readme;
