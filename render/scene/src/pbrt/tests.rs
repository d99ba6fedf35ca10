//! Tests of the built-in scenes, transforms and orientation; `faulty` has faulty input, `meshes` has mesh files, `many_lights` has the
//! scenes of many lights, `own_scenes` what files of others have.

mod cameras;
mod daylight;
mod directed;
mod faulty;
mod lights;
mod many_lights;
mod meshes;
mod own_scenes;
mod photometry;
mod pictures;
mod portals;

use super::{builtin, builtin_of_few_lights, ies, ply};
use crate::{SceneError, load, parse, transform};
use etendue_render::scene::{
    DeltaLight, Details, Emission, Environment, FilmSettings, Geometry, Lens, Material, Message, Roughness, Scene,
    Screen, Shape, SkyRadiance, Varying,
};
use std::path::Path;

/// A scene of a camera and some shapes.
fn world(shapes: &str) -> String {
    format!("LookAt 0 0 5 0 0 0 0 1 0 Camera \"perspective\" WorldBegin\n{shapes}")
}

fn read(text: &str) -> Scene {
    parse(text, "a.pbrt", Path::new("no such directory")).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn warnings(scene: &Scene) -> Vec<String> {
    scene.warnings.iter().map(Message::to_string).collect()
}

const LIGHT: &str = "AreaLightSource \"diffuse\"\n";
const TRIANGLE: &str = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]\n";
const PATCH: &str = "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 2 0 0 0 1 0 2 1 0]\n";

fn sub(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The normal of a flat shape, whose length is twice the area of a triangle or the area of a parallelogram.
fn normal(geometry: &Geometry) -> [f32; 3] {
    match *geometry {
        Geometry::Triangle([a, b, c]) => cross(sub(b, a), sub(c, a)),
        Geometry::Parallelogram { u, v, .. } => cross(u, v),
        Geometry::Sphere { .. } => panic!("a sphere is not flat"),
    }
}

#[test]
fn builtin_scenes_have_the_stated_sizes_and_no_warnings() {
    let expected = [("sphere-light", 26, 1), ("triangle-light", 14, 1), ("quads", 38, 5), ("terrain", 1_036_288, 1)];
    for (name, _) in builtin() {
        let scene = load(name).unwrap();
        assert_eq!(scene.name, *name);
        assert_eq!(warnings(&scene), [""; 0], "{name}");
    }
    for ((name, _), (wanted, triangles, lights)) in builtin().iter().zip(expected) {
        let scene = load(name).unwrap();
        assert_eq!((scene.name.as_str(), *name), (wanted, wanted));
        assert_eq!(scene.triangles.len(), triangles, "{name}");
        assert_eq!(scene.triangle_materials.len(), triangles, "{name}");
        assert_eq!(scene.shapes.len(), lights, "{name}");
        assert!(scene.shapes.iter().all(|shape| shape.emission.is_some_and(|e| !e.two_sided)), "{name}");
        assert!(scene.shapes.iter().all(|shape| scene.materials[shape.material as usize].is_black()), "{name}");
        assert_eq!(scene.pixel_samples, 64, "{name}");
        assert_eq!(
            scene.film,
            FilmSettings {
                width: 256,
                height: 256,
                diagonal: 35.0,
                filename: Some(format!("{name}.exr")),
                place: None
            }
        );
        assert!(scene.triangle_materials.iter().all(|&m| (m as usize) < scene.materials.len()));
    }
}

#[test]
fn builtin_lights_are_where_they_should_be() {
    let scene = load("sphere-light").unwrap();
    assert_eq!(scene.shapes[0].geometry, Geometry::Sphere { center: [0.5, 3.5, -0.5], radius: 0.5 });
    assert_eq!(scene.shapes[0].emission.unwrap().radiance, [50.0; 3]);

    let scene = load("triangle-light").unwrap();
    let corners = [[-2.0, 0.3, -1.5], [2.0, 0.3, -1.5], [0.0, 2.3, -0.5]];
    assert_eq!(scene.shapes[0].geometry, Geometry::Triangle(corners));
    let n = normal(&scene.shapes[0].geometry);
    assert!(n[0] == 0.0 && (n[1] + 4.0).abs() < 1e-6 && (n[2] - 8.0).abs() < 1e-6, "{n:?}");

    let quads: [[[f32; 3]; 4]; 5] = [
        [[-0.8, 3.8, -1.0], [1.6, 0.0, 0.0], [0.0, 0.0, 1.0], [8.0, 8.0, 8.0]],
        [[-4.5, 1.2, 0.3], [0.0, 0.0, -0.6], [0.0, 0.6, 0.0], [60.0, 15.0, 8.0]],
        [[4.5, 0.85, -1.5], [0.0, 0.0, 3.0], [0.0, 0.3, 0.0], [6.0, 12.0, 40.0]],
        [[1.1, 2.6, -4.0], [0.8, 0.0, 0.0], [0.0, 0.32, 0.24], [8.0, 40.0, 8.0]],
        [[-1.6, 4.2, 1.4], [0.2, 0.0, 0.0], [0.0, 0.0, 0.2], [150.0, 140.0, 120.0]],
    ];
    let scene = load("quads").unwrap();
    for (shape, [p, u, v, radiance]) in scene.shapes.iter().zip(quads) {
        assert_eq!(shape.geometry, Geometry::Parallelogram { p, u, v });
        assert_eq!(shape.emission.unwrap().radiance, radiance);
    }
    assert_eq!(scene.materials, [[0.5; 3], [0.7; 3], [0.6, 0.3, 0.3], [0.0; 3]].map(Material::Diffuse));
    assert_eq!(scene.triangle_materials[..2], [0; 2]);
    assert_eq!(scene.triangle_materials[14..26], [1; 12]);

    let scene = load("terrain").unwrap();
    let light = Geometry::Parallelogram { p: [1.0, 5.0, -2.0], u: [2.0, 0.0, 0.0], v: [0.0, 0.0, 2.0] };
    assert_eq!(scene.shapes[0].geometry, light);
}

/// Boxes are closed and face outwards, since the signed tetrahedra add up to their volume; the ground faces up.
#[test]
fn boxes_of_quads_have_their_volumes() {
    let scene = load("quads").unwrap();
    let volumes = [0.8 * 1.2 * 0.8, 1.0 * 0.6 * 0.8, 0.5 * 0.9 * 0.5];
    for (triangles, expected) in scene.triangles[2..].chunks(12).zip(volumes) {
        let six: f64 = triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|p| p.map(f64::from));
                transform::dot(a, transform::cross(b, c))
            })
            .sum();
        assert!((six / 6.0 - expected).abs() < 1e-6, "{} {expected}", six / 6.0);
    }
    for triangle in &scene.triangles[..2] {
        assert_eq!(normal(&Geometry::Triangle(*triangle)), [0.0, 400.0, 0.0]);
    }
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
    let degenerate = scene.triangles.iter().filter(|t| normal(&Geometry::Triangle(**t)) == [0.0; 3]).count();
    assert_eq!(degenerate, 0);
}

