//! Names the build: parts of an image may only be put together if the same program made them.
//!
//! The name is the version, the processor features that the program is compiled for, and a hash of the sources, the versions of all
//! dependencies, and the compiler. Where the sources lie does not matter.

use std::hash::{DefaultHasher, Hasher};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

/// The files below a path, in order.
fn files(path: &Path) -> Vec<PathBuf> {
    if path.is_file() {
        return vec![path.to_owned()];
    }
    let entries = fs::read_dir(path).into_iter().flatten().flatten();
    let mut all: Vec<PathBuf> = entries.flat_map(|entry| files(&entry.path())).collect();
    all.sort();
    all
}

fn main() {
    let mut hash = DefaultHasher::new();
    for source in ["src", "scenes", "Cargo.toml", "../core/src", "../core/Cargo.toml", "../Cargo.lock"] {
        println!("cargo::rerun-if-changed={source}");
        for file in files(Path::new(source)) {
            hash.write(file.to_string_lossy().as_bytes());
            hash.write(&fs::read(&file).unwrap_or_default());
        }
    }
    println!("cargo::rerun-if-env-changed=CARGO_ENCODED_RUSTFLAGS");
    let compiler = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let version = Command::new(compiler).arg("-vV").output().map(|output| output.stdout).unwrap_or_default();
    hash.write(&version);
    let of = |name: &str| env::var(name).unwrap_or_default();
    hash.write(of("TARGET").as_bytes());
    let features = of("CARGO_CFG_TARGET_FEATURE");
    hash.write(features.as_bytes());
    let fma = if features.split(',').any(|feature| feature == "fma") { "+fma" } else { "" };
    let name = format!("{} {}{fma} {:016x}", of("CARGO_PKG_VERSION"), of("CARGO_CFG_TARGET_ARCH"), hash.finish());
    println!("cargo::rustc-env=ETENDUE_BUILD={name}");
}
