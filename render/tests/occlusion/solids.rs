//! Scenes with convex polyhedra, by regimes.

use super::scenes::{Placement, corners, kinds, surface};
use super::truth::{polygon, sphere};
use crate::attack::build::{Solid as Faces, cube, placed, prism, tetrahedron, triangles};
use etendue_judge::generators::Random;
use etendue_judge::occlusion::Scene;
use etendue_oracle::{V3, along, basis, cross, dot, sub, unit, wide};
use etendue_visible::Solid;

/// The least gap between a polyhedron and the light, relative to the way to the light.
const TOUCHES: f64 = 1.0 / 131_072.0;

kinds! {
    /// How polyhedra are placed.
    SolidKind, SOLID_KINDS:
    Any Tiny Huge Near Plate Needle TouchLight CrossHorizon Standing GrazingFace Inside Several AmongPolygons
}

/// A solid within [−1, 1]³.
fn form(random: &mut Random) -> Faces {
    match random.word() % 7 {
        0 => tetrahedron(),
        1 => prism(3),
        2 => prism(5),
        3 => prism(6),
        4 => {
            let top = random.range(0.3, 0.9);
            moved(&prism(4), |[x, y, z]| if y < 0.0 { [x, y, z] } else { [top * x, y, top * z] })
        }
        _ => cube(),
    }
}

fn moved(solid: &Faces, to: impl Fn(V3) -> V3) -> Faces {
    solid.iter().map(|face| face.iter().map(|&v| to(v)).collect()).collect()
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
    let mut solids: Vec<Faces> = Vec::new();
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
        let mut solid = form(random);
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
                solid = cube();
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
        if kind == SolidKind::GrazingFace && solid.len() != 6 {
            continue;
        }
        solid = placed(&solid, half, &axes, middle);
        let reach = |solid: &Faces| solid.iter().flatten().map(|&v| dot(across, v) / limit).fold(0.0, f64::max);
        if kind == SolidKind::TouchLight {
            // the gap is a little more than the rounding of ends
            let scale = (1.0 - TOUCHES * random.magnitude(1.5, 1e3)) / reach(&solid);
            solid = moved(&solid, |v| v.map(|x| x * scale));
        }
        for _ in 0..30 {
            if reach(&solid) < 1.0 - 1.3 * TOUCHES {
                break;
            }
            let corners = solid.iter().flatten();
            let count = corners.clone().count() as f64;
            let middle = corners.fold([0.0; 3], |sum, &v| along(sum, v, 1.0 / count));
            solid = moved(&solid, |v| along(middle, sub(v, middle), 0.8));
        }
        solids.push(solid);
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
    let (points, normals) = surface(random, normal, spread, kind == SolidKind::Standing);
    let placement = Placement::new(random);
    let scene = placement.scene(Scene { light, occluders, points, normals });
    let solid = |solid: &Faces| {
        let solid = moved(solid, |v| wide(placement.point(v)));
        let triangles = triangles(&solid).into_iter().map(|t| t.map(Into::into));
        Solid::polyhedron(&triangles.collect::<Vec<_>>())
    };
    Scene { occluders: solids.iter().filter_map(solid).chain(scene.occluders).collect(), ..scene }
}
