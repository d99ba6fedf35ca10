//! Judges each sampler of a library in a process of its own, so that nothing that it does ends the judge.

use crate::foreign::load;
use crate::lights::measured::{Figure, Measured};
use crate::lights::scene::Axis;
use crate::lights::verdict::{Case, Effort, Finding, Judgement, judge};
use serde::{Deserialize, Serialize};
use std::env::current_exe;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// What a child does: the library, which of its samplers, and how thoroughly. It is the child's argument, as JSON.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Task {
    /// The library.
    pub library: PathBuf,
    /// Index of the sampler; all names are listed without one.
    pub sampler: Option<usize>,
    /// How much to do.
    pub effort: Effort,
    /// Where the answer goes.
    pub answer: PathBuf,
}
impl Task {
    /// Where the child says what it is about to ask.
    fn at(&self) -> PathBuf {
        self.answer.with_extension("at")
    }
    /// What it writes to standard error.
    fn errors(&self) -> PathBuf {
        self.answer.with_extension("errors")
    }
}

/// The names of all samplers, or a judgement, as the answer to a task in JSON.
///
/// # Errors
/// Fails if the library has no such samplers or the answer cannot be written.
pub fn work(task: &str) -> Result<(), String> {
    let task: Task = serde_json::from_str(task).map_err(|e| format!("a child has other arguments: {e}"))?;
    let subjects = load(&task.library)?;
    let answer = match task.sampler {
        None => serde_json::to_string(&subjects.iter().map(|s| &s.name).collect::<Vec<_>>()),
        Some(i) => {
            let subject = subjects.get(i).ok_or("the library has fewer samplers than before")?;
            // one write for each place
            let before = |light: &str| drop(fs::write(task.at(), light));
            serde_json::to_string(&judge(subject, task.effort, before))
        }
    };
    let answer = answer.map_err(|e| e.to_string())?;
    fs::write(&task.answer, answer).map_err(|e| format!("{}: {e}", task.answer.display()))
}

fn said(status: ExitStatus) -> String {
    #[cfg(unix)]
    if let Some(signal) = std::os::unix::process::ExitStatusExt::signal(&status) {
        let name = match signal {
            4 => " (illegal instruction)",
            6 => " (abort)",
            7 => " (bus error)",
            8 => " (arithmetic error)",
            11 => " (segmentation fault)",
            _ => "",
        };
        return format!("it ends the process by signal {signal}{name}");
    }
    format!("it ends the process with {status}")
}

/// Runs a child until it has said nothing new for so long. Returns what it answers, or how it crashed or hung.
fn run(task: &Task, limit: Duration) -> Result<Result<String, String>, String> {
    let program = current_exe().map_err(|e| e.to_string())?;
    // not a pipe, which a library that says much would fill
    let errors = fs::File::create(task.errors()).map_err(|e| e.to_string())?;
    let mut child = Command::new(program)
        .args(["child", &serde_json::to_string(task).map_err(|e| e.to_string())?])
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(errors)
        .spawn()
        .map_err(|e| format!("cannot start a process: {e}"))?;
    let mut heard = (String::new(), Instant::now());
    let status = loop {
        if let Some(status) = child.try_wait().map_err(|e| e.to_string())? {
            break status;
        }
        let now = fs::read_to_string(task.at()).unwrap_or_default();
        if now != heard.0 {
            heard = (now, Instant::now());
        } else if heard.1.elapsed() > limit {
            // what has ended meanwhile needs no end
            let _ = child.kill();
            let _ = child.wait();
            return Ok(Err(format!("it does not end within {} s", limit.as_secs())));
        }
        std::thread::sleep(Duration::from_millis(10));
    };
    if let Ok(answer) = fs::read_to_string(&task.answer) {
        return Ok(Ok(answer));
    }
    let errors = fs::read_to_string(task.errors()).unwrap_or_default();
    if status.code() == Some(2) {
        return Err(errors.trim().to_owned());
    }
    // what it said last is mostly why
    let last = errors.lines().rev().map(str::trim).find(|line| !line.is_empty());
    Ok(Err(last.map_or(said(status), |line| format!("{}, after the line \"{line}\"", said(status)))))
}

/// Judges all samplers of a library, or those whose name contains `only`.
///
/// # Errors
/// Fails if there is nothing to judge.
pub fn library(path: &Path, only: Option<&str>, effort: Effort, limit: Duration) -> Result<Vec<Judgement>, String> {
    let folder = std::env::temp_dir().join(format!("etendue-judge-{}", std::process::id()));
    fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let result = in_folder(path, only, effort, limit, &folder);
    let _ = fs::remove_dir_all(&folder);
    result
}
fn in_folder(
    path: &Path,
    only: Option<&str>,
    effort: Effort,
    limit: Duration,
    folder: &Path,
) -> Result<Vec<Judgement>, String> {
    let task = |sampler: Option<usize>| Task {
        library: path.into(),
        sampler,
        effort,
        answer: folder.join(sampler.map_or("list".into(), |i| format!("{i}.json"))),
    };
    let here = path.display();
    let names = run(&task(None), limit)?.map_err(|how| format!("{here}: when it is loaded, {how}"))?;
    let names: Vec<String> = serde_json::from_str(&names).map_err(|e| e.to_string())?;
    let mut all = Vec::new();
    for (i, name) in names.iter().enumerate().filter(|n| only.is_none_or(|only| n.1.contains(only))) {
        let task = task(Some(i));
        all.push(match run(&task, limit)? {
            Ok(judgement) => serde_json::from_str(&judgement).map_err(|e| format!("{name}: {e}"))?,
            Err(how) => unanswered(name, &how, &fs::read_to_string(task.at()).unwrap_or_default()),
        });
    }
    if all.is_empty() {
        let only = only.unwrap_or_default();
        return Err(format!("{here}: no sampler's name contains '{only}'; there are {}", names.join(", ")));
    }
    Ok(all)
}

/// A judgement of a sampler that ended the process or did not end.
fn unanswered(name: &str, how: &str, at: &str) -> Judgement {
    let figure = Figure::Answer;
    let shape = at.split(':').next().unwrap_or_default();
    let case = Case { axis: Axis::Ordinary, value: 1.0, figures: vec![Measured::unanswered(how)] };
    let finding = Finding { figure, value: 1.0, said: format!("{}: {how}", figure.said(1.0)), input: at.into() };
    Judgement::new(name, shape, "", vec![case], vec![finding])
}
