//! Reading and replacing files.

use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::{fmt, fs};

/// Why a file could not be read or written.
#[derive(Debug)]
pub struct FileError {
    path: PathBuf,
    what: String,
}

impl FileError {
    /// What is wrong with the file, without its path.
    pub fn what(&self) -> &str {
        &self.what
    }
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

/// Opens a regular file; refuses pipes and devices, which may block or never end.
pub fn open_file(path: &Path) -> io::Result<fs::File> {
    if !fs::metadata(path)?.is_file() {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "not a regular file"));
    }
    fs::File::open(path)
}

/// Reads a regular file; refuses pipes and devices, which may block or never end.
pub fn read_file(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open_file(path)?.read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Whether two paths lead to the same existing file, by whatever names or links.
#[must_use]
pub fn is_same(a: &Path, b: &Path) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        let number = |path| fs::metadata(path).map(|file: fs::Metadata| (file.dev(), file.ino()));
        if matches!((number(a), number(b)), (Ok(a), Ok(b)) if a == b) {
            return true;
        }
    }
    matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

/// What kind of file this is, for a message; `None` for a regular file.
fn kind(file: fs::FileType) -> Option<&'static str> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        if file.is_fifo() {
            return Some("a named pipe");
        } else if file.is_socket() {
            return Some("a socket");
        } else if file.is_char_device() || file.is_block_device() {
            return Some("a device; to discard an image, write it to a temporary file");
        }
    }
    if file.is_file() {
        None
    } else if file.is_dir() {
        Some("a folder")
    } else if file.is_symlink() {
        Some("a symbolic link; name the file that it leads to")
    } else {
        Some("not a regular file")
    }
}

/// Checks that [`replace`] can write a file: nothing has this name yet, or a regular file that is not read-only, and the folder takes
/// new files. A symbolic link is refused: it would be replaced, not followed.
///
/// # Errors
/// Fails if the file cannot be written, with the reason.
pub fn check_replaceable(path: &Path) -> Result<(), FileError> {
    let refused = |why: &dyn fmt::Display| failed(path, format!("cannot write: {why}"));
    let ends_in_separator = path.to_string_lossy().ends_with(std::path::is_separator);
    if path.file_name().is_none() || ends_in_separator || path.is_dir() {
        return Err(refused(&"this is a folder"));
    }
    match fs::symlink_metadata(path) {
        Ok(file) => {
            if let Some(kind) = kind(file.file_type()) {
                return Err(refused(&format!("this is {kind}")));
            }
            if file.permissions().readonly() {
                return Err(refused(&"this file is read-only"));
            }
        }
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            let folder = folder(path);
            if !folder.is_dir() {
                return Err(refused(&format!("the folder {} does not exist", folder.display())));
            }
        }
        Err(error) => return Err(refused(&error)),
    }
    let (part, _) = create_part(path).map_err(|error| refused(&error))?;
    fs::remove_file(part).map_err(|error| refused(&error))
}

/// Makes a folder, and those that it is in, unless they are there.
///
/// # Errors
/// Fails if the folder cannot be made, with the reason.
pub fn make_folder(path: &Path) -> Result<(), FileError> {
    if path.exists() && !path.is_dir() {
        return Err(failed(path, "cannot make this folder: a file has this name"));
    }
    fs::create_dir_all(path).map_err(|error| failed(path, format!("cannot make this folder: {error}")))
}

/// The folder that holds a file.
fn folder(path: &Path) -> &Path {
    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Creates a temporary file in the folder of `path`. Its name does not depend on that of `path`, which may be as long as names can be.
fn create_part(path: &Path) -> io::Result<(PathBuf, fs::File)> {
    let mut number = 0;
    loop {
        let part = path.with_file_name(format!(".etendue-{}-{number}.part", std::process::id()));
        match fs::File::create_new(&part) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => number += 1,
            created => return created.map(|file| (part, file)),
        }
    }
}

/// Replaces a file atomically: writes a temporary file beside it, then renames it. A file that existed keeps its permissions.
///
/// # Errors
/// Fails if the file cannot be written; an existing file then remains unchanged.
pub fn replace(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let cannot = |error: io::Error| failed(path, format!("cannot write: {error}"));
    if path.file_name().is_none() {
        return Err(failed(path, "not a file name"));
    }
    let (part, mut file) = create_part(path).map_err(cannot)?;
    let mut write = || -> io::Result<()> {
        // before the contents, which others may not be allowed to read
        if let Ok(old) = fs::metadata(path)
            && old.is_file()
        {
            file.set_permissions(old.permissions())?;
        }
        file.write_all(bytes)?;
        file.sync_all()?;
        fs::rename(&part, path)
    };
    write().map_err(|error| {
        // the error of the write says more than that of the clean-up
        let _ = fs::remove_file(&part);
        cannot(error)
    })
}
