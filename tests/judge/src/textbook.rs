//! Baselines: formulas from textbooks and papers in f32, as they are usually implemented. They only serve to show where they fail.

mod integrals;
mod maps;
mod vectors;

use crate::area_lights::{AreaLight, LightShape, Measure};
use crate::lights::sampler::{Lacks, Prepared, Sampler, Subject, technique};
use integrals::{disk, lambert, projected_cap};
use maps::{Cone, Excess, Fan, Reweighted, Urena};
use vectors::{V, add, sub};

/// The corners of a flat light relative to the point.
fn corners(light: &AreaLight) -> Vec<V> {
    let [p, u, v] = [sub(light.a, light.p), light.b, light.c];
    match light.shape {
        LightShape::Triangle => vec![p, add(p, u), add(p, v)],
        LightShape::Polygon => light.corners().map(|corner| sub(corner, light.p)).to_vec(),
        _ => vec![p, add(p, u), add(add(p, u), v), add(p, v)],
    }
}
/// Arvo's map in the triangles of a light, about its first corner; of a triangle alone, about its second.
fn fan(light: &AreaLight, excess: Excess) -> Box<dyn Sampler> {
    let c = corners(light);
    let halves = |i: usize| [c[i - 1], c[0], c[i]];
    let parts: Vec<_> = if c.len() == 3 { vec![[c[0], c[1], c[2]]] } else { (2..c.len()).map(halves).collect() };
    Box::new(Fan::new(&parts, excess))
}
/// The core's directions, with another density.
fn reweighted(light: &AreaLight, by: Measure, density: f32) -> Prepared<'static> {
    let normal = (by == Measure::ProjectedSolidAngle).then_some(light.n);
    match (technique(light.shape, by).prepare)(light) {
        Prepared::Ready(own) => Prepared::Ready(Box::new(Reweighted { own, density, normal })),
        nothing => nothing,
    }
}

/// The textbooks' samplers of lights, most of which the judge finds wrong.
#[must_use]
pub fn samplers() -> Vec<Subject<'static>> {
    use LightShape::{Disk, Parallelogram, Polygon, Rectangle, Sphere, Triangle};
    let named = |name: &str, shape, by, prepare: Box<dyn Fn(&AreaLight) -> Prepared<'static>>| Subject {
        lacks: Lacks::default(),
        name: format!("textbook {name}"),
        shape,
        by,
        domain: String::new(),
        prepare,
    };
    let of = |name: &str, shape, prepare: fn(&AreaLight) -> Box<dyn Sampler>| {
        named(name, shape, Measure::SolidAngle, Box::new(move |light| Prepared::Ready(prepare(light))))
    };
    let density = |name: &str, shape, by, density: fn(&AreaLight) -> f32| {
        named(name, shape, by, Box::new(move |light| reweighted(light, by, density(light))))
    };
    let mut all = vec![
        of("cone, 1-cos naive", Sphere, |l| Box::new(Cone::new(sub(l.a, l.p), l.radius, false))),
        of("cone, series below 1.5°", Sphere, |l| Box::new(Cone::new(sub(l.a, l.p), l.radius, true))),
        of("Ureña 2013 as published", Rectangle, |l| Box::new(Urena::new([sub(l.a, l.p), l.b, l.c]))),
        density("Ω by arc cosines of the cone", Disk, Measure::SolidAngle, |l| {
            1.0 / disk(sub(l.a, l.p), l.b, l.radius)
        }),
        density("closed form of the pdf", Sphere, Measure::ProjectedSolidAngle, |l| {
            1.0 / projected_cap(sub(l.a, l.p), l.radius, l.n)
        }),
    ];
    for shape in [Triangle, Parallelogram, Polygon] {
        all.push(of("Arvo, angle excess", shape, |l| fan(l, Excess::Angles)));
        all.push(of("Van Oosterom, unit vectors", shape, |l| fan(l, Excess::Oosterom)));
        all.push(density("Lambert by arc cosines", shape, Measure::ProjectedSolidAngle, |l| {
            1.0 / lambert(&corners(l), l.n)
        }));
    }
    all
}
