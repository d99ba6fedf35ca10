//! Writes the playground: one HTML file that shows, for any light, technique and shading point, where samples of the unit square go, with
//! what density, and how far the estimates are from the closed form, beside the textbook's formula.
//!
//! ```sh
//! cargo run --release -p etendue-playground    # writes target/playground/index.html; needs rustup target add wasm32-unknown-unknown
//! .ci/browser                                  # drives it in a browser, and compares its numbers with the core bit by bit
//! ```
//!
//! The file holds everything: the core with its C interface, compiled to WebAssembly with its vectors; the list of lights and techniques,
//! which is the core's own; scripts and style. It needs no server, and opens from a folder.
//!
//! # What the page lets one do
//! Every handle of the light, the shading point and its normal follow mouse, finger and arrow keys; sliders push the light far, thin, small,
//! and to the horizon. Each technique has a card with its directions (in equal areas, or projected), its points on the light, the pdf or a
//! factor of the integrand as a shade, root mean square errors of 1, 16 and 1,024 samples, and what `pdf` and `invert` return under the
//! cursor. A link shows the same again. In the console, `playground.answer()` returns the numbers with all of their bits.
//!
//! The lecture goes through these figures:
//! 1. `hemisphere-vs-area`: drag the light away from 16 rays over the hemisphere, and from 16 to the light.
//! 2. `sphere-area-vs-cone`: push the sphere far, until the textbook's cone collapses to rings.
//! 3. `triangle-area-vs-solid-angle`: move the point under the triangle, and see which map is even.
//! 4. `area-factors`: choose the factor of the integrand by which the light is shaded.
//! 5. `cap-solid-angle-vs-projected`: lower a sphere below the horizon.
//! 6. `sample-variance`: see how often four samples know nothing of their own variance.
//! 7. `quads-convergence`: compare three sequences on a light that the horizon cuts.
//! 8. `importance`: drag the height of a pdf over a bump.
//! 9. `stratification`: measure slopes over an edge and over a ramp.
//!
//! # Sources of the page
//! `page/*.js` are joined in the order of `page.rs` in one scope. `library.js` calls the C interface; `estimates.js` has the ways to sample
//! that are compared, `textbook.js` the formulas beside them, `closed.js` the irradiance; `maps.js`, `scene.js` and `charts.js` draw;
//! `lights.js`, `presets.js`, `controls.js`, `state.js` and `main.js` are what the hand changes.

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
    let wasm = library::build(&list::FUNCTIONS)?;
    let packed = page::gzip(&wasm)?;
    let text = page::join(&lights, &list::warps(), &packed);
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
