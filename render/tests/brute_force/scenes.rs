//! Scenes with lights, and points on lights.

use crate::meshes::{Random, Triangle, add};
use etendue_oracle::{V3, along, cross, length, sub, unit, wide};
use etendue_render::scene::{
    CameraSettings, Emission, Geometry, Material, Parallelogram, Scene, Screen, Shape, Sphere,
};

/// A scene of triangles and shapes.
pub(crate) fn scene(triangles: Vec<Triangle>, shapes: Vec<Shape>) -> Scene {
    let camera = CameraSettings {
        origin: [0.0; 3],
        forward: [0.0; 3],
        right: [0.0; 3],
        up: [0.0; 3],
        is_orthographic: false,
        screen: Screen::Half(0.6),
        lens: None,
    };
    Scene {
        materials: vec![Material::Diffuse([0.5; 3]), Material::Diffuse([0.0; 3])],
        triangle_materials: vec![0; triangles.len()],
        triangles,
        shapes: shapes.into(),
        ..Scene::new(camera, [1; 2])
    }
}

pub(crate) fn shape(geometry: Geometry, emission: Option<bool>) -> Shape {
    let emission = emission.map(|two_sided| Emission { radiance: [1.0; 3], two_sided, ..Emission::default() });
    // flat lights do not reflect
    let black = emission.is_some() && !matches!(geometry, Geometry::Sphere(Sphere { .. }));
    Shape { geometry, material: u32::from(black), emission }
}

/// The quadrilateral p + s u + t v in two triangles.
pub(crate) fn quad(p: [f32; 3], u: [f32; 3], v: [f32; 3]) -> [Triangle; 2] {
    let (a, b) = (add(p, u, 1.0), add(p, v, 1.0));
    [[p, a, add(a, v, 1.0)], [p, add(a, v, 1.0), b]]
}

pub(crate) fn placed(shape: &Shape, scale: f32, shift: f32) -> Shape {
    let place = |v: [f32; 3]| v.map(|x| x * scale + shift);
    let turn = |v: [f32; 3]| v.map(|x| x * scale);
    let geometry = match shape.geometry {
        Geometry::Sphere(Sphere { center, radius }) => {
            Geometry::Sphere(Sphere { center: place(center), radius: radius * scale })
        }
        Geometry::Triangle(corners) => Geometry::Triangle(corners.map(place)),
        Geometry::Parallelogram(Parallelogram { p, u, v }) => {
            Geometry::Parallelogram(Parallelogram { p: place(p), u: turn(u), v: turn(v) })
        }
        ref other => panic!("{other:?} is not moved"),
    };
    Shape { geometry, ..shape.clone() }
}

/// A point of a light that may be visible from p, often on its boundary.
pub(crate) fn light_point(geometry: &Geometry, p: V3, random: &mut Random) -> V3 {
    let snap = |x: f32| match (x * 8.0) as u32 {
        0 | 1 => 0.0,
        2 | 3 => 1.0,
        _ => f64::from(x * 2.0 - 1.0).clamp(0.0, 1.0),
    };
    let [mut s, mut t] = [random.unit(), random.unit()].map(snap);
    match *geometry {
        Geometry::Sphere(Sphere { center, radius }) => {
            let (c, r) = (wide(center), f64::from(radius));
            let axis = sub(p, c);
            let across = unit(cross(axis, wide(random.point())));
            // from the middle of the visible cap to the silhouette
            let most = (r / length(axis)).clamp(-1.0, 1.0).acos();
            let angle = s.sqrt() * most;
            along(along(c, unit(axis), r * angle.cos()), across, r * angle.sin())
        }
        Geometry::Triangle(corners) => {
            if s + t > 1.0 {
                (s, t) = (1.0 - s, 1.0 - t);
            }
            let [a, b, c] = corners.map(wide);
            along(along(a, sub(b, a), s), sub(c, a), t)
        }
        Geometry::Parallelogram(Parallelogram { p, u, v }) => along(along(wide(p), wide(u), s), wide(v), t),
        ref other => panic!("no points of {other:?}"),
    }
}
