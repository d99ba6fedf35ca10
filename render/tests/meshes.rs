//! Difficult meshes.

use crate::random::Random;
use etendue_oracle::narrow;

/// The corners of a triangle.
pub(crate) type Triangle = [[f32; 3]; 3];

pub(crate) fn point(random: &mut Random) -> [f32; 3] {
    narrow(random.point())
}

pub(crate) fn add(a: [f32; 3], b: [f32; 3], s: f32) -> [f32; 3] {
    std::array::from_fn(|k| a[k] + b[k] * s)
}

/// A height field over [−1, 1]² of n × n squares with two triangles each; its corners lie on a lattice.
pub(crate) fn sheet(n: usize, height: impl Fn(f32, f32) -> f32) -> Vec<Triangle> {
    let at = |i: usize, j: usize| {
        let (x, z) = (2.0 * i as f32 / n as f32 - 1.0, 2.0 * j as f32 / n as f32 - 1.0);
        [x, height(x, z), z]
    };
    let square = |i, j| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
        [[a, b, c], [d, c, b]]
    };
    (0..n * n).flat_map(|k| square(k / n, k % n)).collect()
}

/// The cube [−1, 1]³ with a sheet for each side.
pub(crate) fn cube(n: usize) -> Vec<Triangle> {
    let side = sheet(n, |_, _| 1.0);
    let turned = |f: fn([f32; 3]) -> [f32; 3]| side.iter().map(|t| t.map(f)).collect::<Vec<_>>();
    [
        turned(|[x, y, z]| [x, y, z]),
        turned(|[x, y, z]| [x, -y, z]),
        turned(|[x, y, z]| [y, x, z]),
        turned(|[x, y, z]| [-y, x, z]),
        turned(|[x, y, z]| [x, z, y]),
        turned(|[x, y, z]| [x, z, -y]),
    ]
    .concat()
}

/// Difficult meshes within [−2, 2]³.
pub(crate) fn meshes(random: &mut Random) -> Vec<(&'static str, Vec<Triangle>)> {
    let soup = (0..300).map(|_| {
        let center = point(random);
        [0; 3].map(|_| add(center, point(random), 0.2))
    });
    let soup = soup.collect();
    let slivers = (0..200).map(|_| {
        let (a, along) = (point(random), point(random));
        [a, add(a, along, 1.0), add(add(a, along, random.unit() as f32), point(random), 1e-6)]
    });
    let slivers = slivers.collect();
    let fan = (0..64).map(|i| {
        let rim = |i: usize| {
            let (sin, cos) = (i as f32 / 64.0 * std::f32::consts::TAU).sin_cos();
            [cos, 0.3 * cos, sin]
        };
        [[0.0; 3], rim(i), rim((i + 1) % 64)]
    });
    let fan = fan.collect();
    // each half the size of the previous one: the deepest tree that obvhs builds
    let nested = (0..120).map(|i| {
        let s = 0.75_f32.powi(i);
        [[-s, s * 0.1, -s], [s, -s * 0.1, -s], [0.0, s * 0.2, s]]
    });
    let nested = nested.collect();
    let twins = sheet(4, |x, _| 0.25 * x).into_iter().flat_map(|t| [t, t, [t[1], t[2], t[0]]]).collect();
    // few enough for obvhs, which turns them into a list
    let alike = (0..120).map(|i| {
        if i % 2 == 0 {
            [[-1.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 0.0, 1.0]]
        } else {
            [[-1.0, 0.5, 0.0], [1.0, -0.5, 0.0], [0.0, 0.0, 1.0]]
        }
    });
    let alike = alike.collect();
    vec![
        ("alike", alike),
        ("soup", soup),
        ("slivers", slivers),
        ("fan", fan),
        ("nested", nested),
        ("twins", twins),
        ("cube", cube(5)),
        ("hills", sheet(12, |x, z| 0.25 * (x * x - z))),
        ("floor", sheet(8, |_, _| 0.0)),
    ]
}
