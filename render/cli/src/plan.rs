//! `etendue plan`: prints the commands that render an image in parts.

use crate::image::ImageOptions;
use crate::output::Output;
use crate::part::file_name;
use clap::Args;
use etendue_laboratory::options::{out, whole};
use etendue_render::scene::area::Area;
use etendue_render::{Sampler, drive::split};
use std::error::Error;
use std::ffi::{OsStr, OsString};
use std::io::Write;
use std::path::{Path, PathBuf};

#[derive(Args)]
pub(crate) struct Options {
    #[command(flatten)]
    image: ImageOptions,
    /// Write the image to this EXR file in the end [default: the scene's film filename, or SCENE.exr]
    #[arg(short, long, value_name = "OUT.exr")]
    output: Option<PathBuf>,
    /// Split the image into about this many parts
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = whole::<u32>(1..=1_000_000))]
    tasks: u32,
    /// Write the parts into this folder [default: OUT.parts]
    #[arg(long, value_name = "DIR")]
    parts: Option<PathBuf>,
}

/// A word of a command, for a POSIX shell, with whatever bytes names of files have.
fn quote(word: &OsStr) -> Vec<u8> {
    let bytes = word.as_encoded_bytes();
    let is_plain = |c: &u8| c.is_ascii_alphanumeric() || b"_-+=/.,:@%".contains(c);
    if !bytes.is_empty() && bytes.iter().all(is_plain) {
        return bytes.to_owned();
    }
    let quoted: Vec<&[u8]> = bytes.split(|c| *c == b'\'').collect();
    [b"'", &quoted.join(&br"'\''"[..])[..], b"'"].concat()
}

/// A command as a line without its end.
pub(crate) fn line(words: &[OsString]) -> Vec<u8> {
    words.iter().map(|word| quote(word)).collect::<Vec<_>>().join(&b' ')
}

/// The words of a list.
pub(crate) fn words<const N: usize>(words: [&dyn AsRef<OsStr>; N]) -> Vec<OsString> {
    words.map(|word| word.as_ref().to_owned()).into()
}

/// Prints one command a line, and an empty line between the stages. The commands of a stage can run in any order.
pub(crate) fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let Options { image, output, tasks, parts } = options;
    let (scene, settings) = image.load()?;
    image.check(&settings)?;
    // what can be wrong with it should not be found after hours
    let output = Output::new(output.as_deref(), &scene, Path::new(&image.scene))?.exr;
    let folder = parts.clone().unwrap_or_else(|| output.with_extension("parts"));
    if folder.exists() && !folder.is_dir() {
        return Err(format!("--parts {}: this is a file, not a folder", folder.display()).into());
    }
    let areas = split::areas(&settings, *tasks);
    let program = std::env::args_os().next().unwrap_or_else(|| "etendue".into());
    let render = |area: Area, more: &[OsString], to: &Path| {
        let [x0, y0, x1, y1] = area;
        let tile = format!("--tile={x0},{y0},{x1},{y1}");
        let to = to.join(file_name(area));
        [words([&program, &"render"]), image.arguments(), words([&tile]), more.into(), words([&"-o", &to])].concat()
    };
    let parts = |more: &[OsString], to: &Path| -> Vec<_> { areas.iter().map(|&area| render(area, more, to)).collect() };
    let merge = |to: &Path, from: &Path| vec![words([&program, &"merge", &"-o", &to, &from])];
    let stages = if settings.sampler == Sampler::Adaptive {
        let [pilots, pilot, last] = ["pilot", "pilot.exr", "image"].map(|name| folder.join(name));
        let mut after = OsString::from("--after=");
        after.push(&pilot);
        let first = parts(&["--pilot".into()], &pilots);
        vec![first, merge(&pilot, &pilots), parts(&[after], &last), merge(&output, &last)]
    } else {
        vec![parts(&[], &folder), merge(&output, &folder)]
    };
    let mut plan: Vec<Vec<u8>> = Vec::new();
    for stage in stages {
        let commands: Vec<Vec<u8>> = stage.iter().map(|words| line(words)).collect();
        if commands.iter().any(|command| command.contains(&b'\n')) {
            return Err("a plan has one command on each line, so no name in it may have a line break".into());
        }
        plan.push([commands.join(&b'\n'), b"\n".into()].concat());
    }
    out().write_all(&plan.join(&b'\n'))?;
    Ok(())
}
