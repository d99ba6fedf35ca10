//! Runs the WGSL of each program that the tests of `etendue-shader` have written on a Vulkan device, and prints how it differs from Rust.
//!
//! `CASES=folder cargo test -p etendue-shader --test c99` writes the programs; `etendue-shader-device folder [part of a device's name]` runs
//! them, on a software device if there is one. It exits with 1 if a program is not valid or does not run, or returns NaN where Rust does not.

mod case;
mod gpu;

use case::Case;
use gpu::Gpu;
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

fn run(folder: &Path, part: &str) -> Result<bool, Box<dyn Error>> {
    let all = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut paths: Vec<PathBuf> = all.map(|entry| entry.map(|entry| entry.path())).collect::<Result<_, _>>()?;
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "wgsl"));
    paths.sort();
    if paths.is_empty() {
        return Err(format!("{}: no programs in WGSL", folder.display()).into());
    }
    let Some(gpu) = Gpu::new(part)? else {
        println!("WGSL is not compared: there is no Vulkan device");
        return Ok(true);
    };
    println!("{}: errors in units of 2^-24\n", gpu.name);
    println!(
        "{:56} {:>10} {:>9} {:>9} {:>9} {:>9} {:>5} {:>9}",
        "routine", "operations", "same bits", "99 %", "99.9 %", "greatest", "NaN", "pdf not 0"
    );
    let mut fine = true;
    for path in paths {
        let case = Case::read(&path)?;
        match gpu.run(&case.wgsl, case.count, &case.inputs, &case.memory, case.right.len()) {
            Ok(found) => {
                let of = case.difference(&found);
                let same = 100.0 * of.same as f64 / of.numbers as f64;
                let [most, nearly, greatest] = [0.99, 0.999, 1.0].map(|fraction| of.quantile(fraction));
                println!(
                    "{:56} {:10} {same:7.2} % {most:9.3e} {nearly:9.3e} {greatest:9.3e} {:5} {:9}",
                    case.name, case.operations, of.nan, of.pdf_for_none
                );
                fine &= of.nan == 0;
            }
            Err(error) => {
                println!("{:56} {:10} {error}", case.name, case.operations);
                fine = false;
            }
        }
    }
    Ok(fine)
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (Some(folder), true) = (arguments.first(), arguments.len() <= 2) else {
        eprintln!("etendue-shader-device: a folder of programs, and maybe a part of the name of a device");
        return ExitCode::from(2);
    };
    match run(Path::new(folder), arguments.get(1).map_or("", String::as_str)) {
        Ok(fine) => ExitCode::from(u8::from(!fine)),
        Err(error) => {
            eprintln!("etendue-shader-device: {error}");
            ExitCode::from(2)
        }
    }
}
