//! Rays.
fn main() {}
