//! Reading of portals.

use crate::pbrt::text::{read, warnings, world};
use etendue::Vec3;
use etendue::light::Portal;

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
