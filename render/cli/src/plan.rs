//! `etendue plan`: prints the commands that render an image in parts.

use crate::image::ImageOptions;
use crate::output::Output;
use crate::part::file_name;
use clap::Args;
use etendue_render::{Sampler, split};
use std::error::Error;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

#[derive(Args)]
pub(crate) struct Options {
    #[command(flatten)]
    image: ImageOptions,
    /// Write the image to this EXR file in the end [default: the scene's film filename, or SCENE.exr]
    #[arg(short, long, value_name = "OUT.exr")]
    output: Option<PathBuf>,
    /// Split the image into about this many parts
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    tasks: u32,
    /// Split the samples of each tile into this many of the parts; the sampler adaptive cannot
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    ranges: u32,
    /// Write the parts into this folder [default: OUT.parts]
    #[arg(long, value_name = "DIR")]
    parts: Option<PathBuf>,
}

/// A word of a command, for a POSIX shell.
fn quote(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-+=/.,:@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
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
    let output = Output::new(output.as_deref(), &scene)?.exr;
    let folder = parts.clone().unwrap_or_else(|| output.with_extension("parts"));
    let areas = split::areas(&settings, tasks / ranges);
    let spp = settings.spp;
    let mut out = io::stdout().lock();
    let program = std::env::args().next().unwrap_or_else(|| "etendue".to_owned());
    let mut print = |words: Vec<String>| {
        let words: Vec<String> = std::iter::once(&program).chain(&words).map(|word| quote(word)).collect();
        writeln!(out, "{}", words.join(" "))
    };
    let render = |area: [u32; 4], more: &[String], to: PathBuf| -> Vec<String> {
        let [x0, y0, x1, y1] = area;
        let mut words = vec!["render".to_owned()];
        words.extend(image.arguments());
        words.push(format!("--tile={x0},{y0},{x1},{y1}"));
        words.extend(more.iter().cloned());
        words.extend(["-o".to_owned(), to.to_string_lossy().into_owned()]);
        words
    };
    let merge = |to: &Path, from: &Path| -> Vec<String> {
        ["merge", "-o", &to.to_string_lossy(), &from.to_string_lossy()].map(str::to_owned).into()
    };
    let mut last = folder.clone();
    if adaptive {
        let (pilots, pilot) = (folder.join("pilot"), folder.join("pilot.exr"));
        for &area in &areas {
            print(render(area, &["--pilot".to_owned()], pilots.join(file_name(area, None))))?;
        }
        writeln!(io::stdout())?;
        print(merge(&pilot, &pilots))?;
        writeln!(io::stdout())?;
        last = folder.join("image");
        for &area in &areas {
            let after = format!("--after={}", pilot.display());
            print(render(area, &[after], last.join(file_name(area, None))))?;
        }
    } else {
        for &area in &areas {
            for range in split::ranges(spp, *ranges) {
                let words = [format!("--range={}:{}", range.start, range.end)];
                print(render(area, &words, folder.join(file_name(area, Some(&range)))))?;
            }
        }
    }
    writeln!(io::stdout())?;
    print(merge(&output, &last))?;
    Ok(())
}
