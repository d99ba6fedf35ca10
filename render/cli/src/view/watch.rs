//! Which files of a scene have changed since it was read.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// What tells one version of a file from another: the time of its last change, and its size in bytes.
type Stamp = Option<(SystemTime, u64)>;

fn stamp(path: &Path) -> Stamp {
    let file = fs::metadata(path).ok()?;
    Some((file.modified().ok()?, file.len()))
}

/// The files of a scene as they were when it was read.
#[derive(Debug, Default)]
pub(crate) struct Watch(Vec<(PathBuf, Stamp)>);

impl Watch {
    /// Files that were read from this time on. One that has changed since then may not be the one that was read.
    pub(crate) fn new<'a>(files: impl Iterator<Item = &'a Path>, began: SystemTime) -> Self {
        let of = |path: &Path| (path.to_owned(), stamp(path).filter(|(changed, _)| *changed < began));
        Self(files.map(of).collect())
    }

    /// A file that has changed. One that is gone for now is often about to be written anew.
    pub(crate) fn changed(&self) -> Option<&Path> {
        let is_other = |path: &Path, before: &Stamp| stamp(path).is_some_and(|now| Some(now) != *before);
        self.0.iter().find(|(path, before)| is_other(path, before)).map(|(path, _)| path.as_path())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn a_change_is_found() {
        let path = std::env::temp_dir().join(format!("etendue-watch-{}", std::process::id()));
        fs::write(&path, "one").unwrap();
        let long_ago = SystemTime::now() - Duration::from_secs(60);
        assert!(Watch::new(std::iter::once(&*path), long_ago).changed().is_some(), "it changed while it was read");
        let watch = Watch::new(std::iter::once(&*path), SystemTime::now() + Duration::from_secs(60));
        assert_eq!(watch.changed(), None);
        fs::write(&path, "three").unwrap();
        assert_eq!(watch.changed(), Some(path.as_path()));
        fs::remove_file(&path).unwrap();
        assert_eq!(watch.changed(), None);
    }
}
