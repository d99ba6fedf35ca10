//! Flat shapes over a horizon.

use super::flat::{on_ellipse, polygons};
use super::{Case, Random, combine, frame, narrow};
use crate::fixtures::Corners;
use libm::{cos, sin};

/// How a flat shape is placed relative to the horizon.
#[derive(Clone, Copy, Debug)]
enum Lie {
    /// The sine of the elevation of its middle; the azimuth is random.
    At(f64),
    /// The height of the horizon above its middle, in units of its size.
    Cut(f64),
    /// The horizon passes through its first corner.
    Corner,
    /// The zenith, in coordinates along its edges.
    Zenith(f64, f64),
}

/// Flat shapes relative to a horizon, in every regime: corner, two edges and normal.
pub(super) fn over_horizon(each: usize, mut random: Random) -> Vec<Case<[[f32; 3]; 4]>> {
    use Lie::{At, Corner, Cut, Zenith};
    let mut all = Vec::new();
    for _ in 0..each {
        // size, length over width, distance from the point of its plane nearest to the viewpoint, and placement
        for (name, size, aspect, shift, lie) in [
            ("ordinary", 1.0, 1.0, 0.7, At(0.6)),
            ("overhead", 1.0, 1.0, 0.7, At(0.95)),
            ("small 1e-2", 1e-2, 1.0, 0.7, At(0.5)),
            ("tiny 1e-4", 1e-4, 1.0, 0.7, At(0.5)),
            ("tiny 1e-7", 1e-7, 1.0, 0.7, At(0.5)),
            ("tiny 1e-7 overhead", 1e-7, 1.0, 0.7, At(1.0)),
            ("huge 30", 30.0, 1.0, 3.0, At(0.8)),
            ("huge 30, tilted", 30.0, 1.0, 3.0, At(0.2)),
            ("near-hemisphere 1e3", 1e3, 1.0, 30.0, At(1.0)),
            ("near-hemisphere 1e3, tilted", 1e3, 1.0, 30.0, At(0.5)),
            ("sliver 1e2", 1.0, 1e2, 0.7, At(0.5)),
            ("sliver 1e3 overhead", 2.0, 1e3, 0.3, At(0.97)),
            ("grazing 1e-2", 1.0, 1.0, 100.0, At(0.5)),
            ("low 1e-3", 1e-4, 1.0, 0.7, At(1e-3)),
            ("cut", 1.0, 1.0, 0.7, Cut(0.0)),
            ("cut, middle below", 1.0, 1.0, 0.7, Cut(0.2)),
            ("cut, middle above", 1.0, 1.0, 0.7, Cut(-0.2)),
            ("cut, huge 30", 30.0, 1.0, 3.0, Cut(0.1)),
            ("cut, tiny 1e-4", 1e-4, 1.0, 0.7, Cut(0.1)),
            ("cut, tiny 1e-6", 1e-6, 1.0, 0.7, Cut(-0.1)),
            ("cut, sliver 1e2", 1.0, 1e2, 0.7, Cut(0.0)),
            ("almost below", 1.0, 1.0, 0.7, Cut(0.33)),
            ("horizon through a corner", 1.0, 1.0, 0.7, Corner),
            ("horizon through a corner, tiny 1e-5", 1e-5, 1.0, 0.7, Corner),
            ("zenith inside", 1.0, 1.0, 0.7, Zenith(0.3, 0.4)),
            ("zenith inside, tiny 1e-6", 1e-6, 1.0, 0.7, Zenith(0.3, 0.4)),
            ("zenith inside, huge 30", 30.0, 1.0, 3.0, Zenith(0.3, 0.4)),
            ("zenith inside, sliver 1e2", 1.0, 1e2, 0.7, Zenith(0.3, 0.4)),
            ("zenith on an edge", 1.0, 1.0, 0.7, Zenith(0.3, 0.0)),
            ("zenith on an edge, huge 30", 30.0, 1.0, 3.0, Zenith(0.3, 0.0)),
            ("zenith on a corner", 1.0, 1.0, 0.7, Zenith(0.0, 0.0)),
            ("zenith off an edge by 1e-3", 1.0, 1.0, 0.7, Zenith(0.3, -1e-3)),
            ("zenith off an edge by 1e-6", 1.0, 1.0, 0.7, Zenith(0.6, -1e-6)),
        ] {
            let axes = frame(&mut random);
            let angle = random.range(0.8, 2.2);
            let e1 = combine(&axes, size, 0.0, 0.0);
            let e2 = combine(&axes, size / aspect * cos(angle), size / aspect * sin(angle), 0.0);
            let (x, y) = (random.range(-1.0, 1.0) * shift, random.range(0.5, 1.0) * shift);
            let corner = combine(&axes, x - 0.4 * size, y - 0.3 * size / aspect, 1.0);
            let at = |s: f64, t: f64| core::array::from_fn::<f64, 3, _>(|i| corner[i] + e1[i] * s + e2[i] * t);
            let [a, b] = {
                let (a, b) = etendue_oracle::basis(etendue_oracle::unit(at(0.33, 0.33)));
                let turn = random.range(0.0, core::f64::consts::TAU);
                [a, b].map(|_| core::array::from_fn::<f64, 3, _>(|i| a[i] * cos(turn) + b[i] * sin(turn)))
            };
            let middle = etendue_oracle::unit(at(0.33, 0.33));
            // the unit vector perpendicular to p that is nearest to v
            let upright = |p: [f64; 3], v: [f64; 3]| {
                let p = etendue_oracle::unit(p);
                etendue_oracle::unit(etendue_oracle::along(v, p, -etendue_oracle::dot(v, p)))
            };
            let normal = match lie {
                At(sin) => {
                    let cos = f64::sqrt(1.0 - sin * sin);
                    core::array::from_fn(|i| middle[i] * sin + a[i] * cos)
                }
                Cut(below) => {
                    // up to its sign, the plane through p whose tangent is b
                    let reach = size / aspect / etendue_oracle::length(at(0.33, 0.33));
                    let lift = f64::atan(reach * below);
                    let up = upright(middle, b);
                    core::array::from_fn(|i| up[i] * cos(lift) - middle[i] * sin(lift))
                }
                Corner => upright(corner, b),
                Zenith(s, t) => etendue_oracle::unit(at(s, t)),
            };
            all.push((name, [corner, e1, e2, normal].map(narrow)));
        }
        // exactly aligned with the coordinate planes
        random.begin();
        let upright = [[0.2, 0.0, 1.0], [1.0, 0.0, 0.0], [0.5, random.range(0.2, 1.0), 0.0], [0.0, 0.0, 1.0]];
        all.push(("azimuth of an edge", upright.map(narrow)));
        let lying = [[-1.0, 2.0, 0.0], [1.5, 0.0, 0.0], [0.5, 0.2, random.range(0.2, 1.0)], [0.0, 0.0, 1.0]];
        all.push(("an edge on the horizon", lying.map(narrow)));
    }
    all
}

