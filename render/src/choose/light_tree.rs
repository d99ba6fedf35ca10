//! Threads to build a light tree on, and what went wrong with one.

use crate::bvh::BuildError;
use etendue::select::{Join, LightTree};

/// Builds the halves of a tree on the threads of rayon.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Threads;

impl Join for Threads {
    fn join(&self, a: impl FnOnce() + Send, b: impl FnOnce() + Send) {
        rayon::join(a, b);
    }
}

/// There are more lights than a tree can index.
pub(crate) fn build_error(count: usize) -> BuildError {
    BuildError { count, most: LightTree::MOST }
}
