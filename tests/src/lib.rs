//! Tests of the core. What they share with the fuzz targets is in `etendue-judge`, in the folder `properties`.

/// The READMEs' examples, compiled and run as doctests.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
pub struct Readme;

#[cfg(doctest)]
#[doc = include_str!("../../core/README.md")]
pub struct ReadmeOfTheCore;
