//! The mesh of the built-in scene `terrain`: a height field and 25 bumpy spheres.

use super::solids::{Sink, triangle};
use crate::transform::{add, length};

/// Cells along each side of the height field.
const CELLS: usize = 512;
/// Number of times each face of the icosahedron is split in four.
const LEVEL: usize = 5;
/// Spheres along each side of the grid of spheres.
const SPHERES: usize = 5;

/// All 1,036,288 triangles, with normals up and outwards.
pub(super) fn triangles(sink: &mut Sink) {
    let faces = bumpy_sphere();
    height_field(sink);
    for i in 0..SPHERES {
        for j in 0..SPHERES {
            let (i, j) = (i as f64, j as f64);
            let centre = [-3.0 + 1.5 * i, 0.9 + 0.5 * libm::sin(2.1 * i + 1.3 * j), -3.0 + 1.5 * j];
            let radius = 0.45 + 0.1 * libm::cos(1.7 * i - 0.9 * j);
            let place = |v: [f64; 3]| [0, 1, 2].map(|k| centre[k] + radius * v[k]);
            faces.iter().for_each(|face| triangle(face.map(place), sink));
        }
    }
}

fn height_field(sink: &mut Sink) {
    let grid = |i: usize| -12.0 + 24.0 * i as f64 / CELLS as f64;
    let point = |i: usize, j: usize| {
        let (x, z) = (grid(i), grid(j));
        let height = 0.25 * libm::sin(1.7 * x) * libm::cos(1.3 * z)
            + 0.10 * libm::sin(5.3 * x + 1.1) * libm::sin(4.7 * z + 0.3)
            + 0.03 * libm::sin(17.1 * x + 2.3 * z) * libm::cos(15.7 * z - 1.9 * x);
        [x, height, z]
    };
    let row = |i: usize| (0..=CELLS).map(|j| point(i, j)).collect::<Vec<_>>();
    let mut low = row(0);
    for i in 0..CELLS {
        let high = row(i + 1);
        for (a, b) in low.windows(2).zip(high.windows(2)) {
            triangle([a[0], a[1], b[1]], sink);
            triangle([a[0], b[1], b[0]], sink);
        }
        low = high;
    }
}

/// The faces of a subdivided icosahedron on the unit sphere, with each vertex displaced by the bumps.
fn bumpy_sphere() -> Vec<[[f64; 3]; 3]> {
    let bump = |v: [f64; 3]| {
        let s = 1.0 + 0.05 * libm::sin(9.0 * v[0]) * libm::sin(9.0 * v[1]) * libm::sin(9.0 * v[2]);
        v.map(|x| x * s)
    };
    let mut faces = icosahedron();
    for _ in 0..LEVEL {
        let quarter = |k: usize| {
            faces.iter().map(move |&[a, b, c]| {
                let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]][k]
            })
        };
        faces = quarter(0).chain(quarter(1)).chain(quarter(2)).chain(quarter(3)).collect();
    }
    faces.into_iter().map(|face| face.map(bump)).collect()
}

fn icosahedron() -> Vec<[[f64; 3]; 3]> {
    const FACES: [[usize; 3]; 20] = [
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    let t = (1.0 + 5f64.sqrt()) / 2.0;
    let corners: Vec<[f64; 3]> = (0..12)
        .map(|i| {
            let (x, y) = (if i % 2 == 0 { -1.0 } else { 1.0 }, if i % 4 < 2 { t } else { -t });
            normalized([[x, y, 0.0], [0.0, x, y], [y, 0.0, x]][i / 4])
        })
        .collect();
    FACES.iter().map(|face| face.map(|i| corners[i])).collect()
}

fn middle(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    normalized(add(a, b))
}

fn normalized(v: [f64; 3]) -> [f64; 3] {
    let length = length(v);
    v.map(|x| x / length)
}
