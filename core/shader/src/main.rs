//! Writes sources for the lights and warps that are asked for.

use clap::builder::PossibleValuesParser;
use clap::{ArgGroup, Parser};
use etendue_shader::{Language, Part, SampleField, Selection, Wanted, lights, tables, tools, warps};
use std::fs;
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

/// Writes the light sampling of etendue in a shading language
#[derive(Parser)]
#[command(name = "etendue-shader", version, group(ArgGroup::new("what").required(true).multiple(true)))]
struct Options {
    /// Language of the source
    #[arg(long, value_parser = PossibleValuesParser::new(Language::ALL.map(Language::name)))]
    language: String,
    /// Lights by all their techniques (triangle), or by one of them (triangle_by_area), with commas between
    #[arg(long, group = "what", value_delimiter = ',', value_parser = PossibleValuesParser::new(light_names()), hide_possible_values = true)]
    lights: Vec<String>,
    /// Warps, with commas between
    #[arg(long, group = "what", value_delimiter = ',', value_parser = PossibleValuesParser::new(warp_names()), hide_possible_values = true)]
    warps: Vec<String>,
    /// Sequences of random numbers and weights of combined techniques, with commas between
    #[arg(long, group = "what", value_delimiter = ',', value_parser = PossibleValuesParser::new(tool_names()))]
    tools: Vec<String>,
    /// What reads tables in memory, with commas between
    #[arg(long, group = "what", value_delimiter = ',', value_parser = PossibleValuesParser::new(table_names()))]
    tables: Vec<String>,
    /// Functions of each light, warp and table, besides the preparation [default: all]
    #[arg(long, value_delimiter = ',', value_parser = PossibleValuesParser::new(Part::ALL.iter().map(|part| part.name())))]
    functions: Vec<String>,
    /// Fields of the samples of lights [default: all]
    #[arg(long, value_delimiter = ',', value_parser = PossibleValuesParser::new(SampleField::ALL.iter().map(|field| field.name())))]
    fields: Vec<String>,
    /// Write fused multiply-adds, quotients and square roots out, for devices that do not round them correctly: about 50 operations for a multiply-add, 120 for the others
    #[arg(long)]
    exact: bool,
    /// File to write [default: standard output]
    #[arg(short, long)]
    output: Option<PathBuf>,
}

// the names live as long as the program, as the parser demands
fn light_names() -> Vec<&'static str> {
    let lights = lights().into_iter().flat_map(|(light, techniques)| [vec![light], techniques].concat());
    std::iter::once("all").chain(lights.map(|name| &*name.leak())).collect()
}
fn tool_names() -> Vec<&'static str> {
    std::iter::once("all").chain(tools().iter().copied()).collect()
}
fn table_names() -> Vec<&'static str> {
    std::iter::once("all").chain(tables()).collect()
}
fn warp_names() -> Vec<&'static str> {
    std::iter::once("all").chain(warps().into_iter().map(|name| &*name.leak())).collect()
}

impl Options {
    fn wanted(&self) -> Wanted {
        let mut wanted = Wanted::default();
        if !self.functions.is_empty() {
            wanted.parts.retain(|part| self.functions.iter().any(|name| name == part.name()));
        }
        if !self.fields.is_empty() {
            wanted.fields.retain(|field| self.fields.iter().any(|name| name == field.name()));
        }
        wanted
    }
    /// The command that writes the same file.
    fn command(&self) -> String {
        let mut command = format!("etendue-shader --language {}", self.language);
        if self.exact {
            command += " --exact";
        }
        for (option, names) in [
            ("lights", &self.lights),
            ("warps", &self.warps),
            ("tools", &self.tools),
            ("tables", &self.tables),
            ("functions", &self.functions),
            ("fields", &self.fields),
        ] {
            if !names.is_empty() {
                command += &format!(" --{option} {}", names.join(","));
            }
        }
        command
    }
    fn run(&self) -> Result<(), String> {
        let language = Language::ALL.into_iter().find(|language| language.name() == self.language);
        let language = language.expect("clap has refused all others");
        if self.exact && language.is_exact() {
            return Err(format!("--exact: {} rounds all operations correctly without it", language.name()));
        }
        let (lights, warps) = (self.lights.clone(), self.warps.clone());
        let (tools, tables) = (self.tools.clone(), self.tables.clone());
        let selection = Selection { lights, warps, tools, tables, wanted: self.wanted(), exact: self.exact };
        let bytes = language.write(&selection.module(), &format!("Written by `{}`.", self.command()))?;
        match &self.output {
            Some(path) => fs::write(path, bytes).map_err(|error| format!("{}: {error}", path.display())),
            None => match io::stdout().write_all(&bytes) {
                // the reader has seen enough
                Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
                written => written.map_err(|error| format!("standard output: {error}")),
            },
        }
    }
}

fn main() -> ExitCode {
    // clap prints what is wrong with the arguments, with what is possible, and exits with 2
    match Options::parse().run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("etendue-shader: {error}");
            ExitCode::from(2)
        }
    }
}
