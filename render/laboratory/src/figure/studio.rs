//! What every figure needs, and what it becomes.

use super::sheet::Svg;
use std::sync::atomic::AtomicBool;

/// A figure and the lines of text that it illustrates.
pub(super) struct Finding {
    pub(super) svg: Svg,
    pub(super) headline: Vec<String>,
}

/// The context in which figures are drawn.
pub(super) struct Studio<'a> {
    /// Seed of the random numbers.
    pub(super) seed: u64,
    /// Set by Ctrl-C.
    pub(super) stop: &'a AtomicBool,
}
