//! Images: sums of samples, pixels, and files of them.

pub mod claim;
#[cfg(feature = "exr")]
pub mod compare;
pub mod files;
#[cfg(feature = "exr")]
pub mod filtered;
#[cfg(feature = "exr")]
pub mod image;
mod pixels;
pub mod sensor;
pub mod sums;

pub use pixels::{Accumulator, Film, Pixel, PixelSum, Second, channels};
