//! What the sources themselves must keep.

mod architecture;
mod bindings;
