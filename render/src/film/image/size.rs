//! How large an image in a file can be.

use crate::film::files::{FileError, failed};
use crate::scene::limits::MOST_PIXELS;
use std::path::Path;

/// Greatest plausible ratio of decoded to encoded bytes: deflate, the densest compression in use, reaches 1,032.
const MOST_EXPANSION: u128 = 2048;

/// Checks that an image is not empty, and that a file of this length can hold it, before memory is allocated: a header may claim any
/// size.
///
/// # Errors
/// Fails if the image is empty or has more than 2²⁸ pixels, or if the file is too short for it.
pub fn check_size(path: &Path, [width, height]: [u128; 2], bits_per_pixel: u128, file: usize) -> Result<(), FileError> {
    let pixels = width.saturating_mul(height);
    if pixels == 0 {
        return Err(failed(path, format!("the image is empty: {width} × {height} pixels")));
    }
    if pixels > u128::from(MOST_PIXELS) {
        return Err(failed(path, format!("{width} × {height} pixels: at most {MOST_PIXELS} are supported")));
    }
    let bytes = pixels.saturating_mul(bits_per_pixel) / 8;
    if bytes / MOST_EXPANSION > file as u128 {
        let what = format!("damaged: {width} × {height} pixels, {bytes} bytes, do not fit into a file of {file} bytes");
        return Err(failed(path, what));
    }
    Ok(())
}
