//! `etendue list`: prints the names that other commands take.

use etendue_laboratory::options::out;
use etendue_render::{ChoiceBy, Sampler, Sensor, Technique};
use etendue_scene::{Asked, Contents};
use std::error::Error;
use std::io::{self, Write};
use std::path::Path;

/// Letters of the longest name, `projected-solid-angle`.
const WIDTH: usize = 21;

/// Prints what a file offers a choice of, each with the number by which it can be asked for.
pub(crate) fn file(path: &Path, scene: Option<&str>) -> Result<(), Box<dyn Error>> {
    let asked = Asked { scene: scene.map(str::to_owned), ..Asked::default() };
    let Contents { scenes, cameras } = etendue_scene::contents(path, &asked)?;
    let mut out = out();
    for (title, names) in [("scenes", scenes), ("cameras", cameras)] {
        if !names.is_empty() {
            writeln!(out, "{title}")?;
        }
        for (number, name) in names.iter().enumerate() {
            writeln!(out, "  {number:<4} {name}")?;
        }
    }
    Ok(())
}

/// Prints the built-in scenes, techniques, choices, samplers and sensors, each with a description.
pub(crate) fn run() -> io::Result<()> {
    let mut out = out();
    writeln!(out, "scenes")?;
    for (name, about) in etendue_scene::builtin() {
        writeln!(out, "  {name:WIDTH$} {about}")?;
    }
    values(&mut out, "techniques", &Technique::NAMES)?;
    values(&mut out, "choices", &ChoiceBy::NAMES)?;
    values(&mut out, "samplers", &Sampler::NAMES)?;
    values(&mut out, "sensors", &Sensor::NAMES)
}

fn values(out: &mut impl Write, title: &str, names: &[[&str; 2]]) -> io::Result<()> {
    writeln!(out, "{title}")?;
    names.iter().try_for_each(|[name, about]| writeln!(out, "  {name:WIDTH$} {about}"))
}
