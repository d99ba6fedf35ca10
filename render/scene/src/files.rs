//! Files that may be compressed, and what was read of them.

use etendue_render::film::files::read_file;
use etendue_render::scene::Input;
use std::io::{self, Read};
use std::path::Path;

/// Greatest size of a file that was compressed by gzip, in bytes: a few bytes may stand for any number.
const MOST_UNPACKED: u64 = 1 << 34;

/// Like [`read_file`]; unpacks files that gzip has compressed, whatever their names.
pub(super) fn read_unpacked(path: &Path) -> io::Result<Vec<u8>> {
    let bytes = read_file(path)?;
    if !bytes.starts_with(&[0x1f, 0x8b]) {
        return Ok(bytes);
    }
    let damaged = |error: io::Error| io::Error::new(error.kind(), format!("damaged by its gzip compression: {error}"));
    let mut unpacked = Vec::new();
    let mut reader = flate2::read::MultiGzDecoder::new(&bytes[..]).take(MOST_UNPACKED + 1);
    reader.read_to_end(&mut unpacked).map_err(damaged)?;
    if unpacked.len() as u64 > MOST_UNPACKED {
        return Err(io::Error::other("more than 16 GiB when it is unpacked"));
    }
    Ok(unpacked)
}

/// Adds a file that was read, unless it is known.
pub(super) fn note(inputs: &mut Vec<Input>, path: &Path, bytes: &[u8]) {
    let input = Input::new(path, bytes);
    if !inputs.contains(&input) {
        inputs.push(input);
    }
}