/// Convex pentagons relative to a horizon.
#[must_use]
pub fn projected_pentagons(each: usize, numbers: impl Into<Random>) -> Vec<Case<Corners<5>>> {
    let rows = [
        ("ordinary", [0.6, 0.4], [0.2, 0.3, 1.0], Some([0.3, 0.2, 0.8])),
        ("small 1e-2", [1e-2, 1e-2], [0.2, 0.3, 1.0], Some([0.3, -0.2, 0.8])),
        ("cut", [0.6, 0.4], [0.2, 0.3, 1.0], Some([1.0, 0.0, -0.1])),
        ("close", [3.0, 2.0], [0.5, -0.3, 0.7], Some([1.0, 0.5, 0.3])),
        ("zenith inside", [3.0, 2.0], [0.5, -0.3, 0.7], Some([0.1, 0.2, 1.0])),
        ("grazing 1e-1", [1.0, 1.0], [3.0, 0.0, 1e-1], Some([0.5, 0.2, 0.8])),
    ];
    polygons(each, numbers.into(), &rows)
}

/// Convex pentagons of every size relative to a horizon, in coordinates about their own centre.
#[must_use]
pub fn projected_pentagons_of_every_size(each: usize, numbers: impl Into<Random>) -> Vec<Case<Corners<5>>> {
    let mut random: Random = numbers.into();
    let mut all = Vec::new();
    for _ in 0..each {
        for (name, size, unit, normal) in [
            ("small 1e-2", 1e-2, 1.0, [0.3, -0.2, 0.8]),
            ("tiny 1e-4", 1e-4, 1.0, [0.3, -0.2, 0.8]),
            ("tiny 1e-5", 1e-5, 1.0, [0.3, -0.2, 0.8]),
            ("tiny 1e-7", 1e-7, 1.0, [0.3, -0.2, 0.8]),
            ("far 1e7", 1e-7, 1e12, [0.3, -0.2, 0.8]),
            ("cut, tiny 1e-4", 1e-4, 1.0, [1.0, 0.0, -0.2]),
        ] {
            let axes = frame(&mut random);
            let corners = on_ellipse(&axes, [size * unit, 0.7 * size * unit], [0.0; 3], &mut random);
            let normal = Some(narrow(etendue_oracle::unit(combine(&axes, normal[0], normal[1], normal[2]))));
            let point = narrow(combine(&axes, -0.2 * unit, -0.3 * unit, -unit));
            all.push((name, Corners { corners, point, normal }));
        }
    }
    all
}
