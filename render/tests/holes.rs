//! Instances against their copies, rough surfaces beside diffuse ones, and boxes with holes; `attack` has veils and what is behind them.

use crate::kit::{film, narrow, read, settings, sum, world};
use etendue_render::film::compare::LIMIT;
use etendue_render::scene::{Instance, Scene};
use etendue_render::{Technique, World};
use std::f64::consts::TAU;
use std::sync::Arc;

const TECHNIQUES: [Technique; 4] =
    [Technique::SolidAngle, Technique::MisPower, Technique::Analytic, Technique::CosineHemisphere];

/// Mean and standard error of the green channel of the only pixel.
fn pixel(world: &World, technique: Technique, spp: u32) -> (f64, f64) {
    let [mean, variance] = sum(&film(world, &settings(technique, 1, spp)));
    (mean, variance.sqrt())
}

fn seen(camera: &str, scene: &str) -> World {
    world(&narrow(camera, scene))
}

fn square(size: f64, height: f64, parameters: &str) -> String {
    let (a, h) = (size, height);
    format!(
        "Shape \"trianglemesh\" \"point3 P\" [-{a} {h} {a}  {a} {h} {a}  {a} {h} -{a}  -{a} {h} -{a}] \
         \"point2 uv\" [0 0  1 0  1 1  0 1] \"integer indices\" [0 1 2  0 2 3] {parameters}\n"
    )
}

const LAMP: &str = "AttributeBegin Material \"diffuse\" \"rgb reflectance\" [0 0 0] AreaLightSource \"diffuse\" \"rgb L\" [5 5 5] \
    Shape \"bilinearmesh\" \"point3 P\" [-.5 3 -.5  .5 3 -.5  -.5 3 .5  .5 3 .5] AttributeEnd\n";

/// Beside rough surfaces, `analytic` combines light and BSDF on these alone: under a light so large that each has a great weight, all
/// floors have the brightness that the BSDF finds by chance.
#[test]
fn only_rough_surfaces_combine_light_and_bsdf() {
    let lamp = LAMP.replace("-.5 3 -.5  .5 3 -.5  -.5 3 .5  .5 3 .5", "-6 1 -6  6 1 -6  -6 1 6  6 1 6");
    assert_ne!(lamp, LAMP);
    let ball =
        "AttributeBegin Translate 40 0 0 Material \"conductor\" \"float roughness\" .3 Shape \"sphere\" AttributeEnd\n";
    let bent = "\"normal N\" [-.1 1 0  .1 1 0  .1 1 0  -.1 1 0]";
    for (material, parameters) in [
        ("\"diffuse\"", ""),
        ("\"diffuse\"", bent),
        ("\"conductor\" \"float roughness\" .5", ""),
        ("\"coateddiffuse\" \"float roughness\" .3", bent),
    ] {
        let world = seen("2 .6 0", &format!("{lamp}{ball}Material {material}\n{}", square(9.0, 0.0, parameters)));
        let (truth, more) = pixel(&world, Technique::Brdf, 1 << 14);
        assert!(truth > 0.1, "{material}: {truth}");
        for technique in [Technique::Analytic, Technique::MisPower] {
            let (mean, error) = pixel(&world, technique, 1 << 14);
            let error = error.hypot(more).max(2e-4 * truth);
            assert!((mean - truth).abs() < LIMIT * error, "{technique:?} {material}: {mean}, {truth} ± {error}");
            assert!(error < 0.01 * truth, "{technique:?} {material}: {error} of {truth}");
        }
    }
}

/// A box with holes is no body that certificates know: light passes both of its walls by chance.
#[test]
fn boxes_with_holes_are_no_bodies() {
    let floor = square(9.0, 0.0, "");
    let corners =
        (0..8).map(|k| format!("{} {} {} ", (k & 1) * 4 - 2, 1.0 + f64::from(k >> 1 & 1) * 0.5, (k >> 2) * 4 - 2));
    let corners = corners.collect::<String>();
    let mesh = |parameters: &str, indices: &str| {
        format!("Shape \"trianglemesh\" \"point3 P\" [{corners}] {parameters} \"integer indices\" [{indices}]\n")
    };
    let (holes, level) = ("\"float alpha\" .4", "0 4 5 0 5 1  2 3 7 2 7 6");
    let upright = "0 1 3 0 3 2  4 6 7 4 7 5  0 2 6 0 6 4  1 5 7 1 7 3";
    // all of it, or only what is level
    let cages = ["", holes].map(|sides| format!("{}{}", mesh(holes, level), mesh(sides, upright)));
    // half of the upper side is solid, beside the middle of the lamp
    let (below, above) = (mesh(holes, "0 4 5 0 5 1"), mesh(holes, "2 3 7") + &mesh("", "2 7 6"));
    let half = format!("{below}{above}{}", mesh("", upright));
    for technique in TECHNIQUES {
        let seen = |cage: &str| pixel(&seen("5 .5 0", &format!("{LAMP}{floor}{cage}")), technique, 1 << 14);
        let (open, more) = seen("");
        for cage in &cages {
            let (mean, error) = seen(cage);
            let (wanted, error) = (0.36 * open, error.hypot(0.36 * more));
            assert!((mean - wanted).abs() < LIMIT * error, "{technique:?}: {mean} of {wanted}, error {error}");
        }
        // the lamp is symmetric about the middle
        let ((mean, error), wanted) = (seen(&half), 0.18 * open);
        let error = error.hypot(0.18 * more);
        assert!((mean - wanted).abs() < LIMIT * error, "{technique:?}: half {mean} of {wanted}, error {error}");
    }
}

