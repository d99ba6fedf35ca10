//! Tests of cameras, transforms and the graphics state. `builtin` has the built-in scenes, `faulty` faulty input, `meshes` mesh files, `own_scenes`
//! what files of others have, and `text` what their texts share. What lights and shapes mean is in the table of values of the renderer's tests.

mod builtin;
mod cameras;
mod daylight;
mod directed;
mod faulty;
mod lights;
mod meshes;
mod own_scenes;
mod photometry;
mod pictures;
mod portals;
mod subdivision;
mod text;

use crate::pbrt::text::{LIGHT, PATCH, TRIANGLE, read, world};
use etendue_render::scene::{Emission, FilmSettings, Geometry, Lens, Material, Screen, Sphere};

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
            Geometry::Sphere(Sphere { center, radius }) => (center, radius),
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
    assert_eq!(scene.shapes[0].geometry, Geometry::Sphere(Sphere { center: [0.0; 3], radius: 1.0 }));
    assert!(scene.shapes[0].emission.is_none());
    assert!(matches!(scene.shapes[1].geometry, Geometry::Triangle(_)));
    assert!(matches!(scene.shapes[2].geometry, Geometry::Parallelogram(_)));
    assert_eq!(scene.shapes[2].emission, Some(Emission { radiance: [1.0; 3], ..Emission::default() }));
    assert_eq!((scene.materials.len(), scene.pixel_samples), (1, 16));
    assert_eq!(
        scene.film,
        FilmSettings { width: 1280, height: 720, diagonal: 35.0, filename: None, place: None, exposure: 1.0 }
    );
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
        FilmSettings {
            width: 8,
            height: 4,
            diagonal: 50.0,
            filename: Some("a\\b \"c\".exr".into()),
            place: None,
            exposure: 1.0
        }
    );
    let half = libm::tan(35_f64.to_radians() / 2.0);
    assert_eq!((scene.pixel_samples, scene.camera.screen), (15, Screen::Half(half)));
}
