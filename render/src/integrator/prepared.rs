//! A scene with its trees and tables.

use crate::bvh::BuildError;
use crate::certificates::Bodies;
use crate::lights::Lights;
use crate::scene::Scene;
use crate::sky::Sky;
use crate::surfaces::Surfaces;
use std::sync::Arc;

/// Everything that paths need of a scene.
#[derive(Debug)]
pub(super) struct PreparedScene {
    pub(super) surfaces: Surfaces,
    /// Convex parts of the mesh.
    pub(super) bodies: Bodies,
    pub(super) lights: Lights,
    /// The delta lights among `lights`.
    pub(super) deltas: Lights,
    pub(super) sky: Option<Arc<Sky>>,
}

impl PreparedScene {
    pub(super) fn new(scene: &Scene) -> Result<Self, BuildError> {
        let surfaces = Surfaces::new(scene)?;
        let sky = Self::sky(scene);
        let (lights, deltas) = (Lights::new(scene, sky.clone())?, Lights::deltas(scene)?);
        Ok(Self { bodies: Bodies::new(&surfaces.bvh), surfaces, lights, deltas, sky })
    }
    /// Takes the triangles out of the scene.
    pub(super) fn from_scene(scene: &mut Scene) -> Result<Self, BuildError> {
        let sky = Self::sky(scene);
        let (lights, deltas) = (Lights::new(scene, sky.clone())?, Lights::deltas(scene)?);
        let surfaces = Surfaces::from_scene(scene)?;
        Ok(Self { bodies: Bodies::new(&surfaces.bvh), surfaces, lights, deltas, sky })
    }
    fn sky(scene: &Scene) -> Option<Arc<Sky>> {
        scene.environment.as_ref().map(|environment| Arc::new(Sky::new(environment)))
    }
}
