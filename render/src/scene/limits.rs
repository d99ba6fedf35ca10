//! How large images can be, wherever they come from: options, scene files, and files of images.

/// Most samples per pixel: 2²².
pub const MOST_SAMPLES: u32 = 1 << 22;
/// Most pixels of an image: 2²⁸.
pub const MOST_PIXELS: u64 = 1 << 28;
/// Most pixels across, and down.
pub const MOST_SIDE: u32 = 65_536;

/// Greatest radiance: eight samples are added in single precision, which ends at 3.4e38.
pub const MOST_RADIANCE: f32 = 4e37;

/// Whether an image can have this size.
#[must_use]
pub fn is_size(width: u64, height: u64) -> bool {
    let sides = 1..=u64::from(MOST_SIDE);
    sides.contains(&width) && sides.contains(&height) && width * height <= MOST_PIXELS
}
