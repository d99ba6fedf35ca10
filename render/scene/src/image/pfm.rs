//! Portable float maps: text that tells the size, then numbers in single precision, row by row from the bottom.

use crate::message::shortened;
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
    let wrong = |what: &str, found: &str| failed(path, format!("a PFM image whose {what} is {:?}", shortened(found)));
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
