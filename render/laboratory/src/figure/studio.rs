//! What every figure needs, and what it becomes.

use super::sheet::Svg;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// A figure and the lines of text that it illustrates.
pub(super) struct Finding {
    pub(super) svg: Svg,
    pub(super) headline: Vec<String>,
}

/// The context in which figures are drawn.
pub(super) struct Studio<'a> {
    /// Folder for measurements.
    pub(super) output: &'a Path,
    /// Number of threads; 0 means one per core.
    pub(super) threads: usize,
    /// Seed of the random numbers.
    pub(super) seed: u64,
    /// Greatest number of lights of a tree.
    pub(super) most_lights: usize,
    /// Set by Ctrl-C.
    pub(super) stop: &'a Arc<AtomicBool>,
}
