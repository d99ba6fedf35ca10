//! With the feature `dispatch`, compiles the batches once more for x86-64-v3 and x86-64-v4, and links these objects.
//!
//! `wide` chooses its vector instructions when it is compiled, so each level needs a compilation of its own. Cargo has one set of flags for
//! all packages of a build; this script calls it again with others.

use std::env::var;
use std::path::Path;
use std::process::Command;

/// The instructions of each level: those for which `src/lib.rs` asks the processor, and no others.
const V3: &str = "+avx2,+fma,+bmi1,+bmi2,+popcnt";
const V4: &str = "+avx2,+fma,+bmi1,+bmi2,+popcnt,+avx512f,+avx512bw,+avx512cd,+avx512dq,+avx512vl";

/// The feature of a light, of the variable by which cargo tells it.
fn light(variable: &str) -> Option<String> {
    let feature = variable.strip_prefix("CARGO_FEATURE_")?.to_lowercase();
    // the levels multiply and add in one instruction
    (!["default", "dispatch", "all", "same_bits"].contains(&&*feature) && !feature.starts_with("level"))
        .then_some(feature)
}

fn main() {
    println!("cargo::rustc-check-cfg=cfg(levels)");
    println!("cargo::rerun-if-changed=build.rs");
    let is_set = |name: &str| std::env::var_os(name).is_some();
    let is_a_level = is_set("CARGO_FEATURE_LEVEL_V3") || is_set("CARGO_FEATURE_LEVEL_V4");
    if is_a_level || !is_set("CARGO_FEATURE_DISPATCH") || var("CARGO_CFG_TARGET_ARCH").unwrap() != "x86_64" {
        return;
    }
    // the core is beside this crate in its repository alone
    for path in ["src", "Cargo.toml", "../src", "../Cargo.toml"].into_iter().filter(|path| Path::new(path).exists()) {
        println!("cargo::rerun-if-changed={path}");
    }
    let out = var("OUT_DIR").unwrap();
    let out = Path::new(&out);
    println!("cargo::rustc-cfg=levels");
    // clippy and the documentation only look at the code
    println!("cargo::rerun-if-env-changed=ETENDUE_ONLY_LOOK");
    if is_set("ETENDUE_ONLY_LOOK") || var("RUSTC_WORKSPACE_WRAPPER").is_ok_and(|wrapper| wrapper.contains("clippy")) {
        return;
    }
    // OUT_DIR is target/PROFILE/build/PACKAGE/out: all profiles share the levels
    let levels = out.ancestors().nth(4).unwrap_or(out).join("levels");
    let archive = out.join("libetendue_levels.a");
    let _ = std::fs::remove_file(&archive);
    // the lights of this build
    let lights: String =
        std::env::vars().filter_map(|(name, _)| light(&name)).map(|light| format!(",{light}")).collect();
    let compile = |(level, instructions): (&str, &str)| {
        // the same path for all profiles, since cargo compiles again if its arguments change
        let object = levels.join(level).join(format!("{level}.o"));
        let mut cargo = Command::new(var("CARGO").unwrap());
        cargo
            .args([
                "rustc",
                "--release",
                "--lib",
                "--no-default-features",
                "--features",
                &format!("level-{level}{lights}"),
            ])
            .args(["--manifest-path", "Cargo.toml", "--target", &var("TARGET").unwrap()])
            .arg("--target-dir")
            .arg(levels.join(level))
            .args(["--config", "profile.release.panic='abort'", "--config", "profile.release.debug=false"])
            .args(["--", &format!("--emit=obj={}", object.display())])
            .env(
                "CARGO_ENCODED_RUSTFLAGS",
                format!("-Ctarget-cpu=x86-64\x1f-Ctarget-feature={instructions}\x1f-Cforce-unwind-tables=no"),
            )
            .env_remove("RUSTFLAGS")
            .env_remove("CARGO_MAKEFLAGS");
        // settings for the whole build, such as more than one codegen unit, of which each would have an object of its own
        for (name, _) in std::env::vars_os() {
            if name.to_string_lossy().starts_with("CARGO_PROFILE_RELEASE_") {
                cargo.env_remove(name);
            }
        }
        (cargo.spawn().unwrap_or_else(|e| panic!("cannot run {cargo:?}: {e}")), object)
    };
    // both at once: each is one crate, which takes one thread
    let running = [("v3", V3), ("v4", V4)].map(compile);
    let objects = running.map(|(mut cargo, object)| {
        let status = cargo.wait().expect("cargo was started");
        assert!(status.success(), "compiling {} failed: {status}", object.display());
        object
    });
    // a static library, which the linker searches after the objects that need it
    let ar = var("AR").unwrap_or_else(|_| "ar".into());
    let status = Command::new(&ar).arg("crs").arg(&archive).args(&objects).status();
    let status = status.unwrap_or_else(|e| panic!("cannot run {ar}: {e}"));
    assert!(status.success(), "{ar} failed: {status}");
    println!("cargo::rustc-link-search=native={}", out.display());
    println!("cargo::rustc-link-lib=static=etendue_levels");
}
