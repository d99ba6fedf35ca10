//! Runs each program that the tests of `etendue-shader` have written on a Vulkan device, and prints how it differs from Rust.
//!
//! ```sh
//! CASES=folder cargo test -p etendue-shader --test c99
//! etendue-shader-device folder [part of a device's name]
//! ```
//!
//! The device is the first whose name has this part; without it, a software device if there is one. Each program runs three times: as WGSL,
//! as SPIR-V, whose sums and products drivers must not combine, and as SPIR-V in which each fused multiply-add, quotient and square root is
//! written out (*exact*), since devices need not round them correctly. Programs of more than 7000 operations need `LONG=1`.
//!
//! It exits with 1 if a program is not valid or does not run, or if an exact one returns NaN or a density where Rust does not, or less than
//! 99 % of the numbers with the same bits: subnormal numbers differ on many devices.

mod case;
mod gpu;

use case::{Case, Difference};
use gpu::{Gpu, GpuSource};
use std::collections::BTreeMap;
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// What the programs of one kind, such as lights, have in common in one language.
#[derive(Default)]
struct Summary {
    programs: usize,
    /// The least and the greatest percentage of numbers with the same bits.
    same: Option<[f64; 2]>,
    /// How many programs have 99 % of their numbers within 4 units.
    near: usize,
    nan: usize,
    pdf_for_none: usize,
}

impl Summary {
    fn add(&mut self, same: f64, of: &Difference) {
        let [least, most] = self.same.unwrap_or([same; 2]);
        self.same = Some([least.min(same), most.max(same)]);
        self.programs += 1;
        self.near += usize::from(of.quantile(0.99) <= 4.0);
        self.nan += of.nan;
        self.pdf_for_none += of.pdf_for_none;
    }
}

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
        "{:50} {:>10} {:6} {:>9} {:>9} {:>9} {:>9} {:>5} {:>9}",
        "routine", "operations", "", "same bits", "99 %", "99.9 %", "greatest", "NaN", "pdf not 0"
    );
    let mut summaries: BTreeMap<(String, &str), Summary> = BTreeMap::new();
    let (mut fine, long) = (true, std::env::var_os("LONG").is_some());
    for path in paths {
        let case = Case::read(&path)?;
        if !long && case.operations > 7000 {
            continue;
        }
        for (language, source) in [
            ("WGSL", GpuSource::Wgsl(&case.wgsl)),
            ("SPIR-V", GpuSource::SpirV(&case.spirv)),
            ("exact", GpuSource::SpirV(&case.exact)),
        ] {
            print!("{:50} {:10} {language:6} ", case.name, case.operations);
            match gpu.run(source, case.count, &case.inputs, &case.memory, case.right.len()) {
                Ok(found) => {
                    let of = case.difference(&found);
                    let same = 100.0 * of.same as f64 / of.numbers as f64;
                    let [most, nearly, greatest] = [0.99, 0.999, 1.0].map(|fraction| of.quantile(fraction));
                    println!(
                        "{same:7.2} % {most:9.3e} {nearly:9.3e} {greatest:9.3e} {:5} {:9}",
                        of.nan, of.pdf_for_none
                    );
                    // `fewer` are lights of which not all fields are computed
                    let kind = case.name.split('_').next().unwrap_or_default().replace("fewer", "lights");
                    summaries.entry((kind, language)).or_default().add(same, &of);
                    let keeps = of.nan == 0 && of.pdf_for_none == 0 && same >= 99.0;
                    // single operations are asked for more than the languages promise, as conversions of large numbers
                    if language == "exact" && !keeps && case.name != "operations" {
                        println!("{}: too different from Rust", case.name);
                        fine = false;
                    }
                }
                Err(error) => {
                    println!("{error}");
                    fine = false;
                }
            }
        }
    }
    println!(
        "\n{:50} {:>10} {:6} {:>19} {:>19} {:>5} {:>9}",
        "kind", "programs", "", "same bits", "99 % in 4 units", "NaN", "pdf not 0"
    );
    for ((kind, language), Summary { programs, same, near, nan, pdf_for_none }) in summaries {
        let [least, most] = same.unwrap_or_default();
        println!("{kind:50} {programs:10} {language:6} {least:7.2} to {most:6.2} % {near:19} {nan:5} {pdf_for_none:9}");
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
