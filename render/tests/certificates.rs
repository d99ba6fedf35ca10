//! Compares certificates with visibility by brute force in double precision: random patches and lights in difficult scenes.

mod meshes;
mod solids;

use etendue::occlusion::{Convex, Occlusion, Polyhedron};
use etendue::{Mask, Real, Vec3, f32x8, u32x8};
use etendue_render::bvh::{GROUP, Hits, NOTHING, SHAPE, Scratch};
use etendue_render::camera::Pinhole;
use etendue_render::certificates::{Blocker, Bodies, Certificate, Certifier, Patch, Pyramid, Viewer};
use etendue_render::packet::M8;
use etendue_render::scene::{CameraSettings, Emission, FilmSettings, Geometry, Material, Scene, Shape};
use etendue_render::surfaces::Surfaces;
use meshes::{Random, Triangle, add, cube, meshes, sheet};
use solids::solids;

type V = [f64; 3];

fn wide(v: [f32; 3]) -> V {
    v.map(f64::from)
}
fn plus(a: V, b: V, s: f64) -> V {
    std::array::from_fn(|k| a[k] + b[k] * s)
}
fn sub(a: V, b: V) -> V {
    plus(a, b, -1.0)
}
fn dot(a: V, b: V) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}
fn cross(a: V, b: V) -> V {
    std::array::from_fn(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
}
fn length(a: V) -> f64 {
    dot(a, a).sqrt()
}
fn unit(a: V) -> V {
    a.map(|x| x / length(a))
}

/// Whether a segment meets something, unless that is within rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Meets {
    Yes,
    No,
    Unclear,
}

/// The sign of (b−a) × (c−a) · (d−a), or 0 within rounding.
fn side([a, b, c]: [V; 3], d: V, tolerance: f64) -> i32 {
    let (u, v, w) = (sub(b, a), sub(c, a), sub(d, a));
    let volume = dot(cross(u, v), w);
    let scale = [a, b, c, d].iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
    let (lu, lv, lw) = (length(u), length(v), length(w));
    let rounding = tolerance * (lu * lv * lw + scale * (lu * lv + lv * lw + lw * lu));
    if volume > rounding { 1 } else { -i32::from(volume < -rounding) }
}

fn meets_triangle([p, q]: [V; 2], [a, b, c]: [V; 3], tolerance: f64) -> Meets {
    // a ball around the triangle decides where all its volumes are rounding
    let ball = [b, c].iter().map(|&v| length(sub(v, a))).fold(0.0, f64::max);
    if meets_sphere([p, q], a, ball, 1e-6) == Meets::No && [p, q].iter().all(|&end| length(sub(end, a)) > ball) {
        return Meets::No;
    }
    let ends = [p, q].map(|end| side([a, b, c], end, tolerance));
    if ends[0] * ends[1] > 0 {
        return Meets::No;
    }
    let edges = [[a, b], [b, c], [c, a]].map(|[a, b]| side([p, a, b], q, tolerance));
    if edges.contains(&1) && edges.contains(&-1) {
        return Meets::No;
    }
    let clear = ends[0] * ends[1] < 0 && !edges.contains(&0);
    if clear { Meets::Yes } else { Meets::Unclear }
}

fn meets_sphere([p, q]: [V; 2], center: V, radius: f64, tolerance: f64) -> Meets {
    let d = sub(q, p);
    let t = (dot(sub(center, p), d) / dot(d, d)).clamp(0.0, 1.0);
    let distance = length(sub(plus(p, d, t), center)) - radius;
    let ends = [p, q].map(|end| length(sub(end, center)) - radius);
    let scale = [p, q, center].iter().flatten().fold(radius, |m: f64, x| m.max(x.abs()));
    let rounding = tolerance * scale;
    match () {
        () if distance > rounding => Meets::No,
        () if distance < -rounding && ends.iter().any(|&end| end > rounding) => Meets::Yes,
        () if ends.iter().all(|&end| end < -rounding) => Meets::No,
        () => Meets::Unclear,
    }
}

/// Rounding of the tests in double precision.
const EXACT: f64 = 1e-15;

fn meets(segment: [V; 2], geometry: &Geometry) -> Meets {
    match *geometry {
        Geometry::Sphere { center, radius } => meets_sphere(segment, wide(center), f64::from(radius), EXACT),
        Geometry::Triangle(corners) => meets_triangle(segment, corners.map(wide), EXACT),
        Geometry::Parallelogram { p, u, v } => {
            let [p, u, v] = [p, u, v].map(wide);
            let corners = [p, plus(p, u, 1.0), plus(plus(p, u, 1.0), v, 1.0), plus(p, v, 1.0)];
            meets_polygon(segment, &corners, EXACT)
        }
    }
}

fn meets_polygon(segment: [V; 2], corners: &[V], tolerance: f64) -> Meets {
    let parts = (2..corners.len()).map(|k| [corners[0], corners[k - 1], corners[k]]);
    let all: Vec<_> = parts.map(|part| meets_triangle(segment, part, tolerance)).collect();
    [Meets::Yes, Meets::Unclear].into_iter().find(|kind| all.contains(kind)).unwrap_or(Meets::No)
}

/// May a blocker of a certificate occlude a segment? Its corners are rounded.
fn may_occlude(segment: [V; 2], blocker: &Blocker, bodies: &Bodies) -> bool {
    Meets::No
        != match *blocker {
            Blocker::Polygon { corners, count, .. } => meets_polygon(segment, &corners.map(wide)[..count], 1e-7),
            Blocker::Sphere { center, radius, .. } => meets_sphere(segment, wide(center), f64::from(radius), 1e-7),
            Blocker::Body(body) => meets_solid(segment, &bodies.polyhedron(body)),
        }
}

