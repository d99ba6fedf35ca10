//! The renderer's command line: reads the arguments, runs a command and sets the exit code.

mod beside;
mod command_line;
mod compare;
mod hints;
mod image;
mod interrupt;
mod list;
mod output;
mod partial;
mod processor;
mod progress;
mod render;
mod view;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use etendue_laboratory::chart;
use etendue_laboratory::interrupt::survive_limits_of_files;
use etendue_laboratory::options::say;
use std::any::TypeId;
use std::error::Error;
use std::io;
use std::path::PathBuf;
use std::process::ExitCode;

/// A direct-lighting renderer that measures how well lights are sampled
#[derive(Parser)]
#[command(name = "etendue", version)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Render a scene to an EXR file, with a PNG beside it
    ///
    /// Example: `etendue render studio --error 1%` renders until the estimated error is 1 %.
    Render(render::Options),
    /// Show an image in the browser while it improves
    ///
    /// Example: `etendue view studio --technique area` shows it by sampling points of the lamps; the page switches techniques, compares
    /// them and turns the camera.
    View(view::Options),
    /// Compare an image with a reference of the same size
    ///
    /// Example: `etendue compare reference.exr image.exr` prints the error, and whether the difference is more than noise.
    Compare(compare::Options),
    /// Measure the error and time of techniques and samplers, and write a report with charts
    ///
    /// Example: `etendue chart studio --quick` says in a minute how many seconds an error of 1 % takes, and by which technique.
    Chart(chart::Options),
    /// List the built-in scenes, techniques, choices of a light, samplers and sensors, or the scenes and cameras of a file
    ///
    /// Example: `etendue list | grep lens` finds a scene that is seen through a lens, and `etendue list room.glb` the cameras of a file.
    List {
        /// Path of a scene file
        file: Option<PathBuf>,
        /// The scene whose cameras are listed: its name, or its number from 0 on
        #[arg(long, value_name = "NAME", requires = "file")]
        scene: Option<String>,
    },
}

fn main() -> ExitCode {
    let missing = processor::missing_features();
    if !missing.is_empty() {
        say(format_args!(
            "etendue: this program was built for a processor with {}, which this machine lacks.\n\
             Rebuild it without that requirement: CARGO_ENCODED_RUSTFLAGS= cargo build --release",
            missing.join(", ")
        ));
        return ExitCode::from(3);
    }
    survive_limits_of_files();
    match run(arguments().command) {
        Ok(code) => ExitCode::from(code),
        // the reader has closed the pipe, as `head` does: this ends the program as SIGPIPE ends others, without a message
        Err(error) if error.downcast_ref::<io::Error>().is_some_and(|e| e.kind() == io::ErrorKind::BrokenPipe) => {
            ExitCode::from(141)
        }
        Err(error) => {
            say(format_args!("etendue: {error}"));
            ExitCode::from(2)
        }
    }
}

/// The arguments. What follows an option other than that for a file is its value even if it begins with a hyphen, so that a message about
/// a negative number can name both.
fn arguments() -> Cli {
    let is_file = |argument: &clap::Arg| argument.get_value_parser().type_id() == TypeId::of::<PathBuf>();
    let command = Cli::command().mut_subcommands(|command| {
        command.mut_args(|argument| {
            let takes_hyphen = argument.get_action().takes_values() && !argument.is_positional() && !is_file(&argument);
            if takes_hyphen { argument.allow_hyphen_values(true) } else { argument }
        })
    });
    // a view has no number of samples, and says so to whoever asks for one
    let command = command.mut_subcommand("view", |view| view.mut_arg("spp", |spp| spp.hide(true)));
    Cli::from_arg_matches(&command.get_matches()).unwrap_or_else(|error| error.exit())
}

/// Runs a command; returns the exit code.
fn run(command: Command) -> Result<u8, Box<dyn Error>> {
    match command {
        Command::Render(options) => render::run(&options)?,
        Command::View(options) => view::run(&options)?,
        Command::Compare(options) => compare::run(&options)?,
        Command::Chart(options) => return chart::run(&options, &command_line()),
        Command::List { file: Some(file), scene } => list::file(&file, scene.as_deref())?,
        Command::List { .. } => list::run()?,
    }
    Ok(0)
}

/// The command line, for the report.
fn command_line() -> String {
    let arguments = std::env::args_os().skip(1).map(|a| a.to_string_lossy().into_owned());
    let arguments = arguments.map(|a| if a.contains(' ') { format!("{a:?}") } else { a });
    std::iter::once("etendue".to_owned()).chain(arguments).collect::<Vec<_>>().join(" ")
}
