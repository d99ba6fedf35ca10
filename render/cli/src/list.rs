//! `etendue list`: prints the names that other commands take.

use etendue_laboratory::options::out;
use etendue_render::{ChoiceBy, Sampler, Sensor, Technique};
use std::io::{self, Write};

/// Letters of the longest name, `projected-solid-angle`.
const WIDTH: usize = 21;

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
