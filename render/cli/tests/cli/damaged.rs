//! Files of images and parts with damaged headers are refused with a message that says what is wrong.

use super::Folder;
use etendue_render::image::read_exr;
use etendue_render::parts::PieceFile;
use std::fs;
use std::path::Path;

/// Reads a file with one bit flipped in each of its first bytes, and with the fifth bit flipped, which in places of the file leads beyond what
/// systems allow. Every message must begin with the name of the file and say more than a number of an error.
fn flip(path: &Path, length: usize, read: impl Fn(&Path) -> Option<String>) {
    let bytes = fs::read(path).unwrap();
    assert!(bytes.len() > length, "{}", bytes.len());
    let mut refused = 0;
    for at in 0..length {
        for bit in [at % 8, 4] {
            let mut damaged = bytes.clone();
            damaged[at] ^= 1 << bit;
            fs::write(path, &damaged).unwrap();
            let Some(text) = read(path) else { continue };
            let what = text.strip_prefix(&format!("{}: ", path.display())).unwrap_or_default();
            assert!(
                what.len() > 10 && !what.contains("os error") && !what.contains("missing bytes"),
                "{at} {bit}: {text}"
            );
            refused += 1;
        }
    }
    println!("{}: {refused} of {} refused", path.display(), 2 * length);
    assert!(refused > length / 2);
}

#[test]
fn flipped_headers_are_explained() {
    let folder = Folder::new();
    folder.succeed(&["render", "quads", "--size", "9x7", "--spp", "4", "-o", "image.exr"]);
    let tile = ["--tile", "0,0,16,16", "-o", "part.exr"];
    folder.succeed(&[&["render", "quads", "--size", "32x16", "--spp", "8"], &tile[..]].concat());
    flip(&folder.path("image.exr"), 900, |path| read_exr(path).err().map(|error| error.to_string()));
    flip(&folder.path("part.exr"), 1000, |path| {
        let piece = PieceFile::open(path).and_then(|mut part| part.read());
        piece.err().map(|error| error.to_string())
    });
}
