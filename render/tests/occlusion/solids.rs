//! Scenes with convex polyhedra, by regimes.

use super::scene::{Faceted, Scene};
use super::scenes::{Placement, corners};
use super::truth::{polygon, sphere};
use etendue_judge::generators::Random;
use etendue_oracle::{V3, along, basis, cross, dot, narrow, sub, unit};

/// The least gap between a polyhedron and the light, relative to the way to the light.
const TOUCHES: f64 = 1.0 / 131_072.0;

/// How polyhedra are placed.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum SolidKind {
    Any,
    Tiny,
    Huge,
    Near,
    Plate,
    Needle,
    TouchLight,
    CrossHorizon,
    Standing,
    GrazingFace,
    Inside,
    Several,
    AmongPolygons,
}
pub(crate) const SOLID_KINDS: [SolidKind; 13] = [
    SolidKind::Any,
    SolidKind::Tiny,
    SolidKind::Huge,
    SolidKind::Near,
    SolidKind::Plate,
    SolidKind::Needle,
    SolidKind::TouchLight,
    SolidKind::CrossHorizon,
    SolidKind::Standing,
    SolidKind::GrazingFace,
    SolidKind::Inside,
    SolidKind::Several,
    SolidKind::AmongPolygons,
];

/// Corners, and the corners of each face in order around.
type Form = (Vec<V3>, Vec<Vec<usize>>);

/// A prism over a regular polygon with n corners, or its frustum, within [−1, 1]³.
fn prism(n: usize, top: f64) -> Form {
    let corner = |k: usize| {
        let (sin, cos) = ((k % n) as f64 / n as f64 * core::f64::consts::TAU).sin_cos();
        if k < n { [cos, sin, -1.0] } else { [top * cos, top * sin, 1.0] }
    };
    let mut faces: Vec<Vec<usize>> = (0..n).map(|k| vec![k, (k + 1) % n, n + (k + 1) % n, n + k]).collect();
    faces.push((0..n).collect());
    faces.push((n..2 * n).collect());
    ((0..2 * n).map(corner).collect(), faces)
}

/// The box [−1, 1]³.
fn block() -> Form {
    let corners = (0..8).map(|k| [0, 1, 2].map(|axis| f64::from(k >> axis & 1) * 2.0 - 1.0)).collect();
    let faces = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    (corners, faces.map(Vec::from).into())
}

