//! What is known of lights before they are sampled, by the technique of an image.

use super::world::World;
use crate::camera::Camera;
use crate::estimate::{Know, Sampled};
#[cfg(feature = "analytic")]
use crate::know::Knowledge;
use crate::ledger::Ledger;
use crate::settings::Settings;

/// Knows lights without samples, if a technique does.
pub(super) type Knower<'a> = Option<Box<dyn Know + 'a>>;

/// What a technique knows, a ledger for that, and how it samples the rest.
pub(super) fn of_technique<'a>(
    world: &'a World,
    settings: &Settings,
    camera: &Camera,
) -> (Knower<'a>, Ledger, Sampled) {
    #[cfg(feature = "analytic")]
    if world.is_analytic(settings) {
        let know = Knowledge::new(&world.scene, &world.certifiable, camera, settings);
        let ledger = Ledger::all_open(true, world.certifiable.has_irradiances());
        return (Some(Box::new(know)), ledger, Sampled::new(settings.technique, world.scene.surfaces.has_rough()));
    }
    let _ = (world, camera);
    (None, Ledger::all_open(false, false), Sampled::new(settings.technique, false))
}
