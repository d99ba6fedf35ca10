//! Cameras of other programs, and parts of their images.

use super::*;

#[test]
fn cameras_of_others() {
    let camera =
        |text: &str| parse(&format!("{text} WorldBegin LightSource \"point\""), "a.pbrt", Path::new(".")).unwrap();
    let far = camera("LookAt 0 0 5 0 0 0 0 1 0 Camera \"orthographic\" \"float screenwindow\" [-2 2 -2 2]");
    let CameraSettings { origin, forward, .. } = far.camera;
    // a point two units beside the axis in front of the camera is at the edge of the image
    let edge = far.camera.tan_half(100, 100)[0] * (origin[2] - 5.0);
    assert!(forward[2] == -1.0 && (edge - 2.0).abs() < 1e-9 && far.stand_ins.len() == 1, "{edge}");
    let wide = camera("Camera \"perspective\" \"float fov\" 90 \"float screenwindow\" [-.5 .5 -.5 .5]");
    assert!((wide.camera.tan_half(1, 1)[0] - 0.5).abs() < 1e-12 && wide.stand_ins.is_empty());
    assert_eq!(
        camera("Camera \"realistic\" \"string lensfile\" \"x.dat\" \"float aperturediameter\" 1").stand_ins.len(),
        1
    );
    assert!(camera("Film \"gbuffer\" \"float cropwindow\" [0 1 0 1] Camera \"perspective\"").warnings.is_empty());
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
        let t = camera.tan_half(film.width, film.height);
        let [a, b] = [(2.0 * x / f64::from(film.width) - 1.0) * t[0], (1.0 - 2.0 * y / f64::from(film.height)) * t[1]];
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
        // a lens is perpendicular to the middle of the whole
        let lens = of(film, "\"float lensradius\" .1").unwrap();
        assert_eq!((lens.film.width, lens.film.height, lens.warnings.len()), (200, 100, 1));
        assert_eq!(lens.film.diagonal, 35.0);
    }
    assert!(of("\"float cropwindow\" [0 1 0 1 0 1 0 1]", "").is_err());
}
