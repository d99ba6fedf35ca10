//! The thin lens: images of defocused edges compared with their closed form.

use crate::kit::{film, read};
use etendue::{Real, Vec2, f32x8};
use etendue_oracle::tier::is_long;
use etendue_render::camera::{Camera, CameraSample};
use etendue_render::film::compare::Comparison;
use etendue_render::film::image::Picture;
use etendue_render::scene::Scene;
use etendue_render::{Sampler, Settings, Technique, World};
use std::f64::consts::PI;
use std::path::Path;

const SAMPLERS: [Sampler; 5] =
    [Sampler::Independent, Sampler::Stratified, Sampler::Sobol, Sampler::Sobol4d, Sampler::ZOrder];

fn render(scene: &Scene, settings: &Settings) -> Picture {
    Picture::from(&film(&World::new(scene).unwrap(), settings))
}

fn agrees(reference: &Picture, image: &Picture) -> bool {
    let p = Comparison::new(reference, image, 0.0).unwrap().predicted.unwrap();
    println!("{p:?}");
    p.agrees()
}

/// A tile far from the corner of a wide image counts positions from a pixel nearby, from which the rays are the same.
#[test]
fn positions_may_be_counted_from_any_pixel() {
    let size = [10_000, 6000];
    let lens = "\"float lensradius\" .2 \"float focaldistance\" 3";
    for (kind, lens) in [("perspective", ""), ("orthographic", ""), ("perspective", lens)] {
        let scene = read(&format!("LookAt 1 2 3 .5 .2 -1 0 1 0 Camera \"{kind}\" {lens} WorldBegin"));
        let camera = Camera::new(&scene.camera, size[0], size[1]);
        for start in [[4096, 4096], [8192, 0], [0, 4096]] {
            let near = camera.counted_from(start);
            for pixel in [[0, 0], [1000, 1], [1, 1800]] {
                let sample = |place: [u32; 2]| {
                    let [x, y] = place.map(|at| f32x8::splat(at as f32 + 0.5));
                    CameraSample { film: Vec2::new(x, y), lens: Vec2::lit([0.3, -0.6]) }
                };
                let expected = camera.rays(&sample([0, 1].map(|k| start[k] + pixel[k])));
                let (origin, direction) = near.rays(&sample(pixel));
                let off = (origin - expected.0).length() + (direction - expected.1).length();
                assert!(off.lane(0) < 2e-6, "{kind} {lens} {start:?} {pixel:?}: {}", off.lane(0));
            }
        }
    }
}

/// Fraction of the lens that sees the far side of a straight edge; s = 0 is the middle of the blur.
fn fraction(s: f64) -> f64 {
    let s = s.clamp(-1.0, 1.0);
    0.5 + (s.asin() + s * (1.0 - s * s).sqrt()) / PI
}

const SIZE: [u32; 2] = [64, 16];

/// A vertical edge at depth 2, of a light or of a black mesh in front of a light.
fn edge(radius: f64, focus: f64, mesh: bool) -> Scene {
    let light = "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"bool twosided\" true";
    let world = if mesh {
        format!(
            "Shape \"trianglemesh\" \"point3 P\" [0 -9 2 0 9 2 -20 0 2 -5 0 2.01] \"integer indices\" [0 1 2 0 2 3]\n\
             {light} Shape \"bilinearmesh\" \"point3 P\" [-90 -90 8 90 -90 8 -90 90 8 90 90 8]"
        )
    } else {
        format!("{light} Shape \"bilinearmesh\" \"point3 P\" [0 -9 2 20 -9 2 0 9 2 20 9 2]")
    };
    read(&format!(
        "Camera \"perspective\" \"float fov\" 10 \"float lensradius\" {radius} \"float focaldistance\" {focus} WorldBegin\n\
         Material \"diffuse\" \"rgb reflectance\" [0 0 0] {world}"
    ))
}

fn blurred(radius: f64, focus: f64) -> Picture {
    let [width, height] = SIZE.map(|n| n as usize);
    let half = 5.0_f64.to_radians().tan() * width as f64 / height as f64;
    let blur = radius * (1.0 - 2.0 / focus).abs();
    let value = |x: usize| {
        let points = 256;
        let at = |i: usize| {
            let place = (x as f64 + (i as f64 + 0.5) / points as f64) / width as f64;
            fraction(2.0 * half * (2.0 * place - 1.0) / blur.max(1e-12))
        };
        ((0..points).map(at).sum::<f64>() / points as f64) as f32
    };
    let row: Vec<_> = (0..width).map(|x| [value(x); 3]).collect();
    Picture { width, height, radiance: row.repeat(height), variance: None, second: None }
}

/// Edges in front of, behind and in the plane of focus, with every sampler.
#[test]
fn edges_out_of_focus_have_their_closed_form() {
    for (radius, focus) in [(0.5, 1.0), (0.5, 4.0), (0.2, 1.5), (1.0, 2.0)] {
        let reference = blurred(radius, focus);
        for mesh in [false, true] {
            for sampler in SAMPLERS.into_iter().filter(|sampler| is_long() || *sampler == Sampler::Sobol) {
                // four replicates of 2⁶ = 64 samples
                let spp = 256;
                let [width, height] = SIZE;
                let technique = Technique::SolidAngle;
                let settings = Settings { width, height, spp, technique, sampler, seed: 5, ..Settings::DEFAULT };
                let image = render(&edge(radius, focus, mesh), &settings);
                assert!(agrees(&reference, &image), "{sampler:?}, radius {radius}, focus {focus}, mesh {mesh}");
                if sampler == Sampler::Sobol && focus != 2.0 {
                    for (radius, focus) in [(radius * 1.1, focus), (radius, focus * 1.1)] {
                        let wrong = render(&edge(radius, focus, mesh), &settings);
                        assert!(!agrees(&reference, &wrong), "radius {radius}, focus {focus} pass");
                    }
                }
            }
        }
    }
}

/// Multiplying all lengths, including those of the lens, by a power of two does not change the image.
#[test]
fn the_unit_of_length_does_not_matter() {
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/defocus.pbrt")).unwrap();
    let settings = Settings {
        width: 48,
        height: 32,
        spp: 16,
        technique: Technique::SolidAngle,
        sampler: Sampler::Sobol4d,
        seed: 3,
        ..Settings::DEFAULT
    };
    let image = render(&read(&text), &settings);
    for scale in [1024.0, 1.0 / 4096.0] {
        // a unit of camera space is `scale` units of the scene
        let scaled = text
            .replace("LookAt", &format!("Scale {0} {0} {0} LookAt", 1.0 / scale))
            .replace(
                "LookAt 0 0.12 0.5   0.02 0.03 0 ",
                &format!("LookAt 0 {} {}   {} {} 0 ", 0.12 * scale, 0.5 * scale, 0.02 * scale, 0.03 * scale),
            )
            .replace("WorldBegin", &format!("WorldBegin Scale {scale} {scale} {scale}"));
        assert_eq!(image, render(&read(&scaled), &settings), "{scale}");
    }
}
