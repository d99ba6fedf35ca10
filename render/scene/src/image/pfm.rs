//! Portable float maps: text that tells the size, then numbers in single precision, row by row from the bottom.

use etendue_render::film::files::{FileError, failed};
use etendue_render::film::image::check_size;
use std::path::Path;

/// An image: its width, its height, and its pixels, row by row from the top.
type Image = (usize, usize, Vec<[f32; 3]>);

/// Decodes the bytes of a file that messages call `path`; `None` if they are of another format.
pub(super) fn decode(path: &Path, bytes: &[u8]) -> Option<Result<Image, FileError>> {
    let channels = match bytes.get(..3)? {
        [b'P', b'F', c] if c.is_ascii_whitespace() => 3,
        [b'P', b'f', c] if c.is_ascii_whitespace() => 1,
        _ => return None,
    };
    Some(decode_channels(path, &bytes[2..], channels))
}

fn decode_channels(path: &Path, bytes: &[u8], channels: usize) -> Result<Image, FileError> {
    let mut at = 0;
    let mut word = || {
        let is_space = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_whitespace);
        while is_space(at) {
            at += 1;
        }
        let start = at;
        while at < bytes.len() && !is_space(at) {
            at += 1;
        }
        std::str::from_utf8(&bytes[start..at]).unwrap_or("")
    };
    let [width, height, scale] = [word(), word(), word()];
    let wrong = |what: &str, found: &str| failed(path, format!("a PFM image whose {what} is {:?}", shown(found)));
    let side = |what: &str, text: &str| text.parse::<u32>().map_err(|_| wrong(what, text));
    let [width, height] = [side("width", width)?, side("height", height)?];
    // the sign of the scale tells the order of bytes
    let factor: f32 = scale.parse().map_err(|_| wrong("scale", scale))?;
    if !(factor.is_finite() && factor != 0.0) {
        return Err(wrong("scale", scale));
    }
    check_size(path, [width.into(), height.into()], 32 * channels as u128, bytes.len())?;
    let [width, height] = [width as usize, height as usize];
    // one space after the scale
    let data = bytes.get(at + 1..).unwrap_or_default();
    let wanted = 4 * channels * width * height;
    let Some(data) = data.get(..wanted) else {
        return Err(failed(path, format!("a PFM image of {} bytes instead of {wanted}", data.len())));
    };
    let number = |b: &[u8]| {
        let b = [b[0], b[1], b[2], b[3]];
        if factor < 0.0 { f32::from_le_bytes(b) } else { f32::from_be_bytes(b) }
    };
    let pixel = |p: &[u8]| {
        let channel = |k: usize| factor.abs() * number(&p[4 * k.min(channels - 1)..]);
        [channel(0), channel(1), channel(2)]
    };
    let rows = data.chunks_exact(4 * channels * width).rev();
    let radiance = rows.flat_map(|row| row.chunks_exact(4 * channels).map(pixel)).collect();
    Ok((width, height, radiance))
}

/// The beginning of a word.
fn shown(word: &str) -> String {
    word.chars().take(20).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(header: &str, numbers: &[f32], little: bool) -> Vec<u8> {
        let bytes = numbers.iter().flat_map(|x| if little { x.to_le_bytes() } else { x.to_be_bytes() });
        header.bytes().chain(bytes).collect()
    }

    #[test]
    fn rows_begin_at_the_bottom_in_either_order_of_bytes() {
        let numbers: Vec<f32> = (0..12).map(|x| x as f32).collect();
        for (header, little, factor) in [("PF\n2 2\n-1.0\n", true, 1.0), ("PF 2 2 2\n", false, 2.0)] {
            let picture = decode(Path::new("a.pfm"), &file(header, &numbers, little)).unwrap().unwrap();
            let wanted = [[6.0, 7.0, 8.0], [9.0, 10.0, 11.0], [0.0, 1.0, 2.0], [3.0, 4.0, 5.0]];
            assert_eq!((picture.0, picture.1), (2, 2));
            assert_eq!(picture.2, wanted.map(|rgb: [f32; 3]| rgb.map(|x| factor * x)));
        }
        let grey = decode(Path::new("a.pfm"), &file("Pf\n1 2\n-1\n", &[3.0, 4.0], true)).unwrap().unwrap();
        assert_eq!(grey.2, [[4.0; 3], [3.0; 3]]);
        assert!(decode(Path::new("a.pfm"), b"P6 1 1 255\n").is_none());
    }

    #[test]
    fn damaged_files_are_refused() {
        let wrong = |bytes: &[u8]| decode(Path::new("a.pfm"), bytes).unwrap().err().unwrap().to_string();
        for (header, what) in [
            ("PF\n-2 2\n-1\n", "width is \"-2\""),
            ("PF\n2 x\n-1\n", "height is \"x\""),
            ("PF\n2 2\n0\n", "scale is \"0\""),
            ("PF\n2 2\nnan\n", "scale is \"nan\""),
            ("PF\n0 2\n1\n", "empty"),
            ("PF\n2 2\n1\n", "of 0 bytes instead of 48"),
            ("PF\n60000 60000\n1\n", "pixels"),
            ("PF\n", "width is \"\""),
        ] {
            let message = wrong(header.as_bytes());
            assert!(message.contains(what), "{header:?}: {message}");
        }
    }
}
