//! Figures about light sampling, each with the numbers it illustrates.

mod sheet;
mod sky_and_lamp;
mod studio;
mod vignetting;

use crate::interrupt::interrupt;
use crate::options::{out, threads, whole};
use clap::{Args, ValueEnum};
use etendue_render::files;
use std::error::Error;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use studio::{Finding, Studio};

/// Options of `etendue figure`.
#[derive(Args, Clone, Debug)]
pub struct Options {
    /// The figure to draw
    #[arg(value_enum)]
    pub name: Name,
    /// Folder for NAME.svg
    #[arg(short, long, default_value = "figures")]
    pub output: PathBuf,
    /// Number of threads; 0 means one per core
    #[arg(long, default_value_t = 0, value_parser = threads)]
    pub threads: usize,
    /// Seed of the random numbers; different seeds give independent figures
    #[arg(long, default_value_t = 0, value_parser = whole::<u64>(0..=u64::MAX))]
    pub seed: u64,
}

/// The figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Name {
    /// Efficiency of the choice between lamps, skies and suns against the size of the floor
    SkyAndLamp,
    /// The lens as seen from points of the film, in and out of focus, vignetted by its barrel
    Vignetting,
}

impl Studio<'_> {
    fn draw(&self, name: Name) -> Result<Finding, Box<dyn Error>> {
        match name {
            Name::SkyAndLamp => self.sky_and_lamp(),
            Name::Vignetting => self.vignetting(),
        }
    }
}

/// Draws a figure, and prints its numbers.
///
/// # Errors
/// Fails if a file cannot be written, or if Ctrl-C stops it.
pub fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let stop = interrupt()?;
    files::make_folder(&options.output)?;
    let pool = crate::options::pool(options.threads)?;
    let studio = Studio { seed: options.seed, stop: &stop };
    let title = options.name.to_possible_value().map_or_else(String::new, |v| v.get_name().to_owned());
    let finding = pool.install(|| studio.draw(options.name).map_err(|e| e.to_string()))?;
    if stop.load(Ordering::Relaxed) {
        return Err(format!("interrupted while drawing {title}").into());
    }
    let path = options.output.join(format!("{title}.svg"));
    files::replace(&path, finding.svg.file().as_bytes())?;
    let mut out = out();
    writeln!(out, "{title}: wrote {}", path.display())?;
    for line in &finding.headline {
        writeln!(out, "  {line}")?;
    }
    Ok(())
}
