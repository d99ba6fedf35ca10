//! Runs bodies without a fuzzer, with the targets distributed over all processors: on the committed seeds, on damaged copies of them, and on
//! random bytes.

use super::Target;
use crate::random::Random;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;
use std::{fs, panic, thread};

/// Runs inputs on each target, which `run` supplies until one breaks a property. That one is kept as a file.
fn over_all(targets: &[Target], run: impl Fn(&Target, &mut dyn FnMut(&str, &[u8]) -> bool) + Sync) {
    let (next, broken) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let work = || {
        while let Some(target) = targets.get(next.fetch_add(1, Ordering::Relaxed)) {
            let (mut count, start) = (0_u64, Instant::now());
            run(target, &mut |said, bytes| {
                count += 1;
                let holds = panic::catch_unwind(|| (target.body)(bytes)).is_ok();
                if !holds {
                    let file = std::env::temp_dir().join(format!("etendue-fuzz-{}", target.name));
                    let kept = fs::write(&file, bytes).map(|()| file);
                    let mut broken = broken.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
                    broken.push(format!("{}: {said}, kept: {kept:?}", target.name));
                }
                holds
            });
            let each = start.elapsed().as_secs_f64() * 1e6 / count as f64;
            println!("{:24} {count:7} inputs, {each:6.1} us each", target.name);
        }
    };
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, Into::into) {
            scope.spawn(work);
        }
    });
    let broken = broken.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner());
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

/// Runs every file in `fuzz/seeds/<target>`, and so many damaged copies of it, with bytes replaced, removed or repeated.
///
/// # Panics
/// If a property is broken, or a target has no seeds.
pub fn seeds(targets: &[Target], copies: impl Fn(&Target) -> u64 + Sync) {
    let seeds = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds");
    over_all(targets, |target, run| {
        let files = fs::read_dir(seeds.join(target.name)).unwrap_or_else(|error| panic!("{}: {error}", target.name));
        let mut files: Vec<_> = files.map(|file| file.expect("it is readable").path()).collect();
        files.sort();
        assert!(!files.is_empty(), "fuzz/seeds/{} is empty", target.name);
        for file in files {
            let seed = fs::read(&file).expect("it is readable");
            let mut random = Random::new(seed.len() as u64);
            let said = |k: u64| format!("{}, damaged copy {k}", file.display());
            if !run(&file.display().to_string(), &seed)
                || !(0..copies(target)).all(|k| run(&said(k), &damaged(&seed, &mut random)))
            {
                break;
            }
        }
    });
}
fn damaged(seed: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..1 + random.below(4) {
        let at = random.below(bytes.len());
        let end = (at + 1 + random.below(16)).min(bytes.len());
        match random.below(4) {
            0 | 1 => bytes[at] = random.word() as u8,
            2 if bytes.len() > end - at => drop(bytes.drain(at..end)),
            _ => {
                let part = bytes[at..end].to_vec();
                bytes.splice(at..at, part);
            }
        }
    }
    bytes
}

/// Runs so many inputs of 8 to 1,028 random bytes on each target.
///
/// # Panics
/// If a property is broken.
pub fn random(targets: &[Target], count: impl Fn(&Target) -> u64 + Sync) {
    over_all(targets, |target, run| {
        let count = count(target);
        let mut random = Random::new(count);
        let mut bytes = |i: u64| (0..8 + i % 256 * 4).map(|_| random.word() as u8).collect::<Vec<_>>();
        let _ = (0..count).all(|i| run(&format!("input {i} of {count}"), &bytes(i)));
    });
}
