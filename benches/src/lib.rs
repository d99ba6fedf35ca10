//! Benchmarks of the library and of ray traversal. What they measure is in `etendue-routines`, in the folder `routines`.

pub mod report;

use std::fmt::Display;
use std::process::ExitCode;

/// The exit code of a program with this outcome: 2 after an error, which it prints.
pub fn exit_code(outcome: Result<(), impl Display>) -> ExitCode {
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

/// Peak memory of the process, where the system reports it.
pub mod memory {
    /// Resets the peak, where the system supports it.
    pub fn start_peak() {
        let _ = std::fs::write("/proc/self/clear_refs", "5");
    }

    /// Peak memory of this process in MB since [`start_peak`]; NaN where the system does not report it.
    #[must_use]
    pub fn peak() -> f64 {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"));
        line.and_then(|l| l.trim().trim_end_matches(" kB").parse::<f64>().ok()).map_or(f64::NAN, |kb| kb / 1024.0)
    }
}
