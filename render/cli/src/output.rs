//! The files that `render` writes: their names, the checks before rendering, and their contents.

use crate::interrupt::Interrupt;
use etendue_render::film::Film;
use etendue_render::film::claim::Claim;
use etendue_render::scene::{Input, Scene};
use etendue_render::{Identity, film::files, film::image};
use std::ffi::OsStr;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::SystemTime;

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
    /// The EXR file as it was when this program last looked.
    known: Mutex<Option<Version>>,
}

/// When a file was written, and how long it is.
type Version = (SystemTime, u64);

fn version(path: &Path) -> Option<Version> {
    let file = path.metadata().ok()?;
    Some((file.modified().ok()?, file.len()))
}

/// The ends of the names of scenes.
const SCENES: [&str; 3] = ["pbrt", "gltf", "glb"];

/// Fails if a file that nobody named has an image of another scene than that at `path`, or none. Scenes of one name in a folder differ by
/// their contents; otherwise a scene may have changed since.
fn check_own(exr: &Path, scene: &Scene, path: &Path) -> Result<(), String> {
    if !exr.exists() {
        return Ok(());
    }
    let other = SCENES.iter().map(|end| path.with_extension(end)).find(|other| other != path && other.exists());
    let what = match (Identity::scene_of(exr), other) {
        (Some([_, digest]), _) if digest == scene.digest() => return Ok(()),
        (Some([name, _]), None) if name == scene.name => return Ok(()),
        (Some([name, _]), Some(other)) if name == scene.name => {
            format!("an image that may be of {} instead of {}", other.display(), path.display())
        }
        (Some([name, _]), _) => format!("an image of {name}"),
        (None, _) => "no image of this scene".to_owned(),
    };
    Err(format!("{}: this file has {what}, and is not replaced unasked: choose a name with -o", exr.display()))
}

impl Output {
    /// The files to write: those that the user asked for, or those that the scene's film asks for, or else one called as the scene is, whose
    /// name or path is this.
    ///
    /// # Errors
    /// Fails if the name does not end in `.exr`, if a file cannot be written, if the scene has been read from it, or if nobody named it and
    /// it has an image of another scene.
    pub(crate) fn new(asked: Option<&Path>, scene: &Scene, path: &Path) -> Result<Self, String> {
        match (asked, &scene.film.filename) {
            (Some(path), _) => Self::of(path.to_owned(), &scene.inputs),
            // scenes for other renderers often ask for other formats
            (None, Some(file)) if !file.is_empty() => Self::of(Path::new(file).with_extension("exr"), &scene.inputs)
                .map_err(|error| format!("{error}\nThe scene's film asks for {file:?}; -o chooses another file")),
            (None, _) => {
                let own = Self::of(named(path.file_stem().unwrap_or(path.as_os_str()), ".exr"), &scene.inputs)?;
                check_own(&own.exr, scene, path)?;
                Ok(own)
            }
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
        let known = Mutex::new(version(&exr));
        Ok(Self { exr, png, brightness: 1.0, known })
    }

    /// Files that do not exist yet, called `stem`, or that and a number.
    pub(crate) fn free(stem: &OsStr) -> Self {
        let with = |end: String| Self {
            exr: named(stem, &format!("{end}.exr")),
            png: named(stem, &format!("{end}.png")),
            brightness: 1.0,
            known: Mutex::new(None),
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
        identity.write_image(&self.exr, &film.pixels).map_err(|error| error.to_string())?;
        let factor = self.brightness / identity.exposure;
        let written = if factor == 1.0 {
            image::write_png(&self.png, film)
        } else {
            image::write_png(&self.png, &film.scaled(factor))
        };
        written.map_err(|error| format!("{error}; {} was written, but its PNG was not", self.exr.display()))
    }

    /// Like [`Output::write`]; an interruption meanwhile waits, and one after it says what the files hold. If another program has written the
    /// file since the last time, the image is written beside it.
    ///
    /// # Errors
    /// Fails if a file cannot be written, or if another program has written it; the message says what has been written.
    pub(crate) fn save(
        &self,
        interrupt: &Interrupt,
        film: &Film,
        identity: &Identity,
        error: Option<Claim>,
    ) -> Result<(), String> {
        let mut status = interrupt.lock();
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        // of two programs that end at the same time, one looks after the other has written; where folders cannot be locked, nearly always
        let folder = self.exr.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let folder = File::open(folder);
        let _locked = folder.as_ref().map(File::lock);
        if version(&self.exr) != *known {
            let other = self.beside("");
            other.write(film, identity)?;
            let exr = self.exr.display();
            return Err(format!(
                "{exr}: another program has written this file meanwhile: this image is in {}",
                other.both()
            ));
        }
        self.write(film, identity)?;
        *known = version(&self.exr);
        status.hold(self.holds(identity, error));
        Ok(())
    }

    /// New files beside these, with the same brightness.
    fn beside(&self, end: &str) -> Self {
        let mut stem = self.exr.with_extension("").into_os_string();
        stem.push(end);
        Self { brightness: self.brightness, ..Self::free(&stem) }
    }

    /// Writes what an interrupted rendering has to files of their own, and says so. Pixels may have any number of samples.
    ///
    /// # Errors
    /// Fails if a file cannot be written; the message says what has been written.
    pub(crate) fn save_part(&self, film: &Film, identity: &Identity) -> Result<String, String> {
        let mean = film.pixels.iter().map(|pixel| f64::from(pixel.samples)).sum::<f64>() / film.pixels.len() as f64;
        if mean == 0.0 {
            return Ok("no pixel was finished".to_owned());
        }
        let files = self.beside("-partial");
        files.write(film, identity)?;
        let has_black = film.pixels.iter().any(|pixel| pixel.samples == 0);
        let black = if has_black { ", and pixels without any are black" } else { "" };
        Ok(format!("{} have {mean:.1} samples per pixel{black}", files.both()))
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
