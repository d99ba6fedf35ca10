//! Baselines: formulas from textbooks and papers in f32, as they are usually implemented. They only serve to show where they fail.

mod integrals;
mod maps;
mod vectors;

use crate::lights::sampler::{Prepared, Sampler, Subject};
use crate::techniques::{AreaLight, LightShape, Measure};
pub use integrals::{Equiangular, disk, lambert, projected_cap, projected_segment};
pub use maps::{Area, Arvo, Cone, Excess, Fan, Urena, rectangle_with_thresholds, triangle_with_thresholds};
pub use vectors::add;
use vectors::{V, sub};

/// The textbooks' samplers of lights, which the judge finds wrong.
#[must_use]
pub fn samplers() -> Vec<Subject<'static>> {
    let of = |name: &str, shape: LightShape, prepare: fn(&AreaLight, [V; 3]) -> Box<dyn Sampler>| Subject {
        name: format!("textbook {name}"),
        shape,
        by: Measure::SolidAngle,
        domain: String::new(),
        prepare: Box::new(move |light| Prepared::Ready(prepare(light, [sub(light.a, light.p), light.b, light.c]))),
    };
    vec![
        of("cone, 1-cos naive", LightShape::Sphere, |l, [p, ..]| Box::new(Cone::new(p, l.radius, false))),
        of("cone, series below 1.5°", LightShape::Sphere, |l, [p, ..]| Box::new(Cone::new(p, l.radius, true))),
        of("Arvo, angle excess", LightShape::Triangle, |_, [p, u, v]| {
            Box::new(Fan::new(&[[p, add(p, u), add(p, v)]], Excess::Angles))
        }),
        of("Van Oosterom, unit vectors", LightShape::Triangle, |_, [p, u, v]| {
            Box::new(Fan::new(&[[p, add(p, u), add(p, v)]], Excess::Oosterom))
        }),
        of("Ureña 2013 as published", LightShape::Rectangle, |_, shape| Box::new(Urena::new(shape))),
        of("rectangle by area outside 3e-4 to 6.22 sr", LightShape::Rectangle, |_, shape| {
            rectangle_with_thresholds(shape)
        }),
    ]
}
