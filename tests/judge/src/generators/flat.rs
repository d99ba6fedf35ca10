//! Flat shapes by solid angle.

use super::{Case, Random, combine, frame, narrow};
use crate::fixtures::Corners;
use libm::{cos, exp2, log2, sin};

/// Computes a corner and two edges in the given frame.
type PlaceFlat<'a> = dyn FnMut(&mut Random, [[f64; 3]; 3]) -> [[f64; 3]; 3] + 'a;

/// A corner and two edges.
pub(super) type Flat = [[f32; 3]; 3];

/// Flat shapes, `each` random ones in every regime.
pub(super) fn flats(each: usize, mut random: Random) -> Vec<Case<Flat>> {
    let mut all = Vec::new();
    for _ in 0..each {
        let mut push = |name, f: &mut PlaceFlat<'_>| {
            let axes = frame(&mut random);
            all.push((name, f(&mut random, axes).map(narrow)));
        };
        // a shape in the plane z = 1 of the frame, near the axis
        let facing = |r: &mut Random, a: [[f64; 3]; 3], size: f64, shift: f64| {
            let (x, y) = (r.range(-1.0, 1.0) * shift, r.range(-1.0, 1.0) * shift);
            let angle = r.range(0.6, 2.4);
            let e1 = combine(&a, size, 0.0, 0.0);
            let e2 = combine(&a, size * cos(angle), size * sin(angle), 0.0);
            let v0 = combine(&a, x - 0.4 * size, y - 0.3 * size, 1.0);
            [v0, e1, e2]
        };
        push("ordinary", &mut |r, a| facing(r, a, 1.0, 0.7));
        push("small 1e-2", &mut |r, a| facing(r, a, 1e-2, 0.7));
        push("tiny 1e-5", &mut |r, a| facing(r, a, 1e-5, 0.7));
        push("tiny 1e-7", &mut |r, a| facing(r, a, 1e-7, 0.7));
        push("tiny 1e-9", &mut |r, a| facing(r, a, 1e-9, 0.7));
        push("far 1e9", &mut |r, a| facing(r, a, 1e-9, 0.7).map(|v| v.map(|x| x * 1e12)));
        let upright = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        push("on the axis, 1e-4", &mut |r, _| facing(r, upright, 1e-4, 1e-4));
        push("on the axis, 1e-9", &mut |r, _| facing(r, upright, 1e-9, 1e-9));
        push("large 6", &mut |r, a| facing(r, a, 6.0, 1.0));
        push("near-hemisphere 30", &mut |r, a| facing(r, a, 30.0, 3.0));
        push("near-hemisphere 1e3", &mut |r, a| facing(r, a, 1e3, 30.0));
        push("near-hemisphere 1e5", &mut |r, a| facing(r, a, 1e5, 1e3));
        // an axis along which the corner is moved at random, from where to 1 and in which unit; the corner and the edges
        for (name, (axis, low, unit), place) in [
            ("oblique", (0, -1.0, 1.0), [[0.0, 2.0, 1.0], [1.0, 0.2, 0.6], [-0.5, 0.4, -0.8]]),
            ("grazing 1e-2", (0, -1.0, 1.0), [[0.0, 2.0, 1e-2], [1.0, 0.2, 0.0], [0.3, 1.0, 0.0]]),
            ("grazing 1e-4", (0, -1.0, 1.0), [[0.0, 2.0, 1e-4], [1.0, 0.2, 0.0], [0.3, 1.0, 0.0]]),
            ("sliver 1e2", (1, -1.0, 1.0), [[-0.5, 0.0, 1.0], [1.0, 0.0, 0.0], [0.5, 1e-2, 0.0]]),
            ("sliver 1e4", (1, -1.0, 1.0), [[-0.5, 0.0, 1.0], [1.0, 0.0, 0.0], [0.5, 1e-4, 0.0]]),
            ("sliver 1e4 from its end", (0, 0.1, 1.0), [[0.0, 0.0, 1.0], [1e-4, 0.0, 0.0], [0.0, 1.0, 0.0]]),
            ("near a vertex", (0, -1.0, 1e-3), [[0.0, 1e-3, 1e-3], [1.0, 0.0, 0.0], [0.3, 0.9, 0.0]]),
            ("near an edge", (1, -1.0, 1e-3), [[-0.5, 0.0, 1e-3], [1.0, 0.0, 0.0], [0.3, 0.9, 0.0]]),
        ] {
            push(name, &mut |r, a| {
                let mut place = place;
                place[0][axis] = unit * r.range(low, 1.0);
                place.map(|[x, y, z]| combine(&a, x, y, z))
            });
        }
    }
    all
}

