//! `etendue merge`: puts parts of an image together.

use crate::interrupt::Interrupt;
use crate::output::Output;
use crate::progress::bar;
use clap::Args;
use etendue_render::merge::{self, MergeGoal, MergeOutcome, Merged};
use etendue_render::options::{out, pool, threads};
use etendue_render::parts::{PartFile, PieceKind};
use etendue_render::{files, parts};
use std::error::Error;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

#[derive(Args)]
pub(crate) struct Options {
    /// The parts, or folders of parts
    #[arg(required = true, value_name = "PART.exr|DIR")]
    parts: Vec<PathBuf>,
    /// Write the image to this EXR file, and a PNG beside it; of the parts of a pilot, write the whole pilot
    #[arg(short, long, value_name = "OUT.exr")]
    output: PathBuf,
    /// Write an image of the samples that are there, although some are missing
    #[arg(long, conflicts_with = "as_part")]
    partial: bool,
    /// Write one part that holds what the parts hold
    #[arg(long)]
    as_part: bool,
    /// Use this many threads; 0 means one per core
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = threads)]
    threads: usize,
}

/// Whether a merge would lose what is in this file of its folder by writing to it: another part than a merged pilot, which can be made
/// again from the others.
fn is_needed(path: &Path) -> bool {
    PartFile::open(path)
        .is_ok_and(|part| part.pieces.iter().any(|piece| !matches!(piece.kind, PieceKind::Allotment(_))))
}

/// The files, and those in the folders whose names end in `.exr`, in the order of their names; without the output, which may be an image in
/// one of the folders.
fn files_of(paths: &[PathBuf], output: &Output) -> Result<Vec<PathBuf>, String> {
    let is_output = |path: &Path| files::is_same(path, &output.exr) || files::is_same(path, &output.png);
    let input = |path: &Path| format!("{}: this file is an input: choose another name with -o", path.display());
    let mut all = Vec::new();
    for path in paths {
        if !path.is_dir() {
            if is_output(path) {
                return Err(input(path));
            }
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
        if let Some(part) = found.iter().find(|file| is_output(file) && is_needed(file)) {
            return Err(input(part));
        }
        found.retain(|file| !is_output(file));
        if found.is_empty() {
            return Err(format!("{}: there are no parts in this folder", path.display()));
        }
        found.sort();
        all.append(&mut found);
    }
    Ok(all)
}

/// Merges, writes and reports.
pub(crate) fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let interrupt = Interrupt::new()?;
    let mut output = Output::of(options.output.clone(), &[])?;
    let files = files_of(&options.parts, &output)?;
    let goal = match options {
        Options { partial: true, .. } => MergeGoal::Partial,
        Options { as_part: true, .. } => MergeGoal::Part,
        _ => MergeGoal::Image,
    };
    let bar = bar(files.len() as u64, "{wide_bar} {pos} of {len} parts");
    interrupt.watch(&bar, &output.exr);
    let merged = pool(options.threads)?.install(|| merge::merge(&files, goal, &|done| bar.inc(done)));
    bar.finish_and_clear();
    let MergeOutcome { frame, merged, used, duplicates, gaps } = merged?;
    let mut out = out();
    for file in &duplicates {
        writeln!(out, "ignored {}, which holds what another part holds", file.display())?;
    }
    let _status = interrupt.lock();
    match merged {
        Merged::Image(film) => {
            output.place = frame.place;
            output.write(&film, frame.exposure)?;
            writeln!(out, "wrote {} and {} from {used} parts", output.exr.display(), output.png.display())?;
            if !gaps.is_empty() {
                let whole = frame.settings.spp as usize * film.pixels.len();
                let there: usize = film.pixels.iter().map(|pixel| pixel.samples as usize).sum();
                let percent = 100.0 * there as f64 / whole as f64;
                writeln!(out, "{} parts are missing: the image has {percent:.1} % of its samples", gaps.len())?;
            }
        }
        Merged::Part(pieces) => {
            parts::write(&output.exr, &frame, pieces)?;
            writeln!(out, "wrote {} from {used} parts", output.exr.display())?;
        }
    }
    Ok(())
}
