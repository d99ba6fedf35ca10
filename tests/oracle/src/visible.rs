//! The projected solid angle of what convex blockers leave of a light. Blockers are subtracted one after another, which leaves convex
//! pieces, and the pieces are added up: by Lambert's sum, or within a sphere by sectors and triangles about its axis.

use crate::cap::Cap;
use crate::outline::{area_vector, clipped, lambert_vector, perimeter};
use crate::vectors::{V3, along, basis, cross, dot, length, sub, unit};

/// A convex light or blocker, relative to the point that it is seen from.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Corners in order around.
    Polygon(Vec<V3>),
    /// Centre and radius.
    Sphere(V3, f64),
}

/// The projected solid angles of a light, and what its visible part depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Visible {
    /// Projected solid angle without blockers.
    pub all: f64,
    /// Projected solid angle of the visible part.
    pub left: f64,
    /// Number of blockers that hide something on their own.
    pub occluders: usize,
    /// Angle around the light, in radians.
    pub around: f64,
}

/// Ω⊥ of the part of `light` that `blockers` leave over a surface with the unit normal `n`. What is farther than the fraction 1 − `spared`
/// of the way to the plane of a flat light, or beyond the circle of the tangents of a sphere, does not occlude. `None` if a sphere overlaps
/// another, is cut by that limit, or contains the point.
#[must_use]
pub fn visible(light: &Shape, blockers: &[Shape], n: V3, spared: f64) -> Option<Visible> {
    let contains = |shape: &Shape| matches!(shape, Shape::Sphere(center, radius) if length(*center) <= *radius);
    if contains(light) || blockers.iter().any(contains) {
        return None;
    }
    let (mut pieces, measure, front, all, around): (Vec<Vec<V3>>, Measure, (V3, f64), f64, f64) = match light {
        Shape::Polygon(corners) => {
            let across = unit(area_vector(corners));
            let height = dot(across, corners[0]);
            let above = clipped(corners, n, 0.0);
            let around = perimeter(&above);
            let towards = if height > 0.0 { -1.0 } else { 1.0 };
            let front = (across.map(|x| x * towards), -height.abs() * (1.0 - spared));
            let all = if height == 0.0 { 0.0 } else { dot(lambert_vector(&above), n).abs() };
            (if height == 0.0 { Vec::new() } else { vec![above] }, Measure { cap: None, n }, front, all, around)
        }
        Shape::Sphere(center, radius) => {
            let cap = Cap::new(*center, *radius);
            let measure = Measure { cap: Some(cap), n };
            let (s, t) = basis(n);
            let [west, south] = [s, t].map(|v| v.map(|x| -x));
            let quarters = [[n, s, t], [n, t, west], [n, west, south], [n, south, s]].map(Vec::from);
            let all = quarters.iter().map(|quarter| measure.of(quarter)).sum();
            let tangents = length(*center) * cap.cos * cap.cos;
            let around = core::f64::consts::TAU * cap.sin;
            (quarters.into(), measure, (cap.axis.map(|x| -x), -tangents), all, around)
        }
    };
    let mut occluders = 0;
    let whole = pieces.clone();
    let mut caps: Vec<Cap> = Vec::new();
    caps.extend(measure.cap);
    let flat_light = measure.cap.is_none();
    for blocker in blockers {
        match blocker {
            Shape::Polygon(corners) => {
                let corners = clipped(corners, front.0, front.1);
                if corners.len() < 3 {
                    continue;
                }
                let volume = dot(area_vector(&corners), corners[0]);
                let planes: Vec<V3> = (0..corners.len())
                    .map(|i| cross(corners[i], sub(corners[(i + 1) % corners.len()], corners[i])))
                    .map(|plane| plane.map(|x| x * volume.signum()))
                    .collect();
                let inside =
                    |piece: &Vec<V3>| planes.iter().fold(piece.clone(), |piece, &plane| clipped(&piece, plane, 0.0));
                let hides = |piece: &Vec<V3>| volume != 0.0 && measure.of(&inside(piece)) > 1e-13 * all;
                occluders += usize::from(whole.iter().any(hides));
                let mut rest = Vec::new();
                for piece in pieces {
                    if !hides(&piece) {
                        rest.push(piece);
                        continue;
                    }
                    let mut inner = piece;
                    for &plane in &planes {
                        let outer = clipped(&inner, plane.map(|x| -x), 0.0);
                        inner = clipped(&inner, plane, 0.0);
                        if outer.len() > 2 {
                            rest.push(outer);
                        }
                    }
                }
                pieces = rest;
            }
            Shape::Sphere(center, radius) => {
                let nearest = dot(front.0, *center) - front.1;
                if nearest < -radius {
                    continue;
                }
                if nearest < *radius {
                    return None;
                }
                let cap = Cap::new(*center, *radius);
                if caps.iter().any(|other| other.overlaps(&cap)) {
                    return None;
                }
                if flat_light {
                    let hidden = whole.iter().map(|piece| cap.within(piece, n)).sum::<f64>();
                    occluders += usize::from(hidden > 1e-13 * all);
                    caps.push(cap);
                }
            }
        }
    }
    let mut left: f64 = pieces.iter().map(|piece| measure.of(piece)).sum();
    if flat_light {
        left -= pieces.iter().flat_map(|piece| caps.iter().map(|cap| cap.within(piece, n))).sum::<f64>();
    }
    Some(Visible { all, left, occluders, around })
}

/// What fraction of the way from `point` to the plane of a light that is given relative to it is this fraction of the greatest coordinate of
/// both; 0 for a sphere.
#[must_use]
pub fn spared(light: &Shape, point: V3, of_coordinates: f64) -> f64 {
    let Shape::Polygon(corners) = light else { return 0.0 };
    let normal = unit(cross(sub(corners[1], corners[0]), sub(corners[2], corners[0])));
    let absolute = corners.iter().map(|&corner| along(corner, point, 1.0)).chain([point]);
    let greatest = absolute.flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    (of_coordinates * greatest / dot(normal, corners[0]).abs()).min(1.0)
}

/// How a piece is measured: whole, or within a sphere.
struct Measure {
    cap: Option<Cap>,
    n: V3,
}
impl Measure {
    fn of(&self, piece: &[V3]) -> f64 {
        match &self.cap {
            Some(cap) => cap.within(piece, self.n),
            None => dot(lambert_vector(piece), self.n).abs(),
        }
    }
}
