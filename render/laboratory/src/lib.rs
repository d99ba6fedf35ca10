//! Measures the renderer: the error of every technique against its time.
//!
//! - [`chart`]: error against time on scenes, as a report with charts.
//! - [`cost`]: time per sample, for the benchmarks.
//! - [`interrupt`]: what ends the program from outside.
//! - [`options`]: what command lines share.
//! - [`processor_time`]: the time that the processors spend for this program.

pub mod chart;
pub mod cost;
mod hash;
pub mod interrupt;
pub mod options;
pub mod processor_time;
pub mod progress;
