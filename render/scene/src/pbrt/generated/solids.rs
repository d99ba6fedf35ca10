//! Solids of triangles, and numbers that vary.

pub(super) use crate::builder::round;
pub(super) use crate::transform::{add as sum, scaled};
use crate::transform::{cross, length, sub};
use etendue_render::geometry::{Geometry, Parallelogram, Sphere};

/// Receives shapes, each with a radiance in relation to others.
pub(super) type Sink<'a> = dyn FnMut(Geometry, [f64; 3]) + 'a;
pub(super) type Point = [f64; 3];

pub(super) const WHITE: [f64; 3] = [1.0; 3];

/// A number in [0, 1) for each key (the finalizer of SplitMix64, applied to each word).
pub(super) fn noise(key: &[i32]) -> f64 {
    let mut state = 0_u64;
    for &word in key {
        state = (state ^ u64::from(word as u32)).wrapping_add(0x9e37_79b9_7f4a_7c15);
        state = (state ^ state >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        state = (state ^ state >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        state ^= state >> 31;
    }
    (state >> 11) as f64 / (1_u64 << 53) as f64
}

pub(super) fn triangle(corners: [Point; 3], sink: &mut Sink) {
    sink(Geometry::Triangle(corners.map(round)), WHITE);
}

/// Two triangles with corners in cyclic order.
pub(super) fn quad([a, b, c, d]: [Point; 4], sink: &mut Sink) {
    triangle([a, b, c], sink);
    triangle([a, c, d], sink);
}

pub(super) fn parallelogram(p: Point, u: Point, v: Point, radiance: [f64; 3], sink: &mut Sink) {
    sink(Geometry::Parallelogram(Parallelogram { p: round(p), u: round(u), v: round(v) }), radiance);
}

pub(super) fn sphere(center: Point, radius: f64, radiance: [f64; 3], sink: &mut Sink) {
    sink(Geometry::Sphere(Sphere { center: round(center), radius: radius as f32 }), radiance);
}

/// A closed box, given by its least and greatest corner.
pub(super) fn cuboid(low: Point, high: Point, sink: &mut Sink) {
    let corner = |k: usize| [0, 1, 2].map(|axis| if k >> axis & 1 == 1 { high[axis] } else { low[axis] });
    for face in [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]] {
        quad(face.map(corner), sink);
    }
}

/// A profile of radii and heights, turned around the vertical axis through `foot`. Where it goes up, its normals point outwards.
pub(super) fn turned(foot: Point, profile: &[[f64; 2]], sides: usize, sink: &mut Sink) {
    let at = |[radius, height]: [f64; 2], side: usize| {
        let angle = std::f64::consts::TAU * (side % sides) as f64 / sides as f64;
        sum(foot, [radius * libm::cos(angle), height, -radius * libm::sin(angle)])
    };
    for rows in profile.windows(2) {
        for side in 0..sides {
            let [a, b] = [at(rows[0], side), at(rows[0], side + 1)];
            let [d, c] = [at(rows[1], side), at(rows[1], side + 1)];
            if rows[0][0] > 0.0 {
                triangle([a, b, if rows[1][0] > 0.0 { c } else { d }], sink);
            }
            if rows[1][0] > 0.0 {
                triangle([a, c, d], sink);
            }
        }
    }
}

/// A closed ring around the vertical axis through `center`, with a round section.
pub(super) fn ring(center: Point, radius: f64, thickness: f64, sides: usize, sink: &mut Sink) {
    const SECTION: usize = 8;
    let profile: Vec<[f64; 2]> = (0..=SECTION)
        .map(|k| {
            let angle = std::f64::consts::TAU * (k % SECTION) as f64 / SECTION as f64;
            [radius + thickness * libm::cos(angle), thickness * libm::sin(angle)]
        })
        .collect();
    turned(center, &profile, sides, sink);
}

/// The sides of a thin prism between two points.
pub(super) fn rod(from: Point, to: Point, radius: f64, sink: &mut Sink) {
    const SIDES: usize = 6;
    let way = sub(to, from);
    let ([x, _, z], length) = (way, length(way));
    // two unit vectors across: one horizontal, unless the rod is upright
    let level = libm::hypot(x, z);
    let u = if level > 1e-9 * length { [-z / level, 0.0, x / level] } else { [1.0, 0.0, 0.0] };
    let v = cross(way.map(|x| x / length), u);
    let around = |k: usize| {
        let angle = std::f64::consts::TAU * (k % SIDES) as f64 / SIDES as f64;
        sum(scaled(u, radius * libm::cos(angle)), scaled(v, radius * libm::sin(angle)))
    };
    for k in 0..SIDES {
        let [a, b] = [around(k), around(k + 1)];
        quad([sum(from, a), sum(from, b), sum(to, b), sum(to, a)], sink);
    }
}
