//! Cameras of other programs, and parts of their images.

use etendue::{Vec2, u32x8};
use etendue_render::camera::{Camera, CameraSample, counted_from};
use etendue_render::packet::X8;
use etendue_render::scene::area::PlaceInImage;
use etendue_render::scene::{Scene, Screen};
use etendue_scene::parse;
use std::path::Path;

fn seen_by(text: &str) -> Scene {
    parse(&format!("{text} WorldBegin LightSource \"point\""), "a.pbrt", Path::new(".")).unwrap()
}

#[test]
fn cameras_of_others() {
    let realistic = seen_by("Camera \"realistic\" \"string lensfile\" \"x.dat\" \"float aperturediameter\" 1");
    assert_eq!(realistic.stand_ins.len(), 1);
    let half = |text: &str| seen_by(&format!("Camera \"perspective\" {text}")).camera.screen;
    // pbrt-v3 has it
    assert!(matches!(half("\"float halffov\" 45"), Screen::Half(half) if (half - 1.0).abs() < 1e-12));
    assert!(seen_by("Film \"gbuffer\" \"float cropwindow\" [0 1 0 1] Camera \"perspective\"").warnings.is_empty());
}

/// The screen is what the file says, in its shape: pixels need not be square, and the axis need not be in the middle.
#[test]
fn screens() {
    let film = "Film \"rgb\" \"integer xresolution\" 200 \"integer yresolution\" 100";
    // of a field of view of 90 degrees, the half of the shorter side is 1
    for (kind, unit) in [("perspective", 1.0), ("orthographic", 2.0)] {
        for (text, edges) in [
            ("", [-2.0, 2.0, -1.0, 1.0]),
            ("\"float screenwindow\" [-2 2 -1 1]", [-2.0, 2.0, -1.0, 1.0]),
            ("\"float screenwindow\" [-1 1 -.5 .5]", [-1.0, 1.0, -0.5, 0.5]),
            ("\"float screenwindow\" [-.5 .5 -.5 .5]", [-0.5, 0.5, -0.5, 0.5]),
            ("\"float screenwindow\" [0 4 -3 1]", [0.0, 4.0, -3.0, 1.0]),
            ("\"float frameaspectratio\" 2", [-2.0, 2.0, -1.0, 1.0]),
            ("\"float frameaspectratio\" 4", [-4.0, 4.0, -1.0, 1.0]),
            ("\"float frameaspectratio\" .5", [-1.0, 1.0, -2.0, 2.0]),
            ("\"float frameaspectratio\" .5 \"float screenwindow\" [-2 2 -1 1]", [-2.0, 2.0, -1.0, 1.0]),
        ] {
            let scene = seen_by(&format!("Scale .5 .5 .5 {film} Camera \"{kind}\" {text}"));
            let found = scene.camera.edges(200, 100);
            let wanted = edges.map(|edge| edge * unit);
            assert!(found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-12), "{kind} {text}: {found:?}");
            assert_eq!(scene.camera.is_orthographic, kind == "orthographic");
            assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
        }
    }
    // square pixels around the axis stay square in images of another shape
    let square = seen_by(&format!("{film} Camera \"perspective\" \"float screenwindow\" [-1 1 -.5 .5]"));
    assert!(matches!(square.camera.screen, Screen::Half(half) if (half - 0.5).abs() < 1e-12));
}

