//! Finds and reads the files that a scene file names.

use super::builtin::BUILTIN_IMAGES;
use crate::files::{note, read_unpacked};
use crate::image;
use etendue_render::film::files::{FileError, failed, read_file};
use etendue_render::film::image::Picture;
use etendue_render::scene::Input;
use std::cell::RefCell;
use std::io;
use std::path::{Path, PathBuf};

/// Finds and reads the files that a scene file names, and notes what it has read.
#[derive(Clone, Copy)]
pub(super) struct Files<'a> {
    /// The folder of the main file, and that of the file that names others.
    pub(super) main: &'a Path,
    pub(super) folder: &'a Path,
    pub(super) is_builtin: bool,
    pub(super) inputs: &'a RefCell<Vec<Input>>,
}

impl<'a> Files<'a> {
    /// The same for the files that one in this folder names.
    pub(super) fn at<'b>(self, folder: &'b Path) -> Files<'b>
    where
        'a: 'b,
    {
        Files { folder, ..self }
    }
    /// Resolves a name relative to the file that names it, else relative to the main file, as in pbrt.
    pub(super) fn find(&self, name: &str) -> PathBuf {
        let (near, far) = (self.folder.join(name), self.main.join(name));
        if !near.exists() && far.exists() { far } else { near }
    }
    fn noted(&self, path: &Path, bytes: Vec<u8>) -> Vec<u8> {
        note(&mut self.inputs.borrow_mut(), path, &bytes);
        bytes
    }
    /// Reads a file that was found.
    pub(super) fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        Ok(self.noted(path, read_file(path)?))
    }
    /// Reads a file that was found, which may be compressed by gzip.
    pub(super) fn read_unpacked(&self, path: &Path) -> io::Result<Vec<u8>> {
        Ok(self.noted(path, read_unpacked(path)?))
    }
    /// Reads the image with this name.
    pub(super) fn image(&self, name: &str) -> Result<Picture, FileError> {
        if let Some((_, bytes)) = BUILTIN_IMAGES.iter().find(|(known, _)| self.is_builtin && *known == name) {
            return image::decode(Path::new(name), bytes);
        }
        let path = self.find(name);
        let bytes = self.read(&path).map_err(|error| failed(&path, format!("cannot read: {error}")))?;
        image::decode(&path, &bytes)
    }
}
