//! What a scene is: the plain description that [`World`](crate::World) is built of. The package `etendue-scene` reads it from files.

mod coincident;
mod description;
mod environment;
mod inputs;
mod lights;
mod materials;
mod message;
mod scaled;

pub use crate::geometry::*;
pub use coincident::{Coincidence, coincidences};
pub use description::{CameraSettings, Corners, Details, FilmSettings, Lens, Scene, Screen, Shape};
pub use environment::{Environment, SkyRadiance, SunDisk};
pub use inputs::Input;
pub use lights::{Cone, DeltaLight, Emission};
pub use materials::{Material, Roughness, Varying};
pub use message::Message;
