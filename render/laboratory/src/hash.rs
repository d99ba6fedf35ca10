//! A hash that is the same in every version and on every machine.

use std::fs;

/// FNV-1a: unlike the standard library's hasher, the same in every version.
pub(crate) fn fnv1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |h, &b| (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3))
}

/// The build of the program that runs: its version, and a hash of its file.
pub(crate) fn build() -> String {
    let bytes = std::env::current_exe().and_then(fs::read).unwrap_or_default();
    format!("{} {:016x}", env!("CARGO_PKG_VERSION"), fnv1a(&bytes))
}
