//! Compiles the C interface to WebAssembly, and links those of its functions that the page calls.

use std::path::{Path, PathBuf};
use std::process::Command;

const TARGET: &str = "wasm32-unknown-unknown";
/// The flags of the compiler. Cargo's own file of them is for other processors.
const FLAGS: &str = "-Ctarget-feature=+simd128";
/// Settings that let the linker drop the functions that the page never calls.
const PROFILE: [&str; 4] = ["panic='abort'", "lto='fat'", "codegen-units=1", "debug=false"];
/// The lights of the page.
const LIGHTS: &str = "sphere,triangle,parallelogram,rectangle,disk,polygon,patch,line,sun";
/// Bytes for the stack: prepared lights in every lane of a packet take tens of thousands.
const STACK: usize = 1 << 20;

fn said(command: &mut Command) -> Result<String, String> {
    let output = command.output().map_err(|e| format!("cannot run {command:?}: {e}"))?;
    if !output.status.success() {
        return Err(format!("{command:?}: {}\n{}", output.status, String::from_utf8_lossy(&output.stderr).trim_end()));
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// The folder of the toolchain, and the name of the machine that it runs on.
fn toolchain() -> Result<(PathBuf, String), String> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let root = PathBuf::from(said(Command::new(&rustc).args(["--print", "sysroot"]))?.trim());
    let version = said(Command::new(&rustc).arg("-vV"))?;
    let host = version.lines().find_map(|line| line.strip_prefix("host: "));
    Ok((root, host.ok_or("rustc -vV names no host")?.to_owned()))
}

/// The library with these functions.
pub(crate) fn build(functions: &[&str]) -> Result<Vec<u8>, String> {
    let (root, host) = toolchain()?;
    if !root.join("lib/rustlib").join(TARGET).is_dir() {
        return Err(format!("Rust lacks the target of WebAssembly: rustup target add {TARGET}"));
    }
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| workspace.join("target"), PathBuf::from);
    // a folder of its own, since the settings differ from those of other builds
    let target = target.join("wasm");
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.current_dir(&workspace).args(["rustc", "--release", "--locked", "-p", "etendue-c", "--no-default-features"]);
    cargo.args(["--features", LIGHTS]);
    cargo.args(["--crate-type", "staticlib", "--target", TARGET, "--target-dir"]).arg(&target);
    for setting in PROFILE {
        cargo.args(["--config", &format!("profile.release.{setting}")]);
    }
    cargo.env("CARGO_ENCODED_RUSTFLAGS", FLAGS).env_remove("RUSTFLAGS");
    let status = cargo.status().map_err(|e| format!("cannot run {cargo:?}: {e}"))?;
    if !status.success() {
        return Err(format!("the library does not compile: {status}"));
    }

    let linked = target.join("playground.wasm");
    // cargo and rustc link a library only with all that it exports
    let mut linker = Command::new(root.join("lib/rustlib").join(host).join("bin/rust-lld"));
    linker.args(["-flavor", "wasm", "--no-entry", "--gc-sections", "--strip-all", "-O2", "--stack-first"]);
    linker.arg(format!("-zstack-size={STACK}")).arg("--export=__heap_base");
    linker.args(functions.iter().map(|name| format!("--export={name}")));
    linker.arg(target.join(TARGET).join("release/libetendue_c.a")).arg("-o").arg(&linked);
    said(&mut linker)?;
    std::fs::read(&linked).map_err(|e| format!("{}: {e}", linked.display()))
}
