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
//! Folders import one way, from the last line of this list to the first, and so do the files of each:
//!
//! - [`packet`], `named`, [`technique`], [`sampler`], [`settings`]: packets of eight numbers, and what is asked for.
//! - [`geometry`]: the forms of shapes.
//! - [`scene`]: what a scene is, what varies over surfaces, and what lights show.
//! - [`bvh`]: what rays hit.
//! - [`surfaces`]: how it reflects.
//! - [`lights`]: the lights and the sky, and directions to them.
//! - [`choose`]: which light is sampled.
//! - [`camera`]: rays from the camera, and their paths to shading points.
//! - [`know`]: what is known of the lights there: the ledger, what geometry alone tells, and closed forms.
//! - `estimate`: the light that shading points reflect.
//! - [`film`]: sums of samples, pixels, images in files, and what they claim of their error.
//! - [`drive`]: images of a given number of samples, or of a given error or time, or of which parts are rendered apart.

pub mod bvh;
pub mod camera;
pub mod choose;
pub mod drive;
mod estimate;
pub mod film;
pub mod geometry;
pub mod know;
pub mod lights;
mod named;
pub mod packet;
pub mod sampler;
pub mod scene;
pub mod settings;
pub mod surfaces;
pub mod technique;

pub use bvh::RayCount;
pub use choose::ChoiceBy;
#[cfg(feature = "exr")]
pub use drive::identity::Identity;
pub use drive::{View, World};
pub use film::claim::Claim;
pub use film::sensor::Sensor;
pub use sampler::Sampler;
pub use settings::Settings;
pub use technique::Technique;
