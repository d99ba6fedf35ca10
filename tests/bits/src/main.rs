//! Compares the bits of every routine with those of the committed table; see `etendue_bits`.

use std::process::ExitCode;

fn main() -> ExitCode {
    match std::env::args().nth(1).as_deref() {
        None => {
            let rows = etendue_bits::rows();
            let differences = etendue_bits::differences(&rows, etendue_bits::TABLE);
            differences.iter().for_each(|line| println!("{line}"));
            println!("{} routines, {} differences", rows.len(), differences.len());
            if differences.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
        }
        Some("--write") => {
            let rows = etendue_bits::rows();
            etendue_bits::differences(&rows, &etendue_bits::text(&rows)).iter().for_each(|fault| println!("{fault}"));
            let path = concat!(env!("CARGO_MANIFEST_DIR"), "/bits.txt");
            std::fs::write(path, etendue_bits::text(&rows)).expect("the table can be written");
            println!("{path}: {} routines", rows.len());
            ExitCode::SUCCESS
        }
        Some(routine) => {
            etendue_bits::listing(routine).iter().for_each(|line| println!("{line}"));
            ExitCode::SUCCESS
        }
    }
}