/// Depths of p below the faces of a body, and their rounding.
fn depths(p: V, solid: &Polyhedron<'_, f32>) -> (f64, Vec<f64>) {
    let exact = |v: Vec3<f32>| wide([v.x, v.y, v.z]);
    let corners = solid.edges.iter().flat_map(|edge| edge.ends).map(exact);
    let rounding = 3e-7 * corners.chain([p]).flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
    let depth = |[normal, on]: &[Vec3<f32>; 2]| dot(unit(exact(*normal)), sub(exact(*on), p));
    (rounding, solid.faces.iter().map(depth).collect())
}

/// Does a body hide q from p, if it lies before q? It hides everything from inside, otherwise a cone whose sides pass its outline.
fn meets_solid([p, q]: [V; 2], solid: &Polyhedron<'_, f32>) -> Meets {
    let (rounding, depths) = depths(p, solid);
    let least = depths.iter().fold(f64::INFINITY, |m, x| m.min(*x));
    if least > -rounding {
        return if least > rounding { Meets::Yes } else { Meets::Unclear };
    }
    let exact = |v: Vec3<f32>| wide([v.x, v.y, v.z]);
    let (inwards, along) = (sub(exact(solid.center), p), unit(sub(q, p)));
    let mut all = Meets::Yes;
    for edge in solid.edges.iter().filter(|edge| (depths[edge.faces[0]] >= 0.0) != (depths[edge.faces[1]] >= 0.0)) {
        let [a, b] = edge.ends.map(|end| sub(exact(end), p));
        let plane = cross(a, b);
        let side = dot(unit(plane), along) * dot(plane, inwards).signum();
        let distance = length(plane) / length(sub(a, b));
        match () {
            () if side.abs() * distance > rounding => {
                if side < 0.0 {
                    return Meets::No;
                }
            }
            () => all = Meets::Unclear,
        }
    }
    all
}

fn corner(v: [f32; 3]) -> Vec3<f32> {
    v.into()
}

/// A light as the library takes it, and the angle around it as seen from p.
fn convex(geometry: &Geometry, p: V) -> (Convex<f32>, f64) {
    let around = |corners: &[Vec3<f32>]| {
        let directions: Vec<V> = corners.iter().map(|v| unit(sub(wide([v.x, v.y, v.z]), p))).collect();
        let next = directions.iter().cycle().skip(1);
        directions.iter().zip(next).map(|(&a, &b)| length(cross(a, b)).atan2(dot(a, b))).sum()
    };
    match *geometry {
        Geometry::Sphere { center, radius } => {
            let sin = f64::from(radius) / length(sub(wide(center), p));
            (Convex::Sphere { center: corner(center), radius }, std::f64::consts::TAU * sin)
        }
        Geometry::Triangle([a, b, c]) => {
            let corners = [a, b, c, c].map(corner);
            (Convex::Polygon { corners, count: 3 }, around(&corners[..3]))
        }
        Geometry::Parallelogram { p: a, u, v } => {
            let (a, u, v) = (corner(a), corner(u), corner(v));
            let corners = [a, a + u, a + u + v, a + v];
            (Convex::Polygon { corners, count: 4 }, around(&corners))
        }
    }
}

/// What the corridors of a test have shown.
#[derive(Debug, Default)]
struct Counts {
    corridors: u64,
    lit: u64,
    dark: u64,
    blockers: u64,
    unknown: u64,
    pairs: u64,
    visible: u64,
    /// Occluded pairs of dark corridors.
    covered: u64,
    unclear: u64,
    /// Shadow rays in single precision that differ from a certificate.
    rays: u64,
    ray_differs: u64,
    /// Shading points, and the greatest share of its margin by which one is outside of its patch.
    points: u64,
    off: f64,
    /// Certificates that list bodies, and the pairs that were compared with those.
    with_bodies: u64,
    solid: u64,
    solid_met: u64,
    solid_unclear: u64,
    /// Points from which a body hides as much of a light as its triangles do, or not all.
    shadows: u64,
    on_surface: u64,
    partial: u64,
    /// Packets for which the visible part is not computed with a body, and points for which it is not with its triangles.
    bodies_fail: u64,
    triangles_fail: u64,
    /// Greatest difference between the two, relative to its bound.
    worst: f64,
    /// Least height of a shading point over its plane, in units of a sixteenth of the margin.
    height: f64,
}

/// A scene of triangles and shapes.
fn scene(triangles: Vec<Triangle>, shapes: Vec<Shape>) -> Scene {
    let camera =
        CameraSettings { origin: [0.0; 3], forward: [0.0; 3], right: [0.0; 3], up: [0.0; 3], fov: 60.0, lens: None };
    Scene {
        name: String::new(),
        camera,
        film: FilmSettings { width: 1, height: 1, diagonal: 35.0, filename: None },
        pixel_samples: 1,
        materials: vec![Material::Diffuse([0.5; 3]), Material::Diffuse([0.0; 3])],
        triangle_materials: vec![0; triangles.len()],
        triangles,
        shapes: shapes.into(),
        delta_lights: Vec::new(),
        environment: None,
        warnings: Vec::new(),
        inputs: Vec::new(),
    }
}

