//! What certificates allow to compute, against the truth in double precision.

pub(crate) mod regimes;
pub(crate) mod values;

mod scenes;
mod solids;
mod truth;
mod views;
