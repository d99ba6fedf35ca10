//! The built-in scenes. (The images of `sphere-light`, `triangle-light` and `quads` are compared with those of an independent renderer.)

use crate::pbrt::text::{warnings, world};
use etendue_oracle::{V3, cross, dot, sub, wide};
use etendue_render::scene::{FilmSettings, Geometry, Material, Parallelogram, Shape};
use etendue_scene::{builtin_of_few_lights, load, parse};
use std::collections::HashMap;
use std::path::Path;

/// The volume inside of closed triangles whose normals point outwards.
fn volume(triangles: &[[[f32; 3]; 3]]) -> f64 {
    // around a corner of their own, so that the tetrahedra do not cancel
    let origin = wide(triangles[0][0]);
    let six = triangles.iter().map(|t| {
        let [a, b, c] = t.map(|p| sub(wide(p), origin));
        dot(a, cross(b, c))
    });
    six.sum::<f64>() / 6.0
}

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

/// Compares the sum of all coordinates with one computed independently from the same formulas, which includes the light's two
/// triangles. A few coordinates may round differently, because sines differ in their last bit.
#[test]
fn terrain_matches_an_independent_sum() {
    let scene = load("terrain").unwrap();
    let sum: f64 = scene.triangles.iter().flatten().flatten().map(|&x| f64::from(x)).sum();
    let light = [1.0 + 3.0 + 3.0, 5.0 * 3.0, -2.0 - 2.0 + 0.0, 1.0 + 3.0 + 1.0, 5.0 * 3.0, -2.0 + 0.0 + 0.0];
    let expected = 1_385_121.984_778_002_6 - light.iter().sum::<f64>();
    assert!((sum - expected).abs() < 1e-4, "{sum} {expected}");
    assert_eq!(
        scene.triangles[0].map(|p| [p[0], p[2]]),
        [[-12.0, -12.0], [-12.0, -11.953125], [-11.953125, -11.953125]]
    );
}

/// Two thirds of the chandelier's plates hang below others: all hang freely, and no bulb is within another.
#[test]
fn bulbs_and_plates_are_apart() {
    let scene = load("chandelier").unwrap();
    let bounds: Vec<_> = scene.shapes.iter().map(|shape| shape.geometry.bounds()).collect();
    for (i, [low, high]) in bounds.iter().enumerate() {
        let meets = |other: &[[f32; 3]; 2]| (0..3).all(|k| other[0][k] <= high[k] && other[1][k] >= low[k]);
        assert!(!bounds[..i].iter().any(meets), "light {i}: {:?}", scene.shapes[i]);
    }
    let spheres = scene.shapes.iter().filter(|shape| matches!(shape.geometry, Geometry::Sphere(_))).count();
    let two_sided = scene.shapes.iter().filter(|shape| shape.emission.unwrap().two_sided).count();
    assert_eq!((spheres, two_sided), (160, 840));
}

