//! Small scenes on a lattice, so that their parts touch, coincide and are parallel, whose certificates must agree with single segments.

use etendue_oracle::{V3, along, cross, dot, length, sub, unit, wide};
use etendue_render::bvh::SHAPE;
use etendue_render::camera::Pinhole;
use etendue_render::certify::{Bodies, Certifier, patch};
use etendue_render::scene::{
    CameraSettings, Emission, Geometry, Material, Parallelogram, Scene, Screen, Shape, Sphere,
};
use etendue_render::surfaces::Surfaces;
use etendue_visible::{MOST, Proof, Solid, Viewer};

/// Reads bytes as numbers; zeros follow the last.
struct Input<'a> {
    bytes: std::slice::Iter<'a, u8>,
    scale: f32,
    shift: f32,
}

impl Input<'_> {
    fn byte(&mut self) -> u8 {
        self.bytes.next().copied().unwrap_or(0)
    }
    fn below(&mut self, n: usize) -> usize {
        usize::from(self.byte()) % n
    }
    /// A lattice point in [−4, 4)³.
    fn vector(&mut self) -> [f32; 3] {
        std::array::from_fn(|_| f32::from(self.byte() as i8) / 32.0 * self.scale)
    }
    fn point(&mut self) -> [f32; 3] {
        self.vector().map(|x| x + self.shift * self.scale)
    }
    fn triangle(&mut self) -> [[f32; 3]; 3] {
        [0; 3].map(|_| self.point())
    }
    fn radius(&mut self) -> f32 {
        f32::from(self.byte()) / 64.0 * self.scale
    }
    fn light(&mut self) -> Geometry {
        match self.below(3) {
            0 => Geometry::Sphere(Sphere { center: self.point(), radius: self.radius() }),
            1 => Geometry::Triangle(self.triangle()),
            _ => Geometry::Parallelogram(Parallelogram { p: self.point(), u: self.vector(), v: self.vector() }),
        }
    }
}

/// Whether a segment meets a triangle by a clear margin, or misses it by one.
fn meets_triangle(p: V3, y: V3, corners: [V3; 3]) -> [bool; 2] {
    let [a, b, c] = corners;
    let (d, e1, e2, s) = (sub(y, p), sub(b, a), sub(c, a), sub(p, a));
    let normal = cross(e1, e2);
    let slope = -dot(normal, d);
    let crosses = slope.abs() > 1e-7 * length(normal) * length(d);
    if !crosses {
        return [false; 2];
    }
    let moment = cross(s, d);
    let (t, u, v) = (dot(normal, s) / slope, dot(e2, moment) / slope, -dot(e1, moment) / slope);
    let least = u.min(v).min(1.0 - u - v).min(t * 100.0).min((1.0 - 1.0 / 131_072.0 - t) * 100.0);
    [least > 1e-5, least < -1e-5]
}

fn meets_polygon(p: V3, y: V3, corners: &[V3]) -> [bool; 2] {
    let parts = (2..corners.len()).map(|k| meets_triangle(p, y, [corners[0], corners[k - 1], corners[k]]));
    parts.fold([false, true], |all, part| [all[0] | part[0], all[1] & part[1]])
}

fn meets_sphere(p: V3, y: V3, center: V3, radius: f64) -> [bool; 2] {
    let d = sub(y, p);
    let t = (dot(sub(center, p), d) / dot(d, d)).clamp(0.0, 1.0);
    let distance = |q: V3| length(sub(q, center)) / radius;
    let (least, most) = (distance(along(p, d, t)), distance(p).max(distance(y)));
    let clear = 1e-5 * (1.0 + most);
    [least < 1.0 - clear && most > 1.0 + clear, least > 1.0 + clear]
}

fn parallelogram(p: V3, u: V3, v: V3) -> [V3; 4] {
    [p, along(p, u, 1.0), along(along(p, u, 1.0), v, 1.0), along(p, v, 1.0)]
}

fn meets(p: V3, y: V3, geometry: &Geometry) -> [bool; 2] {
    match *geometry {
        Geometry::Sphere(Sphere { center, radius }) => meets_sphere(p, y, wide(center), f64::from(radius)),
        Geometry::Triangle(corners) => meets_triangle(p, y, corners.map(wide)),
        Geometry::Parallelogram(Parallelogram { p: corner, u, v }) => {
            meets_polygon(p, y, &parallelogram(wide(corner), wide(u), wide(v)))
        }
        ref other => unreachable!("no scene has {other:?}"),
    }
}

