//! The lists of lights by techniques and of warps, for what does something with all of each: bindings, shaders, tests.

pub mod light;
pub mod warp;