fn close(a: [f64; 3], b: [f64; 3]) -> bool {
    a.iter().zip(b).all(|(x, y)| (x - y).abs() < 1e-14)
}

/// f = normalize(target − origin), r = normalize(f × up), v = r × f.
#[test]
fn builtin_cameras_are_right_handed() {
    let views = [
        ("sphere-light", [0.0, 5.0, 6.0], [0.0, 0.2, 0.0], 35.0),
        ("triangle-light", [0.0, 4.0, 6.0], [0.0, 0.2, 0.3], 35.0),
        ("quads", [0.0, 6.0, 7.0], [0.0, 0.0, 0.0], 40.0),
        ("terrain", [0.0, 6.0, 7.5], [0.0, 0.0, -0.2], 40.0),
        ("defocus", [0.0, 0.12, 0.5], [0.02, 0.03, 0.0], 28.0),
    ];
    for (name, origin, target, fov) in views {
        let camera = load(name).unwrap().camera;
        let forward = transform::unit(transform::sub(target, origin)).unwrap();
        let right = transform::unit(transform::cross(forward, [0.0, 1.0, 0.0])).unwrap();
        let up = transform::cross(right, forward);
        assert!(close(camera.origin, origin), "{name} {camera:?}");
        assert!(
            close(camera.forward, forward) && close(camera.right, right) && close(camera.up, up),
            "{name} {camera:?}"
        );
        // The ray at (0, 0), the top left, points to the left (−x) of the target and above it.
        let [_, across, _, down] = camera.edges(256, 256);
        assert!((across - (0.5_f64 * fov).to_radians().tan()).abs() < 1e-15 && across == down);
        let ray: Vec<f64> =
            (0..3).map(|k| camera.forward[k] - across * camera.right[k] + down * camera.up[k]).collect();
        assert!(ray[0] < 0.0 && ray[1] > forward[1], "{name} {ray:?}");
    }
}

