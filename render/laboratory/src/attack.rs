//! Attacks the renderer with random scenes: renders each by several techniques and by the oracle, and shrinks those on which they differ.
//!
//! [`regimes`] has the scenes, [`draft`] their parts, `draft_text` their text, [`skin`] what varies over them, `meaning` what they mean, [`bridge`] what
//! the oracle gets of them, [`judge`] the comparison,
//! [`shrink`] the fewest parts that still differ, [`report`] what is printed, [`claims`] whether images tell their error,
//! [`choice`] how well kinds of lights are chosen, and [`defects`] the scenes on which the renderer was wrong once.

pub mod bridge;
mod build;
pub mod choice;
pub mod claims;
pub mod defects;
pub mod draft;
mod draft_text;
pub mod judge;
mod meaning;
pub mod regimes;
pub mod report;
pub mod shrink;
pub mod skin;
