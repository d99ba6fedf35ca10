//! A scene ready to be rendered.

use crate::bvh::BuildError;
use crate::certify::Certifiable;
use crate::prepared::PreparedScene;
use crate::scene::{CameraSettings, Scene};
use crate::sensor::{Exposure, Sensor};
use crate::settings::Settings;

/// A scene ready to be rendered.
#[derive(Debug)]
pub struct World {
    pub(super) scene: PreparedScene,
    /// What closed forms need.
    pub(super) certifiable: Certifiable,
    pub(super) camera: CameraSettings,
    /// Diagonal of the film in millimetres.
    diagonal: f64,
    sensor: Sensor,
}

impl World {
    /// Builds the trees and tables of a scene.
    ///
    /// # Errors
    /// Fails if there are more primitives than a tree can index.
    pub fn new(scene: &Scene) -> Result<Self, BuildError> {
        Ok(Self::with(PreparedScene::new(scene)?, scene))
    }

    /// Like [`World::new`], but takes the triangles out of the scene and builds the tree in their memory.
    ///
    /// # Errors
    /// Fails if there are more primitives than a tree can index.
    pub fn from_scene(scene: &mut Scene) -> Result<Self, BuildError> {
        Ok(Self::with(PreparedScene::from_scene(scene)?, scene))
    }

    fn with(prepared: PreparedScene, scene: &Scene) -> Self {
        let (camera, diagonal) = (scene.camera.clone(), scene.film.diagonal);
        Self {
            certifiable: Certifiable::new(scene, &prepared),
            scene: prepared,
            camera,
            diagonal,
            sensor: Sensor::default(),
        }
    }

    /// Size of the trees and their primitives in bytes.
    pub fn bytes(&self) -> usize {
        self.scene.surfaces.bvh.bytes()
    }

    /// The same world, with another sensor.
    #[must_use]
    pub fn with_sensor(self, sensor: Sensor) -> Self {
        Self { sensor, ..self }
    }

    /// Checks that the lights of the scene can be chosen as these settings say.
    ///
    /// # Errors
    /// Says what the choice would need.
    pub fn check(&self, settings: &Settings) -> Result<(), String> {
        let sampled = self.scene.sampled(settings.technique, settings.choice);
        sampled.map(|_| ()).map_err(|what| format!("the choice {} needs {what}", settings.choice.name()))
    }

    /// The weights of radiance in an image of this size; `None` if the sensor measures radiance itself.
    pub fn exposure(&self, width: u32, height: u32) -> Option<Exposure> {
        Exposure::new(self.sensor, &self.camera, self.diagonal, [width, height])
    }
}
