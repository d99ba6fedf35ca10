//! A scene with its trees and tables.

use crate::bvh::BuildError;
use crate::lights::Lights;
use crate::scene::Scene;
use crate::sky::Sky;
use crate::surfaces::Surfaces;
use std::sync::Arc;

/// Everything that paths need of a scene.
#[derive(Debug)]
pub(crate) struct PreparedScene {
    pub(crate) surfaces: Surfaces,
    pub(crate) lights: Lights,
    /// The delta lights among `lights`.
    pub(crate) deltas: Lights,
    pub(crate) sky: Option<Arc<Sky>>,
}

impl PreparedScene {
    /// The lights that are sampled: rays that find lights by chance never find a delta light, so those alone, or all.
    pub(crate) fn sampled(&self, finds_lights: bool) -> &Lights {
        if finds_lights { &self.deltas } else { &self.lights }
    }
    pub(crate) fn new(scene: &Scene) -> Result<Self, BuildError> {
        let surfaces = Surfaces::new(scene)?;
        let sky = Self::sky(scene);
        let (lights, deltas) = (Lights::new(scene, sky.clone())?, Lights::deltas(scene)?);
        Ok(Self { surfaces, lights, deltas, sky })
    }
    /// Takes the triangles out of the scene.
    pub(crate) fn from_scene(scene: &mut Scene) -> Result<Self, BuildError> {
        let sky = Self::sky(scene);
        let (lights, deltas) = (Lights::new(scene, sky.clone())?, Lights::deltas(scene)?);
        let surfaces = Surfaces::from_scene(scene)?;
        Ok(Self { surfaces, lights, deltas, sky })
    }
    fn sky(scene: &Scene) -> Option<Arc<Sky>> {
        scene.environment.as_ref().map(|environment| Arc::new(Sky::new(environment)))
    }
}
