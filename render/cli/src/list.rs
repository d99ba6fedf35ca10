//! `etendue list`: prints the names that other commands take.

use clap::ValueEnum;
use etendue_render::options::out;
use etendue_render::{ChoiceBy, Sampler, Sensor, Technique, scene};
use std::io::{self, Write};

/// Prints the built-in scenes, techniques, choices, samplers and sensors, each with a description.
pub(crate) fn run() -> io::Result<()> {
    let mut out = out();
    writeln!(out, "scenes")?;
    for (name, about) in scene::builtin() {
        writeln!(out, "  {name:20} {about}")?;
    }
    values::<Technique>(&mut out, "techniques")?;
    values::<ChoiceBy>(&mut out, "choices")?;
    values::<Sampler>(&mut out, "samplers")?;
    values::<Sensor>(&mut out, "sensors")
}

fn values<T: ValueEnum>(out: &mut impl Write, title: &str) -> io::Result<()> {
    writeln!(out, "{title}")?;
    for value in T::value_variants().iter().filter_map(ValueEnum::to_possible_value) {
        let help = value.get_help().map(ToString::to_string).unwrap_or_default();
        writeln!(out, "  {:20} {help}", value.get_name())?;
    }
    Ok(())
}
