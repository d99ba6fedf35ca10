//! Closed convex parts of meshes.

use crate::meshes::{Random, Triangle};
use etendue_oracle::{V3, along, cross, unit, wide};

/// A convex polyhedron within [−1, 1]³: corners, and the corners of each face in order around.
pub(crate) type Solid = (Vec<V3>, Vec<Vec<usize>>);

/// The box [−1, 1]³.
pub(crate) fn block() -> Solid {
    let corners = (0..8).map(|k| [0, 1, 2].map(|axis| f64::from(k >> axis & 1) * 2.0 - 1.0)).collect();
    let faces = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    (corners, faces.map(Vec::from).into())
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
