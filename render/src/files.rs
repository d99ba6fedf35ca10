//! Reading and replacing files.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::{fmt, fs};

/// Why a file could not be read or written.
#[derive(Debug)]
pub struct FileError {
    path: PathBuf,
    what: String,
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.path.display(), self.what)
    }
}

impl std::error::Error for FileError {}

/// The error that a file is not as it should be.
pub fn failed(path: &Path, what: impl fmt::Display) -> FileError {
    FileError { path: path.to_owned(), what: what.to_string() }
}

/// Reads a regular file; refuses pipes and devices, which may block or never end.
pub fn read_file(path: &Path) -> io::Result<Vec<u8>> {
    if !fs::metadata(path)?.is_file() {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "not a regular file"));
    }
    fs::read(path)
}

/// Replaces a file atomically: writes a temporary file beside it, then renames it.
///
/// # Errors
/// Fails if the file cannot be written; an existing file then remains unchanged.
pub fn replace(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let mut name = path.file_name().ok_or_else(|| failed(path, "not a file name"))?.to_owned();
    name.push(format!(".{}.part", std::process::id()));
    let part = path.with_file_name(name);
    let write = || -> io::Result<()> {
        let mut file = fs::File::create(&part)?;
        file.write_all(bytes)?;
        file.sync_all()?;
        fs::rename(&part, path)
    };
    write().map_err(|error| {
        // the error of the write says more than that of the clean-up
        let _ = fs::remove_file(&part);
        failed(path, format!("cannot write: {error}"))
    })
}
