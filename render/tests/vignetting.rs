//! Vignetting of a lens in a barrel, as seen from points of the film.

use crate::kit::read;
use etendue_render::camera::{Barrel, Camera, Pupil, ThinLens};
use etendue_render::film::Film;
use etendue_render::film::compare::{Comparison, LIMIT};
use etendue_render::film::image::Picture;
use etendue_render::{Sampler, Settings, Technique, World, scene};
use std::f64::consts::PI;

const SIZE: [u32; 2] = [48, 32];

fn scene(lens: &str, world: &str) -> scene::Scene {
    let text = format!(
        "Camera \"perspective\" \"float fov\" 40 {lens} WorldBegin Material \"diffuse\" \"rgb reflectance\" [0 0 0]\n\
         AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"bool twosided\" true {world}"
    );
    read(&text)
}

fn render(scene: &scene::Scene, camera: &Camera, [width, height]: [u32; 2], spp: u32, sampler: Sampler) -> Film {
    let settings = Settings {
        width,
        height,
        spp,
        technique: Technique::SolidAngle,
        sampler,
        seed: 4,
        depth: 1,
        ..Settings::DEFAULT
    };
    World::new(scene).unwrap().view_through(camera, &settings).image(&|_| ()).0
}

fn lens_of(scene: &scene::Scene) -> (ThinLens, scene::Lens) {
    let lens = scene.camera.lens.unwrap();
    (ThinLens::new(&scene.camera, &lens, SIZE[0], SIZE[1]), lens)
}

/// Under uniform radiance 1, the radiance of a pixel is the open fraction of the lens.
#[test]
fn vignetting_has_its_closed_form() {
    let [width, height] = SIZE;
    // length and radius of the barrel, in radii of the lens, and distance of the plane of focus
    for (length, radius, focus) in
        [(2.0, 1.15, 100.0), (5.0, 0.8, 100.0), (1.0, 2.0, 2.0), (3.0, 1.2, 2.5), (3.0, 0.5, 0.02), (0.0, 0.7, 1.0)]
    {
        let scene = scene(
            &format!("\"float lensradius\" .01 \"float focaldistance\" {focus}"),
            "Shape \"sphere\" \"float radius\" 1000",
        );
        let (thin, lens) = lens_of(&scene);
        let barrel = Barrel::new(&scene.camera, &lens, [length * 0.01, radius * 0.01], width, height);
        for sampler in [Sampler::Independent, Sampler::Sobol4d] {
            let film = render(&scene, &Camera::Barrel(thin, barrel), SIZE, 256, sampler);
            let nodes = 8;
            let at = |i: usize, n: usize| (i as f64) + (n as f64 + 0.5) / f64::from(nodes);
            let part = |i: usize| {
                let (x, y) = (i % width as usize, i / width as usize);
                let sum: f64 = (0..64).map(|n| barrel.open_part(at(x, n % 8), at(y, n / 8))).sum();
                [(sum / 64.0) as f32; 3]
            };
            let size = SIZE.map(|n| n as usize);
            let image = Picture::from(&film);
            let reference =
                Picture { radiance: (0..size[0] * size[1]).map(part).collect(), variance: None, ..image.clone() };
            let p = Comparison::new(&reference, &image, 0.0).unwrap().predicted.unwrap();
            println!("{length} {radius} {focus} {sampler:?}: {p:?}");
            assert!(p.agrees(), "{length} {radius} {focus} {sampler:?}: {p:?}");
        }
    }
}

#[test]
fn open_parts_that_are_known() {
    let scene = scene("\"float lensradius\" .01 \"float focaldistance\" 1", "Shape \"sphere\" \"float radius\" 1000");
    let (_, lens) = lens_of(&scene);
    let part = |length: f64, radius: f64, x: f64, y: f64| {
        Barrel::new(&scene.camera, &lens, [length * 0.01, radius * 0.01], SIZE[0], SIZE[1]).open_part(x, y)
    };
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-6, "{a} {b}");
    // in the middle of the film, the narrower of lens and rim counts; a wide rim blocks nothing
    close(part(2.0, 3.0, 24.0, 16.0), 1.0);
    close(part(0.0, 0.5, 24.0, 16.0), 0.25);
    close(part(0.0, 0.5, 3.0, 30.0), 0.25);
    close(part(2.0, 9.0, 0.0, 0.0), 1.0);
    // with a very long barrel, the corner sees nothing
    close(part(90.0, 1.0, 0.0, 0.0), 0.0);
    // two equal disks whose centres are one radius apart share 2/3 − √3/(2π)
    let slope = |x: f64| (x - 24.0) / 16.0 * 20.0_f64.to_radians().tan();
    let length = 1.0 / (slope(36.0) + 0.01);
    close(part(length, 1.0 - 0.01 * length, 36.0, 16.0), 2.0 / 3.0 - 3.0_f64.sqrt() / (2.0 * PI));
}

