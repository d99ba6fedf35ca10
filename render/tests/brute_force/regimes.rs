//! Scenes of the regimes in which closed forms lose digits, and points of view from which blockers cut their lights.

use super::scenes::{light_point, quad, shape};
use super::solids::{Solid, block, cut, moved};
use super::views::{Fit, View, World};
use crate::meshes::{Random, Triangle};
use etendue_oracle::{V3, along, cross, dot, length, sub, unit, wide};
use etendue_render::scene::{Geometry, Parallelogram, Shape, Sphere};

/// A scene, and how many of its first triangles receive light in most of the views.
pub(crate) struct Setting {
    pub(crate) triangles: Vec<Triangle>,
    pub(crate) shapes: Vec<Shape>,
    pub(crate) floors: usize,
}

/// A name, and what makes its scenes.
type Regime = (&'static str, fn(&mut Random) -> Setting);

/// All regimes.
pub(crate) const REGIMES: [Regime; 7] = [
    ("thin sheets", sheets),
    ("chamfered boxes", chamfered),
    ("inside spheres", inside),
    ("touching spheres", touching),
    ("small and far lights", far_lights),
    ("small lights far out", far_out),
    ("long walls", walls),
];

/// A number between two others, evenly by its logarithm.
fn between(random: &mut Random, low: f64, high: f64) -> f64 {
    low * (high / low).powf(f64::from(random.unit()))
}

fn narrow(v: V3) -> [f32; 3] {
    v.map(|x| x as f32)
}

fn anywhere(random: &mut Random, reach: f64) -> V3 {
    wide(random.point()).map(|x| x * reach)
}

/// A place above the floor.
fn above(random: &mut Random, distance: f64) -> V3 {
    let tilt = [0, 1].map(|_| 0.7 * f64::from(random.signed()));
    [tilt[0] * distance, distance, tilt[1] * distance]
}

/// A lamp of any form around a place, seen from the origin.
fn lamp(random: &mut Random, center: V3, size: f64) -> Shape {
    let turned = [0; 2].map(|_| narrow(anywhere(random, size)));
    let geometry = match random.below(4) {
        0 => Geometry::Sphere(Sphere { center: narrow(center), radius: size as f32 }),
        1 => Geometry::Triangle([0; 3].map(|_| narrow(along(center, wide(random.point()), size)))),
        2 => Geometry::Parallelogram(Parallelogram { p: narrow(center), u: turned[0], v: turned[1] }),
        _ => Geometry::Parallelogram(Parallelogram {
            p: narrow(center),
            u: [size as f32, 0.0, 0.0],
            v: [0.0, 0.0, size as f32],
        }),
    };
    shape(geometry, Some(true))
}

fn floor(reach: f64) -> Vec<Triangle> {
    let e = reach as f32;
    quad([-e, 0.0, -e], [2.0 * e, 0.0, 0.0], [0.0, 0.0, 2.0 * e]).into()
}

/// Lamps beyond a body of this size at a place: so large that single precision suffices, or as small as the displacement of an edge counts.
fn beyond(random: &mut Random, center: V3, size: f64) -> Vec<Shape> {
    let each = |random: &mut Random| {
        let factor = 1.0 + between(random, 0.05, 3.0);
        let place = along(center.map(|x| x * factor), wide(random.point()), 0.5 * size);
        let size = if random.below(2) == 0 {
            length(place) * between(random, 0.1, 1.0)
        } else {
            size * factor * between(random, 1e-3, 3.0)
        };
        lamp(random, place, size)
    };
    (0..2).map(|_| each(random)).collect()
}

/// Closed sheets, no thicker than their rounding or as thick as a slab, up to 300 above the floor.
fn sheets(random: &mut Random) -> Setting {
    let distance = between(random, 0.5, 300.0);
    let center = above(random, distance);
    let thickness = between(random, 1e-5, 1e-1);
    let half = [between(random, 0.1, 1.0), 0.5 * thickness, between(random, 0.1, 1.0)];
    let place = moved(half, center, random.below(3), random);
    let mut triangles = floor(4.0 * distance + 4.0);
    triangles.extend(cut(&block(), place, random));
    if random.below(3) == 0 {
        let other = moved(half, along(center, wide(random.point()), 0.5), 2, random);
        triangles.extend(cut(&block(), other, random));
    }
    Setting { triangles, shapes: beyond(random, center, 1.0), floors: 2 }
}

/// The box [−1, 1]³ with this much of the edges at some of its corners cut off.
fn chamfer(cuts: [f64; 8]) -> Solid {
    let (corners, faces) = block();
    let mut places = corners.clone();
    // for each corner that is cut, the places on its edges, by axis
    let mut ends = [[0; 3]; 8];
    for (k, corner) in corners.iter().enumerate() {
        ends[k] = [k; 3];
        if cuts[k] > 0.0 {
            for axis in 0..3 {
                let mut place = *corner;
                place[axis] -= cuts[k] * corner[axis];
                ends[k][axis] = places.len();
                places.push(place);
            }
        }
    }
    let mut all = Vec::new();
    for face in faces {
        let mut around = Vec::new();
        for (i, &k) in face.iter().enumerate() {
            let axis = |other: usize| (k ^ other).trailing_zeros() as usize;
            let (before, after) = (face[(i + face.len() - 1) % face.len()], face[(i + 1) % face.len()]);
            around.push(ends[k][axis(before)]);
            if cuts[k] > 0.0 {
                around.push(ends[k][axis(after)]);
            }
        }
        all.push(around);
    }
    all.extend((0..8).filter(|&k| cuts[k] > 0.0).map(|k| ends[k].to_vec()));
    (places, all)
}

/// Boxes with corners cut off, from as little as nothing.
fn chamfered(random: &mut Random) -> Setting {
    let size = between(random, 0.1, 2.0);
    let distance = between(random, 1.0, 60.0) * size;
    let center = above(random, distance);
    let half = [0; 3].map(|_| size * between(random, 0.3, 1.0));
    let mut cuts = [0.0; 8];
    for _ in 0..1 + random.below(3) {
        cuts[random.below(8)] = between(random, 1e-7, 1e-1);
    }
    let place = moved(half, center, random.below(3), random);
    let mut triangles = floor(4.0 * distance + 4.0 * size);
    triangles.extend(cut(&chamfer(cuts), place, random));
    Setting { triangles, shapes: beyond(random, center, size), floors: 2 }
}

/// Spheres around the floor, with lamps and blockers inside and outside.
fn inside(random: &mut Random) -> Setting {
    let mut triangles = floor(0.5);
    let mut shapes = Vec::new();
    for _ in 0..1 + random.below(2) {
        let radius = between(random, 0.5, 4.0);
        let center = along([0.0; 3], wide(random.point()), 0.6 * radius);
        shapes.push(shape(Geometry::Sphere(Sphere { center: narrow(center), radius: radius as f32 }), None));
    }
    for _ in 0..2 {
        let distance = between(random, 0.3, 8.0);
        let center = above(random, distance);
        let size = distance * between(random, 0.003, 0.3);
        shapes.push(lamp(random, center, size));
    }
    if random.below(2) == 0 {
        let center = above(random, 0.25);
        let half = [0.1, 0.02, 0.1];
        triangles.extend(cut(&block(), moved(half, center, 2, random), random));
    }
    if random.below(2) == 0 {
        shapes.push(shape(Geometry::Sphere(Sphere { center: narrow(above(random, 0.2)), radius: 0.05 }), None));
    }
    Setting { triangles, shapes, floors: 2 }
}

/// Spheres that rest on the floor and on each other, some of them as large as the floor or cut by it.
fn touching(random: &mut Random) -> Setting {
    let mut triangles = floor(4.0);
    let mut shapes = Vec::new();
    let mut last: Option<(V3, f64)> = None;
    for k in 0..1 + random.below(3) {
        let radius = between(random, 0.02, 2.0);
        let center = match last {
            Some((below, size)) if random.below(2) == 0 => {
                let up = unit(above(random, 1.0));
                along(below, up, size + radius)
            }
            _ => {
                let height = if random.below(4) == 0 { radius * f64::from(random.unit()) } else { radius };
                let at = anywhere(random, 1.0 + 2.0 * f64::from(k as u32));
                [at[0], height, at[2]]
            }
        };
        shapes.push(shape(Geometry::Sphere(Sphere { center: narrow(center), radius: radius as f32 }), None));
        last = Some((center, radius));
    }
    for _ in 0..2 {
        let distance = between(random, 0.5, 30.0);
        let center = above(random, distance);
        let size = distance * between(random, 0.001, 0.5);
        shapes.push(lamp(random, center, size));
    }
    if random.below(3) == 0 {
        triangles.extend(quad(narrow(above(random, 1.0)), random.point(), random.point()));
    }
    Setting { triangles, shapes, floors: 2 }
}

/// Lights from 10 µm to 1, at distances up to 10⁶, behind something of size 1.
fn far_lights(random: &mut Random) -> Setting {
    let mut triangles = floor(8.0);
    let mut shapes = Vec::new();
    let height = between(random, 0.5, 3.0);
    match random.below(4) {
        0 => triangles.push([0; 3].map(|_| narrow(along([0.0, height, 0.0], wide(random.point()), 1.0)))),
        1 => triangles.extend(quad(narrow(above(random, height)), random.point(), random.point())),
        2 => {
            let half = [0; 3].map(|_| between(random, 0.1, 0.6));
            triangles.extend(cut(&block(), moved(half, above(random, height), 2, random), random));
        }
        _ => {
            let radius = between(random, 0.05, 0.9) * height;
            shapes.push(shape(
                Geometry::Sphere(Sphere { center: narrow(above(random, height)), radius: radius as f32 }),
                None,
            ));
        }
    }
    for _ in 0..2 {
        let distance = if random.below(2) == 0 { between(random, 4.0, 40.0) } else { between(random, 4.0, 1e6) };
        let center = above(random, distance);
        let size = if random.below(2) == 0 {
            between(random, 1e-5, 1.0)
        } else {
            (distance * between(random, 1e-7, 1e-1)).max(1e-5)
        };
        shapes.push(lamp(random, center, size));
    }
    Setting { triangles, shapes, floors: 2 }
}

/// Lights of millimetres near a floor, all at coordinates of 40 to 700.
fn far_out(random: &mut Random) -> Setting {
    let reach = between(random, 40.0, 700.0);
    let shift = wide(random.point()).map(|x| (x * reach) as f32);
    let mut triangles = floor(2.0);
    let mut shapes = Vec::new();
    for _ in 0..2 {
        let distance = between(random, 0.2, 2.0);
        let center = above(random, distance);
        let size = between(random, 3e-4, 3e-2);
        shapes.push(lamp(random, center, size));
    }
    for _ in 0..random.below(3) {
        let center = above(random, 0.15);
        match random.below(3) {
            0 => triangles.push([0; 3].map(|_| narrow(along(center, wide(random.point()), 0.1)))),
            1 => triangles.extend(cut(&block(), moved([0.05, 0.01, 0.03], center, 2, random), random)),
            _ => shapes.push(shape(Geometry::Sphere(Sphere { center: narrow(center), radius: 0.05 }), None)),
        }
    }
    let triangles = triangles.iter().map(|t| t.map(|v| std::array::from_fn(|k| v[k] + shift[k]))).collect();
    for shape in &mut shapes {
        let moved = match &mut shape.geometry {
            Geometry::Sphere(Sphere { center, .. }) => std::slice::from_mut(center),
            Geometry::Triangle(corners) => &mut corners[..],
            Geometry::Parallelogram(Parallelogram { p, .. }) => std::slice::from_mut(p),
            other => panic!("no shape is {other:?}"),
        };
        moved.iter_mut().for_each(|v| (0..3).for_each(|k| v[k] += shift[k]));
    }
    Setting { triangles, shapes, floors: 2 }
}

/// Walls and fences up to 1000 times as long as high, lamps behind them: points next to a wall see its edges under nearly 180°.
fn walls(random: &mut Random) -> Setting {
    let (height, reach) = (between(random, 0.05, 2.0), between(random, 5.0, 50.0));
    let half = [reach, 0.5 * height, 0.5 * height * between(random, 1e-3, 1.0)];
    let mut triangles = floor(2.0 * reach);
    let place = moved(half, [0.0, 0.5 * height, 0.0], random.below(2), random);
    let side = unit(sub(place([0.0, 0.0, 1.0]), place([0.0; 3])));
    if random.below(4) == 0 {
        let [corner, end, top] = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [-1.0, 1.0, 0.0]].map(&place);
        triangles.extend(quad(narrow(corner), narrow(sub(end, corner)), narrow(sub(top, corner))));
    } else {
        triangles.extend(cut(&block(), &place, random));
    }
    let each = |random: &mut Random| {
        let along_it = place([f64::from(random.signed()), 1.0, 0.0]);
        let from = along([along_it[0], 0.0, along_it[2]], side, height * between(random, 0.1, 5.0));
        let center = along(from, sub(along_it, from), between(random, 1.3, 30.0));
        let size = length(sub(center, from)) * between(random, 1e-3, 1.0);
        lamp(random, center, size)
    };
    let shapes = [0; 2].map(|_| each(random)).into();
    Setting { triangles, shapes, floors: 2 }
}

