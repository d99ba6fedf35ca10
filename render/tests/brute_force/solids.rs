//! Scenes with closed convex parts of meshes, and parts that are almost that.

use super::scenes::{Scenes, light, quad, shape};
use crate::meshes::{Random, Triangle, cube};
use etendue_oracle::{V3, along, cross, unit, wide};
use etendue_render::scene::{Geometry, Parallelogram, Shape, Sphere};

/// A convex polyhedron within [−1, 1]³: corners, and the corners of each face in order around.
pub(crate) type Solid = (Vec<V3>, Vec<Vec<usize>>);

/// A prism over a regular polygon.
fn prism(n: usize) -> Solid {
    let corner = |k: usize| {
        let (sin, cos) = ((k % n) as f64 / n as f64 * std::f64::consts::TAU).sin_cos();
        [cos, if k < n { -1.0 } else { 1.0 }, sin]
    };
    let mut faces: Vec<Vec<usize>> = (0..n).map(|k| vec![k, (k + 1) % n, n + (k + 1) % n, n + k]).collect();
    faces.push((0..n).collect());
    faces.push((n..2 * n).collect());
    ((0..2 * n).map(corner).collect(), faces)
}

/// The box [−1, 1]³.
pub(crate) fn block() -> Solid {
    let corners = (0..8).map(|k| [0, 1, 2].map(|axis| f64::from(k >> axis & 1) * 2.0 - 1.0)).collect();
    let faces = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    (corners, faces.map(Vec::from).into())
}

