//! The results of all measurements.

use super::clock::Clock;
use super::measure::{Plan, Rows};
use super::summary::Summary;

/// Everything a report is made of.
#[derive(Debug)]
pub struct Outcome {
    /// The planned measurements.
    pub plan: Plan,
    /// The finished measurements.
    pub rows: Rows,
    /// Which time counts.
    pub clock: Clock,
    /// One summary per scene.
    pub summaries: Vec<Summary>,
    /// Names and values of the circumstances that the measurements depend on, such as the machine.
    pub facts: Vec<(&'static str, String)>,
    /// Warnings and remarks for the reader.
    pub notes: Vec<String>,
}
