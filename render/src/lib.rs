//! A direct-lighting renderer: it reads scenes and writes images with their variance.
//!
//! Modules import one way, from the last line of this list to the first:
//!
//! - [`packet`], [`area`], [`geometry`], [`texture`], [`limits`], [`options`]: packets of eight numbers, rectangles of pixels, the forms
//!   of shapes, what varies over them, how large images can be, and what command lines share.
//! - [`sums`], [`film`], [`files`], [`image`], [`compare`]: sums of samples, pixels, and images in files.
//! - [`scene`]: scene files.
//! - [`bvh`], [`technique`], [`bsdf`], [`surfaces`]: what rays hit, and how it reflects.
//! - [`camera`], [`sensor`], [`sampler`], [`sky`], [`lights`]: the numbers and directions of a sample.
//! - [`certificates`]: what geometry alone tells about the light that reaches a surface.
//! - [`integrator`], [`claim`], [`progressive`]: images of a given number of samples, or of a given error or time, and what they
//!   claim of it.
//! - [`frame`], [`split`], [`parts`], [`merge`]: images whose parts are rendered apart.

pub mod area;
pub mod bsdf;
pub mod bvh;
pub mod camera;
pub mod certificates;
pub mod claim;
pub mod compare;
pub mod files;
pub mod film;
pub mod frame;
pub mod geometry;
pub mod image;
pub mod integrator;
pub mod intensity;
pub mod light_picture;
pub mod light_profile;
pub mod light_tree;
pub mod lights;
pub mod limits;
pub mod lobe;
pub mod merge;
pub mod options;
pub mod packet;
pub mod parts;
pub mod progressive;
pub mod sampler;
pub mod scene;
pub mod sensor;
pub mod sky;
pub mod split;
pub mod sums;
pub mod surfaces;
pub mod technique;
pub mod texture;

pub use claim::Claim;
pub use frame::Frame;
pub use integrator::{RayCount, Settings, View, World};
pub use sampler::Sampler;
pub use sensor::Sensor;
pub use technique::Technique;
