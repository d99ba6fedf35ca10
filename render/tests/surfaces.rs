//! Mirrors, textures and smooth normals of surfaces, against closed forms.

use crate::kit::{ALBEDO, BLACK, MATT, exactly, film, list, narrow, pixel, settings, world};
use etendue_oracle::{V3, along, cross, dot, unit};
use etendue_render::film::compare::Comparison;
use etendue_render::film::image::Picture;
use etendue_render::scene::texture::Texture;
use etendue_render::scene::{Material, Varying};
use etendue_render::{Sampler, Settings, Technique, World};
use std::f64::consts::PI;

/// What is seen of the origin.
fn seen(camera: &str, scene: &str) -> World {
    world(&narrow(camera, scene))
}

/// A camera sees in a mirror floor what its mirror image sees of the scene, upside down.
#[test]
fn a_mirror_shows_the_mirror_image() {
    let objects = format!(
        "AttributeBegin {BLACK} AreaLightSource \"diffuse\" \"rgb L\" [5 4 3] \
        Shape \"bilinearmesh\" \"point3 P\" [-1 3 -1  1 3 -1  -1 3 1  1 3 1] AttributeEnd\n\
        AttributeBegin Translate .5 1 0 Material \"diffuse\" \"rgb reflectance\" [.7 .2 .7] \
        Shape \"sphere\" \"float radius\" .6 AttributeEnd\n\
        LightSource \"point\" \"point3 from\" [-2 1 2] \"rgb I\" [3 3 9]\n\
        Shape \"trianglemesh\" \"point3 P\" [-1.5 .5 -.5  -.2 .5 -.5  -.8 2 .3]\n"
    );
    let view =
        |camera: &str, up: &str| format!("LookAt {camera} {up} Camera \"perspective\" \"float fov\" 40 WorldBegin\n");
    let floor = "Material \"mirror\" \"rgb Kr\" [1 1 1] Shape \"bilinearmesh\" \"point3 P\" [-90 0 90  90 0 90  -90 0 -90  90 0 -90]\n";
    let above = world(&format!("{}{objects}{floor}", view("0 2 5  0 -1.5 0", "0 1 0")));
    let below = world(&format!("{}{objects}", view("0 -2 5  0 1.5 0", "0 1 0")));
    for technique in [Technique::SolidAngle, Technique::Area, Technique::MisPower, Technique::Brdf] {
        let [a, b] = [(&above, 3), (&below, 4)]
            .map(|(world, seed)| Picture::from(&film(world, &Settings { seed, ..settings(technique, 48, 128) })));
        let flip = |rows: &[[f32; 3]]| rows.chunks(48).rev().flatten().copied().collect::<Vec<_>>();
        let b = Picture { radiance: flip(&b.radiance), variance: b.variance.as_deref().map(flip), ..b };
        let p = Comparison::new(&b, &a, 0.0).unwrap().predicted.unwrap();
        assert!(p.agrees(), "{technique:?}: {p:?}");
        assert!(a.radiance.iter().flatten().any(|&x| x > 4.5), "the light is not in view");
        // the check rejects an image that is upside down
        let p = Comparison::new(&Picture { radiance: flip(&b.radiance), ..b.clone() }, &a, 0.0).unwrap();
        assert!(p.predicted.unwrap().z_mse > 20.0);
    }
}

