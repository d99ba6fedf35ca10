//! The built-in scenes.

use crate::pbrt::text::{warnings, world};
use etendue_render::scene::{FilmSettings, Geometry, Material, Shape};
use etendue_scene::{builtin_of_few_lights, load, parse};
use std::path::Path;

/// A number with commas between groups of three digits.
fn grouped(n: usize) -> String {
    let digits = n.to_string();
    let groups: Vec<&str> = digits.as_bytes().rchunks(3).rev().map(|g| str::from_utf8(g).unwrap()).collect();
    groups.join(",")
}

/// Numbers of triangles, of shapes that emit, of lights without an area, of mirrors and of rough materials.
const SIZES: [(&str, [usize; 5]); 15] = [
    ("studio", [88, 4, 0, 0, 0]),
    ("sphere-light", [26, 1, 0, 0, 0]),
    ("triangle-light", [14, 1, 0, 0, 0]),
    ("quads", [38, 5, 0, 0, 0]),
    ("terrain", [1_036_288, 1, 0, 0, 0]),
    ("cornell-box", [30, 1, 0, 0, 0]),
    ("mirror-room", [24, 1, 0, 3, 0]),
    ("plates", [12, 4, 0, 0, 4]),
    ("delta-lights", [26, 0, 3, 0, 0]),
    ("sky", [2, 0, 0, 1, 1]),
    ("defocus", [2, 3, 0, 0, 0]),
    ("chandelier", [29_548, 1_000, 0, 0, 0]),
    ("city", [193_156, 109_655, 0, 0, 0]),
    ("wet-city", [193_156, 109_655, 0, 0, 2]),
    ("knot", [28, 1_000_000, 0, 0, 0]),
];

#[test]
fn builtin_scenes_have_the_stated_sizes_and_no_warnings() {
    let (few, many) = etendue_scene::builtin().split_at(builtin_of_few_lights().len());
    assert_eq!(few, builtin_of_few_lights());
    let mut found = Vec::new();
    for (name, about) in etendue_scene::builtin() {
        let scene = load(name).unwrap();
        assert_eq!((warnings(&scene), scene.name.as_str()), (Vec::new(), *name));
        // sky.exr is its map
        let filename = Some(format!("{}.exr", if *name == "sky" { "sky-render" } else { name }));
        let (width, height, samples) = match *name {
            "studio" => (512, 384, 16),
            "defocus" => (384, 256, 256),
            _ => (256, 256, 64),
        };
        let film = FilmSettings { width, height, diagonal: 35.0, filename, place: None, exposure: 1.0 };
        assert_eq!((&scene.film, scene.pixel_samples), (&film, samples));
        let emitting: Vec<_> = scene.shapes.iter().filter(|shape| shape.emission.is_some()).collect();
        let count = |is: fn(&Material) -> bool| scene.materials.iter().filter(|material| is(material)).count();
        let [mirrors, rough] = [count(|material| material.is_mirror()), count(|material| material.is_glossy())];
        found.push((*name, [scene.triangles.len(), emitting.len(), scene.delta_lights.len(), mirrors, rough]));
        let lights = emitting.len() + scene.delta_lights.len();
        match many.iter().any(|(other, _)| other == name) {
            true => assert!(about.contains(&grouped(lights)), "{name}: {about}"),
            false => assert!(lights <= etendue_render::choose::allocation::FEW, "{name}: {lights}"),
        }
        // lights reflect nothing, and each emits
        assert!(emitting.iter().all(|shape| scene.materials[shape.material as usize].is_black()), "{name}");
        let radiance = |shape: &&Shape| shape.emission.unwrap().radiance;
        assert!(emitting.iter().map(radiance).all(|r| r.iter().all(|x| x.is_finite() && *x > 0.0)), "{name}");
        assert!(scene.shapes.iter().all(|shape| shape.geometry.area() > 0.0), "{name}");
        assert!(scene.triangles.iter().all(|t| Geometry::Triangle(*t).area() > 0.0), "{name}");
        assert_eq!(scene.triangle_materials.len(), scene.triangles.len());
    }
    assert_eq!(found, SIZES);
    // only the built-in scene may refer to its image
    let text = world("LightSource \"infinite\" \"string filename\" \"sky.exr\"");
    assert!(parse(&text, "a.pbrt", Path::new("no such directory")).is_err());
}
