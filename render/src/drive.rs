//! Renders images: which samples each pixel takes, in tiles, and what is known of their error.

mod adaptive;
mod after_pilot;
mod allocation;
mod corners;
mod estimator;
mod radiance;
mod runs;
mod second_sets;
mod specks;
mod tile;
mod view;
mod world;

pub use adaptive::{Allotment, Statistics};
pub use allocation::APART;
pub use view::{Content, Samples, View};
pub use world::World;