fn shape(geometry: Geometry, emission: Option<bool>) -> Shape {
    let emission = emission.map(|two_sided| Emission { radiance: [1.0; 3], two_sided });
    // flat lights do not reflect
    let black = emission.is_some() && !matches!(geometry, Geometry::Sphere { .. });
    Shape { geometry, material: u32::from(black), emission }
}

/// The quadrilateral p + s u + t v in two triangles.
fn quad(p: [f32; 3], u: [f32; 3], v: [f32; 3]) -> [Triangle; 2] {
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
type Scenes = Vec<(String, Vec<Triangle>, Vec<Shape>)>;

/// A light of any form near the unit cube.
fn light(random: &mut Random, size: f32) -> Shape {
    let center = random.point().map(|x| 1.8 * x);
    let geometry = match random.below(3) {
        0 => Geometry::Sphere { center, radius: size * (0.05 + random.unit()) },
        1 => Geometry::Triangle([0; 3].map(|_| add(center, random.point(), size))),
        _ => {
            let [u, v] = [0; 2].map(|_| random.point().map(|x| x * size));
            Geometry::Parallelogram { p: center, u, v }
        }
    };
    let two_sided = random.below(3) == 0;
    shape(geometry, Some(two_sided))
}

/// Scenes with lights: the difficult meshes, rooms with boxes and flush lamps, sparse triangles, walls, and spheres.
fn scenes(random: &mut Random) -> Scenes {
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
            shape(Geometry::Parallelogram { p: [x, y, z], u: [w, 0.0, 0.0], v: [0.0, 0.0, h] }, Some(false))
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
            shapes.push(shape(Geometry::Sphere { center: random.point(), radius }, None));
        }
        // a lamp that stands on the floor, and a ball that rests on it
        let p = [random.signed(), -1.0, random.signed()];
        let standing = Geometry::Parallelogram { p, u: [0.0, 0.3, 0.0], v: [0.3, 0.0, 0.1] };
        shapes.push(shape(standing, Some(true)));
        let center = [random.signed(), -0.75, random.signed()];
        shapes.push(shape(Geometry::Sphere { center, radius: 0.25 }, Some(false)));
        all.push(("sparse".to_owned(), mesh, shapes));
    }
    for n in [1, 4] {
        // a wall between a floor and the lights
        let mut mesh = sheet(n, |_, _| -1.0);
        mesh.extend(quad([-3.0, 0.1, -3.0], [6.0, 0.0, 0.0], [0.0, 0.1, 6.0]));
        let lights = (0..4).map(|_| {
            let mut lamp = light(random, 0.3);
            match &mut lamp.geometry {
                Geometry::Sphere { center, .. } => center[1] = 1.5 + 0.2 * center[1],
                Geometry::Triangle(corners) => corners.iter_mut().for_each(|c| c[1] = 1.5 + 0.2 * c[1]),
                Geometry::Parallelogram { p, .. } => p[1] = 1.5 + 0.2 * p[1],
            }
            lamp
        });
        let mut shapes: Vec<_> = lights.collect();
        shapes.push(shape(Geometry::Sphere { center: [0.0, -0.3, 0.0], radius: 0.3 }, None));
        all.push(("wall".to_owned(), mesh, shapes));
    }
    all
}

fn placed(shape: &Shape, scale: f32, shift: f32) -> Shape {
    let place = |v: [f32; 3]| v.map(|x| x * scale + shift);
    let turn = |v: [f32; 3]| v.map(|x| x * scale);
    let geometry = match shape.geometry {
        Geometry::Sphere { center, radius } => Geometry::Sphere { center: place(center), radius: radius * scale },
        Geometry::Triangle(corners) => Geometry::Triangle(corners.map(place)),
        Geometry::Parallelogram { p, u, v } => Geometry::Parallelogram { p: place(p), u: turn(u), v: turn(v) },
    };
    Shape { geometry, ..shape.clone() }
}

/// A point of a light that may be visible from p, often on its boundary.
fn light_point(geometry: &Geometry, p: V, random: &mut Random) -> V {
    let snap = |x: f32| match (x * 8.0) as u32 {
        0 | 1 => 0.0,
        2 | 3 => 1.0,
        _ => f64::from(x * 2.0 - 1.0).clamp(0.0, 1.0),
    };
    let [mut s, mut t] = [random.unit(), random.unit()].map(snap);
    match *geometry {
        Geometry::Sphere { center, radius } => {
            let (c, r) = (wide(center), f64::from(radius));
            let axis = sub(p, c);
            let across = unit(cross(axis, wide(random.point())));
            // from the middle of the visible cap to the silhouette
            let most = (r / length(axis)).clamp(-1.0, 1.0).acos();
            let angle = s.sqrt() * most;
            plus(plus(c, unit(axis), r * angle.cos()), across, r * angle.sin())
        }
        Geometry::Triangle(corners) => {
            if s + t > 1.0 {
                (s, t) = (1.0 - s, 1.0 - t);
            }
            let [a, b, c] = corners.map(wide);
            plus(plus(a, sub(b, a), s), sub(c, a), t)
        }
        Geometry::Parallelogram { p, u, v } => plus(plus(wide(p), wide(u), s), wide(v), t),
    }
}

