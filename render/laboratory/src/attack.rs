//! Attacks the renderer with random scenes: renders each by several techniques and by the oracle, and shrinks those on which they differ.
//!
//! [`regimes`] has the scenes, [`draft`] their parts, `draft_text` their text, [`skin`] what varies over them, [`bridge`] what the oracle
//! gets of them, [`judge`] the comparison, [`shrink`] the fewest parts that still differ, [`report`] what is printed, [`claims`] whether
//! images tell their error, and [`defects`] the scenes on which the renderer was wrong once. What the parameters of lights mean is in the
//! table of values of the renderer's tests.

pub mod bridge;
mod build;
pub mod claims;
pub mod defects;
pub mod draft;
mod draft_text;
pub mod judge;
pub mod regimes;
pub mod report;
pub mod shrink;
pub mod skin;
