//! `etendue compare`: prints the difference of two images.

use clap::Args;
use etendue_laboratory::options::{out, say};
use etendue_render::film::compare::Comparison;
use etendue_render::film::image;
use std::error::Error;
use std::io::Write;
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct Options {
    /// EXR file of the reference
    reference: PathBuf,
    /// EXR file of the image
    image: PathBuf,
    /// Take this as the mean squared standard error of a reference whose file has no variance
    #[arg(long, default_value_t = 0.0)]
    reference_error: f64,
    /// Print the result as one JSON object
    #[arg(long)]
    json: bool,
}

/// Prints the comparison.
pub(crate) fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let error = options.reference_error;
    if !(error.is_finite() && error >= 0.0) {
        return Err(format!("--reference-error: must be a number of at least 0, not {error}").into());
    }
    let reference = image::read_exr(&options.reference)?;
    let other = image::read_exr(&options.image)?;
    let comparison =
        Comparison::new(&reference, &other, error).map_err(|what| format!("{}: {what}", options.image.display()))?;
    if comparison.shares_noise() {
        say(format_args!(
            "warning: {} and {} differ by much less than their variances predict: they seem to share their random numbers (same \
             seed?), so their difference says little about their errors",
            options.reference.display(),
            options.image.display()
        ));
    }
    if options.json {
        writeln!(out(), "{}", comparison.to_json())?;
    } else {
        writeln!(out(), "{comparison}")?;
    }
    Ok(())
}
