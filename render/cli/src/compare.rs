//! `etendue compare`: prints the difference of two images, or the error of a filtered one.

use clap::Args;
use etendue_laboratory::options::{out, say};
use etendue_render::film::compare::Comparison;
use etendue_render::film::filtered::FilteredClaim;
use etendue_render::film::image;
use std::error::Error;
use std::io::Write;
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct Options {
    /// EXR file of the reference; with --claim, of an image as it was rendered by the sampler adaptive
    reference: PathBuf,
    /// EXR file of the image; with --claim, of what any filter made of the other one, of its channels R, G and B alone
    image: PathBuf,
    /// Print the error of the filtered image, which the second sets in the file of the rendered one tell, and which of both is better
    #[arg(long, conflicts_with = "reference_error")]
    claim: bool,
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
    let is_png = |path: &&PathBuf| path.extension().is_some_and(|text| text.eq_ignore_ascii_case("png"));
    if let Some(png) = [&options.reference, &options.image].into_iter().find(is_png) {
        let exr = png.with_extension("exr");
        return Err(format!("{}: EXR files are compared, such as {}", png.display(), exr.display()).into());
    }
    let reference = image::read_exr(&options.reference)?;
    let other = image::read_exr(&options.image)?;
    if options.claim {
        let claim = FilteredClaim::new(&reference, &other)
            .map_err(|what| format!("{} and {}: {what}", options.reference.display(), options.image.display()))?;
        return Ok(if options.json { writeln!(out(), "{}", claim.to_json()) } else { writeln!(out(), "{claim}") }?);
    }
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
