//! Compiles the batches once more for x86-64-v3 and x86-64-v4, and links these objects.
//!
//! `wide` chooses its vector instructions when it is compiled, so each level needs a compilation of its own. Cargo has one set of flags for
//! all packages of a build; this script calls it again with others.

use std::env::var;
use std::path::Path;
use std::process::Command;

fn main() {
    println!("cargo::rustc-check-cfg=cfg(levels)");
    for path in ["build.rs", "src", "Cargo.toml", "../src", "../Cargo.toml"] {
        println!("cargo::rerun-if-changed={path}");
    }
    let is_set = |name: &str| std::env::var_os(name).is_some();
    let is_a_level = is_set("CARGO_FEATURE_LEVEL_V3") || is_set("CARGO_FEATURE_LEVEL_V4");
    if is_a_level || !is_set("CARGO_FEATURE_DISPATCH") || var("CARGO_CFG_TARGET_ARCH").unwrap() != "x86_64" {
        return;
    }
    let out = var("OUT_DIR").unwrap();
    let out = Path::new(&out);
    println!("cargo::rustc-cfg=levels");
    // clippy only looks at the code
    if var("RUSTC_WORKSPACE_WRAPPER").is_ok_and(|wrapper| wrapper.contains("clippy")) {
        return;
    }
    // OUT_DIR is target/PROFILE/build/PACKAGE/out: all profiles share the levels
    let levels = out.ancestors().nth(4).unwrap_or(out).join("levels");
    let archive = out.join("libetendue_levels.a");
    let _ = std::fs::remove_file(&archive);
    for level in ["v3", "v4"] {
        let object = out.join(format!("{level}.o"));
        let mut cargo = Command::new(var("CARGO").unwrap());
        cargo
            .args(["rustc", "--release", "--lib", "--no-default-features", "--features", &format!("level-{level}")])
            .args(["--manifest-path", "Cargo.toml", "--target", &var("TARGET").unwrap()])
            .arg("--target-dir")
            .arg(levels.join(level))
            .args(["--config", "profile.release.panic='abort'", "--config", "profile.release.debug=false"])
            .args(["--", &format!("--emit=obj={}", object.display())])
            .env("CARGO_ENCODED_RUSTFLAGS", format!("-Ctarget-cpu=x86-64-{level}\x1f-Cforce-unwind-tables=no"))
            .env_remove("RUSTFLAGS")
            .env_remove("CARGO_MAKEFLAGS");
        run(cargo);
        // a static library that the linker searches after the objects that need it
        let mut ar = Command::new(var("AR").unwrap_or_else(|_| "ar".into()));
        run({
            ar.arg("crs").arg(&archive).arg(&object);
            ar
        });
    }
    println!("cargo::rustc-link-search=native={}", out.display());
    println!("cargo::rustc-link-lib=static=etendue_levels");
}

fn run(mut command: Command) {
    let status = command.status().unwrap_or_else(|e| panic!("cannot run {command:?}: {e}"));
    assert!(status.success(), "{command:?} failed: {status}");
}
