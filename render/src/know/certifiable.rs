//! What closed forms need of a scene besides its trees.

use super::bodies::Bodies;
use super::picture_irradiance::PictureIrradiance;
use crate::camera::PreparedScene;
use crate::scene::{Scene, Shape, coincidences};
use rayon::prelude::*;

/// What closed forms need of a scene.
#[derive(Debug)]
pub(crate) struct Certifiable {
    /// Convex parts of the mesh.
    pub(super) bodies: Bodies,
    /// By which the light of a few shapes with pictures is known, in the order of the lights; empty if none is.
    pub(super) irradiances: Vec<Option<PictureIrradiance>>,
    /// Whether another light hides part of each light, in the same place: it is only sampled. In the order of the lights; empty if none does.
    pub(super) hidden: Vec<bool>,
    /// Whether all lights show pictures that have no closed form, or have none themselves.
    only_sampled: bool,
}

impl Certifiable {
    pub(crate) fn new(scene: &Scene, prepared: &PreparedScene) -> Self {
        let emitting: Vec<&Shape> = scene.shapes.iter().filter(|shape| shape.emission.is_some()).collect();
        let irradiance = |shape: &&Shape| {
            let emission = shape.emission.filter(|of| of.spread.is_none() && of.profile.is_none())?;
            PictureIrradiance::new(&scene.pictures[emission.picture? as usize], &shape.geometry)
        };
        let shows_picture = |shape: &&Shape| shape.emission.is_some_and(|emission| emission.picture.is_some());
        let mut irradiances = Vec::new();
        if prepared.lights.only_few_areas() && emitting.iter().any(shows_picture) {
            irradiances = emitting.par_iter().map(irradiance).collect();
        }
        let has_none = |shape: &&Shape| shows_picture(shape) || !shape.geometry.outline().is_exact();
        let only_sampled = emitting.iter().all(has_none) && !irradiances.iter().any(Option::is_some);
        let mut hidden = Vec::new();
        if prepared.lights.only_few_areas() {
            let second: Vec<u32> =
                coincidences(&scene.shapes).iter().filter(|pair| pair.hides).map(|pair| pair.lights[1]).collect();
            if !second.is_empty() {
                hidden = prepared.surfaces.light_shapes().map(|index| second.contains(&index)).collect();
            }
        }
        Self { bodies: Bodies::new(&prepared.surfaces.bvh), irradiances, hidden, only_sampled }
    }
    /// Whether closed forms know no light, whatever is in its way.
    pub(crate) const fn only_sampled(&self) -> bool {
        self.only_sampled
    }
    /// Whether the pictures of any lights have closed forms.
    pub(super) fn has_irradiances(&self) -> bool {
        self.irradiances.iter().any(Option::is_some)
    }
}
