//! Describes the machine and the build that made a measurement.

use std::fs;
use std::path::Path;
use std::process::Command;

/// Names and values of everything a reader needs to judge the measurements.
#[must_use]
pub fn facts(threads: usize) -> Vec<(&'static str, String)> {
    vec![
        ("machine", format!("{}, {} cores, {}", processor(), cores(), std::env::consts::OS)),
        ("threads", threads.to_string()),
        (
            "program",
            format!(
                "etendue {}, {}",
                env!("CARGO_PKG_VERSION"),
                if cfg!(debug_assertions) { "with debug assertions" } else { "without debug assertions" }
            ),
        ),
        ("built by", env!("ETENDUE_BUILD").to_owned()),
        ("instructions", features().join(" ")),
        ("commit", commit()),
    ]
}

fn processor() -> String {
    let info = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    model.map_or_else(|| format!("unknown {} processor", std::env::consts::ARCH), |(_, name)| name.trim().to_owned())
}

fn cores() -> usize {
    std::thread::available_parallelism().map_or(0, std::num::NonZero::get)
}

fn features() -> Vec<&'static str> {
    let mut list = Vec::new();
    macro_rules! listed {
        ($($name:tt)*) => { $(if cfg!(target_feature = $name) { list.push($name); })* };
    }
    listed!("sse4.2" "avx" "avx2" "fma" "avx512f" "neon");
    list
}

/// The current commit of the source tree, which may be newer than the program.
fn commit() -> String {
    let git = |arguments: &[&str]| {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
        let output = Command::new("git").arg("-C").arg(folder).args(arguments).output().ok()?;
        output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
    };
    git(&["describe", "--always", "--dirty", "--abbrev=12"]).unwrap_or_else(|| "unknown".to_owned())
}
