//! Lights: what their samplers return. The judge of anybody's samplers judges all of the core's; these are the special cases.

mod area;
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

use etendue_judge::lights::sampler::own;
use etendue_judge::lights::verdict::{Effort, judge};
use etendue_judge::page;
use etendue_oracle::tier::cases;

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
