//! The built-in scene `knot`: a trefoil of neon tube, a million triangles that emit, in metres.

use super::solids::{Point, Sink, round, scaled, sum};
use crate::transform::{cross, length};
use etendue_render::geometry::Geometry;
use std::f64::consts::TAU;

/// Quads along the tube and around it, each of two triangles.
const ALONG: usize = 5000;
const AROUND: usize = 100;
/// The curve winds around a torus with these radii.
const TORUS: [f64; 2] = [1.0, 0.42];
const TUBE: f64 = 0.11;
const CENTER: Point = [0.0, 1.75, 0.0];
/// Colours along the tube.
const COLOURS: [[f64; 3]; 3] = [[1.0, 0.15, 0.45], [0.1, 0.75, 1.0], [1.0, 0.55, 0.08]];

/// A point of the torus knot (2, 3) and its tangent, for t in [0, 1).
fn curve(t: f64) -> [Point; 2] {
    let (a, b) = (2.0 * TAU * t, 3.0 * TAU * t);
    let far = TORUS[0] + TORUS[1] * libm::cos(b);
    let (out, rise) = (-3.0 * TORUS[1] * libm::sin(b), 3.0 * TORUS[1] * libm::cos(b));
    let tangent = [out * libm::cos(a) - 2.0 * far * libm::sin(a), out * libm::sin(a) + 2.0 * far * libm::cos(a), rise];
    [
        sum(CENTER, [far * libm::cos(a), far * libm::sin(a), TORUS[1] * libm::sin(b)]),
        scaled(tangent, 1.0 / length(tangent)),
    ]
}

/// The unit normal of the torus at the point of its knot: perpendicular to the curve, and the same after a turn.
fn normal(t: f64) -> Point {
    let (a, b) = (2.0 * TAU * t, 3.0 * TAU * t);
    [libm::cos(b) * libm::cos(a), libm::cos(b) * libm::sin(a), libm::sin(b)]
}

/// All 1,000,000 triangles, a closed surface with normals outwards.
pub(super) fn tube(sink: &mut Sink) {
    let circle = |i: usize| -> Vec<Point> {
        let t = (i % ALONG) as f64 / ALONG as f64;
        let ([center, d], u) = (curve(t), normal(t));
        let v = cross(d, u);
        let angles = (0..AROUND).map(|j| TAU * j as f64 / AROUND as f64);
        let offset = |angle: f64| sum(scaled(u, TUBE * libm::cos(angle)), scaled(v, TUBE * libm::sin(angle)));
        angles.map(|angle| sum(center, offset(angle))).collect()
    };
    let mut here = circle(0);
    for i in 0..ALONG {
        let next = circle(i + 1);
        let colour = colour((i as f64 + 0.5) / ALONG as f64);
        for j in 0..AROUND {
            let k = (j + 1) % AROUND;
            for corners in [[here[j], here[k], next[k]], [here[j], next[k], next[j]]] {
                sink(Geometry::Triangle(corners.map(round)), colour);
            }
        }
        here = next;
    }
}

/// A smooth periodic mixture of the colours.
fn colour(t: f64) -> [f64; 3] {
    let place = 3.0 * t;
    let (from, to) = (place as usize % 3, (place as usize + 1) % 3);
    let s = place.fract();
    let s = s * s * (3.0 - 2.0 * s);
    [0, 1, 2].map(|k| (1.0 - s) * COLOURS[from][k] + s * COLOURS[to][k])
}