/// Corner and edges of flat shapes so nearly in a plane with the viewpoint that f32 barely resolves on which side it lies.
#[must_use]
pub fn nearly_in_plane(each: usize, numbers: impl Into<Random>) -> Vec<Flat> {
    let mut random: Random = numbers.into();
    let mut one = |height: f64| {
        let a = frame(&mut random);
        if random.word() & 1 == 0 {
            let v0 = combine(&a, random.range(-1.0, 1.0), 2.0, height);
            return [v0, combine(&a, 1.0, 0.2, 0.0), combine(&a, 0.3, 1.0, 0.0)].map(narrow);
        }
        // the far edge is perpendicular to the view, so that all of it is about as far as its ends
        let v0 = combine(&a, random.range(-0.1, 0.1), random.range(0.2, 2.0), height);
        [v0, combine(&a, -0.3, 1.0, 0.0), combine(&a, 0.3, 1.0, 0.0)].map(narrow)
    };
    [1e-5, 1e-6, 1e-7, 1e-8].into_iter().flat_map(|height| (0..each).map(|_| one(height)).collect::<Vec<_>>()).collect()
}

/// Two perpendicular vectors whose products with 8-bit numbers are exact in f32, and their unit normal: columns of the rotation by a
/// quaternion of small integers, the first of which may have a half besides.
#[must_use]
pub fn exact_axes([a, b, c, d]: [f64; 4]) -> [[f64; 3]; 3] {
    let u = [a * a + b * b - c * c - d * d, 2.0 * (b * c + a * d), 2.0 * (b * d - a * c)];
    let v = [2.0 * (b * c - a * d), a * a - b * b + c * c - d * d, 2.0 * (c * d + a * b)];
    [u, v, etendue_oracle::unit(etendue_oracle::cross(u, v))]
}

/// One of the integers of such a quaternion.
pub fn small_integer(random: &mut Random) -> f64 {
    (random.word() % 13) as f64 - 6.0
}

/// Axes of random orientation: a case begins.
fn any_exact_axes(random: &mut Random) -> [[f64; 3]; 3] {
    random.begin();
    let [a, b, c, d] = [(); 4].map(|()| small_integer(random));
    exact_axes([a + 0.5, b, c, d])
}

/// Rounds to 8 bits.
#[must_use]
pub fn coarse(x: f64) -> f64 {
    let unit = exp2(log2(x.abs()).floor() - 7.0);
    if x == 0.0 { x } else { (x / unit).round() * unit }
}

/// A rectangle's size, and its corner in a frame whose z axis is the normal.
type SizeAndCorner = ([f64; 2], [f64; 3]);

/// Rectangles in every regime; rounding leaves their right angles exact.
pub(super) fn rectangles(each: usize, mut random: Random) -> Vec<Case<Flat>> {
    let mut all = Vec::new();
    for _ in 0..each {
        let mut push = |name, f: &dyn Fn(&mut Random) -> SizeAndCorner| {
            let a = any_exact_axes(&mut random);
            let unit = [a[0], a[1], a[2]].map(etendue_oracle::unit);
            let (size, corner) = f(&mut random);
            let edge = |k: usize| a[k].map(|x| x * coarse(size[k] / etendue_oracle::length(a[k])));
            let (mut u, mut v) = (edge(0), edge(1));
            if random.word() & 1 == 0 {
                (u, v) = (v, u);
            }
            all.push((name, [combine(&unit, corner[0], corner[1], corner[2]), u, v].map(narrow)));
        };
        let facing = |r: &mut Random, size: f64, shift: f64| {
            let at = |r: &mut Random| r.range(-1.0, 1.0) * shift - 0.5 * size;
            ([size, size * r.range(0.5, 1.0)], [at(r), at(r), 1.0])
        };
        push("ordinary", &|r| facing(r, 1.0, 0.7));
        push("ordinary, aside", &|r| facing(r, 1.0, 3.0));
        push("small 1e-2", &|r| facing(r, 1e-2, 1.0));
        push("tiny 1e-5", &|r| facing(r, 1e-5, 1.0));
        push("tiny 1e-7", &|r| facing(r, 1e-7, 1.0));
        push("tiny 1e-9", &|r| facing(r, 1e-9, 1.0));
        push("tiny 1e-9 below", &|r| facing(r, 1e-9, 1e-9));
        push("far 1e9", &|r| {
            let (size, corner) = facing(r, 1e-9, 1.0);
            (size.map(|x| x * 1e12), corner.map(|x| x * 1e12))
        });
        push("large 6", &|r| facing(r, 6.0, 1.0));
        push("near-hemisphere 30", &|r| facing(r, 30.0, 3.0));
        push("near-hemisphere 1e3", &|r| facing(r, 1e3, 30.0));
        push("near-hemisphere 1e5", &|r| facing(r, 1e5, 1e3));
        push("grazing 1e-2", &|r| ([1.0, 1.0], [r.range(-1.0, 1.0), 2.0, 1e-2]));
        push("grazing 1e-4", &|r| ([1.0, 1.0], [r.range(-1.0, 1.0), 2.0, 1e-4]));
        push("grazing 1e-4, diagonal", &|r| ([1.0, 0.6], [r.range(0.2, 1.0), r.range(-2.0, -1.0), 1e-4]));
        push("sliver 1e2", &|r| ([1.0, 1e-2], [-0.5, r.range(-1.0, 1.0), 1.0]));
        push("sliver 1e4", &|r| ([1.0, 1e-4], [-0.5, r.range(-1.0, 1.0), 1.0]));
        push("sliver 1e4 from its end", &|r| ([1e-4, 1.0], [r.range(0.1, 1.0), 0.0, 1.0]));
        push("near a vertex", &|r| ([1.0, 0.9], [1e-3 * r.range(-1.0, 1.0), 1e-3, 1e-3]));
        push("near an edge", &|r| ([1.0, 0.9], [-0.5, 1e-3 * r.range(-1.0, 1.0), 1e-3]));
        // tilted rectangles on the z axis of the world, where the granularity is less than 1
        let tilt = any_exact_axes(&mut random);
        let length = etendue_oracle::length(tilt[0]);
        for (name, size) in [("on the axis, 1e-4", 1e-4), ("on the axis, 1e-9", 1e-9)] {
            let edge = |k: usize, size: f64| tilt[k].map(|x| x * coarse(size / length));
            let (u, v) = (edge(0, size), edge(1, 0.7 * size));
            let p = [-0.4 * (u[0] + v[0]), -0.3 * (u[1] + v[1]), 1.0];
            all.push((name, [p, u, v].map(narrow)));
        }
    }
    all
}

