//! Runs the fuzz bodies of the renderer and of the C interface without a fuzzer, on the committed seeds and findings, and on randomly damaged copies of them.

use etendue_fuzz_bodies as files;
use etendue_oracle::tier::cases;
use std::path::Path;

/// A random number generator.
fn next(state: &mut u64) -> u64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    *state >> 33
}

/// Runs `body` on each seed, and on `times` damaged copies with bytes replaced, removed or repeated.
fn damaged(name: &str, body: fn(&[u8]), times: u64) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../seeds").join(name);
    let mut paths: Vec<_> = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path()).collect();
    paths.sort();
    assert!(!paths.is_empty());
    for path in paths {
        let seed = std::fs::read(&path).unwrap();
        body(&seed);
        let mut state = seed.len() as u64;
        for k in 0..times {
            let mut bytes = seed.clone();
            for _ in 0..1 + next(&mut state) % 4 {
                let at = next(&mut state) as usize % bytes.len();
                let end = (at + 1 + next(&mut state) as usize % 16).min(bytes.len());
                match next(&mut state) % 4 {
                    0 | 1 => bytes[at] = next(&mut state) as u8,
                    2 if bytes.len() > end - at => drop(bytes.drain(at..end)),
                    _ => {
                        let part = bytes[at..end].to_vec();
                        bytes.splice(at..at, part);
                    }
                }
            }
            let outcome = std::panic::catch_unwind(|| body(&bytes));
            assert!(outcome.is_ok(), "{}, damaged copy {k}", path.display());
        }
    }
}

#[test]
fn scenes() {
    damaged("scene", files::scene, cases(500, 4000));
}
#[test]
fn images() {
    damaged("image", files::image, cases(200, 2000));
}
#[test]
fn certificates() {
    damaged("certificates", files::certificates, cases(3000, 30_000));
}
/// Runs `body` on each seed, on damaged copies, and on random bytes.
fn damaged_and_random(name: &str, body: fn(&[u8]), times: u64) {
    damaged(name, body, times / 4);
    let mut state = times;
    for k in 0..times {
        let bytes: Vec<u8> = (0..8 + k % 256).map(|_| next(&mut state) as u8).collect();
        let outcome = std::panic::catch_unwind(|| body(&bytes));
        assert!(outcome.is_ok(), "{name}, random input {k}");
    }
}
#[test]
fn daylight() {
    damaged_and_random("daylight", files::daylight, cases(2000, 20_000));
}
#[test]
fn emitters() {
    damaged_and_random("emitters", files::emitters, cases(2000, 20_000));
}
#[test]
fn occlusion() {
    damaged_and_random("occlusion", files::occlusion, cases(4000, 20_000));
}
#[test]
fn c_interface() {
    damaged("c_interface", files::c_interface, cases(100, 1000));
    // every function, whatever the seeds are
    let mut state = 1;
    for function in 0..47 {
        for k in 0..cases(50, 500) {
            let mut bytes: Vec<u8> = (0..4 + k % 300).map(|_| next(&mut state) as u8).collect();
            bytes[1] = function;
            let outcome = std::panic::catch_unwind(|| files::c_interface(&bytes));
            assert!(outcome.is_ok(), "function {function}, input {k}");
        }
    }
}
#[test]
#[ignore = "half a million damaged files of each kind: some minutes"]
fn many_files() {
    damaged("scene", files::scene, 500_000);
    damaged("image", files::image, 500_000);
}
#[test]
#[ignore = "a million calls for each seed: some minutes"]
fn many_calls() {
    damaged("c_interface", files::c_interface, 1_000_000);
}
#[test]
#[ignore = "ten million small scenes: some minutes"]
fn many_certificates() {
    damaged("certificates", files::certificates, 2_000_000);
}
