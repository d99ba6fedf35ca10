//! Scenes with lights, and points on lights.

use crate::meshes::{Random, Triangle, add, cube, meshes, sheet};
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

/// The sides of a box.
fn sides(low: [f32; 3], high: [f32; 3]) -> Vec<Triangle> {
    let middle: [f32; 3] = std::array::from_fn(|k| 0.5 * (low[k] + high[k]));
    let half: [f32; 3] = std::array::from_fn(|k| 0.5 * (high[k] - low[k]));
    let place = |v: [f32; 3]| std::array::from_fn(|k| middle[k] + half[k] * v[k]);
    cube(1).into_iter().map(|t| t.map(place)).collect()
}

/// Scenes by name.
pub(crate) type Scenes = Vec<(String, Vec<Triangle>, Vec<Shape>)>;

/// A light of any form near the unit cube.
pub(crate) fn light(random: &mut Random, size: f32) -> Shape {
    let center = random.point().map(|x| 1.8 * x);
    let geometry = match random.below(3) {
        0 => Geometry::Sphere(Sphere { center, radius: size * (0.05 + random.unit()) }),
        1 => Geometry::Triangle([0; 3].map(|_| add(center, random.point(), size))),
        _ => {
            let [u, v] = [0; 2].map(|_| random.point().map(|x| x * size));
            Geometry::Parallelogram(Parallelogram { p: center, u, v })
        }
    };
    let two_sided = random.below(3) == 0;
    shape(geometry, Some(two_sided))
}

/// Scenes with lights: the difficult meshes, rooms with boxes and flush lamps, sparse triangles, walls, and spheres.
pub(crate) fn scenes(random: &mut Random) -> Scenes {
    let mut all = Vec::new();
    for (name, mesh) in meshes(random) {
        let lights = (0..3).map(|k| light(random, [0.5, 0.1, 0.01][k])).collect();
        all.push((name.to_owned(), mesh, lights));
    }
    for room in 0..6 {
        let mut mesh = cube(1 + room % 2 * 2);
        for _ in 0..random.below(5) {
            let (x, z) = (0.7 * random.signed(), 0.7 * random.signed());
            let size = [0, 1, 2].map(|_| 0.05 + 0.3 * random.unit());
            mesh.extend(sides([x, -1.0, z], [x + size[0], -1.0 + size[1], z + size[2]]));
        }
        let lamp = |random: &mut Random, y: f32| {
            let (x, z) = (0.8 * random.signed(), 0.8 * random.signed());
            let (w, h) = (0.2 * random.unit() + 0.01, 0.2 * random.unit() + 0.01);
            shape(
                Geometry::Parallelogram(Parallelogram { p: [x, y, z], u: [w, 0.0, 0.0], v: [0.0, 0.0, h] }),
                Some(false),
            )
        };
        let lights = vec![lamp(random, 1.0), lamp(random, 0.999), lamp(random, 0.5), light(random, 0.2)];
        all.push(("room".to_owned(), mesh, lights));
    }
    for _ in 0..8 {
        let mut mesh: Vec<Triangle> = quad([-2.0, -1.0, -2.0], [4.0, 0.0, 0.0], [0.0, 0.0, 4.0]).into();
        for _ in 0..random.below(5) {
            let center = random.point();
            mesh.push([0; 3].map(|_| add(center, random.point(), 1.0)));
        }
        for _ in 0..2 {
            mesh.extend(quad(random.point(), random.point(), random.point()));
        }
        let mut shapes: Vec<Shape> = (0..4).map(|k| light(random, [0.5, 0.2, 0.05, 0.01][k])).collect();
        for _ in 0..random.below(4) {
            let radius = 0.05 + 0.6 * random.unit();
            shapes.push(shape(Geometry::Sphere(Sphere { center: random.point(), radius }), None));
        }
        // a lamp that stands on the floor, and a ball that rests on it
        let p = [random.signed(), -1.0, random.signed()];
        let standing = Geometry::Parallelogram(Parallelogram { p, u: [0.0, 0.3, 0.0], v: [0.3, 0.0, 0.1] });
        shapes.push(shape(standing, Some(true)));
        let center = [random.signed(), -0.75, random.signed()];
        shapes.push(shape(Geometry::Sphere(Sphere { center, radius: 0.25 }), Some(false)));
        all.push(("sparse".to_owned(), mesh, shapes));
    }
    for n in [1, 4] {
        // a wall between a floor and the lights
        let mut mesh = sheet(n, |_, _| -1.0);
        mesh.extend(quad([-3.0, 0.1, -3.0], [6.0, 0.0, 0.0], [0.0, 0.1, 6.0]));
        let lights = (0..4).map(|_| {
            let mut lamp = light(random, 0.3);
            match &mut lamp.geometry {
                Geometry::Sphere(Sphere { center, .. }) => center[1] = 1.5 + 0.2 * center[1],
                Geometry::Triangle(corners) => corners.iter_mut().for_each(|c| c[1] = 1.5 + 0.2 * c[1]),
                Geometry::Parallelogram(Parallelogram { p, .. }) => p[1] = 1.5 + 0.2 * p[1],
                other => panic!("{other:?} is not moved"),
            }
            lamp
        });
        let mut shapes: Vec<_> = lights.collect();
        shapes.push(shape(Geometry::Sphere(Sphere { center: [0.0, -0.3, 0.0], radius: 0.3 }), None));
        all.push(("wall".to_owned(), mesh, shapes));
    }
    all
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