/// Corners of a convex polygon about the z axis of a frame, on an ellipse of these semi-axes about a centre.
pub(super) fn on_ellipse<const N: usize>(
    axes: &[[f64; 3]; 3],
    size: [f64; 2],
    [x, y, z]: [f64; 3],
    random: &mut Random,
) -> [[f32; 3]; N] {
    core::array::from_fn(|i| {
        let angle = (i as f64 + random.range(-0.3, 0.3)) * core::f64::consts::TAU / N as f64;
        narrow(combine(axes, x + size[0] * cos(angle), y + size[1] * sin(angle), z))
    })
}

/// The semi-axes and the centre of the ellipse about a polygon, and the normal of a surface at the viewpoint.
pub(super) type Row = (&'static str, [f64; 2], [f64; 3], Option<[f64; 3]>);
/// Convex polygons that are seen from the origin.
pub(super) fn polygons<const N: usize>(each: usize, mut random: Random, rows: &[Row]) -> Vec<Case<Corners<N>>> {
    let mut all = Vec::new();
    for &(name, size, center, normal) in (0..each).flat_map(|_| rows) {
        let axes = frame(&mut random);
        let corners = on_ellipse(&axes, size, center, &mut random);
        let normal = normal.map(|[x, y, z]| narrow(etendue_oracle::unit(combine(&axes, x, y, z))));
        all.push((name, Corners { corners, point: [0.0; 3], normal }));
    }
    all
}
/// Convex hexagons.
#[must_use]
pub fn hexagons(each: usize, numbers: impl Into<Random>) -> Vec<Case<Corners<6>>> {
    let rows = [
        ("ordinary", [0.6, 0.4], [0.2, 0.3, 1.0], None),
        ("tiny 1e-3", [1e-3, 1e-3], [0.2, 0.3, 1.0], None),
        ("close", [3.0, 2.0], [0.5, -0.3, 0.7], None),
        ("near-hemisphere", [30.0, 20.0], [1.0, 2.0, 1.0], None),
        ("grazing 1e-2", [1.0, 1.0], [3.0, 0.0, 1e-2], None),
        ("sliver 1e2", [0.5, 5e-3], [0.1, 0.2, 1.0], None),
    ];
    polygons(each, numbers.into(), &rows)
}

/// Convex hexagons of every size, in coordinates about their own centre, as the corners of a small one in a large scene have their digits.
#[must_use]
pub fn hexagons_of_every_size(each: usize, numbers: impl Into<Random>) -> Vec<Case<Corners<6>>> {
    let mut random: Random = numbers.into();
    let mut all = Vec::new();
    for _ in 0..each {
        for (name, size, unit) in [
            ("small 1e-2", 1e-2, 1.0),
            ("tiny 1e-3", 1e-3, 1.0),
            ("tiny 1e-5", 1e-5, 1.0),
            ("tiny 1e-7", 1e-7, 1.0),
            ("tiny 1e-9", 1e-9, 1.0),
            ("far 1e9", 1e-9, 1e12),
        ] {
            let axes = frame(&mut random);
            let corners = on_ellipse(&axes, [size * unit, 0.7 * size * unit], [0.0; 3], &mut random);
            let [x, y] = [(); 2].map(|()| random.range(-0.7, 0.7) * unit);
            let point = narrow(combine(&axes, x, y, unit));
            all.push((name, Corners { corners, point, normal: None }));
        }
    }
    all
}
