//! Certificates against visibility by brute force in double precision.

pub(crate) mod counts;
pub(crate) mod scenes;
pub(crate) mod solids;
pub(crate) mod views;

mod compare;
mod segments;
