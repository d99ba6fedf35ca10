//! Passes the compiler version and build flags to the program, which prints them in its reports.

use std::env;
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let variable = |name: &str| env::var(name).unwrap_or_default();
    let compiler = Command::new(variable("RUSTC")).arg("--version").output();
    let version = compiler.map_or_else(|_| String::new(), |o| String::from_utf8_lossy(&o.stdout).trim().to_owned());
    let flags = variable("CARGO_ENCODED_RUSTFLAGS").replace('\x1f', " ");
    let (profile, level, target) = (variable("PROFILE"), variable("OPT_LEVEL"), variable("TARGET"));
    println!("cargo::rustc-env=ETENDUE_BUILD={version}, {target}, {profile}, opt-level {level}, flags [{flags}]");
}