/// Does a point of a light emit towards p?
fn emits(shape: &Shape, y: V, p: V) -> bool {
    let two_sided = shape.emission.is_some_and(|emission| emission.two_sided);
    let away = sub(p, y);
    match shape.geometry {
        Geometry::Sphere { center, .. } => dot(sub(y, wide(center)), away) > 0.0,
        Geometry::Triangle(corners) => {
            let [a, b, c] = corners.map(wide);
            two_sided || dot(cross(sub(b, a), sub(c, a)), away) > 0.0
        }
        Geometry::Parallelogram { u, v, .. } => two_sided || dot(cross(wide(u), wide(v)), away) > 0.0,
    }
}

/// A scene to be tested.
struct World {
    name: String,
    scene: Scene,
    surfaces: Surfaces,
}

/// A shading point, with the normal on the side of the viewer.
#[derive(Clone, Copy, Debug)]
struct Point {
    p: V,
    normal: V,
    /// Whether a ray has found it.
    traced: bool,
    /// A point of the light to be tested first.
    to: Option<V>,
}

/// What some pixels show of a primitive.
struct View {
    pyramid: Pyramid,
    receiver: u32,
    patch: Patch,
    points: Vec<Point>,
    /// The only light to be tested.
    light: Option<u32>,
}

impl World {
    /// Does a primitive meet the segment from p to y, up to the fraction of shadow rays?
    fn occluded(&self, p: V, y: V, receiver: u32, light: usize) -> Meets {
        let segment = [p, plus(p, sub(y, p), 1.0 - 1.0 / 131_072.0)];
        let own = if receiver & SHAPE == 0 { self.surfaces.bvh.order()[receiver as usize] } else { NOTHING };
        let mut worst = Meets::No;
        let triangles = (0..).zip(&self.scene.triangles).filter(|(id, _)| *id != own);
        let shapes = (0..).zip(self.scene.shapes.iter());
        let shapes = shapes.filter(|(id, _)| id | SHAPE != receiver && *id as usize != light);
        let all = triangles.map(|(_, t)| meets_triangle(segment, t.map(wide), EXACT));
        for met in all.chain(shapes.map(|(_, s)| meets(segment, &s.geometry))) {
            match met {
                Meets::Yes => return Meets::Yes,
                Meets::Unclear => worst = Meets::Unclear,
                Meets::No => {}
            }
        }
        worst
    }
    /// The normal on the side of a viewer.
    fn normal(&self, place: u32, p: V, viewer: V) -> V {
        if place & SHAPE != 0 {
            let Geometry::Sphere { center, .. } = self.scene.shapes[(place & !SHAPE) as usize].geometry else {
                unreachable!("flat shapes are no receivers")
            };
            return unit(sub(p, wide(center)));
        }
        let [a, b, c] = self.scene.triangles[self.surfaces.bvh.order()[place as usize] as usize].map(wide);
        let normal = unit(cross(sub(b, a), sub(c, a)));
        if dot(normal, sub(viewer, a)) < 0.0 { normal.map(|x| -x) } else { normal }
    }
    /// Looks at the scene through random pixels: what they show of a primitive, and shading points there.
    fn look(&self, random: &mut Random, place: impl Fn([f32; 3]) -> [f32; 3], c: &mut Counts) -> Option<View> {
        let distance = if random.below(4) == 0 { 20.0 } else { 1.9 };
        let origin = wide(place(random.point().map(|x| x * distance)));
        let target = if self.scene.triangles.is_empty() || random.below(8) == 0 {
            wide(place(random.point()))
        } else {
            let t = self.scene.triangles[random.below(self.scene.triangles.len())].map(wide);
            let (u, v) = (f64::from(random.unit()), f64::from(random.unit()));
            plus(plus(t[0], sub(t[1], t[0]), u * (1.0 - v)), sub(t[2], t[0]), v)
        };
        let forward = unit(sub(target, origin));
        let right = unit(cross(forward, wide(random.point())));
        let up = cross(right, forward);
        let camera = CameraSettings {
            origin,
            forward,
            right,
            up,
            fov: [60.0, 60.0, 1.0, 0.001][random.below(4)],
            ..self.scene.camera.clone()
        };
        let size = [8, 64, 512, 4096][random.below(4)];
        let pinhole = Pinhole::new(&camera, size, size);
        let corner = [0; 2].map(|_| (f64::from(size) * (0.5 + 0.1 * f64::from(random.signed()))).floor());
        let wideness = [1.0, 1.0, 4.0][random.below(3)];
        let area = [corner[0], corner[1], corner[0] + wideness, corner[1] + wideness];
        let pyramid = Pyramid::new(&pinhole, area);
        // rays anywhere in the rectangle, often at its corners and edges
        let mut hits = [Hits::none(f32x8::splat(f32::INFINITY)); GROUP];
        let mut inside = || {
            let x = random.unit();
            (((x * 1.5 - 0.25).clamp(0.0, 1.0)) * wideness as f32).min(wideness as f32)
        };
        let mut coordinates = |k: usize| f32x8::from_fn(|_| corner[k] as f32 + inside());
        let rays: [_; GROUP] = std::array::from_fn(|_| {
            let (x, y) = (coordinates(0), coordinates(1));
            let (origin, direction) = pinhole.ray(x, y);
            self.surfaces.bvh.rays(origin, direction)
        });
        self.surfaces.bvh.closest(&rays, &[M8::splat(true); GROUP], &mut hits, &mut Scratch::default());
        let places = |i: usize| hits[i / 8].place.to_array()[i % 8];
        let receiver = places(random.below(8 * GROUP));
        if receiver == NOTHING {
            return None;
        }
        let patch = Patch::of(&self.surfaces, receiver, Viewer::Pixels(&pyramid))?;
        let mut points: Vec<Point> = Vec::new();
        let viewer = wide(origin.map(|x| x as f32));
        for (hits, rays) in hits.iter().zip(&rays) {
            let surface = self.surfaces.hit(hits, rays);
            for lane in (0..8).filter(|&i| hits.place.to_array()[i] == receiver) {
                let p = surface.point.lane(lane);
                let p = wide([p.x, p.y, p.z]);
                points.push(Point { p, normal: self.normal(receiver, p, viewer), traced: true, to: None });
                self.measure(&patch, p, c);
            }
        }
        // some of them, and points of the patch that no ray has found
        while points.len() > 6 {
            points.swap_remove(random.below(points.len()));
        }
        let corners: Vec<V> = patch.corners().collect();
        for k in 0..6 {
            if receiver & SHAPE == 0 {
                let mix = if k < 3 { 0.0 } else { f64::from(random.unit()) };
                let (a, b) = (corners[random.below(corners.len())], corners[random.below(corners.len())]);
                let normal = patch.normal().unwrap();
                let p = plus(plus(a, sub(b, a), mix), normal, patch.margin() / 4.0);
                points.push(Point { p, normal, traced: false, to: None });
            }
        }
        Some(View { pyramid, receiver, patch, points, light: None })
    }
    /// Tests the certificates of all lights.
    fn test(&self, view: &View, random: &mut Random, c: &mut Counts) {
        let found = Bodies::new(&self.surfaces.bvh);
        let none = Bodies::default();
        let own = found.is_empty() || random.below(3) == 0;
        for bodies in [(!found.is_empty()).then_some(&found), own.then_some(&none)].into_iter().flatten() {
            let mut certifier = Certifier::new(&self.surfaces, bodies, self.surfaces.light_shapes());
            let all = self.surfaces.light_shapes().enumerate();
            for (index, light) in all.filter(|(_, light)| view.light.is_none_or(|only| only == *light)) {
                let certificate = certifier.certify(&view.patch, index);
                self.compare(certificate, bodies, view, light, random, c);
                if let Certificate::Blockers(blockers) = certificate {
                    self.compare_bodies(blockers, bodies, &view.points, light, random, c);
                }
            }
        }
    }
    /// The triangles of a body.
    fn triangles<'a>(&'a self, bodies: &'a Bodies, body: u32) -> impl Iterator<Item = Triangle> + 'a {
        let places = (0..).zip(self.surfaces.bvh.order()).filter(move |(place, _)| bodies.of(*place) == Some(body));
        places.map(|(_, id)| self.scene.triangles[*id as usize])
    }
    /// Compares the bodies of a certificate with their triangles: single segments, and how much of the light they hide.
    fn compare_bodies(
        &self,
        blockers: &[Blocker],
        bodies: &Bodies,
        points: &[Point],
        light: u32,
        random: &mut Random,
        c: &mut Counts,
    ) {
        let shape = &self.scene.shapes[light as usize];
        let listed = blockers.iter().filter_map(|b| if let Blocker::Body(body) = b { Some(*body) } else { None });
        let listed: Vec<u32> = listed.collect();
        c.with_bodies += u64::from(!listed.is_empty());
        for body in listed {
            let (solid, triangles) = (bodies.polyhedron(body), self.triangles(bodies, body).collect::<Vec<_>>());
            for &Point { p, .. } in points {
                for _ in 0..3 {
                    let y = light_point(&shape.geometry, p, random);
                    let met: Vec<_> = triangles.iter().map(|t| meets_triangle([p, y], t.map(wide), EXACT)).collect();
                    let met = [Meets::Yes, Meets::Unclear].into_iter().find(|kind| met.contains(kind));
                    let (met, hidden) = (met.unwrap_or(Meets::No), meets_solid([p, y], &solid));
                    c.solid += 1;
                    if met == Meets::Unclear || hidden == Meets::Unclear {
                        c.solid_unclear += 1;
                        continue;
                    }
                    c.solid_met += u64::from(met == Meets::Yes);
                    assert_eq!(met, hidden, "{}: {p:?} → {y:?}, {solid:?}", self.name);
                }
            }
            self.compare_shadows(&solid, &triangles, points, shape, c);
        }
    }
    /// Compares how much a body hides in single precision with how much its triangles hide in double precision.
    fn compare_shadows(
        &self,
        solid: &Polyhedron<'_, f32>,
        triangles: &[Triangle],
        points: &[Point],
        light: &Shape,
        c: &mut Counts,
    ) {
        let lanes = |of: &dyn Fn(&Point) -> V| {
            let axis = |k: usize| f32x8::from_fn(|lane| of(&points[lane % points.len()])[k] as f32);
            Vec3::new(axis(0), axis(1), axis(2))
        };
        let (p, normal) = (lanes(&|point| point.p), lanes(&|point| point.normal));
        let mut occlusion = Occlusion::<f32x8>::new();
        let (form, _) = convex(&light.geometry, points[0].p);
        let all = occlusion.visible(p, normal, &form, &[]).unwrap();
        let Some(by_body) = occlusion.visible_past(p, normal, &form, &[], &[*solid]) else {
            c.bodies_fail += 1;
            return;
        };
        let exact = |v: Vec3<f32>| Vec3::from(wide([v.x, v.y, v.z]));
        let flat = |&[a, b, d]: &Triangle| Convex::Polygon { corners: [a, b, d, d].map(|v| wide(v).into()), count: 3 };
        let triangles: Vec<Convex<f64>> = triangles.iter().map(flat).collect();
        let form = match form {
            Convex::Polygon { corners, count } => Convex::Polygon { corners: corners.map(exact), count },
            Convex::Sphere { center, radius } => Convex::Sphere { center: exact(center), radius: f64::from(radius) },
        };
        let mut occlusion = Occlusion::<f64>::new();
        for (lane, point) in points.iter().enumerate().take(8) {
            let (all, by_body) = (f64::from(all.lane(lane)), f64::from(by_body.lane(lane)));
            assert!((0.0..=all).contains(&by_body), "{by_body} of {all}");
            let (p, normal) = (exact(p.lane(lane)), exact(normal.lane(lane)));
            let Some(by_triangles) = occlusion.visible(p, normal, &form, &triangles) else {
                c.triangles_fail += 1;
                continue;
            };
            // on the surface, points are inside or outside by rounding
            let (rounding, depths) = depths(point.p, solid);
            if depths.iter().fold(f64::INFINITY, |m, x| m.min(*x)).abs() < rounding {
                c.on_surface += 1;
                continue;
            }
            c.shadows += 1;
            c.partial += u64::from(by_body > 0.01 * all && by_body < 0.99 * all);
            let bound = 1e-5 * all + 4e-7 * convex(&light.geometry, point.p).1;
            let error = (by_body - by_triangles).abs() / bound;
            let what =
                || format!("{triangles:?}: {by_body} and {by_triangles} of {all}, {point:?}, {solid:?}, {light:?}");
            assert!(error < 1.0, "{}: {}", self.name, what());
            c.worst = c.worst.max(error);
        }
    }
    /// The world with one more triangle, that just touches a segment of the view: it is either a needle with its tip beyond the segment,
    /// or a large triangle with an edge that does not reach the segment.
    fn with_edge(&self, view: &View, random: &mut Random) -> Option<(Self, View)> {
        if view.receiver & SHAPE != 0 {
            return None;
        }
        let lights: Vec<u32> = self.surfaces.light_shapes().collect();
        let light = *lights.get(random.below(lights.len()))?;
        let Point { p, normal, traced, .. } = view.points[random.below(view.points.len())];
        let y = light_point(&self.scene.shapes[light as usize].geometry, p, random);
        let along = sub(y, p);
        let at = match random.below(8) {
            0 => 1.0 - f64::from(random.unit()) / 8192.0,
            1 => f64::from(random.unit()) / 8192.0,
            _ => f64::from(random.unit()),
        };
        let x = plus(p, along, at);
        let out = unit(cross(along, wide(random.point())));
        let side = unit(plus(cross(along, out), along, 0.5 * f64::from(random.signed())));
        let scale = length(along);
        let reach = x.iter().fold(scale, |m: f64, x| m.max(x.abs()));
        let beyond = [1e-5, 1e-4, 1e-6][random.below(3)] * reach;
        let corners = if random.below(2) == 0 {
            let end = plus(x, out, 0.3 * scale);
            [plus(x, out, -beyond), plus(end, side, 0.1 * scale), plus(end, side, -0.1 * scale)]
        } else {
            let edge = plus(x, out, -beyond);
            [plus(edge, side, 20.0 * scale), plus(edge, side, -20.0 * scale), plus(edge, out, -20.0 * scale)]
        };
        let mut scene = self.scene.clone();
        scene.triangles.push(corners.map(|v| v.map(|x| x as f32)));
        scene.triangle_materials.push(0);
        let surfaces = Surfaces::new(&scene).unwrap();
        let id = self.surfaces.bvh.order()[view.receiver as usize];
        let receiver = surfaces.bvh.order().iter().position(|&other| other == id)? as u32;
        let patch = Patch::of(&surfaces, receiver, Viewer::Pixels(&view.pyramid))?;
        let points = vec![Point { p, normal, traced, to: Some(y) }];
        let view = View { pyramid: view.pyramid, receiver, patch, points, light: Some(light) };
        Some((Self { name: format!("an edge in {}", self.name), scene, surfaces }, view))
    }
    /// How far a shading point is outside of its patch, and how high above it.
    fn measure(&self, patch: &Patch, p: V, c: &mut Counts) {
        c.points += 1;
        let corners: Vec<V> = patch.corners().collect();
        let Some(normal) = patch.normal() else {
            for k in 0..3 {
                let low = corners.iter().map(|q| q[k]).fold(f64::INFINITY, f64::min);
                let high = corners.iter().map(|q| q[k]).fold(f64::NEG_INFINITY, f64::max);
                c.off = c.off.max((low - p[k]).max(p[k] - high) / patch.margin());
            }
            return;
        };
        let height = dot(normal, sub(p, corners[0]));
        c.height = c.height.min(height / patch.margin() * 16.0);
        c.off = c.off.max(height / patch.margin());
        let center = corners.iter().fold([0.0; 3], |s, &q| plus(s, q, 1.0 / corners.len() as f64));
        for (i, &a) in corners.iter().enumerate() {
            let edge = sub(corners[(i + 1) % corners.len()], a);
            let out = unit(cross(edge, normal));
            // short edges of a clipped polygon are nothing but rounding
            if out[0].is_finite() && length(edge) > patch.margin() {
                let out = if dot(out, sub(center, a)) > 0.0 { out.map(|x| -x) } else { out };
                c.off = c.off.max(dot(out, sub(p, a)) / patch.margin());
            }
        }
    }
    /// Compares one certificate with pairs of points.
    fn compare(
        &self,
        certificate: Certificate<'_>,
        bodies: &Bodies,
        view: &View,
        light: u32,
        random: &mut Random,
        c: &mut Counts,
    ) {
        c.corridors += 1;
        let shape = &self.scene.shapes[light as usize];
        *match certificate {
            Certificate::Lit => &mut c.lit,
            Certificate::Dark => &mut c.dark,
            Certificate::Blockers(_) => &mut c.blockers,
            Certificate::Unknown => &mut c.unknown,
        } += 1;
        if matches!(certificate, Certificate::Unknown) {
            return;
        }
        for &Point { p, normal, traced, to } in &view.points {
            if let Certificate::Blockers(blockers) = certificate {
                for blocker in blockers {
                    assert_front(blocker, bodies, &shape.geometry, p, &self.name);
                }
            }
            for k in 0..3 {
                let y = to.filter(|_| k == 0).unwrap_or_else(|| light_point(&shape.geometry, p, random));
                if !(dot(normal, sub(y, p)) > 0.0 && emits(shape, y, p)) {
                    continue;
                }
                c.pairs += 1;
                let segment = [p, plus(p, sub(y, p), 1.0 - 1.0 / 131_072.0)];
                let met = self.occluded(p, y, view.receiver, light as usize);
                c.visible += u64::from(met == Meets::No);
                c.covered += u64::from(met == Meets::Yes && matches!(certificate, Certificate::Dark));
                c.unclear += u64::from(met == Meets::Unclear);
                let what = || {
                    format!("{}: {certificate:?}, {p:?} → {y:?}, light {light}, receiver {}", self.name, view.receiver)
                };
                match certificate {
                    Certificate::Lit => assert!(met != Meets::Yes, "occluded: {}", what()),
                    Certificate::Dark => assert!(met != Meets::No, "visible: {}", what()),
                    Certificate::Blockers(blockers) if met == Meets::Yes => {
                        assert!(
                            blockers.iter().any(|b| may_occlude(segment, b, bodies)),
                            "a blocker is missing: {}",
                            what()
                        );
                    }
                    _ => {}
                }
                if traced && !matches!(certificate, Certificate::Blockers(_)) {
                    let open = self.sees(p, y, light);
                    c.rays += 1;
                    c.ray_differs += u64::from(open != matches!(certificate, Certificate::Lit));
                }
            }
        }
    }
    /// Is a shadow ray of the renderer unoccluded?
    fn sees(&self, p: V, y: V, light: u32) -> bool {
        let d = sub(y, p);
        let splat = |v: V| Vec3::<f32x8>::from(v.map(|x| x as f32));
        let ray = self.surfaces.bvh.rays(splat(p), splat(unit(d)));
        let limit = f32x8::splat(length(d) as f32) * f32x8::lit(1.0 - 1.0 / 131_072.0);
        let mut open = [M8::splat(true)];
        self.surfaces.bvh.occluded(&[ray], &mut open, &[limit], &[u32x8::splat(light)], &mut Scratch::default());
        open[0].any()
    }
}