/// However wide the film, its pixels see what they should, up to the rounding of the rays themselves: of parallel ones to 2⁻¹⁰ of a pixel, of
/// others twice as much. The position is rounded to 2⁻¹³ of a pixel, and would be to 2⁻⁹ if it were counted from the corner of the film.
#[test]
fn wide_films() {
    let (side, step) = (65_536, 2_f64.powi(-10));
    for (kind, lens, limit) in [("orthographic", 0.0, 1.13), ("perspective", 0.0, 2.2), ("perspective", 0.01, 2.2)] {
        let view = "LookAt 0 0 0 0 0 1 0 1 0 Camera";
        let scene = seen_by(&format!("{view} \"{kind}\" \"float lensradius\" {lens}"));
        let (camera, [.., upper]) = (Camera::new(&scene.camera, 4096, side), scene.camera.edges(4096, side));
        for y in [0, 1, 4095, 4096, 20_000, 40_001, 65_535] {
            let start = counted_from([1000, y]);
            let near = camera.counted_from(start);
            for u in (0..1000).map(|k| (k as f32 + 0.37) / 1000.0) {
                let pixel = [1000 - start[0], y - start[1]].map(u32x8::splat);
                let sample = CameraSample::new(pixel[0], pixel[1], Vec2::new(X8::splat(0.5), X8::splat(u)), None);
                let (origin, direction) = near.rays(&sample);
                let [origin, direction] = [origin, direction].map(|v| v.lane(0).map(f64::from));
                let up = origin.y + direction.y / direction.z;
                let error = (1.0 - up / upper) * f64::from(side) / 2.0 - f64::from(y) - f64::from(u);
                assert!(error.abs() < limit * step, "{kind}, row {y} + {u}: {error} of a pixel");
            }
        }
    }
}

/// A part of an image shows what the whole shows there.
#[test]
fn parts_of_images() {
    let view = "LookAt 1 2 3 0 .5 0 .2 1 0 Camera \"perspective\" \"float fov\" 70";
    let of = |film: &str, camera: &str| {
        let size = "\"integer xresolution\" 200 \"integer yresolution\" 100";
        let text = format!("Film \"rgb\" {size} {film} {view} {camera} WorldBegin LightSource \"point\"");
        parse(&text, "a.pbrt", Path::new("."))
    };
    let whole = of("", "").unwrap();
    let through = |scene: &Scene, x: f64, y: f64| {
        let (camera, film) = (&scene.camera, &scene.film);
        let [left, right, lower, upper] = camera.edges(film.width, film.height);
        let a = left + (right - left) * x / f64::from(film.width);
        let b = upper + (lower - upper) * y / f64::from(film.height);
        let axis = |k: usize| camera.forward[k] + a * camera.right[k] + b * camera.up[k];
        let direction = [axis(0), axis(1), axis(2)];
        let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        direction.map(|x| x / length)
    };
    for (film, area) in [
        ("\"float cropwindow\" [.25 .75 .1 .6]", [50, 10, 150, 60]),
        ("\"float cropwindow\" [.302 .304 0 1]", [61, 0, 61, 100]),
        ("\"float cropwindow\" [1 .9 .5 2]", [180, 50, 200, 100]),
        ("\"integer pixelbounds\" [-5 30 99 4000]", [0, 99, 30, 100]),
        ("\"integer pixelbounds\" [3 4 0 1] \"float cropwindow\" [0 .5 0 .5]", [0, 0, 100, 50]),
    ] {
        let [x0, y0, x1, y1] = area;
        if x0 == x1 {
            let error = of(film, "").unwrap_err().to_string();
            assert!(error.contains("\"cropwindow\": no pixel of 200 × 100"), "{error}");
            continue;
        }
        let part = of(film, "").unwrap();
        assert!(part.warnings.is_empty());
        assert_eq!([part.film.width, part.film.height], [x1 - x0, y1 - y0]);
        for [x, y] in [[0.0, 0.0], [0.5, 0.25], [1.0, 1.0]] {
            let [x, y] = [x * f64::from(x1 - x0), y * f64::from(y1 - y0)];
            let [a, b] = [through(&part, x, y), through(&whole, f64::from(x0) + x, f64::from(y0) + y)];
            assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12), "{film}: {a:?}, not {b:?}");
        }
        assert_eq!(part.film.place, Some(PlaceInImage { start: [x0, y0], whole: [200, 100] }));
        // a lens stays perpendicular to the axis of the whole
        let lens = of(film, "\"float lensradius\" .1").unwrap();
        assert_eq!((lens.camera.screen, &lens.film), (part.camera.screen, &part.film));
        assert_eq!((lens.camera.forward, lens.warnings.len()), (whole.camera.forward, 0));
    }
    assert!(of("\"float cropwindow\" [0 1 0 1 0 1 0 1]", "").is_err());
}
