//! A direct-lighting renderer: it renders scenes to images with their variance.
//!
//! A floor under a square light, seen from above:
//!
//! ```
//! use etendue_render::scene::{CameraSettings, Emission, Geometry, Material, Parallelogram, Scene, Screen, Shape};
//! use etendue_render::{ChoiceBy, Sampler, Settings, Technique, World};
//!
//! let (origin, forward, right, up) = ([0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
//! let (screen, lens) = (Screen::Half(0.01), None);
//! let camera = CameraSettings { origin, forward, right, up, is_orthographic: false, screen, lens };
//! let mut scene = Scene::new(camera, [16, 16]);
//! scene.materials = vec![Material::Diffuse([0.5; 3]), Material::Diffuse([0.0; 3])];
//! scene.triangles = vec![[[-9.0, -9.0, 0.0], [9.0, -9.0, 0.0], [0.0, 9.0, 0.0]]];
//! scene.triangle_materials = vec![0];
//! let square = Geometry::Parallelogram(Parallelogram { p: [-1.0, -1.0, 2.0], u: [0.0, 2.0, 0.0], v: [2.0, 0.0, 0.0] });
//! let emission = Some(Emission { radiance: [3.0; 3], ..Emission::default() });
//! scene.shapes = [Shape { geometry: square, material: 1, emission }].into();
//!
//! let (technique, choice, sampler) = (Technique::SolidAngle, ChoiceBy::Auto, Sampler::Sobol);
//! let settings = Settings { width: 16, height: 16, spp: 64, technique, choice, depth: 8, sampler, sets: 0, seed: 0 };
//! let (film, _rays) = World::new(&scene)?.render(&settings, &|_| ());
//! let mean = film.pixels.iter().map(|pixel| pixel.mean[0]).sum::<f32>() / film.pixels.len() as f32;
//! // a surface that faces a light of radiance L reflects albedo · L times its form factor
//! let half = (1.0_f32 / 5.0).sqrt();
//! let form_factor = 4.0 / std::f32::consts::PI * half * half.atan();
//! assert!((mean / (0.5 * 3.0 * form_factor) - 1.0).abs() < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The package `etendue-scene` reads scenes from files.
//!
//! | feature | what it is for |
//! |---|---|
//! | `analytic` (default) | closed forms of light wherever geometry tells what can hide it |
//! | `exr` (default) | images in EXR and PNG files, comparing them, and images whose parts are rendered apart |
//!
//! Modules import one way, from the last line of this list to the first:
//!
//! - [`packet`], [`area`], [`geometry`], [`texture`], [`limits`]: packets of eight numbers, rectangles of pixels, the
//!   forms of shapes, what varies over them, and how large images can be.
//! - [`intensity`], [`light_picture`], [`light_profile`], [`scene`]: what a scene is, and what its lights show.
//! - [`sums`], [`film`], [`files`], [`image`], [`compare`]: sums of samples, pixels, and images in files.
//! - [`bvh`], [`technique`], [`lobe`], [`bsdf`], [`surfaces`]: what rays hit, and how it reflects.
//! - [`camera`], [`sensor`], [`sampler`], [`sky`], `light_tree`, [`lights`], [`choose`]: the numbers and directions of a sample.
//! - `paths`, `ledger`, `estimate`: camera rays to shading points, what is known of lights there, and the light that these reflect.
//! - `know`: what geometry alone tells about that light, and closed forms of it.
//! - [`settings`], [`drive`], [`claim`], [`progressive`]: images of a given number of samples, or of a given error or time, and what they
//!   claim of it.
//! - [`identity`], [`split`], [`parts`], [`merge`]: what an image depends on, and images whose parts are rendered apart.

pub mod allocation;
pub mod area;
pub mod bsdf;
pub mod bvh;
pub mod camera;
pub mod choose;
pub mod claim;
pub mod coat;
#[cfg(feature = "exr")]
pub mod compare;
pub mod drive;
mod estimate;
pub mod files;
pub mod film;
pub mod geometry;
#[cfg(feature = "exr")]
pub mod identity;
#[cfg(feature = "exr")]
pub mod image;
pub mod intensity;
#[cfg(feature = "analytic")]
pub mod know;
mod ledger;
pub mod light_picture;
pub mod light_profile;
mod light_tree;
pub mod lights;
pub mod limits;
pub mod lobe;
#[cfg(feature = "exr")]
pub mod merge;
mod named;
pub mod packet;
#[cfg(feature = "exr")]
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
pub mod spread;
pub mod sums;
pub mod surfaces;
pub mod technique;
pub mod texture;

pub use choose::ChoiceBy;
pub use claim::Claim;
pub use drive::{View, World};
pub use estimate::RayCount;
#[cfg(feature = "exr")]
pub use identity::Identity;
pub use sampler::Sampler;
pub use sensor::Sensor;
pub use settings::Settings;
pub use technique::Technique;