#[test]
fn fov_spans_the_shorter_side() {
    let camera = read(&world(TRIANGLE)).camera;
    assert_eq!(camera.screen, Screen::Half(libm::tan(90_f64.to_radians() / 2.0)));
    for (width, height, expected) in [(400, 200, [2.0, 1.0]), (200, 400, [1.0, 2.0]), (1, 1, [1.0, 1.0])] {
        let [left, right, lower, upper] = camera.edges(width, height);
        assert!((right - expected[0]).abs() < 1e-12 && (upper - expected[1]).abs() < 1e-12, "{right} {upper}");
        assert_eq!([left, lower], [-right, -upper]);
    }
}

/// Without `Scale -1 1 1`, pbrt's camera space is left-handed: looking from +z towards the origin, right is −x.
#[test]
fn camera_space_is_left_handed() {
    let camera = read("LookAt 0 0 5 0 0 0 0 1 0 Camera \"perspective\" WorldBegin").camera;
    assert_eq!((camera.origin, camera.forward), ([0.0, 0.0, 5.0], [0.0, 0.0, -1.0]));
    assert_eq!((camera.right, camera.up), ([-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]));
    // a scale of the camera changes nothing; the identity looks along +z
    let scaled = read("Scale 3 3 3 LookAt 0 0 5 0 0 0 0 1 0 Camera \"perspective\" WorldBegin").camera;
    assert_eq!((scaled.origin, scaled.forward, scaled.right), (camera.origin, camera.forward, camera.right));
    assert_eq!(read("Camera \"perspective\" WorldBegin").camera.forward, [0.0, 0.0, 1.0]);
}

#[test]
fn transforms_compose_as_in_pbrt() {
    let at = |transform: &str| {
        let scene = read(&world(&format!("{transform} Shape \"sphere\" \"float radius\" 1")));
        match scene.shapes[0].geometry {
            Geometry::Sphere { center, radius } => (center, radius),
            _ => unreachable!(),
        }
    };
    assert_eq!(at("Translate 1 2 3 Scale 2 2 2"), ([1.0, 2.0, 3.0], 2.0));
    assert_eq!(at("Scale 2 2 2 Translate 1 2 3"), ([2.0, 4.0, 6.0], 2.0));
    assert_eq!(at("Translate 5 5 5 Identity"), ([0.0; 3], 1.0));
    assert_eq!(at("Rotate 90 0 0 1 Translate 1 0 0").0.map(f32::round), [0.0, 1.0, 0.0]);
    assert_eq!(at("Rotate 90 0 5 0 Translate 1 0 0").0.map(f32::round), [0.0, 0.0, -1.0]);
    assert_eq!(at("Translate 9 9 9 Transform [ 2 0 0 0  0 0 2 0  0 2 0 0  1 2 3 1 ]"), ([1.0, 2.0, 3.0], 2.0));
    assert_eq!(at("Translate 1 0 0 ConcatTransform [ 2 0 0 0  0 2 0 0  0 0 2 0  1 2 3 1 ]"), ([2.0, 2.0, 3.0], 2.0));
    assert_eq!(at("CoordSysTransform \"camera\"").0, [0.0, 0.0, 5.0]);
    assert_eq!(at("Translate 1 0 0 CoordinateSystem \"a\" Identity CoordSysTransform \"a\"").0, [1.0, 0.0, 0.0]);
    assert_eq!(at("AttributeBegin Translate 1 0 0 AttributeEnd").0, [0.0; 3]);
    assert_eq!(at("Scale -1 1 1 Translate 1 0 0").0, [-1.0, 0.0, 0.0]);
}

/// Transforms are composed in f64, and vertices are rounded once.
#[test]
fn vertices_are_rounded_once() {
    let scene = read(&world(&format!("Translate 1e8 0 0 Translate -1e8 0 0 Translate 0.1 0 0 {TRIANGLE}")));
    assert_eq!(scene.triangles[0][0][0], 0.1_f32 + 0.0);
}

#[test]
fn orientation_flips_once_for_each_cause() {
    let up = |text: &str| normal(&read(&world(&format!("{LIGHT}{text}"))).shapes[0].geometry)[2] > 0.0;
    for shape in [TRIANGLE, PATCH] {
        assert!(up(shape));
        assert!(!up(&format!("ReverseOrientation {shape}")));
        // a reflection in x leaves the normal along +z
        assert!(up(&format!("Scale -1 1 1 {shape}")));
        assert!(!up(&format!("Scale -1 1 1 ReverseOrientation {shape}")));
        assert!(!up(&format!("Scale 1 1 -1 {shape}")));
        assert!(up(&format!("ReverseOrientation ReverseOrientation {shape}")));
        assert!(up(&format!("AttributeBegin ReverseOrientation AttributeEnd {shape}")));
    }
    let flipped = read(&world(&format!("ReverseOrientation {TRIANGLE}"))).triangles[0];
    assert_eq!(normal(&Geometry::Triangle(flipped)), [0.0, 0.0, -1.0]);
    // orientation does not matter for spheres that emit on both sides or not at all
    read(&world("ReverseOrientation AreaLightSource \"diffuse\" \"bool twosided\" true Shape \"sphere\""));
    read(&world("Scale 1 1 -1 Shape \"sphere\""));
}

