//! A scene with its trees and tables.

use crate::bvh::BuildError;
use crate::choose::{ChoiceBy, Chooser, Choosers};
use crate::lights::Lights;
use crate::lights::sky::Sky;
use crate::scene::Scene;
use crate::surfaces::Surfaces;
use crate::technique::Technique;
use std::sync::Arc;

/// Everything that paths need of a scene.
#[derive(Debug)]
pub(crate) struct PreparedScene {
    pub(crate) surfaces: Surfaces,
    pub(crate) lights: Lights,
    /// Those of `lights` that no ray can hit.
    pub(crate) unhit: Lights,
    /// How lights are chosen, and how those are.
    choosers: [Choosers; 2],
    pub(crate) sky: Option<Arc<Sky>>,
}

impl PreparedScene {
    pub(crate) fn new(scene: &Scene) -> Result<Self, BuildError> {
        let surfaces = Surfaces::new(scene)?;
        Self::with(scene, surfaces)
    }
    /// Takes the triangles out of the scene.
    pub(crate) fn from_scene(scene: &mut Scene) -> Result<Self, BuildError> {
        let surfaces = Surfaces::from_scene(scene)?;
        Self::with(scene, surfaces)
    }
    fn with(scene: &Scene, surfaces: Surfaces) -> Result<Self, BuildError> {
        let sky = scene.environment.as_ref().map(|environment| Arc::new(Sky::new(environment)));
        let (lights, unhit) = (Lights::new(scene, sky.clone()), Lights::unhit(scene));
        let reach = surfaces.bvh.reach();
        let choosers = [Choosers::new(&lights, reach)?, Choosers::new(&unhit, reach)?];
        Ok(Self { surfaces, lights, unhit, choosers, sky })
    }
    /// The lights that are sampled, and how they are chosen: a technique that finds lights by chance never hits some, so it samples
    /// those.
    ///
    /// # Errors
    /// Says what the choice would need if it is none for these lights.
    pub(crate) fn sampled(&self, technique: Technique, by: ChoiceBy) -> Result<(&Lights, &Chooser), String> {
        let (lights, choosers) = match technique.finds_lights() {
            true => (&self.unhit, &self.choosers[1]),
            false => (&self.lights, &self.choosers[0]),
        };
        choosers.by(lights, by).map(|chooser| (lights, chooser))
    }
}
