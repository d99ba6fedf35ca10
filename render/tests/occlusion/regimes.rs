//! All regimes of scenes with blockers.

use super::scenes::{KINDS, Round, scene};
use super::solids::{SOLID_KINDS, scene_with_solids};
use etendue_judge::generators::Random;
use etendue_judge::occlusion::Scene;

/// A regime: its name, whether it has polyhedra, and its scenes.
pub(crate) struct Regime {
    pub(crate) name: String,
    pub(crate) has_polyhedra: bool,
    pub(crate) scene: Box<dyn Fn(&mut Random) -> Scene>,
}

pub(crate) fn regimes() -> Vec<Regime> {
    let rounds = [Round::None, Round::Light, Round::Occluders];
    let flat = rounds.into_iter().flat_map(|round| KINDS.iter().map(move |&kind| (kind, round)));
    let flat = flat.map(|(kind, round)| Regime {
        name: format!("{kind:?}, {round:?}"),
        has_polyhedra: false,
        scene: Box::new(move |random| scene(random, kind, round)),
    });
    let solid = [false, true].into_iter().flat_map(|round| SOLID_KINDS.iter().map(move |&kind| (kind, round)));
    let solid = solid.map(|(kind, round)| Regime {
        name: format!("{kind:?}, {}", if round { "sphere" } else { "polygon" }),
        has_polyhedra: true,
        scene: Box::new(move |random| scene_with_solids(random, kind, round)),
    });
    flat.chain(solid).collect()
}
