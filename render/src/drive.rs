//! Renders images: which samples each pixel takes, in tiles, and what is known of their error.

mod adaptive;
mod allocation;
mod checks;
mod corners;
mod estimator;
mod radiance;
mod rest;
mod runs;
mod specks;
mod tile;
mod view;
mod world;

pub use adaptive::{Allotment, Statistics};
pub use allocation::APART;
pub use view::{Content, Samples, View};
pub use world::World;
