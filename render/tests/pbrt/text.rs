//! Scenes as text in pbrt's format.

use etendue_render::scene::{Geometry, Message, Parallelogram, Scene};
use etendue_scene::parse;
use std::path::Path;

/// A scene of a camera and some shapes.
pub(crate) fn world(shapes: &str) -> String {
    format!("LookAt 0 0 5 0 0 0 0 1 0 Camera \"perspective\" WorldBegin\n{shapes}")
}

pub(crate) fn read(text: &str) -> Scene {
    parse(text, "a.pbrt", Path::new("no such directory")).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// The error of a text.
pub(crate) fn error(text: &str) -> String {
    match parse(text, "a.pbrt", Path::new("no such directory")) {
        Ok(_) => panic!("read without an error:\n{text}"),
        Err(error) => error.to_string(),
    }
}

pub(crate) fn warnings(scene: &Scene) -> Vec<String> {
    scene.warnings.iter().map(Message::to_string).collect()
}

pub(crate) const LIGHT: &str = "AreaLightSource \"diffuse\"\n";
pub(crate) const TRIANGLE: &str = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]\n";
pub(crate) const PATCH: &str = "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 2 0 0 0 1 0 2 1 0]\n";

pub(crate) fn sub(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(crate) fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The normal of a flat shape, whose length is twice the area of a triangle or the area of a parallelogram.
pub(crate) fn normal(geometry: &Geometry) -> [f32; 3] {
    match *geometry {
        Geometry::Triangle([a, b, c]) => cross(sub(b, a), sub(c, a)),
        Geometry::Parallelogram(Parallelogram { u, v, .. }) => cross(u, v),
        ref other => panic!("no normal is tested of {other:?}"),
    }
}
