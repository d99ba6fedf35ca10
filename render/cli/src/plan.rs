//! `etendue plan`: prints the commands that render an image in parts.

use crate::image::ImageOptions;
use crate::output::Output;
use crate::part::file_name;
use clap::Args;
use etendue_render::area::Area;
use etendue_render::limits::MOST_SAMPLES;
use etendue_render::options::{out, whole};
use etendue_render::{Sampler, split};
use std::error::Error;
use std::ffi::{OsStr, OsString};
use std::io::Write;
use std::ops::Range;
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
    /// Split the samples of each tile into this many of the parts; the sampler adaptive cannot
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = whole::<u32>(1..=MOST_SAMPLES.into()))]
    ranges: u32,
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
fn line(words: &[OsString]) -> Vec<u8> {
    words.iter().map(|word| quote(word)).collect::<Vec<_>>().join(&b' ')
}

/// The words of a list.
fn words<const N: usize>(words: [&dyn AsRef<OsStr>; N]) -> Vec<OsString> {
    words.map(|word| word.as_ref().to_owned()).into()
}

/// Prints one command a line, and an empty line between the stages. The commands of a stage can run in any order.
pub(crate) fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let Options { image, output, tasks, ranges, parts } = options;
    let (scene, settings) = image.load()?;
    image.check(&settings, scene.camera.lens.is_some())?;
    let adaptive = settings.sampler == Sampler::Adaptive;
    if adaptive && *ranges > 1 {
        return Err("--ranges: the sampler adaptive can only be split into tiles; \
                    choose another, such as --sampler sobol, or leave --ranges out"
            .into());
    }
    if *ranges > *tasks || *ranges > settings.spp {
        let (least, what) = (settings.spp.min(*tasks), if *tasks < settings.spp { "tasks" } else { "samples" });
        return Err(format!("--ranges {ranges}: there are only {least} {what}").into());
    }
    // what can be wrong with it should not be found after hours
    let output = Output::new(output.as_deref(), &scene, image.stem())?.exr;
    let folder = parts.clone().unwrap_or_else(|| output.with_extension("parts"));
    if folder.exists() && !folder.is_dir() {
        return Err(format!("--parts {}: this is a file, not a folder", folder.display()).into());
    }
    let areas = split::areas(&settings, tasks / ranges);
    let spp = settings.spp;
    let program = std::env::args_os().next().unwrap_or_else(|| "etendue".into());
    let render = |area: Area, more: &OsStr, to: &Path| {
        let [x0, y0, x1, y1] = area;
        let tile = format!("--tile={x0},{y0},{x1},{y1}");
        [words([&program, &"render"]), image.arguments(), words([&tile, &more, &"-o", &to])].concat()
    };
    let merge = |to: &Path, from: &Path| vec![words([&program, &"merge", &"-o", &to, &from])];
    let stages = if adaptive {
        let [pilots, pilot, last] = ["pilot", "pilot.exr", "image"].map(|name| folder.join(name));
        let mut after = OsString::from("--after=");
        after.push(&pilot);
        let parts = |more: &OsStr, to: &Path| -> Vec<_> {
            areas.iter().map(|&area| render(area, more, &to.join(file_name(area, None)))).collect()
        };
        vec![parts("--pilot".as_ref(), &pilots), merge(&pilot, &pilots), parts(&after, &last), merge(&output, &last)]
    } else {
        let parts =
            areas.iter().flat_map(|&area| split::ranges(spp, *ranges).into_iter().map(move |range| (area, range)));
        let part = |(area, range): (Area, Range<u32>)| {
            let more = format!("--range={}:{}", range.start, range.end);
            render(area, more.as_ref(), &folder.join(file_name(area, Some(&range))))
        };
        vec![parts.map(part).collect(), merge(&output, &folder)]
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
