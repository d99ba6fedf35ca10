//! The bodies of the fuzz targets without a fuzzer: on the committed seeds, which include past findings, and on random bytes.

use etendue_judge::area_lights::{AreaLight, LightShape, Measure};
use etendue_judge::fixture::Subject;
use etendue_judge::fuzz_bodies::{TARGETS, Target};
use etendue_judge::generators::Random;
use etendue_judge::properties;
use etendue_oracle::tier::cases;
use rayon::prelude::*;
use std::path::Path;
use std::time::Instant;

/// Runs every file in `fuzz/seeds/<target>`.
#[test]
fn seeds() {
    let seeds = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/seeds");
    for Target { name, body, .. } in TARGETS {
        let mut files: Vec<_> = std::fs::read_dir(seeds.join(name))
            .unwrap_or_else(|error| panic!("fuzz/seeds/{name}: {error}"))
            .map(|file| file.unwrap().path())
            .collect();
        files.sort();
        assert!(!files.is_empty(), "fuzz/seeds/{name} is empty");
        for file in &files {
            let bytes = std::fs::read(file).unwrap();
            if std::panic::catch_unwind(|| body(&bytes)).is_err() {
                panic!("{} breaks a property", file.display());
            }
        }
        println!("{name:24} {} seeds", files.len());
    }
}

/// Every light of the core's list.
#[test]
fn every_light_has_a_target() {
    for (shape, _) in AreaLight::KINDS {
        let name = format!("{shape:?}_light").to_lowercase();
        assert!(TARGETS.iter().any(|target| target.name == name), "{name}");
    }
}

/// A past finding as plain numbers: a triangle with an edge that rises vertically above the horizon, and a direction next to that edge.
#[test]
fn inverse_beside_an_upright_edge() {
    let flat =
        [[-1.0866929, 0.21072814, 0.14530581], [0.5384565, 0.15991381, 0.8273404], [-0.33004466, 0.755619, -0.5657831]];
    let normal = [0.09743712, -0.066804275, 0.15172845];
    let triangle = AreaLight::seen(LightShape::Triangle, Measure::ProjectedSolidAngle, flat, normal);
    properties::inverse(&Subject::new(&triangle), [-0.504813015, 0.341584474, 0.79276967]);
}

/// Runs `count` inputs of 8 to 1,028 bytes on each target. An input that breaks a property is kept as a file.
fn random(count: impl Fn(&Target) -> u64 + Sync) {
    let breaks = |target: &Target| {
        let (count, start) = (count(target), Instant::now());
        let mut random = Random::new(count);
        let broken = (0..count).find_map(|i| {
            let bytes: Vec<u8> = (0..8 + i % 256 * 4).map(|_| random.word() as u8).collect();
            std::panic::catch_unwind(|| (target.body)(&bytes)).err().map(|_| {
                let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(target.name);
                std::fs::write(&file, &bytes).unwrap();
                format!("{}: input {i} of {count}, kept as {}", target.name, file.display())
            })
        });
        let each = start.elapsed().as_secs_f64() * 1e6 / count as f64;
        println!("{:24} {count:7} inputs, {each:6.1} us each", target.name);
        broken
    };
    let broken: Vec<_> = TARGETS.par_iter().filter_map(breaks).collect();
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

#[test]
fn a_million_random_inputs() {
    let shares: u32 = TARGETS.iter().map(|t| t.share).sum();
    random(|target| u64::from(target.share) * cases(50_000, 1_000_000) / u64::from(shares) + 1);
}
#[test]
#[ignore = "a million inputs for each target: half an hour"]
fn a_million_random_inputs_each() {
    random(|_| 1_000_000);
}
