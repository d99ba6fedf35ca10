//! The estimator of a technique: samples, or closed forms around them.

use super::world::World;
use crate::camera::Camera;
#[cfg(feature = "analytic")]
use crate::certify::Analytic;
use crate::estimate::{Sampled, TileEstimator};
use crate::settings::Settings;

/// What the technique of an image does at shading points.
pub(super) fn of_technique<'a>(world: &'a World, settings: &Settings, camera: &Camera) -> Box<dyn TileEstimator + 'a> {
    #[cfg(feature = "analytic")]
    if world.is_analytic(settings) {
        let sampled = Sampled::new(settings.technique, world.scene.surfaces.has_rough());
        return Box::new(Analytic::new(&world.scene, &world.certifiable, camera, settings, sampled));
    }
    let _ = (world, camera);
    Box::new(Sampled::new(settings.technique, false))
}
