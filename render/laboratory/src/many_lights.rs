//! Choices among many lights: their variance, their time, and how their importance fails.
//!
//! [`published`] has the tree of the literature that the library's tree is compared with, [`stage`] the scenes and the points that their
//! cameras see, [`moments`] the variance of one sample without the noise of the choice, [`time`] the time of each part of a sample,
//! [`scaling`] sets of any number of lights, and [`nodes`] what the importance of a node is worth.

pub mod moments;
pub mod nodes;
pub mod published;
pub mod scaling;
pub mod stage;
pub mod time;
