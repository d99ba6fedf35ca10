//! Benchmarks of the library and of whole images. What they measure is in `etendue-routines`, in the folder `routines`.

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
