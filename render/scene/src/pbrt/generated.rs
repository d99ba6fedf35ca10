//! Shapes of the built-in scenes that are computed: in f64, rounded once to f32, the same on every machine up to the last bit of a sine.

mod chandelier;
mod city;
mod knot;
mod solids;
mod terrain;

use solids::Sink;

/// Hands the shapes of this name to `sink`, each with its radiance relative to that of the scene file; returns whether the name is known.
pub(super) fn add(name: &str, sink: &mut Sink) -> bool {
    match name {
        "terrain" => terrain::triangles(sink),
        "chandelier/brass" => chandelier::brass(sink),
        "chandelier/marble" => chandelier::marble(sink),
        "chandelier/wood" => chandelier::wood(sink),
        "chandelier/bulbs" => chandelier::bulbs(sink),
        "chandelier/glass" => chandelier::glass(sink),
        "city/brick" => city::walls(city::Facade::Brick, sink),
        "city/concrete" => city::walls(city::Facade::Concrete, sink),
        "city/plaster" => city::walls(city::Facade::Plaster, sink),
        "city/pavements" => city::pavements(sink),
        "city/dark-windows" => city::dark_windows(sink),
        "city/metal" => city::metal(sink),
        "city/lights" => city::lights(sink),
        "knot" => knot::tube(sink),
        _ => return false,
    }
    true
}
