//! `etendue-judge`: judges samplers of lights. The exit code is 0 if all are right, 1 if one is wrong, and 2 if there is nothing to judge.

use clap::{Args, Parser, Subcommand};
use etendue_judge::child;
use etendue_judge::lights::sampler::{Lacks, own};
use etendue_judge::lights::verdict::{Effort, Judgement, judge};
use etendue_judge::{numbers, page, proofs, textbook};
use std::io::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

/// Judges samplers of lights: anybody's.
#[derive(Parser)]
#[command(version)]
struct Options {
    #[command(subcommand)]
    command: Command,
}
#[derive(Subcommand)]
enum Command {
    /// Judges the samplers of shared libraries (tests/judge/include/etendue_judge.h)
    Run {
        /// Libraries
        #[arg(required = true)]
        libraries: Vec<PathBuf>,
        /// Judges those whose name contains this text
        #[arg(long)]
        only: Option<String>,
        /// Seconds after which a sampler that does not answer is given up
        #[arg(long, default_value_t = 30)]
        limit: u64,
        #[command(flatten)]
        how: How,
    },
    /// Judges this project's techniques, and its proofs of visibility
    Own {
        /// Judges textbooks' samplers too
        #[arg(long)]
        textbooks: bool,
        /// Judges this many times, with other positions each time, and prints how many find something
        #[arg(long, default_value_t = 0)]
        judgements: u64,
        #[command(flatten)]
        how: How,
    },
    /// Writes what a sampler is asked as files of numbers, for what is not called from here
    Ask {
        /// Folder for the files
        folder: PathBuf,
        /// sphere, triangle, rectangle, parallelogram or disk
        #[arg(long)]
        shape: String,
        /// solid angle, projected solid angle, area or other
        #[arg(long, default_value = "other")]
        measure: String,
        /// A name for tables
        #[arg(long, default_value = "sampler")]
        name: String,
        /// The sampler has no map: numbers are what its generator starts from
        #[arg(long)]
        generator: bool,
        /// The sampler evaluates no densities, but of its samples
        #[arg(long)]
        no_pdf: bool,
        #[command(flatten)]
        tried: Tried,
    },
    /// Judges the answers that are in such folders
    Numbers {
        /// Folders
        #[arg(required = true)]
        folders: Vec<PathBuf>,
        #[command(flatten)]
        how: How,
    },
}
#[derive(Args)]
struct Tried {
    /// Tries half of the places with a quarter of the samples
    #[arg(long)]
    quick: bool,
    /// Decides positions and random numbers
    #[arg(long, default_value_t = 1)]
    seed: u64,
}
#[derive(Args)]
struct How {
    /// Writes JSON instead of text
    #[arg(long)]
    json: bool,
    /// Writes a page, with maps and times
    #[arg(long)]
    page: Option<PathBuf>,
    #[command(flatten)]
    tried: Tried,
}
impl How {
    fn effort(&self) -> Effort {
        Effort { quick: self.tried.quick, seed: self.tried.seed, page: self.page.is_some() }
    }
    /// Writes verdicts, and returns whether all are right.
    fn tell(&self, all: &[Judgement]) -> Result<bool, String> {
        if let Some(path) = &self.page {
            std::fs::write(path, page::html(all)).map_err(|e| format!("{}: {e}", path.display()))?;
        }
        let text = if self.json { page::json(all) + "\n" } else { page::text(all) + "\n" + &page::table(all) };
        // a pipe that closes early has read enough
        let _ = std::io::stdout().write_all(text.as_bytes());
        Ok(all.iter().all(Judgement::is_right))
    }
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let done = match &arguments[..] {
        [first, task] if first == "child" => child::work(task).map(|()| true),
        _ => run(&Options::parse()),
    };
    match done {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(message) => {
            eprintln!("{message}");
            ExitCode::from(2)
        }
    }
}

fn run(options: &Options) -> Result<bool, String> {
    match &options.command {
        Command::Run { libraries, only, limit, how } => {
            let mut all = Vec::new();
            for library in libraries {
                let limit = Duration::from_secs(*limit);
                all.extend(child::library(library, only.as_deref(), how.effort(), limit)?);
            }
            how.tell(&all)
        }
        Command::Own { judgements, how, .. } if *judgements > 0 => Ok(false_alarms(*judgements, how)),
        Command::Own { textbooks, how, .. } => {
            let subjects = own().into_iter().chain(if *textbooks { textbook::samplers() } else { Vec::new() });
            let mut all: Vec<_> = subjects.map(|subject| judge(&subject, how.effort(), |_| ())).collect();
            let rooms = if how.tried.quick { 1000 } else { 4000 };
            all.push(proofs::judge("etendue-visible", &proofs::own, rooms, how.tried.seed));
            how.tell(&all)
        }
        Command::Ask { folder, shape, measure, name, generator, no_pdf, tried } => {
            let mut asked = numbers::Asked::new(name, shape, measure, tried.quick, tried.seed)?;
            asked.lacks = Lacks { map: *generator, pdf: *no_pdf };
            numbers::ask(folder, &asked).map(|()| true)
        }
        Command::Numbers { folders, how } => {
            let all: Result<Vec<_>, _> = folders.iter().map(|folder| numbers::judge(folder)).collect();
            how.tell(&all?)
        }
    }
}

/// Judges right samplers over and over, and prints how many judgements find something.
fn false_alarms(judgements: u64, how: &How) -> bool {
    let subjects = own();
    let (mut false_ones, mut seconds) = (0_u64, 0.0);
    for i in 0..judgements {
        let subject = &subjects[(i % subjects.len() as u64) as usize];
        let seed = how.tried.seed + i / subjects.len() as u64;
        let judgement = judge(subject, Effort { seed, page: false, ..how.effort() }, |_| ());
        seconds += judgement.seconds;
        if !judgement.is_right() {
            false_ones += 1;
            print!("seed {seed}: {}", page::text(&[judgement]));
        }
    }
    println!("{false_ones} of {judgements} judgements find something; {:.2} s each", seconds / judgements as f64);
    false_ones * 1000 < judgements
}
