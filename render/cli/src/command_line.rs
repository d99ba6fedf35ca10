//! Commands as a shell takes them.

use std::ffi::OsStr;

/// A word of a command, for a POSIX shell, with whatever bytes names of files have.
fn quote(word: &OsStr) -> Vec<u8> {
    let bytes = word.as_encoded_bytes();
    let is_plain = |c: &u8| c.is_ascii_alphanumeric() || b"_-+=/.,:@%".contains(c);
    if !bytes.is_empty() && bytes.iter().all(is_plain) {
        return bytes.to_owned();
    }
    let quoted: Vec<&[u8]> = bytes.split(|c| *c == b'\'').collect();
    [b"'", &quoted.join(&br"'\''"[..])[..], b"'"].concat()
}

/// A command as a line without its end.
pub(crate) fn line(words: &[&dyn AsRef<OsStr>]) -> Vec<u8> {
    words.iter().map(|word| quote(word.as_ref())).collect::<Vec<_>>().join(&b' ')
}
