//! Renders images: which samples each pixel takes, in tiles, and what is known of their error.
//!
//! With the sampler `adaptive`, the pixels share the samples of an image among themselves. For example, 64 samples per pixel of an image of
//! 1024 × 1024 pixels are 8 packets of 8 for each pixel on average:
//!
//! 1. *Second sets* take a 48th of the samples of the others, so that 8 · 48/49 = 7.84 packets remain (`second_sets`).
//! 2. The *pilot* takes 2 packets in every pixel, a quarter of them rounded to a power of two. They are part of the image, and tell its
//!    variance (`pixel_statistics`). Where 9 to 32 lights shine, it is as large as their allocation needs, up to a third of all samples.
//!    Eight samples are a pilot alone, so an eighth more follows.
//! 3. `pixel_counts` looks at the mean variance *around* each pixel. If it is 0.01 in one half of the image and 1 in the other, the numbers
//!    of packets are to be as 0.01^0.4 to 1, at least those of the pilot, and 7.84 on average: 2.1 and 13.5. Powers of two at random have
//!    these means: 2 or, rarely, 4 packets in the dark half, 8 or 16 in the other one.
//! 4. Where few lights shine, the packets of a pixel are *allocated* to them instead of choosing lights at random. For the pilot, weights are
//!    what each light can contribute at the pixel's corners (`corners`); then, what the pilot tells of its variance around the pixel
//!    (`light_weights`).
//! 5. Where outlines of lights in view are most of the variance, further rays only look at these: 8 of them take the time of 3 samples
//!    (`pixel_counts`).
//! 6. The second set of some pixels is rendered: as many samples once more, which are no part of the image. Its squared differences from the
//!    first set tell by what factor the variance of all pixels of a tile differs from what the spread of their samples lets expect.
//!
//! An image of a given error repeats this in passes, each of up to eight times as many samples, and one of a given time has a pass that fills
//! it: how many samples that takes is decided after its pilot ([`progressive`]).

mod auto;
mod corners;
#[cfg(feature = "exr")]
pub mod identity;
mod light_weights;
mod pixel_counts;
mod pixel_statistics;
pub mod progressive;
mod radiance;
mod runs;
mod second_sets;
mod specks;
mod tile;
mod view;
mod world;

pub use auto::{AutoTrial, TechniqueChoice};
pub use view::{Listener, View};
pub use world::World;
