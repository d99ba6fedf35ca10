//! The visible part of lights past convex blockers, against an oracle that subtracts the blockers one after another.

mod accuracy;
mod compact;
mod known_values;
mod lobes;
mod properties;
mod scene;
mod scenes;
mod solids;
mod truth;
