//! The files that `render` writes: their names, the checks before rendering, and their contents.

use crate::interrupt::Interrupt;
use etendue_render::film::Film;
use etendue_render::film::claim::Claim;
use etendue_render::scene::{Input, Scene};
use etendue_render::{Identity, drive::parts, film::files, film::image};
use std::ffi::OsStr;
use std::io;
use std::path::{Path, PathBuf};

/// The name of a file that is called after the scene.
pub(crate) fn named(stem: &OsStr, end: &str) -> PathBuf {
    let mut name = stem.to_owned();
    name.push(end);
    name.into()
}

/// The files of an image.
#[derive(Debug)]
pub(crate) struct Output {
    /// The EXR file.
    pub(crate) exr: PathBuf,
    /// The PNG file beside it.
    pub(crate) png: PathBuf,
    /// What the PNG is multiplied by.
    pub(crate) brightness: f64,
}

impl Output {
    /// The files to write: those that the user asked for, or those that the scene's film asks for, or else one called `stem`.
    ///
    /// # Errors
    /// Fails if the name does not end in `.exr`, if a file cannot be written, or if the scene has been read from it.
    pub(crate) fn new(asked: Option<&Path>, scene: &Scene, stem: &OsStr) -> Result<Self, String> {
        match (asked, &scene.film.filename) {
            (Some(path), _) => Self::of(path.to_owned(), &scene.inputs),
            // scenes for other renderers often ask for other formats
            (None, Some(file)) if !file.is_empty() => Self::of(Path::new(file).with_extension("exr"), &scene.inputs)
                .map_err(|error| format!("{error}\nThe scene's film asks for {file:?}; -o chooses another file")),
            (None, _) => Self::of(named(stem, ".exr"), &scene.inputs),
        }
    }

    /// The files to write for an image at this path, which is made from files that must stay as they are.
    ///
    /// # Errors
    /// Fails if the name does not end in `.exr`, if a file cannot be written, or if it is among `inputs`.
    pub(crate) fn of(exr: PathBuf, inputs: &[Input]) -> Result<Self, String> {
        let png = exr.with_extension("png");
        // what a device is matters more than how its name ends
        files::check_replaceable(&exr).map_err(|error| error.to_string())?;
        if !exr.extension().is_some_and(|e| e.eq_ignore_ascii_case("exr")) {
            return Err(format!(
                "--output {}: the name must end in .exr; the PNG is written beside the EXR file, under the same name",
                exr.display()
            ));
        }
        files::check_replaceable(&png).map_err(|error| error.to_string())?;
        for file in [&exr, &png] {
            if inputs.iter().any(|input| files::is_same(&input.path, file)) {
                let what =
                    if *file == exr { "the image".to_owned() } else { format!("the PNG beside {}", exr.display()) };
                let shown = file.display();
                return Err(format!(
                    "{shown}: the scene has been read from this file, so {what} cannot be written to it: choose another name with -o"
                ));
            }
        }
        Ok(Self { exr, png, brightness: 1.0 })
    }

    /// Files that do not exist yet, called `stem`, or that and a number.
    pub(crate) fn free(stem: &OsStr) -> Self {
        let with = |end: String| Self {
            exr: named(stem, &format!("{end}.exr")),
            png: named(stem, &format!("{end}.png")),
            brightness: 1.0,
        };
        let names = (2..).map(|n| with(format!("-{n}")));
        let mut all = std::iter::once(with(String::new())).chain(names);
        let found = all.find(|files| !files.exr.exists() && !files.png.exists());
        found.unwrap_or_else(|| unreachable!("there are more numbers than files"))
    }

    /// Both names, for a message.
    pub(crate) fn both(&self) -> String {
        format!("{} and {}", self.exr.display(), self.png.display())
    }

    /// An error after both files have been written.
    pub(crate) fn were_written(&self, error: &io::Error) -> io::Error {
        io::Error::new(error.kind(), format!("{error}; {} were written", self.both()))
    }

    /// Writes both files. The PNG is exposed so that its middle looks the same with every sensor.
    ///
    /// # Errors
    /// Fails if a file cannot be written; the message says what has been written.
    pub(crate) fn write(&self, film: &Film, identity: &Identity) -> Result<(), String> {
        parts::write_image(&self.exr, identity, film.pixels.clone()).map_err(|error| error.to_string())?;
        let factor = self.brightness / identity.exposure;
        let written = if factor == 1.0 {
            image::write_png(&self.png, film)
        } else {
            image::write_png(&self.png, &film.scaled(factor))
        };
        written.map_err(|error| format!("{error}; {} was written, but its PNG was not", self.exr.display()))
    }

    /// Like [`Output::write`]; an interruption meanwhile waits, and one after it says what the files hold.
    ///
    /// # Errors
    /// Fails if a file cannot be written; the message says what has been written.
    pub(crate) fn save(
        &self,
        interrupt: &Interrupt,
        film: &Film,
        identity: &Identity,
        error: Option<Claim>,
    ) -> Result<(), String> {
        let mut status = interrupt.lock();
        self.write(film, identity)?;
        status.text = self.holds(identity, error);
        status.last = None;
        Ok(())
    }

    /// What to say of the files.
    pub(crate) fn holds(&self, identity: &Identity, error: Option<Claim>) -> String {
        let spp = identity.settings.spp;
        let error = error.map_or_else(|| "not known".to_owned(), |claim| percent(claim.total()));
        format!("{} holds an image of {spp} samples per pixel, estimated error {error}", self.exr.display())
    }
}

/// A number with commas between groups of three digits.
pub(crate) fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// A fraction as a percentage with three digits.
pub(crate) fn percent(x: f64) -> String {
    let x = 100.0 * x;
    // 0 has no logarithm
    let digits = (2.0 - x.log10().floor()).clamp(0.0, 8.0) as usize;
    format!("{x:.digits$} %")
}
