//! The files that a scene is read from.

use std::path::{Path, PathBuf};
use xxhash_rust::xxh3::xxh3_128;

/// A file that was read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Input {
    /// Where it was.
    pub path: PathBuf,
    /// Hash of its bytes as they were read.
    pub hash: u128,
}

impl Input {
    /// The file at a path that had these bytes.
    pub fn new(path: &Path, bytes: &[u8]) -> Self {
        Self { path: path.to_owned(), hash: xxh3_128(bytes) }
    }
}