fn tetrahedron() -> Solid {
    let corners = vec![[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    (corners, vec![vec![0, 1, 2], vec![0, 1, 3], vec![0, 2, 3], vec![1, 2, 3]])
}

fn octahedron() -> Solid {
    let corner = |k: usize| {
        let mut v = [0.0; 3];
        v[k % 3] = if k < 3 { 1.0 } else { -1.0 };
        v
    };
    let faces = (0..8).map(|k| (0..3).map(|axis| axis + 3 * (k >> axis & 1)).collect());
    ((0..6).map(corner).collect(), faces.collect())
}

/// The triangles of a solid whose corners are moved by `place`, with the faces cut, turned and ordered at random.
pub(crate) fn cut((corners, faces): &Solid, place: impl Fn(V3) -> V3, random: &mut Random) -> Vec<Triangle> {
    let corners: Vec<[f32; 3]> = corners.iter().map(|&v| place(v).map(|x| x as f32)).collect();
    let mut triangles = Vec::new();
    for face in faces {
        let start = random.below(face.len());
        let at = |k: usize| corners[face[(start + k) % face.len()]];
        for k in 2..face.len() {
            let mut triangle = [at(0), at(k - 1), at(k)];
            triangle.rotate_left(random.below(3));
            if random.below(2) == 0 {
                triangle.swap(0, 1);
            }
            triangles.insert(random.below(triangles.len() + 1), triangle);
        }
    }
    triangles
}

/// Moves a solid: half its size along its own axes, its centre, and whether its axes are turned about the vertical or anyhow.
pub(crate) fn moved(half: V3, center: V3, turned: usize, random: &mut Random) -> impl Fn(V3) -> V3 + use<> {
    let forward = match turned {
        0 => [1.0, 0.0, 0.0],
        1 => unit([f64::from(random.signed()), 0.0, f64::from(random.signed())]),
        _ => unit(wide(random.point())),
    };
    let up = if turned < 2 { [0.0, 1.0, 0.0] } else { unit(cross(forward, wide(random.point()))) };
    let side = cross(forward, up);
    move |v| {
        let on_two = along(along(center, forward, v[0] * half[0]), up, v[1] * half[1]);
        along(on_two, side, v[2] * half[2])
    }
}

/// Moves a number by some units in the last place.
fn ulps(x: f32, by: i32) -> f32 {
    f32::from_bits((x.to_bits() as i32 + by) as u32)
}

fn any_solid(random: &mut Random) -> Solid {
    match random.below(7) {
        0 => tetrahedron(),
        1 => octahedron(),
        2 => prism(3),
        3 => prism(6),
        _ => block(),
    }
}

fn half(random: &mut Random, most: f32) -> V3 {
    [0; 3].map(|_| f64::from((0.05 + 0.95 * random.unit()) * most))
}

fn at(random: &mut Random, y: f64) -> V3 {
    [0.8 * f64::from(random.signed()), y, 0.8 * f64::from(random.signed())]
}

/// Some of what `one` makes.
fn some(random: &mut Random, one: impl Fn(&mut Random) -> Vec<Triangle>) -> Vec<Triangle> {
    (0..1 + random.below(4)).flat_map(|_| one(random)).collect()
}

/// A solid anywhere.
fn free(random: &mut Random) -> Vec<Triangle> {
    let (solid, half, center) = (any_solid(random), half(random, 0.4), wide(random.point()));
    let place = moved(half, center, random.below(3), random);
    cut(&solid, place, random)
}

/// A solid on the floor, or as deep in it as this part of its half height.
fn standing(deeper: f64, random: &mut Random) -> Vec<Triangle> {
    let half = half(random, 0.4);
    let center = at(random, half[1] - 1.0 - deeper * half[1]);
    let place = moved(half, center, random.below(2), random);
    let solid = if random.below(4) == 0 { prism(3) } else { block() };
    cut(&solid, place, random)
}

/// Boxes side by side with flush tops, and one on top.
fn touching(random: &mut Random) -> Vec<Triangle> {
    let (a, b) = (half(random, 0.4), half(random, 0.4));
    let center = at(random, a[1] - 1.0);
    let beside = [center[0] + a[0] + b[0], a[1] - 1.0, center[2] + 0.01];
    let above = [center[0] + 0.01, 2.0 * a[1] - 1.0 + b[1], center[2]];
    let all = [(a, center), ([b[0], a[1], b[2]], beside), (b, above)];
    all.into_iter().flat_map(|(half, center)| cut(&block(), moved(half, center, 0, random), random)).collect()
}

/// Boxes within each other.
fn nested(random: &mut Random) -> Vec<Triangle> {
    let (half, center) = (half(random, 0.6), wide(random.point()));
    let of = |size: f64| cut(&block(), moved(half.map(|x| x * size), center, 0, random), random);
    [1.0, 0.7, 0.3].into_iter().flat_map(of).collect()
}

/// A plate no thicker than the tolerance of closed forms.
fn plate(random: &mut Random) -> Vec<Triangle> {
    let mut half = half(random, 0.6);
    half[1] = 5e-5;
    let center = if random.below(3) == 0 { at(random, -0.9) } else { wide(random.point()) };
    let place = moved(half, center, random.below(3), random);
    let solid = if random.below(4) == 0 { prism(6) } else { block() };
    cut(&solid, place, random)
}

/// Boxes that lights cross, or in which they are.
fn around(lights: &[Shape], whole: bool, random: &mut Random) -> Vec<Triangle> {
    let mut mesh = Vec::new();
    for lamp in lights {
        let (Geometry::Sphere(Sphere { center: at, .. })
        | Geometry::Triangle([at, ..])
        | Geometry::Parallelogram(Parallelogram { p: at, .. })) = lamp.geometry
        else {
            panic!("no lamp is {:?}", lamp.geometry)
        };
        let (mut half, mut center) = (half(random, 0.3), wide(at));
        if whole {
            half = half.map(|x| x + 0.5 * f64::from(random.unit()));
        } else {
            center = along(center, wide(random.point()), 0.4);
        }
        let place = moved(half, center, random.below(3), random);
        mesh.extend(cut(&block(), place, random));
    }
    mesh
}

/// A room with boxes in it, and lamps just inside, flush with the ceiling and above it.
fn room(lights: &mut Vec<Shape>, random: &mut Random) -> Vec<Triangle> {
    let mut mesh: Vec<Triangle> = cube(1).into_iter().map(|t| t.map(|v| v.map(|x| 1.9 * x))).collect();
    mesh.extend(some(random, |random| {
        let half = half(random, 0.3);
        let (center, turned) = (at(random, half[1] - 1.9), random.below(2));
        let place = moved(half, center, turned, random);
        cut(&block(), place, random)
    }));
    for y in [1.899, 1.9, 1.900_01, 1.91] {
        let p = [random.signed(), y, random.signed()];
        let geometry = Geometry::Parallelogram(Parallelogram { p, u: [0.3, 0.0, 0.0], v: [0.0, 0.0, 0.2] });
        lights.push(shape(geometry, Some(y > 1.9)));
    }
    mesh
}

/// A solid of which a triangle is missing, twice there, or has a corner that is moved by rounding.
fn damaged(kind: &str, random: &mut Random) -> Vec<Triangle> {
    let mut triangles = free(random);
    let chosen = random.below(triangles.len());
    match kind {
        "open" => drop(triangles.remove(chosen)),
        "duplicate" => triangles.push(triangles[chosen]),
        _ => {
            let corner = triangles[chosen][0];
            let by = (1 + random.below(8)) as i32 * [1, -1][random.below(2)];
            let dent = |v: [f32; 3]| if v == corner { v.map(|x| ulps(x, by)) } else { v };
            triangles.iter_mut().for_each(|t| *t = t.map(dent));
        }
    }
    triangles
}

const KINDS: [&str; 12] = [
    "free",
    "standing",
    "sunk",
    "touching",
    "nested",
    "plates",
    "crossing",
    "light in box",
    "room",
    "open",
    "duplicate",
    "dented",
];

/// Scenes with solids, by name.
pub(crate) fn solids(random: &mut Random) -> Scenes {
    let mut all = Vec::new();
    for kind in KINDS {
        let mut lights: Vec<Shape> = (0..3).map(|k| light(random, [0.5, 0.2, 0.05][k])).collect();
        let mut mesh = match kind {
            "free" => some(random, free),
            "standing" => some(random, |random| standing(0.0, random)),
            "sunk" => some(random, |random| standing([1e-6, 1e-4, 0.3][random.below(3)], random)),
            "touching" => touching(random),
            "nested" => nested(random),
            "plates" => some(random, plate),
            "crossing" | "light in box" => around(&lights, kind != "crossing", random),
            "room" => room(&mut lights, random),
            _ => some(random, |random| damaged(kind, random)),
        };
        if kind != "room" {
            mesh.extend(quad([-2.0, -1.0, -2.0], [4.0, 0.0, 0.0], [0.0, 0.0, 4.0]));
        }
        // balls receive light, too
        if random.below(2) == 0 {
            let radius = 0.02 + 0.3 * random.unit();
            lights.push(shape(Geometry::Sphere(Sphere { center: random.point(), radius }), None));
        }
        all.push((kind.to_owned(), mesh, lights));
    }
    all
}
