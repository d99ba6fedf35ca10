//! Parameters of maps of lines, squares and surfaces.

use super::{Case, EPSILON};
use crate::fixtures::{Bilinear, Cone, GgxVisibleNormals, PatchSurface};

/// Cones of half-angles from 1e−15 to π.
#[must_use]
pub fn cones() -> Vec<Case<Cone>> {
    let of = |sigma: f64| Cone { one_minus_cos: (2.0 * libm::sin(sigma / 2.0).powi(2)) as f32 };
    let mut all: Vec<_> = [
        ("1e-15", 1e-15),
        ("1e-9", 1e-9),
        ("1e-6", 1e-6),
        ("1e-4", 1e-4),
        ("series seam of others", 0.0262),
        ("0.1", 0.1),
        ("1", 1.0),
        ("just below a hemisphere", 1.57),
        ("beyond a hemisphere", 1.58),
        ("2.5", 2.5),
        ("near the sphere", 3.1),
        ("nearer the sphere", 3.139),
    ]
    .map(|(name, sigma)| (name, of(sigma)))
    .to_vec();
    all.push(("hemisphere", Cone { one_minus_cos: 1.0 }));
    all.push(("sphere", Cone { one_minus_cos: 2.0 }));
    all.push(("sphere, all but a point", Cone { one_minus_cos: 2.0 - 2.0 * EPSILON }));
    all
}

/// Bilinear densities: flat, ordinary, with corners and sides of 0, steep, in tiny and huge units.
#[must_use]
pub fn bilinears() -> Vec<Case<Bilinear>> {
    [
        ("flat", [1.0; 4]),
        ("ordinary", [1.0, 2.0, 0.5, 4.0]),
        ("one corner", [0.0, 0.0, 3.0, 0.0]),
        ("opposite corners", [1.0, 0.0, 0.0, 1.0]),
        ("one side", [1.0, 0.0, 2.0, 0.0]),
        ("steep", [1e-3, 1.0, 0.03, 0.01]),
        ("tiny units", [1e-30, 2e-30, 3e-30, 4e-30]),
        ("huge units", [1e31, 2e31, 3e31, 1e30]),
    ]
    .map(|(name, corners)| (name, Bilinear { corners }))
    .to_vec()
}

/// Microsurfaces: rough, smooth and anisotropic, viewed from above, at grazing angles and from below.
#[must_use]
pub fn microsurfaces() -> Vec<Case<GgxVisibleNormals>> {
    [
        ("ordinary", [0.3, 0.3], [0.5, 0.2, 0.8]),
        ("rough 1", [1.0, 1.0], [-0.3, 0.6, 0.4]),
        ("from the normal", [0.2, 0.4], [0.0, 0.0, 1.0]),
        ("anisotropic", [0.5, 0.1], [0.6, 0.3, 0.5]),
        ("smooth 1e-3", [1e-3, 1e-3], [0.5, 0.2, 0.8]),
        ("smooth 1e-6", [1e-6, 2e-6], [0.5, 0.2, 0.8]),
        ("sliver 1e3", [1.0, 1e-3], [0.3, 0.6, 0.5]),
        ("grazing 1e-2", [0.4, 0.4], [0.8, 0.6, 1e-2]),
        ("grazing 1e-5", [0.4, 0.2], [0.8, -0.6, 1e-5]),
        ("on the horizon", [0.5, 0.5], [0.0, 1.0, 0.0]),
        ("below", [0.5, 0.4], [0.8, 0.3, -0.3]),
        ("far below", [0.5, 0.5], [0.3, 0.0, -1.0]),
        ("rough 10", [10.0, 5.0], [0.3, 0.2, 0.6]),
    ]
    .map(|(name, alpha, wi)| (name, GgxVisibleNormals { alpha, wi }))
    .to_vec()
}

/// Name, distance and size of surfaces in space.
const PLACES: [(&str, f32, f32); 5] = [
    ("ordinary", 1.0, 0.7),
    ("small 1e-3", 1.0, 1e-3),
    ("large 1e3", 1.0, 1e3),
    ("small units", 1e-9, 2e-10),
    ("huge units", 1e9, 4e8),
];

const PLACE: [f32; 3] = [0.48, -0.64, 0.6];

fn times(v: [f32; 3], s: f32) -> [f32; 3] {
    v.map(|x| x * s)
}

/// Bilinear patches in space: flat, twisted, a trapezium, long, and with two corners nearly coincident.
#[must_use]
pub fn patch_surfaces() -> Vec<Case<PatchSurface>> {
    let u = [0.8, 0.36, -0.2];
    let v = [-0.3, 0.9, 0.5];
    let sum = |s: f32, t: f32, lift: f32| -> [f32; 3] {
        let n = [0.36, -0.34, 0.83];
        core::array::from_fn(|k| s * u[k] + t * v[k] + lift * n[k])
    };
    let mut all: Vec<Case<PatchSurface>> = PLACES
        .map(|(name, d, size)| {
            let [u, v, w] = [u, v, sum(1.0, 1.0, 0.4)].map(|e| times(e, size));
            (name, PatchSurface { p: times(PLACE, d), u, v, w })
        })
        .to_vec();
    for (name, w) in [
        ("flat", sum(1.0, 1.0, 0.0)),
        ("trapezium", sum(0.6, 1.0, 0.0)),
        ("kite", sum(2.0, 1.7, 0.0)),
        ("strongly twisted", sum(1.0, 1.0, 1.5)),
        ("nearly a triangle", sum(0.02, 1.0, 0.0)),
    ] {
        all.push((name, PatchSurface { p: PLACE, u, v, w }));
    }
    let long = times(u, 0.01);
    let w = core::array::from_fn(|k| 1.5 * long[k] + v[k]);
    all.push(("sliver 1e2", PatchSurface { p: PLACE, u: long, v, w }));
    all
}
