//! A direct-lighting renderer that measures light sampling techniques: it reads scenes and writes images with their variance.

pub mod accel;
pub mod atlas;
pub mod camera;
pub mod chart;
pub mod compare;
pub mod figure;
pub mod film;
pub mod image;
pub mod integrator;
pub mod lens;
pub mod lights;
pub mod sampler;
pub mod scene;
pub mod selftest;
pub mod sensor;
pub mod sky;
pub mod vignetting;

pub use integrator::{RayCount, Settings, World};
pub use lights::Technique;
pub use sampler::Sampler;
pub use sensor::Sensor;
