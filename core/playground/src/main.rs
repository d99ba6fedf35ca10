//! Writes the playground: one HTML file that shows, for any light, measure and shading point, where samples of the unit square go, with
//! what density, and how far the estimates are from the closed form.
//!
//! The file holds everything: the core with its C interface, compiled to WebAssembly with its vectors; the list of lights and techniques,
//! which is the core's own; scripts and style. It needs no server, and opens from a folder.

mod library;
mod list;
mod page;

use clap::Parser;
use std::path::PathBuf;
use std::process::ExitCode;

/// Write the playground, one static page that opens from a folder, without a server
#[derive(Parser, Debug)]
struct Options {
    /// Folder for index.html
    #[arg(short, long, default_value = "target/playground")]
    output: PathBuf,
}

fn write(options: &Options) -> Result<(), String> {
    let lights = list::lights();
    let wasm = library::build(&list::functions(&lights))?;
    let packed = page::gzip(&wasm)?;
    let text = page::join(&lights, &packed);
    std::fs::create_dir_all(&options.output).map_err(|e| format!("{}: {e}", options.output.display()))?;
    let path = options.output.join("index.html");
    std::fs::write(&path, &text).map_err(|e| format!("{}: {e}", path.display()))?;
    let whole = page::gzip(text.as_bytes())?.len();
    println!(
        "{}: {} bytes, {whole} compressed; in it the library: {} bytes, {} compressed",
        path.display(),
        text.len(),
        wasm.len(),
        packed.len()
    );
    Ok(())
}

fn main() -> ExitCode {
    match write(&Options::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::from(2)
        }
    }
}
