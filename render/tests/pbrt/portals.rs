//! Reading of portals, and their error messages.

use crate::pbrt::text::{read, warnings, world};
use etendue::Vec3;
use etendue::light::Portal;
use etendue_scene::parse;
use std::path::Path;

/// A floor of which the portals in the plane z = 1 show the sky above.
const FLOOR: &str = "Shape \"trianglemesh\" \"point3 P\" [0 0 0  1 0 0  0 1 0]\n";
/// (p3 − p0) × (p1 − p0) is +z.
const UP: &str = "0 0 1  0 1 1  2 1 1  2 0 1";

fn sky(portal: &str) -> String {
    format!("LightSource \"infinite\" \"rgb L\" [1 2 3] \"point3 portal\" [{portal}]\n")
}

fn portals(text: &str) -> Vec<Portal> {
    let scene = read(&world(text));
    assert_eq!(warnings(&scene), [""; 0]);
    scene.environment.unwrap().portals
}

fn error(text: &str) -> String {
    parse(&world(text), "a.pbrt", Path::new("no such directory")).map(|_| ()).unwrap_err().to_string()
}

/// In world space, whatever the transform is; the sky is where pbrt has it; several in a list, or in lights of the same sky.
#[test]
fn portals_are_read() {
    let wanted = Portal::new([0.0, 0.0, 1.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]).unwrap();
    assert!(wanted.faces(Vec3::<f32>::default()) && !wanted.faces(Vec3::new(0.0, 0.0, 1.5_f32)));
    assert_eq!(portals(&format!("{FLOOR}Rotate 90 1 0 0 {}", sky(UP))), [wanted]);
    let other = "5 0 1  5 1 1  6 2 1  6 1 1";
    let skew = Portal::new([5.0, 0.0, 1.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]).unwrap();
    assert_eq!(portals(&format!("{FLOOR}{}", sky(&format!("{UP} {other}")))), [wanted, skew]);
    assert_eq!(portals(&format!("{FLOOR}{}{}", sky(UP), sky(other))), [wanted, skew]);
    // nothing to see is no error: there may be other lights
    assert_eq!(portals(&sky(UP)), [wanted]);
    // a light that comes from everywhere is another one
    let scene = read(&world(&format!("{FLOOR}{}LightSource \"infinite\"", sky(UP))));
    assert_eq!(warnings(&scene), ["a.pbrt:4: LightSource \"infinite\": a second sky is ignored (reported once)"]);
}

#[test]
fn portals_that_are_none_are_errors() {
    for (portal, what) in [
        ("", "expected four corners for each of 1 to 8 portals, found 0 points"),
        ("0 0 0  1 0 0  1 1 0", "expected four corners for each of 1 to 8 portals, found 3 points"),
        ("0 0 1  0 1 1  2 1 1  2 0 1.1", "[0, 0, 1] [0, 1, 1] [2, 1, 1] [2, 0, 1.1] are not those of a parallelogram"),
        ("0 0 1  2 1 1  0 1 1  2 0 1", "are not those of a parallelogram in a plane, one after the other"),
        ("0 0 1  1 0 1  2 0 1  1 0 1", "enclose no area"),
        ("0 0 1  0 0 1  0 0 1  0 0 1", "enclose no area"),
        ("0 0 1  0 1 1e300  2 1 1e300  2 0 1", "are not those of a parallelogram"),
        ("0 0 1  2 0 1  2 1 1  0 1 1", "no surface is on the side from which it shows the sky"),
    ] {
        let message = error(&format!("{FLOOR}{}", sky(portal)));
        assert!(
            message.starts_with("a.pbrt:3: LightSource \"infinite\": \"portal\": ") && message.contains(what),
            "{message}"
        );
    }
    let many = [UP; 9].join(" ");
    assert!(error(&format!("{FLOOR}{}", sky(&many))).contains("found 36 points"));
    let message = error(&format!("{FLOOR}{}", sky("0 0")));
    assert!(message.contains("expected a multiple of 3 numbers, found 2"), "{message}");
}
