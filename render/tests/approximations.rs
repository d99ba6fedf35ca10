//! How far what the list calls approximated is off, against closed forms and sums in double precision; the list has these figures.

use crate::kit::{pixel, read, world};
use etendue_oracle::{V3, cross, direct, dot, length, sub, unit};
use etendue_render::Technique;
use etendue_render::scene::Geometry;
use etendue_scene::list::PBRT;
use std::f64::consts::{PI, TAU};

/// Checks that the list says of a row that it is off by this much, in percent.
fn says(name: &str, kind: &str, what: &str, off: f64, shown: &str) {
    let note = PBRT.entry(name, kind).unwrap().note;
    println!("{name} {kind:?}, {what}: {:+.2} %, listed as {shown}", 100.0 * off);
    assert!(note.contains(shown), "{kind}: {note:?} lacks {shown:?}");
    let listed: f64 = shown.split(' ').next().unwrap().parse().unwrap();
    assert!((100.0 * off.abs() - listed).abs() < 0.1 * listed + 0.05, "{kind}, {what}: {off}, listed as {shown}");
}

/// Irradiance at the origin of a floor whose normal is +z by an emitter of radiance 1 over it, a sum over the directions to points with normals.
fn irradiance(points: impl Iterator<Item = (V3, V3)>, area: f64) -> f64 {
    points.map(|(p, n)| area * unit(p)[2].max(0.0) * (-dot(unit(p), n)).max(0.0) / dot(p, p)).sum()
}

/// A cylinder is a prism: its irradiance by Lambert's formula for each of its triangles.
#[test]
fn cylinders_are_nearly_prisms() {
    let mut worst = 0.0_f64;
    for (distance, turn) in [1.5, 3.0, 9.0].into_iter().flat_map(|d| [0.0, 1.0, 2.8].map(|turn| (d, turn))) {
        let text = format!(
            "Camera \"perspective\" WorldBegin AreaLightSource \"diffuse\" Translate {distance} 0 3 Rotate {turn} 0 0 1\n\
             Shape \"cylinder\" \"float zmin\" -1 \"float zmax\" 1"
        );
        let triangle = |geometry: &Geometry| {
            let Geometry::Triangle(corners) = geometry else { panic!("{geometry:?}") };
            let [a, b, c] = corners.map(|p| p.map(f64::from));
            let edge = |p: V3, q: V3| {
                let across = cross(p, q);
                (length(across).atan2(dot(p, q)) / length(across)) * across[2]
            };
            let faces = dot(cross(sub(b, a), sub(c, a)), a) < 0.0;
            if faces { 0.5 * (edge(a, b) + edge(b, c) + edge(c, a)).abs() } else { 0.0 }
        };
        let seen: f64 = read(&text).shapes.iter().map(|shape| triangle(&shape.geometry)).sum();
        let (around, up) = (4000, 400);
        let point = |k: usize| {
            let (sin, cos) = (TAU * ((k % around) as f64 + 0.5) / around as f64).sin_cos();
            ([distance + cos, sin, 2.0 + 2.0 * ((k / around) as f64 + 0.5) / up as f64], [cos, sin, 0.0])
        };
        let right = irradiance((0..around * up).map(point), TAU * 2.0 / (around * up) as f64);
        worst = worst.max((seen / right - 1.0).abs());
    }
    says("Shape", "cylinder", "irradiance by it", worst, "0.3 %");
}

/// Fresnel's reflectance of a dielectric of index 1.5.
fn fresnel(angle: f64) -> f64 {
    direct::fresnel(angle.cos(), 1.5, 0.0)
}

/// What a pane lets through of a sun at an angle, beside the series of both sides.
#[test]
fn panes_reflect_as_at_normal_incidence() {
    for (degrees, shown) in [(45.0_f64, "2 % more"), (60.0, "10 % at 60°")] {
        let angle = degrees.to_radians();
        let scene = |pane: &str| {
            world(&format!(
                "LookAt 0 0 .5 0 0 0 .1 .7 .3 Camera \"perspective\" \"float fov\" 1e-4 WorldBegin\n\
                 LightSource \"distant\" \"point3 from\" [{} 0 {}] \"point3 to\" [0 0 0]\n\
                 Shape \"bilinearmesh\" \"point3 P\" [-9 -9 0  9 -9 0  -9 9 0  9 9 0]\n{pane}",
                angle.sin(),
                angle.cos()
            ))
        };
        let pane = "Material \"thindielectric\" Shape \"bilinearmesh\" \"point3 P\" [-9 -9 1  9 -9 1  -9 9 1  9 9 1]";
        let [[with, _], [without, _]] =
            [pane, ""].map(|pane| pixel(&scene(pane), Technique::SolidAngle, 1 << 18).map(|value| value[1]));
        let right = (1.0 - fresnel(angle)) / (1.0 + fresnel(angle));
        says(
            "Material",
            "thindielectric",
            &format!("light through it at {degrees}°"),
            with / without / right - 1.0,
            shown,
        );
    }
}

/// pbrt-v3's plastic at normal incidence, lit at an angle: its own roughness and no dimming of what is below.
#[test]
fn older_plastic_is_nearly_a_coat() {
    let mut worst = 0.0_f64;
    for degrees in [0.0_f64, 20.0, 45.0, 70.0] {
        let angle = degrees.to_radians();
        let text = format!(
            "LookAt 0 0 .5 0 0 0 .1 .7 .3 Camera \"perspective\" \"float fov\" 1e-4 WorldBegin\n\
             LightSource \"distant\" \"point3 from\" [{} 0 {}] \"point3 to\" [0 0 0]\nMaterial \"plastic\"\n\
             Shape \"bilinearmesh\" \"point3 P\" [-9 -9 0  9 -9 0  -9 9 0  9 9 0]",
            angle.sin(),
            angle.cos()
        );
        let [seen, _] = pixel(&world(&text), Technique::SolidAngle, 16);
        let x = 0.1_f64.ln();
        let alpha = 1.62142 + x * (0.819955 + x * (0.1734 + x * (0.0171201 + x * 0.000640711)));
        let square = (0.5 * angle).cos().powi(2);
        let density = alpha * alpha / (PI * (square * (alpha * alpha - 1.0) + 1.0).powi(2));
        let masked = 1.0 + 0.5 * ((1.0 + (alpha * angle.tan()).powi(2)).sqrt() - 1.0);
        let shine = 0.25 * fresnel(0.5 * angle) * density / masked / 4.0;
        let right = 0.25 / PI * angle.cos() + shine;
        println!("plastic at {degrees}: {} of {right}", seen[1]);
        worst = worst.max((seen[1] / right - 1.0).abs());
    }
    says("Material", "plastic", "seen from above", worst, "4 %");
}
