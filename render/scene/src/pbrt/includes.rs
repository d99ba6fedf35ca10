//! The files of a scene that are being read, each included by a line of the one before.

use super::inputs::Files;
use crate::message::Place;
use etendue_render::film::files::is_same;
use etendue_render::scene::Message;
use std::path::{Path, PathBuf};

/// Greatest depth of nested `Include`s, and greatest number of included files.
const DEEPEST: usize = 32;
const MOST: usize = 4096;

/// Where the text of a scene comes from.
#[derive(Clone, Copy, Debug)]
pub(super) enum Origin<'a> {
    /// From the program.
    Builtin,
    /// From this file.
    File(&'a Path),
    /// From elsewhere.
    Text,
}

/// The files that are being read.
#[derive(Debug)]
pub(super) struct Includes {
    main: Option<PathBuf>,
    /// The included files, and the lines that include them.
    open: Vec<(Place, PathBuf)>,
    count: usize,
}

impl Includes {
    /// Only the main file is being read.
    pub(super) fn new(origin: Origin<'_>) -> Self {
        let main = if let Origin::File(path) = origin { Some(path.to_owned()) } else { None };
        Self { main, open: Vec::new(), count: 0 }
    }

    /// Reads the file that the line at `place` includes.
    pub(super) fn open(&mut self, place: &Place, path: &Path, files: &Files<'_>) -> Result<Vec<u8>, Message> {
        let shown = path.display().to_string();
        self.open.push((place.clone(), path.to_owned()));
        self.count += 1;
        if let Some(start) = self.start_of_cycle(path) {
            let step = |(place, path): &(Place, PathBuf)| {
                format!("{}:{} includes {:?}", place.file, place.line, path.display().to_string())
            };
            let steps: Vec<_> = self.open[start..].iter().map(step).collect();
            return Err(place.message(format!("Include {shown:?}: the file includes itself: {}", steps.join(", "))));
        }
        if self.open.len() > DEEPEST {
            return Err(place.message(format!("Include {shown:?}: more than {DEEPEST} files deep")));
        }
        if self.count > MOST {
            return Err(place.message(format!("Include {shown:?}: more than {MOST} files in all")));
        }
        files.read_unpacked(path).map_err(|error| place.message(format!("Include: cannot read {shown:?}: {error}")))
    }

    /// Ends the file that was opened last.
    pub(super) fn close(&mut self) {
        self.open.pop();
    }

    /// The first of the lines that lead from a file back to itself, if the last one does.
    fn start_of_cycle(&self, path: &Path) -> Option<usize> {
        if self.main.as_ref().is_some_and(|main| is_same(main, path)) {
            return Some(0);
        }
        let before = &self.open[..self.open.len() - 1];
        before.iter().position(|(_, other)| is_same(other, path)).map(|at| at + 1)
    }
}