/// A blocker that does not cross the light is in front of it, as seen from p.
fn assert_front(blocker: &Blocker, bodies: &Bodies, light: &Geometry, p: V, name: &str) {
    let (points, radius) = match *blocker {
        Blocker::Polygon { crosses_light: true, .. } | Blocker::Sphere { crosses_light: true, .. } => return,
        Blocker::Polygon { corners, count, .. } => (corners.map(wide)[..count].to_vec(), 0.0),
        Blocker::Sphere { center, radius, .. } => (vec![wide(center)], f64::from(radius)),
        Blocker::Body(body) => {
            let ends = bodies.polyhedron(body).edges.iter().flat_map(|edge| edge.ends);
            (ends.map(|v| wide([v.x, v.y, v.z])).collect(), 0.0)
        }
    };
    let is_front = |x: V| match *light {
        Geometry::Sphere { center, radius: r } => {
            let (c, r) = (wide(center), f64::from(r));
            dot(sub(x, c), sub(p, c)) - radius * length(sub(p, c)) >= r * r
        }
        Geometry::Triangle(corners) => {
            let [a, b, c] = corners.map(wide);
            let normal = unit(cross(sub(b, a), sub(c, a)));
            dot(normal, sub(x, a)) * dot(normal, sub(p, a)).signum() >= radius
        }
        Geometry::Parallelogram { p: a, u, v } => {
            let normal = unit(cross(wide(u), wide(v)));
            dot(normal, sub(x, wide(a))) * dot(normal, sub(p, wide(a))).signum() >= radius
        }
    };
    assert!(points.into_iter().all(is_front), "{name}: {blocker:?} is behind {light:?} from {p:?}");
}

