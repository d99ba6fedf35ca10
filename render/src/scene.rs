//! What a scene is: the plain description that [`World`](crate::World) is built of. The package `etendue-scene` reads it from files.

pub mod area;
mod coincident;
mod description;
mod environment;
mod inputs;
pub mod intensity;
pub mod light_picture;
pub mod light_profile;
mod lights;
pub mod limits;
mod materials;
mod message;
mod scaled;
pub mod texture;

pub use crate::geometry::*;
pub use coincident::{Coincidence, coincidences};
pub use description::{CameraSettings, Corners, Details, FilmSettings, Lens, Scene, Screen, Shape};
pub use environment::{Environment, SkyRadiance, SunDisk};
pub use inputs::Input;
pub use lights::{Cone, DeltaLight, Emission};
pub use materials::{Material, NormalMap, Roughness, Varying};
pub use message::Message;
