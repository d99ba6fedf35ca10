//! Tests of the core. What they share with the fuzz targets is in `etendue-judge`, in the folder `properties`.

/// The README's example, compiled and run as a doctest.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
pub struct Readme;
