//! Says at once if Rust lacks the target of WebAssembly, which the program compiles for when it runs, minutes later.

use std::env;
use std::path::PathBuf;
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let variable = |name: &str| env::var(name).unwrap_or_default();
    let output = Command::new(variable("RUSTC")).args(["--print", "sysroot"]).output();
    let root = output.map_or_else(|_| String::new(), |o| String::from_utf8_lossy(&o.stdout).trim().to_owned());
    let is_there = PathBuf::from(root).join("lib/rustlib/wasm32-unknown-unknown").is_dir();
    // tests, clippy and documentation do without it
    let only_looks = variable("PROFILE") == "debug" || variable("RUSTC_WORKSPACE_WRAPPER").contains("clippy");
    if !is_there && !only_looks {
        println!(
            "cargo::error=the playground needs Rust's target of WebAssembly: rustup target add wasm32-unknown-unknown"
        );
    }
}
