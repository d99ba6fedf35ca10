//! A direct-lighting renderer: it reads scenes and writes images with their variance.
//!
//! Modules import one way, from the last line of this list to the first:
//!
//! - [`packet`], [`area`], [`geometry`], [`texture`], [`limits`], [`options`]: packets of eight numbers, rectangles of pixels, the forms
//!   of shapes, what varies over them, how large images can be, and what command lines share.
//! - [`sums`], [`film`], [`files`], [`image`], [`compare`]: sums of samples, pixels, and images in files.
//! - [`scene`]: scene files.
//! - [`bvh`], [`technique`], [`bsdf`], [`surfaces`]: what rays hit, and how it reflects.
//! - [`camera`], [`sensor`], [`sampler`], [`sky`], [`lights`], [`choose`]: the numbers and directions of a sample.
//! - `paths`, `estimate`: camera rays to shading points, and the light that these reflect.
//! - [`certify`]: what geometry alone tells about that light, and closed forms of it.
//! - [`drive`], [`claim`], [`progressive`]: images of a given number of samples, or of a given error or time, and what they
//!   claim of it.
//! - [`identity`], [`split`], [`parts`], [`merge`]: what an image depends on, and images whose parts are rendered apart.

pub mod area;
pub mod bsdf;
pub mod bvh;
pub mod camera;
pub mod certify;
pub mod choose;
pub mod claim;
pub mod compare;
pub mod drive;
mod estimate;
pub mod files;
pub mod film;
pub mod geometry;
pub mod identity;
pub mod image;
pub mod intensity;
pub mod light_picture;
pub mod light_profile;
mod light_tree;
pub mod lights;
pub mod limits;
pub mod lobe;
pub mod merge;
pub mod options;
pub mod packet;
pub mod parts;
mod paths;
mod prepared;
pub mod progressive;
pub mod sampler;
pub mod scene;
pub mod sensor;
pub mod settings;
pub mod sky;
pub mod split;
pub mod sums;
pub mod surfaces;
pub mod technique;
pub mod texture;

pub use choose::ChoiceBy;
pub use claim::Claim;
pub use drive::{View, World};
pub use estimate::RayCount;
pub use identity::Identity;
pub use sampler::Sampler;
pub use sensor::Sensor;
pub use settings::Settings;
pub use technique::Technique;
