//! Certificates against visibility by brute force in double precision.

pub(crate) mod counts;
pub(crate) mod regimes;
pub(crate) mod scenes;
pub(crate) mod solids;
pub(crate) mod values;
pub(crate) mod views;

mod compare;
mod segments;
mod truth;