fn form(random: &mut Random) -> Form {
    match random.word() % 7 {
        0 => {
            let corners = vec![[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
            (corners, vec![vec![0, 1, 2], vec![0, 1, 3], vec![0, 2, 3], vec![1, 2, 3]])
        }
        1 => prism(3, 1.0),
        2 => prism(5, 1.0),
        3 => prism(6, 1.0),
        4 => prism(4, random.range(0.3, 0.9)),
        _ => block(),
    }
}

/// A scene with polyhedra before a light, which is a sphere if `round`.
pub(crate) fn scene_with_solids(random: &mut Random, kind: SolidKind, round: bool) -> Scene {
    let toward = random.direction();
    let (s, t) = basis(toward);
    let size = if round { random.magnitude(0.05, 0.9) } else { random.magnitude(0.05, 1.5) };
    let tilt = along(toward, random.direction(), if kind == SolidKind::Huge { 0.1 } else { 0.9 });
    let plane = basis(unit(tilt));
    let radii = [size, size * random.magnitude(0.3, 1.0)];
    let flat = corners(random, toward, [plane.0, plane.1], radii);
    let light = if round { sphere(toward, size) } else { polygon(&flat) };
    // polyhedra have across · x below the limit
    let across = if round { toward } else { unit(cross(plane.0, plane.1)) };
    let limit = if round { 1.0 - size * size } else { dot(across, toward) };
    let (across, limit) = if limit < 0.0 { (across.map(|x| -x), -limit) } else { (across, limit) };
    let mut normal = unit(along(toward, random.direction(), random.range(0.0, 1.5)));
    let count = if kind == SolidKind::Several { 2 + random.word() % 2 } else { 1 };
    let mut solids: Vec<Form> = Vec::new();
    for _ in 0..count {
        let f = match kind {
            SolidKind::Near => random.magnitude(1e-2, 0.2),
            _ => random.range(0.1, 0.9),
        };
        let aside = along(s.map(|x| x * random.range(-0.8, 0.8)), t, random.range(-0.8, 0.8));
        let mut middle = along(toward, aside, size).map(|x| x * f);
        let own = f * match kind {
            SolidKind::Tiny => random.magnitude(2e-4, 1e-2),
            SolidKind::Several => size * random.magnitude(0.1, 0.7),
            SolidKind::Needle => size * random.magnitude(0.5, 1.5),
            _ => size * random.magnitude(0.1, 1.5),
        };
        let mut half = [own, own * random.magnitude(0.2, 1.0), own * random.magnitude(0.2, 1.0)];
        let z = random.direction();
        let (x, y) = basis(z);
        let mut axes = [x, y, z];
        let (mut corners, faces) = form(random);
        match kind {
            SolidKind::Huge => {
                let side = random.magnitude(1.0, 30.0);
                let own = basis(unit(along(toward, random.direction(), 0.05)));
                axes = [own.0, own.1, cross(own.0, own.1)];
                half = [side, side * random.range(0.2, 1.0), 0.3 * f * limit.min(f)];
                // one of its faces ends before the light
                middle = along(middle, axes[0], side);
            }
            SolidKind::Plate => half[2] = own * random.magnitude(2e-3, 5e-2),
            // wider than the rounding of its corners, with a centre inside
            SolidKind::Needle => (half[1], half[2]) = (own * 0.03, own * random.magnitude(1e-2, 3e-2)),
            SolidKind::CrossHorizon => {
                normal = unit(along(normal, middle, -dot(normal, middle) / dot(middle, middle)));
            }
            SolidKind::Standing => {
                let (a, b) = basis(normal);
                let turn = random.direction();
                let a = unit(along(along(a, b, turn[0]), b, turn[1]));
                axes = [a, cross(normal, a), normal];
                (corners, _) = block();
                middle = along(middle, normal, half[2] - dot(middle, normal));
                if random.unit() < 0.3 {
                    middle = along(middle, normal, -half[2] * random.magnitude(1e-6, 0.5));
                }
            }
            SolidKind::GrazingFace => {
                // the plane of a face passes the points at a small distance
                let x = unit(cross(middle, random.direction()));
                axes = [x, unit(cross(x, middle)), unit(middle)];
                let off = random.magnitude(1e-7, 1e-2) * if random.unit() < 0.5 { -1.0 } else { 1.0 };
                middle = along(middle, x, off - half[0]);
            }
            SolidKind::Inside => {
                half = [0; 3].map(|_| random.range(0.1, 0.5) * limit);
                middle = random.direction().map(|x| x * 0.2 * limit);
            }
            _ => {}
        }
        let faces = if kind == SolidKind::Standing { block().1 } else { faces };
        if kind == SolidKind::GrazingFace && corners.len() != 8 {
            continue;
        }
        let at = |v: &V3| (0..3).fold(middle, |sum, k| along(sum, axes[k], v[k] * half[k]));
        let mut corners: Vec<V3> = corners.iter().map(at).collect();
        let reach = |corners: &[V3]| corners.iter().map(|&v| dot(across, v) / limit).fold(0.0, f64::max);
        if kind == SolidKind::TouchLight {
            // the gap is a little more than the rounding of ends
            let scale = (1.0 - TOUCHES * random.magnitude(1.5, 1e3)) / reach(&corners);
            corners.iter_mut().for_each(|v| *v = v.map(|x| x * scale));
        }
        for _ in 0..30 {
            if reach(&corners) < 1.0 - 1.3 * TOUCHES {
                break;
            }
            let middle = corners.iter().fold([0.0; 3], |sum, &v| along(sum, v, 1.0 / corners.len() as f64));
            corners.iter_mut().for_each(|v| *v = along(middle, sub(*v, middle), 0.8));
        }
        solids.push((corners, faces));
    }
    let mut occluders = Vec::new();
    if kind == SolidKind::AmongPolygons {
        for _ in 0..1 + random.word() % 3 {
            let aside = along(s.map(|x| x * random.range(-0.8, 0.8)), t, random.range(-0.8, 0.8));
            let f = random.range(0.1, 0.9);
            let plane = basis(unit(along(toward, random.direction(), 0.7)));
            let own = f * size * random.magnitude(0.1, 1.0);
            let middle = along(toward, aside, size).map(|x| x * f);
            occluders.push(polygon(&corners(random, middle, [plane.0, plane.1], [own; 2])));
        }
    }
    let spread = match kind {
        SolidKind::Inside => 0.3 * limit,
        SolidKind::Near | SolidKind::GrazingFace => 1e-3 * size,
        _ => 0.2 * size.min(0.5),
    };
    let points = core::array::from_fn(|i| {
        let off = random.direction();
        // on the surface, so that what stands on it touches the horizon
        let off = along(off, normal, -dot(off, normal));
        narrow(off.map(|x| if i == 0 { 0.0 } else { spread * x }))
    });
    let normals = core::array::from_fn(|i| {
        let off = if kind == SolidKind::Standing || i < 2 { 0.0 } else { 0.1 };
        narrow(unit(along(normal, random.direction(), off)))
    });
    let placement = Placement::new(random);
    let scene = placement.scene(Scene { light, occluders, solids: Vec::new(), points, normals });
    let solid = |(corners, faces): &Form| {
        let corners: Vec<_> = corners.iter().map(|&v| placement.point(v)).collect();
        Faceted::new(&corners, faces)
    };
    Scene { solids: solids.iter().map(solid).collect(), ..scene }
}