impl World {
    /// A view of a place where a light is seen past the edge of something, on one of the first `floors` triangles or on a sphere.
    pub(crate) fn look_past_edges(&self, floors: usize, random: &mut Random, fit: &mut Fit) -> Option<View> {
        let lights: Vec<u32> = self.surfaces.light_shapes().collect();
        let light = &self.scene.shapes[*lights.get(random.below(lights.len().max(1)))? as usize].geometry;
        let spheres = self.scene.shapes.iter().filter(|shape| shape.emission.is_none());
        let spheres: Vec<_> = spheres.collect();
        let y = light_point(light, wide(random.point()), random);
        if !spheres.is_empty() && random.below(8) == 0 {
            let Geometry::Sphere(Sphere { center, radius }) = spheres[random.below(spheres.len())].geometry else {
                return None;
            };
            let target = along(wide(center), unit(wide(random.point())), f64::from(radius));
            let out = unit(along(sub(target, wide(center)), wide(random.point()), 0.5 * f64::from(radius)));
            let origin = along(target, out, f64::from(radius) * between(random, 0.1, 10.0));
            return self.look_at(origin, target, random, fit);
        }
        let [a, b, d] = self.scene.triangles[random.below(floors)].map(wide);
        let normal = unit(cross(sub(b, a), sub(d, a)));
        let triangles = &self.scene.triangles;
        let blockers = &triangles[if floors < triangles.len() { floors } else { 0 }..];
        let choice = random.below(blockers.len() + spheres.len());
        let x = if let Some(triangle) = blockers.get(choice).map(|t| t.map(wide)) {
            let k = random.below(3);
            along(triangle[k], sub(triangle[(k + 1) % 3], triangle[k]), f64::from(random.unit()))
        } else {
            let Geometry::Sphere(Sphere { center, radius }) = spheres[choice - blockers.len()].geometry else {
                return None;
            };
            let out = unit(cross(sub(wide(center), y), wide(random.point())));
            along(wide(center), out, f64::from(radius))
        };
        let fall = dot(normal, sub(x, y));
        let target = along(y, sub(x, y), dot(normal, sub(a, y)) / fall);
        let inside = |p: V3, q: V3| dot(normal, cross(sub(q, p), sub(target, p))) >= 0.0;
        let is_met = inside(a, b) && inside(b, d) && inside(d, a) && length(sub(target, x)).is_finite();
        let target = if is_met {
            target
        } else {
            let (u, v) = (f64::from(random.unit()), f64::from(random.unit()));
            along(along(a, sub(b, a), u * (1.0 - v)), sub(d, a), v)
        };
        let side = dot(normal, sub(y, target)).signum();
        let up = normal.map(|x| x * side);
        let out = unit(along(up, wide(random.point()), between(random, 0.1, 10.0)));
        let out = if dot(out, up) > 0.0 { out } else { out.map(|x| -x) };
        let distance = length(sub(target, x)) * between(random, 0.02, 5.0);
        self.look_at(along(target, out, distance), target, random, fit)
    }
}
