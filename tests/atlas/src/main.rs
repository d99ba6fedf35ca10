//! `etendue-atlas`: maps where the library and textbook formulas lose accuracy.

use clap::Parser;
use etendue_laboratory::options::say;
use std::process::ExitCode;

fn main() -> ExitCode {
    match etendue_atlas::run(&etendue_atlas::Options::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            say(format_args!("etendue-atlas: {error}"));
            ExitCode::from(2)
        }
    }
}
