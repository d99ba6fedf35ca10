//! The two tiers of tests: `cargo test` runs each of them with few cases, `LONG=1 cargo test` with all.

/// Whether the environment asks for all cases.
#[must_use]
pub fn is_long() -> bool {
    std::env::var_os("LONG").is_some()
}

/// How many cases a test runs: `quick` of them, or `long`.
#[must_use]
pub fn cases<T>(quick: T, long: T) -> T {
    if is_long() { long } else { quick }
}
