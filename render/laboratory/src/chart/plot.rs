//! Draws charts as SVG.
//!
//! Each series is a separate group (`<g data-series="…">`), so that a page can switch it on and off.

mod axis;
mod drawing;
mod lines;
mod text;

pub use axis::{Bar, Scale};
pub use drawing::{Drawing, color, dash};
pub use lines::{Chart, Dot, Line};
pub use text::{escape, short};
