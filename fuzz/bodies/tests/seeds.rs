//! Runs the fuzz bodies of the renderer and of the C interface without a fuzzer, on the committed seeds and findings, on randomly damaged copies of them,
//! and on random bytes.

use etendue_fuzz_bodies::TARGETS;
use etendue_judge::fuzz_bodies::run;
use etendue_oracle::tier::cases;

#[test]
fn seeds_and_damaged_copies() {
    run::seeds(TARGETS, |target| u64::from(target.share) * cases(1, 10));
}
/// Random bytes are no files.
#[test]
fn random_bytes() {
    let are_files = |name: &str| matches!(name, "scene" | "image" | "certificates");
    let targets: Vec<_> = TARGETS.iter().copied().filter(|target| !are_files(target.name)).collect();
    run::random(&targets, |target| 4 * u64::from(target.share) * cases(1, 10));
}
#[test]
#[ignore = "millions of damaged copies of each seed: some minutes for each target"]
fn many_damaged_copies() {
    run::seeds(TARGETS, |target| 1000 * u64::from(target.share));
}