/// How many times a triangle is added to a small scene, for each view.
const EDGES: usize = 6;

/// Tests the certificates of `looks` views of each scene at each scale.
fn campaign(made: fn(&mut Random) -> Scenes, looks: usize, rounds: u32, seed: u32) -> Counts {
    let mut c = Counts { height: f64::INFINITY, ..Counts::default() };
    for round in 0..rounds {
        let mut random = Random { index: seed.wrapping_add(round.wrapping_mul(0x0700_0000)) };
        for (name, triangles, shapes) in made(&mut random) {
            for (scale, shift) in [(1.0_f32, 0.0), (1e-6, 0.0), (1e6, 0.0), (1.0, 100.0), (1e-3, 1.0)] {
                let place = |v: [f32; 3]| v.map(|x| x * scale + shift);
                let triangles: Vec<Triangle> = triangles.iter().map(|t| t.map(place)).collect();
                let shapes = shapes.iter().map(|s| placed(s, scale, shift)).collect();
                let scene = scene(triangles, shapes);
                let world = World {
                    name: format!("{name} × {scale} + {shift}"),
                    surfaces: Surfaces::new(&scene).unwrap(),
                    scene,
                };
                for _ in 0..looks {
                    let Some(view) = world.look(&mut random, place, &mut c) else { continue };
                    world.test(&view, &mut random, &mut c);
                    if world.scene.triangles.len() < 20 {
                        for _ in 0..EDGES {
                            let Some((other, view)) = world.with_edge(&view, &mut random) else { break };
                            other.test(&view, &mut random, &mut c);
                        }
                    }
                }
            }
        }
    }
    println!("{c:#?}");
    c
}

