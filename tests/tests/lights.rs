//! Lights: what their samplers return. The judge of anybody's samplers judges all of the core's; these are the special cases.

mod below_the_horizon;
mod environment;
mod mistakes_of_hosts;
mod on_surface;
mod patches;
mod pictures;
mod polygon;
mod portals;
mod projected;
mod samplers;
mod sets;
mod without_area;

use etendue::Vec2;
use etendue_judge::lights::sampler::own;
use etendue_judge::lights::verdict::{Effort, judge};
use etendue_judge::page;
use etendue_oracle::tier::cases;
use etendue_oracle::{V3, cross, length, sub};

/// Every technique of shapes with an area, and sets of one light, at ordinary places and where one thing is extreme.
#[test]
fn the_judge_finds_nothing() {
    for subject in own() {
        for seed in 0..cases(1, 8) {
            let judgement = judge(&subject, Effort { quick: true, seed, page: false }, |_| ());
            assert!(judgement.is_right(), "seed {seed}: {}", page::text(&[judgement]));
        }
    }
}

/// What a map makes of an area about `u`, over that and times the pdf: 1 of a density that is that of the map. `None` where a step leads out of
/// the square, or into another piece of the map.
pub(crate) fn stretch<P: PartialEq>(draw: impl Fn(Vec2<f64>) -> (V3, f64, P), u: [f64; 2]) -> Option<f64> {
    const STEP: f64 = 1e-6;
    let (_, pdf, piece) = draw(u.into());
    let at = |axis: usize, by: f64| {
        let mut u = u;
        u[axis] += by;
        let (w, _, other) = if (0.0..1.0).contains(&u[axis]) { draw(u.into()) } else { return None };
        (other == piece).then_some(w)
    };
    let [across, along] = [sub(at(0, STEP)?, at(0, -STEP)?), sub(at(1, STEP)?, at(1, -STEP)?)];
    Some(length(cross(across, along)) / (4.0 * STEP * STEP) * pdf)
}
