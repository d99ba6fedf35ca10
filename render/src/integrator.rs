//! Integrates direct light in packets: camera rays, light samples and shadow rays.

mod adaptive;
mod allocation;
mod analytic;
mod by_surface;
mod checks;
mod choice;
mod end;
mod exact;
mod fitted;
mod gather;
mod known;
mod paths;
mod prepared;
mod radiance;
mod settings;
mod specks;
mod tile;
mod trial;
mod view;
mod visible;
mod world;

pub use adaptive::{Allotment, Statistics};
pub use allocation::APART;
pub use known::Survey;
pub use settings::{RayCount, Settings};
pub use view::{Content, Samples, View};
pub use world::World;
