//! Oracles, domains, tolerances, and the laws that every warp obeys.
//!
//! A law is a plain function of a [`Subject`](laws::Subject) (a warp with its parameters) and perhaps a point of the unit square;
//! it panics with the subject, the argument and the figure when it is broken. The tests in `tests/` run the laws over
//! the regimes of [`domain`]; fuzz targets run them over arbitrary bits. A new warp needs a `Subject` and a line in a list.
//!
//! - [`oracle`]: closed forms, double-double arithmetic and quadrature; nothing here calls the code under test.
//! - [`domain`]: arguments biased to where methods fail.
//! - [`tolerances`]: the one table of tolerances, each with its reason.
//! - [`suite`]: all laws over all regimes.
//! - [`campaign`]: the bodies of the fuzz targets.
//! - [`checks`]: the same for functions that are no warps; [`techniques`]: for lights.
//! - [`planted`]: defects of well-known renderers, which the laws must notice.
//! - [`stats`]: probabilities of what was observed.

pub mod campaign;
pub mod checks;
pub mod domain;
// the atlas's own file: this library does without the renderer, and so do the fuzz targets that call it
#[path = "../../render/src/atlas/double_double.rs"]
pub mod double_double;
pub mod laws;
pub mod oracle;
pub mod planted;
pub mod stats;
pub mod subjects;
pub mod suite;
pub mod techniques;
pub mod tolerances;

/// The README's example, compiled and run with the documentation's.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
pub struct Readme;