/// May a solid hide y from p? `body` tells the triangles of a polyhedron.
fn is_listed<I: Iterator<Item = [[f32; 3]; 3]>>(p: V3, y: V3, solids: &[Solid], body: impl Fn(&Solid) -> I) -> bool {
    solids.iter().any(|solid| match *solid {
        Solid::Sphere { center, radius } => !meets_sphere(p, y, center.into(), radius)[1],
        Solid::Parallelogram { corner, edges: [u, v] } => {
            !meets_polygon(p, y, &parallelogram(corner.into(), u.into(), v.into()))[1]
        }
        Solid::Polygon { corners, count, .. } => !meets_polygon(p, y, &corners.map(V3::from)[..count])[1],
        Solid::Polyhedron(_) => body(solid).any(|t| !meets_triangle(p, y, t.map(wide))[1]),
    })
}

fn scene(triangles: Vec<[[f32; 3]; 3]>, shapes: Vec<Shape>, camera: CameraSettings) -> Scene {
    Scene {
        materials: vec![Material::Diffuse([0.5; 3])],
        triangle_materials: vec![0; triangles.len()],
        triangles,
        shapes: shapes.into(),
        ..Scene::new(camera, [16; 2])
    }
}

/// Any small scene has a certificate for the light of shape 0 as seen from triangle 0 or from the last sphere. No segment from there to
/// the light contradicts it.
pub fn certificates(bytes: &[u8]) {
    let mut input = Input { bytes: bytes.iter(), scale: 1.0, shift: 0.0 };
    let kind = input.below(16);
    input.scale = [1.0, 1e-6, 1e6, 1.0, 1e-30, 1e15, 1.0, 0.01][kind % 8];
    input.shift = [0.0, 0.0, 0.0, 100.0, 0.0, 0.0, 0.0, 0.0][kind % 8];
    let two_sided = input.below(2) == 0;
    let light = Shape {
        geometry: input.light(),
        material: 0,
        emission: Some(Emission { radiance: [1.0; 3], two_sided, ..Emission::default() }),
    };
    let view = input.below(4);
    let origin = wide(input.point());
    let place = input.below(256);
    let receiver = input.triangle();
    let mut triangles = vec![receiver];
    let mut shapes = vec![light.clone()];
    for _ in 0..input.below(24) {
        match input.below(8) {
            0 => {
                let geometry = Geometry::Sphere(Sphere { center: input.point(), radius: input.radius() });
                shapes.push(Shape { geometry, material: 0, emission: None });
            }
            // two triangles of a quadrilateral
            1..4 => {
                let [p, u, v] = [input.point(), input.vector(), input.vector()];
                let add = |a: [f32; 3], b: [f32; 3]| std::array::from_fn(|k| a[k] + b[k]);
                triangles.push([p, add(p, u), add(add(p, u), v)]);
                triangles.push([p, add(add(p, u), v), add(p, v)]);
            }
            // a box, or one with a triangle missing
            4 | 5 => {
                let [p, u, v, w] = [input.point(), input.vector(), input.vector(), input.vector()];
                let corner = |k: usize| {
                    let side = |bit: usize, v: f32| if k >> bit & 1 == 0 { 0.0 } else { v };
                    std::array::from_fn(|axis| p[axis] + side(0, u[axis]) + side(1, v[axis]) + side(2, w[axis]))
                };
                for [a, b, c, d] in [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]]
                {
                    triangles.extend([[a, b, c], [c, d, a]].map(|t: [usize; 3]| t.map(corner)));
                }
                if input.below(8) == 0 {
                    triangles.pop();
                }
            }
            _ => triangles.push(input.triangle()),
        }
    }
    let [a, b, c] = receiver.map(wide);
    let target = along(along(a, sub(b, a), place as f64 / 512.0), sub(c, a), 0.25);
    let forward = unit(sub(target, origin));
    let right = unit(cross(forward, [0.3, 1.0, 0.2]));
    let up = cross(right, forward);
    if length(up) == 0.0 {
        return;
    }
    let camera =
        CameraSettings { origin, forward, right, up, is_orthographic: false, screen: Screen::Half(0.364), lens: None };
    let pyramid = Pinhole::new(&camera, 16, 16).pyramid([7.0, 7.0, 9.0, 9.0]);
    let scene = scene(triangles, shapes, camera);
    let Ok(surfaces) = Surfaces::new(&scene) else { return };
    let viewer = [Viewer::Pixels(&pyramid), Viewer::Pixels(&pyramid), Viewer::Front, Viewer::Back][view];
    let last = scene.shapes.len() - 1;
    let is_ball = matches!(scene.shapes[last].geometry, Geometry::Sphere(_)) && last > 0 && view == 2;
    let place = if is_ball {
        last as u32 | SHAPE
    } else {
        (0..).zip(surfaces.bvh.order()).find(|(_, id)| **id == 0).map_or(0, |(place, _)| place)
    };
    let Some(patch) = patch(&surfaces, place, viewer) else { return };
    let bodies = if kind < 12 { Bodies::new(&surfaces.bvh) } else { Bodies::default() };
    let of_body = |body: &Solid| {
        let bodies = &bodies;
        let body = bodies.solids().iter().position(|other| other == body).unwrap_or_default() as u32;
        let places = (0..).zip(surfaces.bvh.order()).filter(move |(place, _)| bodies.of(*place) == Some(body));
        places.map(|(_, id)| scene.triangles[*id as usize])
    };
    let mut certifier = Certifier::new(&surfaces, &bodies, [0]);
    let (proof, _) = certifier.certify(place, &patch, 0);
    if let Proof::Behind(solids) = proof {
        assert!((1..=MOST).contains(&solids.len()));
    }
    let corners: Vec<V3> = patch.corners().collect();
    for _ in 0..24 {
        let mut mix = || [0.0, 1.0, 0.5, 0.25, 0.9, 0.01][input.below(6)];
        let (p, normal) = match (patch.normal(), &scene.shapes[last].geometry) {
            (Some(normal), _) => {
                let (s, t) = (mix(), mix());
                let at = |k: usize| corners[k % corners.len()];
                let k = input.below(8);
                let edge = along(at(k), sub(at(k + 1), at(k)), s);
                (along(along(edge, sub(at(k + 2), edge), t), normal, patch.margin() / 4.0), normal)
            }
            (None, Geometry::Sphere(Sphere { center, radius })) => {
                let normal = unit(along([mix(), mix(), mix()], [0.5; 3], -1.0));
                (along(wide(*center), normal, f64::from(*radius) + patch.margin() / 8.0), normal)
            }
            _ => return,
        };
        let (s, t) = ([0.0, 1.0, 0.5, 0.3][input.below(4)], [0.0, 1.0, 0.5, 0.3][input.below(4)]);
        let y = match light.geometry {
            Geometry::Sphere(Sphere { center, radius }) => {
                let axis = unit(sub(p, wide(center)));
                let across = unit(cross(axis, wide(input.vector())));
                if across == [0.0; 3] {
                    continue;
                }
                let sin = 0.99 * s;
                let cos = f64::sqrt(1.0 - sin * sin);
                let radius = f64::from(radius);
                along(along(wide(center), axis, radius * cos), across, radius * sin)
            }
            Geometry::Triangle(corners) => {
                let [a, b, c] = corners.map(wide);
                along(along(a, sub(b, a), s * (1.0 - t)), sub(c, a), t)
            }
            Geometry::Parallelogram(Parallelogram { p, u, v }) => along(along(wide(p), wide(u), s), wide(v), t),
            ref other => unreachable!("no scene has {other:?}"),
        };
        let away = sub(p, y);
        let outward = match light.geometry {
            Geometry::Sphere(Sphere { center, .. }) => sub(y, wide(center)),
            Geometry::Triangle(corners) => {
                let [a, b, c] = corners.map(wide);
                cross(sub(b, a), sub(c, a))
            }
            Geometry::Parallelogram(Parallelogram { u, v, .. }) => cross(wide(u), wide(v)),
            ref other => unreachable!("no scene has {other:?}"),
        };
        let is_sphere = matches!(light.geometry, Geometry::Sphere(_));
        if !(dot(normal, away) < 0.0 && (dot(outward, away) > 0.0 || two_sided && !is_sphere)) {
            continue;
        }
        let others = (0..).zip(&scene.triangles).filter(|(id, _)| place & SHAPE != 0 || *id != 0_u32);
        let shapes = (0..).zip(scene.shapes.iter()).skip(1).filter(|(id, _)| id | SHAPE != place);
        let all =
            others.map(|(_, t)| meets_triangle(p, y, t.map(wide))).chain(shapes.map(|(_, s)| meets(p, y, &s.geometry)));
        let [met, missed] = all.fold([false, true], |all, one| [all[0] | one[0], all[1] & one[1]]);
        match proof {
            Proof::Lit => assert!(!met, "{p:?} → {y:?} is occluded, but lit"),
            Proof::Dark => assert!(!missed, "{p:?} → {y:?} is visible, but dark"),
            Proof::Behind(solids) => {
                assert!(!met || is_listed(p, y, solids, of_body), "{p:?} → {y:?} is occluded by none of {solids:?}");
            }
            Proof::Open => {}
        }
    }
}
