//! Compares the bits of images with those of the committed table; see `etendue_image_bits`.

use etendue_image_bits::{ImageHashes, TABLE, differences, rows, scenes, write};
use std::process::ExitCode;
use std::time::Instant;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let asked: Vec<&str> = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] | ["--write", _] => scenes(),
        [scene] if scenes().contains(&scene) => vec![scene],
        _ => {
            println!("asked for: nothing, the name of a scene, or --write \"WHY\", the line of the changelog");
            return ExitCode::FAILURE;
        }
    };
    let began = Instant::now();
    let all: Vec<ImageHashes> = asked.iter().flat_map(|scene| rows(scene)).collect();
    if let [_, why] = &arguments[..] {
        let written = write(&all, why);
        println!("{}", written.as_ref().err().map_or("the table is written", String::as_str));
        return if written.is_ok() { ExitCode::SUCCESS } else { ExitCode::FAILURE };
    }
    let differences = differences(&all, &asked, TABLE);
    differences.iter().for_each(|line| println!("{line}"));
    println!("{} rows, {} differences, {:.1} s", all.len(), differences.len(), began.elapsed().as_secs_f64());
    if differences.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