/// Houses, cars, posts and pavements are closed boxes whose normals point outwards. Each flat light is close in front of such a box.
#[test]
fn lights_of_the_city_face_away_from_what_they_are_mounted_on() {
    let scene = load("city").unwrap();
    let dark_windows = scene.materials.iter().position(|m| *m == Material::Diffuse([0.05, 0.05, 0.06])).unwrap();
    let is_of_box = |(t, m): (&[[f32; 3]; 3], &u32)| (*m != 0 && *m as usize != dark_windows).then_some(*t);
    let walls: Vec<_> = scene.triangles.iter().zip(&scene.triangle_materials).filter_map(is_of_box).collect();
    assert!(scene.triangle_materials[..2] == [0; 2] && walls.len().is_multiple_of(12));
    // boxes in columns of 16 m
    let column = |x: f64| (x / 16.0).floor() as i32;
    let mut columns: HashMap<i32, Vec<[V3; 2]>> = HashMap::new();
    for solid in walls.chunks(12) {
        let extreme = |k: usize, of: fn(f32, f32) -> f32| solid.iter().flatten().map(|p| p[k]).reduce(of).unwrap();
        let [low, high] = [f32::min as fn(f32, f32) -> f32, f32::max].map(|of| wide([0, 1, 2].map(|k| extreme(k, of))));
        let product: f64 = (0..3).map(|k| high[k] - low[k]).product();
        assert!((volume(solid) - product).abs() < 1e-9 * product, "{low:?} {high:?}");
        (column(low[0])..=column(high[0])).for_each(|k| columns.entry(k).or_default().push([low, high]));
    }
    let is_inside = |p: V3| {
        let boxes = columns.get(&column(p[0])).into_iter().flatten();
        boxes.into_iter().any(|[low, high]| (0..3).all(|k| low[k] < p[k] && p[k] < high[k]))
    };
    let mut windows = 0;
    for shape in scene.shapes.iter() {
        let Geometry::Parallelogram(Parallelogram { p, u, v }) = shape.geometry else { continue };
        assert!(!shape.emission.unwrap().two_sided);
        windows += 1;
        let n = wide(shape.geometry.normal());
        let at = |s: f64, t: f64, away: f64| {
            let (p, u, v) = (wide(p), wide(u), wide(v));
            [0, 1, 2].map(|k| p[k] + s * u[k] + t * v[k] + away * n[k])
        };
        for (s, t) in [(0.01, 0.01), (0.99, 0.01), (0.01, 0.99), (0.99, 0.99), (0.5, 0.5)] {
            assert!(is_inside(at(s, t, -0.06)) && !is_inside(at(s, t, 0.0)) && !is_inside(at(s, t, 0.06)), "{shape:?}");
        }
    }
    assert!(windows > scene.shapes.len() * 95 / 100 && windows < scene.shapes.len());
}

/// Each edge of the knot belongs to two triangles, in opposite directions, and the volume is that of a tube: the area of its section, a
/// polygon of 100 sides, times the length of its curve.
///
/// The section turns by about 0.003 from one step to the next against one that moves without rotation, and the quads, of width w, are all
/// folded along the same diagonal: this adds 0.003 w² ds / 12 for each, 3·10⁻⁵ of the volume. Chords instead of arcs change it by less
/// than 10⁻⁵, and the rounding of 500,000 vertices by less than 10⁻⁷.
#[test]
fn the_knot_is_closed_and_has_its_volume() {
    let scene = load("knot").unwrap();
    let corners = scene.shapes.iter().filter_map(|shape| match shape.geometry {
        Geometry::Triangle(corners) => Some(corners),
        _ => None,
    });
    let triangles: Vec<_> = corners.collect();
    let mut points: Vec<[u32; 3]> = triangles.iter().flatten().map(|p| p.map(f32::to_bits)).collect();
    points.sort_unstable();
    points.dedup();
    // a closed surface with the topology of a torus has half as many vertices as triangles
    assert_eq!((points.len(), triangles.len()), (500_000, 1_000_000));
    let index = |p: [f32; 3]| points.binary_search(&p.map(f32::to_bits)).unwrap() as u64;
    let directed = triangles.iter().flat_map(|t| {
        let [a, b, c] = t.map(index);
        [[a, b], [b, c], [c, a]]
    });
    let mut edges: Vec<[u64; 2]> = directed.collect();
    edges.sort_unstable();
    let mut reversed: Vec<[u64; 2]> = edges.iter().map(|[a, b]| [*b, *a]).collect();
    reversed.sort_unstable();
    assert!(edges == reversed && edges.windows(2).all(|two| two[0] != two[1]));

    let (far, near, tube) = (1.0, 0.42, 0.11_f64);
    let speed = |t: f64| (4.0 * (far + near * (3.0 * t).cos()).powi(2) + 9.0 * near * near).sqrt();
    let step = std::f64::consts::TAU / 4096.0;
    // the trapezoidal rule is exact for smooth periodic functions
    let length: f64 = (0..4096).map(|i| speed(f64::from(i) * step)).sum::<f64>() * step;
    let section = 50.0 * (std::f64::consts::TAU / 100.0).sin() * tube * tube;
    let (found, expected) = (volume(&triangles), section * length);
    assert!((found / expected - 1.0).abs() < 1e-4, "{found} {expected}");
}