/// Between two facing mirrors, a light is seen after exactly `depth` reflections, and each attenuates it by Kr.
#[test]
fn chains_of_mirrors_end_at_their_depth() {
    let mirrors = "Material \"mirror\" \"rgb Kr\" [.5 .5 .5]\n\
        Shape \"bilinearmesh\" \"point3 P\" [-50 -2 9  50 -2 9  -50 -2 -9  50 -2 -9]\n\
        Shape \"bilinearmesh\" \"point3 P\" [-50 2 9  50 2 9  -50 2 -9  50 2 -9]\n";
    // in the plane z = 0, a ray from (−18, 0) towards (−16, −2) runs at 45 degrees and is reflected every 4 units of x
    for (depth, x) in [(1, -14.0), (2, -10.0), (3, -6.0), (5, 2.0)] {
        // midway between two reflections, at y = 0
        let light = format!(
            "AttributeBegin {BLACK} AreaLightSource \"diffuse\" \"rgb L\" [8 8 8] \
             Translate {x} 0 0 Shape \"sphere\" \"float radius\" .2 AttributeEnd\n"
        );
        let text = format!(
            "LookAt -18 0 0 -17 -1 0 0 0 1 Camera \"perspective\" \"float fov\" 1e-3 WorldBegin\n{mirrors}{light}"
        );
        let world = world(&text);
        for allowed in 0..8 {
            let settings =
                Settings { depth: allowed, sampler: Sampler::Stratified, ..settings(Technique::SolidAngle, 2, 11) };
            let (film, rays) = world.render(&settings, &|_| ());
            let expected = if allowed >= depth { 8.0 * 0.5_f32.powi(depth as i32) } else { 0.0 };
            let seen = film.pixels[3].mean;
            assert!((seen[1] - expected).abs() < 1e-5, "{depth} mirrors, {allowed} allowed: {seen:?}");
            assert_eq!(rays.mirror, 44 * u64::from(allowed.min(depth)));
        }
    }
}

/// Spheres keep their own colour if all triangles share one that comes later in the file.
#[test]
fn materials_are_not_mixed_up() {
    let scene = "Material \"diffuse\" \"rgb reflectance\" [.8 .5 .2] Shape \"sphere\" \"float radius\" 1e-3\n\
        Material \"diffuse\" \"rgb reflectance\" [0 1 0] Shape \"trianglemesh\" \"point3 P\" [-9 -1 9  9 -1 9  0 -1 -9]\n\
        LightSource \"distant\" \"point3 from\" [0 1 0] \"point3 to\" [0 0 0]";
    let [mean, _] = pixel(&seen("0 5 1e-9", scene), Technique::SolidAngle, 64);
    for (k, albedo) in ALBEDO.into_iter().enumerate() {
        assert!((mean[k] - albedo / PI).abs() < 0.02 * albedo, "{mean:?}");
    }
}

/// A triangle around the origin in the plane y = 0, and the weights of its corners there: areas over the whole area.
const CORNERS: [V3; 3] = [[-3.0, 0.0, 2.0], [1.0, 0.0, -5.0], [4.0, 0.0, 1.0]];
fn weights() -> V3 {
    let area = |a: V3, b: V3| cross(a, b)[1];
    let [a, b, c] = CORNERS;
    let parts = [area(b, c), area(c, a), area(a, b)];
    parts.map(|part| part / parts.iter().sum::<f64>())
}
fn mesh(parameters: &str) -> String {
    format!("Shape \"trianglemesh\" \"point3 P\" [{}] {parameters}\n", list(&CORNERS))
}
fn sun(to: V3) -> String {
    let [x, y, z] = to;
    format!("LightSource \"distant\" \"point3 from\" [{x} {y} {z}] \"point3 to\" [0 0 0]\n")
}

/// A checkerboard of n × n squares over u shows whether the interpolated u is in an even one: the digits of each corner's weight.
#[test]
fn textures_are_where_their_coordinates_say() {
    for (corner, weight) in weights().into_iter().enumerate() {
        for n in 2..40 {
            let uv: Vec<_> = (0..3).map(|k| if k == corner { "1 0.3" } else { "0 0.3" }).collect();
            let text = format!(
                "{}Texture \"b\" \"spectrum\" \"checkerboard\" \"float uscale\" {n} \"rgb tex1\" [.8 .5 .2] \"rgb tex2\" [.1 .2 .3]\n\
                 Material \"diffuse\" \"texture reflectance\" \"b\"\n{}",
                sun([0.0, 1.0, 0.0]),
                mesh(&format!("\"point2 uv\" [{}]", uv.join(" ")))
            );
            let place = weight * f64::from(n);
            if (place - place.round()).abs() < 1e-3 {
                continue;
            }
            let albedo = if place.floor() % 2.0 == 0.0 { ALBEDO } else { [0.1, 0.2, 0.3] };
            let [mean, _] = pixel(&seen("1 5 2", &text), Technique::Auto, 8);
            for k in 0..3 {
                assert!((mean[k] * PI / albedo[k] - 1.0).abs() < 1e-5, "corner {corner}, {n} squares: {mean:?}");
            }
        }
    }
}