#[test]
fn a_lens_is_measured_in_camera_space() {
    let lens = |text: &str| read(&format!("{text} WorldBegin")).camera.lens;
    assert_eq!(lens("Camera \"perspective\" \"float focaldistance\" 3"), None);
    assert_eq!(lens("Camera \"perspective\" \"float lensradius\" 0"), None);
    let plain = lens("Camera \"perspective\" \"float lensradius\" .5 \"float focaldistance\" 3");
    assert_eq!(plain, Some(Lens { radius: 0.5, focus: 3.0, unit: 1.0 }));
    // pbrt's default focal distance; a unit of camera space is 4 units of world space
    let scaled = lens("Scale .25 .25 .25 Camera \"perspective\" \"float lensradius\" .5");
    assert_eq!(scaled, Some(Lens { radius: 0.5, focus: 1e6, unit: 4.0 }));
    assert!(
        read("Camera \"perspective\" \"float lensradius\" 1 WorldBegin").warnings.len() == 1,
        "the only warning is that nothing emits light"
    );
}

#[test]
fn shapes_become_what_they_should() {
    let scene = read(&world(&format!("{TRIANGLE}{PATCH}Shape \"sphere\"\n{LIGHT}{TRIANGLE}{PATCH}")));
    assert_eq!(scene.triangles.len(), 3);
    assert_eq!(scene.triangles[1], [[0.0; 3], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0]]);
    assert_eq!(scene.triangles[2], [[0.0; 3], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(scene.shapes[0].geometry, Geometry::Sphere { center: [0.0; 3], radius: 1.0 });
    assert!(scene.shapes[0].emission.is_none());
    assert!(matches!(scene.shapes[1].geometry, Geometry::Triangle(_)));
    assert!(matches!(scene.shapes[2].geometry, Geometry::Parallelogram { .. }));
    assert_eq!(scene.shapes[2].emission, Some(Emission { radiance: [1.0; 3], ..Emission::default() }));
    assert_eq!((scene.materials.len(), scene.pixel_samples), (1, 16));
    assert_eq!(scene.film, FilmSettings { width: 1280, height: 720, diagonal: 35.0, filename: None, place: None });
}

#[test]
fn materials_and_lights_follow_the_graphics_state() {
    let scene = read(&world(&format!(
        "MakeNamedMaterial \"red\" \"string type\" \"diffuse\" \"rgb reflectance\" [1 0 0] # comment\n\
         Material \"diffuse\" \"rgb reflectance\" [.25 .25 .25]\n{TRIANGLE}\
         AttributeBegin NamedMaterial \"red\" AreaLightSource \"diffuse\" \"rgb L\" [1 2 3] \"float scale\" [2] \"bool twosided\" \"true\"\n\
         {TRIANGLE} AttributeEnd\n{TRIANGLE} Material \"diffuse\" {TRIANGLE}"
    )));
    assert_eq!(scene.materials, [[0.25; 3], [1.0, 0.0, 0.0], [0.5; 3]].map(Material::Diffuse));
    assert_eq!(scene.triangle_materials, [0, 0, 2]);
    assert_eq!(scene.shapes[0].material, 1);
    assert_eq!(
        scene.shapes[0].emission,
        Some(Emission { radiance: [2.0, 4.0, 6.0], two_sided: true, ..Emission::default() })
    );
}

#[test]
fn strings_numbers_and_sizes() {
    let scene = read(
        "Film \"rgb\" \"string filename\" [\"a\\\\b \\\"c\\\".exr\"]\r\n \"integer xresolution\" 8 \"integer yresolution\" [ 4 ] \"float diagonal\" 5e1\r\n\
         Sampler \"stratified\" \"integer xsamples\" 3 \"integer ysamples\" 5 Camera \"perspective\" \"float fov\" 3.5e1 WorldBegin",
    );
    assert_eq!(
        scene.film,
        FilmSettings { width: 8, height: 4, diagonal: 50.0, filename: Some("a\\b \"c\".exr".into()), place: None }
    );
    let half = libm::tan(35_f64.to_radians() / 2.0);
    assert_eq!((scene.pixel_samples, scene.camera.screen), (15, Screen::Half(half)));
}