/// The sum over a view of the lens is what the pixel receives.
#[test]
fn a_view_has_the_open_part_and_nothing_else() {
    let scene = scene("\"float lensradius\" .01 \"float focaldistance\" 1", "Shape \"sphere\" \"float radius\" 1000");
    let (thin, lens) = lens_of(&scene);
    let barrel = Barrel::new(&scene.camera, &lens, [0.03, 0.012], SIZE[0], SIZE[1]);
    for film in [[24.0, 16.0], [40.0, 16.0], [3.0, 29.0], [47.5, 0.5]] {
        for barrel in [None, Some(barrel)] {
            let extent = 1.25;
            let camera = Camera::Pupil(Pupil::new(thin, barrel, film, 64, extent));
            let view = render(&scene, &camera, [64, 64], 64, Sampler::Independent);
            let area = 4.0 * extent * extent / PI;
            let n = view.pixels.len() as f64;
            let open = view.mean()[0] * area;
            let error = view.pixels.iter().map(|p| f64::from(p.variance[0])).sum::<f64>().sqrt() / n * area;
            let truth = barrel.map_or(1.0, |barrel| barrel.open_part(film[0], film[1]));
            assert!((open - truth).abs() < LIMIT * error, "{film:?}: {open} ± {error}, expected {truth}");
            assert!(error < 2e-3);
            // everything outside the lens is black
            let corner = view.pixels[0].mean;
            assert_eq!(corner, [0.0; 3]);
        }
    }
}

/// In focus, the whole lens shows one point; out of focus, each of its points shows a different one.
#[test]
fn a_view_is_uniform_in_focus_and_a_picture_out_of_focus() {
    // a light for x > 0 at depth 2
    let world = "Shape \"bilinearmesh\" \"point3 P\" [0 -9 2 20 -9 2 0 9 2 20 9 2]";
    let half = 20.0_f64.to_radians().tan();
    for (focus, films) in
        [(2.0, [20.0, 23.0, 25.0, 30.0]), (0.5, [23.0, 24.0, 24.5, 25.0]), (8.0, [23.0, 24.0, 24.5, 25.0])]
    {
        let scene = scene(&format!("\"float lensradius\" .1 \"float focaldistance\" {focus}"), world);
        let (thin, _) = lens_of(&scene);
        for x in films {
            let camera = Camera::Pupil(Pupil::new(thin, None, [x, 11.0], 64, 1.0));
            let view = render(&scene, &camera, [64, 64], 16, Sampler::Stratified);
            // position of the ray from ℓ at depth 2
            let at = |lens: f64| 2.0 * (x - 24.0) / 16.0 * half + 0.1 * lens * (1.0 - 2.0 / focus);
            let mut lit = 0;
            for (i, p) in view.pixels.iter().enumerate() {
                let edge = |k: usize| (k as f64) / 32.0 - 1.0;
                let [left, right] = [edge(i % 64), edge(i % 64 + 1)];
                let farthest = [edge(i / 64), edge(i / 64 + 1)].map(f64::abs).into_iter().fold(0.0, f64::max);
                if left.abs().max(right.abs()).hypot(farthest) > 1.0 {
                    continue;
                }
                let [a, b] = [at(left), at(right)].map(|place| if place.abs() < 1e-6 { 0.0 } else { place.signum() });
                if a * b > 0.0 {
                    assert_eq!(p.mean[0], if a > 0.0 { 1.0 } else { 0.0 }, "focus {focus}, film {x}, {left}");
                    lit += usize::from(a > 0.0);
                }
            }
            let inside = (lit > 0) as usize + (lit < 3000) as usize;
            if focus == 2.0 {
                assert!(lit == 0 || lit > 3000, "in focus, all or nothing must be lit: {lit}");
            } else if x == 24.0 || x == 24.5 {
                assert_eq!(inside, 2, "out of focus, only a part must be lit: {lit}");
            }
        }
    }
}