#[test]
fn certificates_agree_with_brute_force() {
    let c = campaign(scenes, 100, 1, 1);
    assert!(c.lit * 10 > c.corridors && c.dark * 20 > c.corridors && c.blockers * 20 > c.corridors, "{c:?}");
    assert!(c.covered * 50 > c.pairs, "{c:?}");
    assert!(c.unclear * 200 < c.pairs, "{c:?}");
    assert!(c.off < 0.5 && c.height > 2.0, "{c:?}");
}

/// Each body that a certificate lists hides what its triangles hide.
#[test]
fn bodies_agree_with_their_triangles() {
    let c = campaign(solids, 100, 3, 7);
    assert!(c.with_bodies * 60 > c.corridors && c.dark * 20 > c.corridors && c.lit * 20 > c.corridors, "{c:?}");
    assert!(c.solid_unclear * 100 < c.solid && c.solid_met * 20 > c.solid, "{c:?}");
    assert!(c.partial * 20 > c.shadows, "{c:?}");
}

#[test]
#[ignore = "three million patches and lights: some minutes"]
fn bodies_agree_with_their_triangles_at_length() {
    let c = campaign(solids, 300, 36, 2_000_000);
    assert!(c.solid_unclear * 100 < c.solid, "{c:?}");
}

#[test]
#[ignore = "ten million patches and lights: ten minutes"]
fn certificates_agree_with_brute_force_at_length() {
    let c = campaign(scenes, 450, 36, 1_000_000);
    assert!(c.corridors >= 10_000_000 && c.off < 0.5 && c.height > 1.5, "{c:?}");
}

