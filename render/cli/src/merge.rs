//! `etendue merge`: puts the parts of an image together, or averages images.

use crate::interrupt::Interrupt;
use crate::output::Output;
use crate::progress::bar;
use clap::Args;
use etendue_laboratory::options::{out, pool, threads};
use etendue_render::drive::merge::{self, MergeOutcome, Merged};
use etendue_render::{drive::parts, film::files, scene::area};
use std::error::Error;
use std::fs;
use std::io::{self, Write};
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct Options {
    /// The parts of an image, or images of different seeds to be averaged, or folders of them
    #[arg(required = true, value_name = "FILE.exr|DIR")]
    files: Vec<PathBuf>,
    /// Write the image to this EXR file, and a PNG beside it; of the parts of a pilot, write the whole pilot
    #[arg(short, long, value_name = "OUT.exr")]
    output: PathBuf,
    /// Write an image of the tiles that are there, although some are missing
    #[arg(long)]
    partial: bool,
    /// Use this many threads; 0 means one per core
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = threads)]
    threads: usize,
}

/// The files, and those in the folders whose names end in `.exr`, in the order of their names. None may be the output.
fn files_of(paths: &[PathBuf], output: &Output) -> Result<Vec<PathBuf>, String> {
    let mut all = Vec::new();
    for path in paths {
        if !path.is_dir() {
            all.push(path.clone());
            continue;
        }
        let cannot = |error: io::Error| format!("{}: cannot read: {error}", path.display());
        let entries = fs::read_dir(path).map_err(cannot)?;
        let mut found =
            entries.map(|entry| entry.map(|entry| entry.path())).collect::<Result<Vec<_>, _>>().map_err(cannot)?;
        // files that are being written begin with a dot
        found.retain(|file| {
            let is_hidden = file.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
            let is_exr = file.extension().is_some_and(|e| e.eq_ignore_ascii_case("exr"));
            is_exr && !is_hidden && file.is_file()
        });
        if found.is_empty() {
            return Err(format!("{}: there are no parts in this folder", path.display()));
        }
        found.sort();
        all.append(&mut found);
    }
    let is_output = |path: &&PathBuf| files::is_same(path, &output.exr) || files::is_same(path, &output.png);
    match all.iter().find(is_output) {
        Some(path) => Err(format!("{}: this file is an input: choose another name with -o", path.display())),
        None => Ok(all),
    }
}

/// Merges, writes and reports.
pub(crate) fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let interrupt = Interrupt::new()?;
    let output = Output::of(options.output.clone(), &[])?;
    let files = files_of(&options.files, &output)?;
    let bar = bar(files.len() as u64, "{wide_bar} {pos} of {len} files");
    interrupt.watch(&bar, &output.exr);
    let merged = pool(options.threads)?.install(|| merge::merge(&files, options.partial, &|done| bar.inc(done)));
    bar.finish_and_clear();
    let MergeOutcome { identity, merged, used, duplicates, gaps } = merged?;
    let mut out = out();
    for file in &duplicates {
        writeln!(out, "ignored {}, which holds what another part holds", file.display())?;
    }
    let _status = interrupt.lock();
    match merged {
        Merged::Image(film) => {
            output.write(&film, &identity.of_image())?;
            writeln!(out, "wrote {} and {} from {used} files", output.exr.display(), output.png.display())?;
            if !gaps.is_empty() {
                let missing: usize = gaps.iter().map(|gap| area::count(*gap)).sum();
                let percent = 100.0 - 100.0 * missing as f64 / film.pixels.len() as f64;
                writeln!(out, "{} areas are missing: the image has {percent:.1} % of its pixels", gaps.len())?;
            }
        }
        Merged::Pilot(piece) => {
            parts::write(&output.exr, &identity, piece)?;
            writeln!(out, "wrote {} from {used} files", output.exr.display())?;
        }
    }
    Ok(())
}