/// The same scene without instances.
fn expanded(scene: &Scene) -> Scene {
    let mut own = scene.clone();
    let mut details = (*scene.details).clone();
    let first = scene.objects[0].start;
    own.triangles.truncate(first);
    own.triangle_materials.truncate(first);
    details.of_triangles.truncate(first);
    for Instance { object, to_world } in &scene.instances {
        let rows = to_world.cofactors();
        for triangle in scene.objects[*object as usize].clone() {
            own.triangles.push(scene.triangles[triangle].map(|p| to_world.point(p.into()).into()));
            own.triangle_materials.push(scene.triangle_materials[triangle]);
            let mut corners = *scene.details.of(triangle as u32).unwrap();
            corners.normals = corners.normals.map(|n| {
                let [x, y, z] = rows.map(|row| row.dot(n.map(f64::from).into()));
                let length = (x * x + y * y + z * z).sqrt();
                if length > 0.0 { [x, y, z].map(|x| (x / length) as f32) } else { n }
            });
            details.of_triangles.push(details.corners.len() as u32);
            details.corners.push(corners);
        }
    }
    (own.objects, own.instances, own.details) = (Vec::new(), Vec::new(), Arc::new(details));
    own
}

/// A sphere without its poles in n × n squares, with normals and texture coordinates.
fn ball(n: usize) -> String {
    let [mut points, mut uvs, mut indices] = [String::new(), String::new(), String::new()];
    for (i, j) in (0..=n).flat_map(|j| (0..=n).map(move |i| (i, j))) {
        let [u, v] = [i, j].map(|k| k as f64 / n as f64);
        let ((sin, cos), (r, z)) = ((TAU * u).sin_cos(), (0.1 + 2.9 * v).sin_cos());
        points += &format!("{} {} {z} ", r * cos, r * sin);
        uvs += &format!("{u} {v} ");
    }
    for (i, j) in (0..n).flat_map(|j| (0..n).map(move |i| (i, j))) {
        let [a, b] = [j, j + 1].map(|j| j * (n + 1) + i);
        indices += &format!("{a} {} {b} {} {} {b} ", a + 1, a + 1, b + 1);
    }
    format!(
        "Shape \"trianglemesh\" \"point3 P\" [{points}] \"normal N\" [{points}] \"point2 uv\" [{uvs}] \"integer indices\" [{indices}]"
    )
}

/// Objects that have too many triangles to be copied give the image of their copies: smooth and textured ones, turned, stretched and
/// mirrored, with holes.
#[test]
fn instances_look_like_copies() {
    let ball = ball(128);
    let mut text = format!(
        "LookAt 0 4 9 0 .5 0 0 1 0 Camera \"perspective\" \"float fov\" 40 WorldBegin\n{LAMP}\
         Texture \"dots\" \"spectrum\" \"checkerboard\" \"float uscale\" 6 \"float vscale\" 6 \
           \"rgb tex1\" [.9 .2 .1] \"rgb tex2\" [.1 .3 .8]\n\
         Texture \"holes\" \"float\" \"checkerboard\" \"float uscale\" 5 \"float vscale\" 3 \"float tex1\" 1 \"float tex2\" 0\n\
         {}ObjectBegin \"a\" Material \"diffuse\" \"texture reflectance\" \"dots\"\n{ball}\n\
         Translate 0 1.2 0 {} ObjectEnd\n",
        square(9.0, 0.0, ""),
        square(0.8, 0.0, "\"texture alpha\" \"holes\""),
    );
    let count = 40;
    for i in 0..count {
        let (x, z) = (f64::from(i % 8) - 3.5, f64::from(i / 8) - 2.0);
        let mirror = if i % 3 == 0 { "Scale -1 1 1" } else { "" };
        text += &format!(
            "AttributeBegin Translate {x} {} {z} Rotate {} 1 .3 .2 {mirror} Scale .4 {} .3 ObjectInstance \"a\" AttributeEnd\n",
            0.3 + 0.02 * f64::from(i),
            37 * i,
            0.2 + 0.01 * f64::from(i),
        );
    }
    let scene = read(&text);
    assert_eq!((scene.instances.len(), scene.objects.len(), scene.triangles.len()), (count as usize, 1, 2 + 32_770));
    let copies = expanded(&scene);
    assert_eq!(copies.triangles.len(), 2 + 32_770 * count as usize);
    let [world, copies] = [&scene, &copies].map(|scene| World::new(scene).unwrap());
    assert!(world.bytes() * 8 < copies.bytes(), "{} and {} bytes", world.bytes(), copies.bytes());
    for technique in [Technique::SolidAngle, Technique::MisPower, Technique::Analytic] {
        let [one, other] = [&world, &copies].map(|world| film(world, &settings(technique, 48, 4)));
        let lit = one.pixels.iter().filter(|pixel| pixel.mean[0] > 0.0).count();
        assert!(lit > 1000, "{technique:?}: {lit} of 2304 pixels are lit");
        let differ = one.pixels.iter().zip(&other.pixels).filter(|(a, b)| a.mean != b.mean).count();
        assert_eq!(differ, 0, "{technique:?}: {differ} of 2304 pixels differ");
    }
}