/// Interpolated normals by every technique: the cosine is that of the smooth surface, and no light passes through either surface.
#[test]
fn smooth_normals_are_interpolated() {
    let bent: [V3; 3] = [[0.3, 1.0, 0.1], [-0.4, 1.0, 0.6], [0.2, 1.0, -0.7]];
    // more than 90° apart, as those of a smooth cube or octahedron are
    let apart: [V3; 3] = [[-0.98, 0.196, 0.0], [0.7, 0.3, -0.6], [0.2, 0.2, 0.95]];
    let cosine = |to: V3, normals: [V3; 3]| {
        let mixed = (0..3).fold([0.0; 3], |sum, i| along(sum, unit(normals[i]), weights()[i]));
        dot(unit(to), unit(mixed))
    };
    let (up, aside): (V3, V3) = ([0.0, 1.0, 0.0], [1.0, 1.0, 0.5]);
    let turned = |v: V3| v.map(|x| -x);
    // one that faces away from the viewer is turned until its cosine to him is 0.01
    let (away, view) = (unit([-1.0, 1.0, 0.0]), unit([5.0, 1.0, 0.0]));
    let facing = unit(along(away, view, 0.01 - dot(away, view)));
    for (what, camera, to, normals, truth) in [
        ("from above", "1 5 2", up, bent, cosine(up, bent)),
        ("from aside", "1 5 2", aside, bent, cosine(aside, bent)),
        ("from the horizon", "1 5 2", [-3.0, 1.0, 1.0], bent, cosine([-3.0, 1.0, 1.0], bent)),
        ("far apart", "1 5 2", up, apart, cosine(up, apart)),
        ("whichever way they point in the file", "1 5 2", aside, bent.map(turned), cosine(aside, bent)),
        ("from below", "-1 -5 -2", turned(aside), bent, cosine(aside, bent)),
        ("away from the viewer", "5 1 0", up, [away; 3], facing[1]),
        // tilted so far that the sun is above one surface alone
        ("above the smooth surface", "1 5 2", [3.0, -0.2, 0.0], [[1.0, 1.0, 0.0]; 3], 0.0),
        ("above the flat surface", "1 5 2", [3.0, 0.2, 0.0], [[-1.0, 1.0, 0.0]; 3], 0.0),
    ] {
        println!("{what}: {truth}");
        let surface = mesh(&format!("\"normal N\" [{}]", list(&normals)));
        exactly(&seen(camera, &format!("{}{MATT}{surface}", sun(to))), [truth; 3]);
    }
}

/// A quarter of a metal, by the parameters of glTF: F₀ is between 0.04 and the base, and all is reflected at grazing incidence.
#[test]
fn metallic_materials_have_the_parameters_of_gltf() {
    let [base, metallic, roughness] = [0.5, 0.25, 0.6].map(Texture::number);
    let (diffuse, specular) = ([0.375; 3], [0.04 + 0.46 * 0.25; 3]);
    let roughness_squared = (0.6 * 0.6_f32).into();
    let expected =
        Material::Glossy { diffuse, specular, grazing: [1.0; 3], roughness: roughness_squared, greatest: false };
    assert_eq!(Varying::Metallic { base, metallic, roughness }.constant(), Some(expected));
}

/// A smooth mirror does not reflect what is below its flat surface.
#[test]
fn smooth_mirrors_do_not_see_through_themselves() {
    let mirror = |n: &str| {
        let scene =
            format!("LightSource \"infinite\"\nMaterial \"mirror\"\n{}", mesh(&format!("\"normal N\" [{n} {n} {n}]")));
        pixel(&seen("5 1 0", &scene), Technique::Auto, 8)[0]
    };
    // the mirror image of the direction to the viewer, (5, 1, 0), is (−4.47, 2.45, 0) and (−4.95, −1.20, 0) with these normals
    assert!((mirror(".05 1 0")[0] - 0.9).abs() < 1e-5, "{:?}", mirror(".05 1 0"));
    assert_eq!(mirror("-.19 .98 0"), [0.0; 3]);
}
