//! Independent truth for the tests of the core and for the laboratory: double-double arithmetic, closed forms and quadrature.
//!
//! Nothing here calls the library under test.

mod closed_forms;
pub mod double_double;

pub use closed_forms::*;
