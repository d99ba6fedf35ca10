//! The visible part of lights past convex occluders, against an oracle that subtracts the occluders one after another.

mod accuracy;
mod compact;
mod known_values;
mod lobes;
mod properties;
mod regimes;
mod scenes;
mod solids;
pub(crate) mod truth;