/// Median times of certificates, by outcome.
#[test]
#[ignore = "measures time"]
fn time_per_certificate() {
    for name in ["quads", "terrain"] {
        let scene = etendue_render::scene::load(name).unwrap();
        let surfaces = Surfaces::new(&scene).unwrap();
        let bodies = Bodies::new(&surfaces.bvh);
        let mut certifier = Certifier::new(&surfaces, &bodies, surfaces.light_shapes());
        let lights = surfaces.light_shapes().count();
        for (size, wideness) in [(256_u32, 1_u32), (1024, 16)] {
            let pinhole = Pinhole::new(&scene.camera, size, size);
            let (mut places, mut scratch) = (Vec::new(), Scratch::default());
            for y in (0..size).step_by(wideness as usize) {
                for x in (0..size).step_by(wideness as usize) {
                    let middle = [x, y].map(|x| f32x8::splat(x as f32 + 0.5 * wideness as f32));
                    let (origin, direction) = pinhole.ray(middle[0], middle[1]);
                    let mut hits = [Hits::none(f32x8::splat(f32::INFINITY))];
                    let ray = surfaces.bvh.rays(origin, direction);
                    surfaces.bvh.closest(&[ray], &[M8::splat(true)], &mut hits, &mut scratch);
                    let place = hits[0].place.to_array()[0];
                    if place != NOTHING {
                        let area = [x, y, x + wideness, y + wideness].map(f64::from);
                        places.push((place, Pyramid::new(&pinhole, area)));
                    }
                }
            }
            let start = std::time::Instant::now();
            let patch = |(place, pyramid): &(u32, Pyramid)| Patch::of(&surfaces, *place, Viewer::Pixels(pyramid));
            let patches: Vec<Patch> = places.iter().filter_map(patch).collect();
            let nanoseconds = start.elapsed().as_secs_f64() * 1e9 / places.len() as f64;
            println!(
                "{name} at {size}, {wideness}: {} patches of {}, {nanoseconds:.0} ns each",
                patches.len(),
                places.len()
            );
            let mut outcomes = [const { Vec::new() }; 4];
            for light in 0..lights {
                for patch in &patches {
                    let start = std::time::Instant::now();
                    let outcome = match certifier.certify(patch, light) {
                        Certificate::Lit => 0,
                        Certificate::Dark => 1,
                        Certificate::Blockers(_) => 2,
                        Certificate::Unknown => 3,
                    };
                    outcomes[outcome].push(start.elapsed().as_secs_f64() * 1e6);
                }
            }
            for (outcome, mut times) in ["lit", "dark", "blockers", "unknown"].iter().zip(outcomes) {
                times.sort_by(f64::total_cmp);
                let at = |share: f64| times.get((times.len() as f64 * share) as usize).unwrap_or(&0.0);
                println!("    {outcome:8} {:7}, {:.2} µs, 90 % below {:.2} µs", times.len(), at(0.5), at(0.9));
            }
        }
    }
}
