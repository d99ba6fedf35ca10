//! Maps where methods fail: compares every technique of the library, and textbook formulas, with the exact result in 106 bits, over
//! sweeps of size, elevation, aspect ratio and distance.
//!
//! [`pose`] has the sweeps, [`truth`] the exact results, [`methods`] the measured techniques, [`etendue_judge::textbook`] the baselines,
//! [`mod@survey`] and `irradiance` the measurements, `maps` and [`page`] what is drawn of them.

mod irradiance;
mod maps;
pub mod methods;
pub mod page;
pub mod pose;
pub mod survey;
pub mod truth;

use clap::Parser;
use etendue_laboratory::options::{out, pool, threads};
use etendue_laboratory::progress::bar;
use etendue_render::film::files::make_folder;
use pose::ShapeKind;
use std::error::Error;
use std::io::Write;
use std::path::PathBuf;
use survey::{Detail, cells, survey};

/// Maps where each technique of the library loses accuracy, compared with textbook formulas
///
/// Example: `etendue-atlas --shape triangle --quick` maps triangles in some seconds.
#[derive(Clone, Debug, Parser)]
#[command(version)]
pub struct Options {
    /// Folder for atlas.html, atlas.csv and one SVG of maps per sweep
    #[arg(short, long, default_value = "atlas")]
    pub output: PathBuf,
    /// Shapes to measure [default: all]
    #[arg(long, value_enum, value_delimiter = ',')]
    pub shape: Vec<ShapeKind>,
    /// Measure coarse maps, in two minutes on two cores
    #[arg(long)]
    pub quick: bool,
    /// Number of threads; 0 means one per core
    #[arg(long, default_value_t = 0, value_parser = threads)]
    pub threads: usize,
}

/// Measures, writes the page and prints a summary.
///
/// # Errors
/// Fails if a file cannot be written.
pub fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let mut kinds = Vec::new();
    for &kind in if options.shape.is_empty() { ShapeKind::all() } else { &options.shape } {
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    let folder = &options.output;
    // fail before the measurements, not after them
    make_folder(folder)?;
    let pool = pool(options.threads)?;
    let detail = Detail::new(options.quick);
    let bar = bar(cells(&kinds, detail) as u64, "measuring")?;
    let charts = pool.install(|| survey(&kinds, detail, || bar.inc(1)));
    bar.finish_and_clear();
    page::write(&charts, folder, options.quick)?;
    let mut out = out();
    write!(out, "{}", page::table(&charts))?;
    writeln!(out, "wrote {}", folder.join("atlas.html").display())?;
    Ok(())
}
