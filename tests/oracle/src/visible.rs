//! The projected solid angle of what convex blockers leave of a light. Blockers are subtracted one after another, which leaves convex
//! pieces, and the pieces are added up: by Lambert's sum, or within a sphere by sectors and triangles about its axis.

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

/// Twice the area of a polygon, along its normal.
fn area_vector(corners: &[V3]) -> V3 {
    (1..corners.len().saturating_sub(1))
        .fold([0.0; 3], |sum, i| along(sum, cross(sub(corners[i], corners[0]), sub(corners[i + 1], corners[0])), 1.0))
}

/// The part of a polygon with normal · x ≥ `least`.
fn clipped(corners: &[V3], normal: V3, least: f64) -> Vec<V3> {
    let mut part = Vec::with_capacity(corners.len() + 1);
    for (i, &a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        let (ha, hb) = (dot(a, normal) - least, dot(b, normal) - least);
        if ha >= 0.0 {
            part.push(a);
        }
        if (ha < 0.0 && hb > 0.0) || (ha > 0.0 && hb < 0.0) {
            part.push(along(a, sub(b, a), ha / (ha - hb)));
        }
    }
    if part.len() < 3 { Vec::new() } else { part }
}

/// The angle between two vectors.
fn angle(a: V3, b: V3) -> f64 {
    length(cross(a, sub(b, a))).atan2(dot(a, b))
}

/// The angle around a polygon.
fn perimeter(corners: &[V3]) -> f64 {
    (0..corners.len()).map(|i| angle(corners[i], corners[(i + 1) % corners.len()])).sum()
}

/// ∫ r dω over a polygon, up to its sign: half the sum of the edges' angles along their normals.
fn lambert_vector(corners: &[V3]) -> V3 {
    let mut sum = [0.0; 3];
    for (i, &a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        sum = along(sum, unit(cross(a, sub(b, a))), 0.5 * angle(a, b));
    }
    sum
}

/// The directions to a sphere.
#[derive(Clone, Copy)]
struct Cap {
    axis: V3,
    sin: f64,
    cos: f64,
}
impl Cap {
    fn new(center: V3, radius: f64) -> Self {
        let distance = length(center);
        let sin = (radius / distance).min(1.0);
        let cos = (((distance - radius) * (distance + radius)).max(0.0)).sqrt() / distance;
        Self { axis: unit(center), sin, cos }
    }
    fn overlaps(&self, other: &Self) -> bool {
        angle(self.axis, other.axis) < self.sin.atan2(self.cos) + other.sin.atan2(other.cos)
    }
    /// Ω⊥ of the part of the cap in a polygon above the horizon of `n`: the sum of signed parts between the axis and each edge. Where an
    /// edge is within the cap, that is a triangle, and elsewhere a sector.
    fn within(&self, corners: &[V3], n: V3) -> f64 {
        let corners = clipped(corners, self.axis, 0.0);
        let (s, t) = basis(self.axis);
        let alpha = self.sin.atan2(self.cos);
        let share = 0.5 * (alpha - self.sin * self.cos);
        let tan_squared = (self.sin / self.cos).powi(2);
        let mut sum = [0.0; 3];
        for (i, &p) in corners.iter().enumerate() {
            let edge = sub(corners[(i + 1) % corners.len()], p);
            // within the cone: |u + xv|² < tan²α (f + xg)²
            let (u, v) = (cross(self.axis, p), cross(self.axis, edge));
            let (f, g) = (dot(self.axis, p), dot(self.axis, edge));
            let a = dot(v, v) - tan_squared * g * g;
            let b = dot(u, v) - tan_squared * f * g;
            let c = dot(u, u) - tan_squared * f * f;
            let root = (b * b - a * c).max(0.0).sqrt();
            let q = -(b + root.copysign(b));
            let mut cuts = vec![0.0, 1.0];
            cuts.extend([q / a, c / q].into_iter().filter(|x| (0.0..1.0).contains(x)));
            cuts.sort_by(f64::total_cmp);
            for pair in cuts.windows(2) {
                let middle = 0.5 * (pair[0] + pair[1]);
                let (from, to) = (along(p, edge, pair[0]), along(p, edge, pair[1]));
                if a * middle * middle + 2.0 * b * middle + c < 0.0 {
                    sum = along(sum, lambert_vector(&[self.axis, from, to]), 1.0);
                } else {
                    let [y0, y1] = [from, to].map(|x| dot(x, t).atan2(dot(x, s)));
                    let mut turn = y1 - y0;
                    if turn.abs() > core::f64::consts::PI {
                        turn -= core::f64::consts::TAU.copysign(turn);
                    }
                    sum = along(sum, self.axis, 0.5 * self.sin * self.sin * turn);
                    sum = along(sum, s, share * (y1.sin() - y0.sin()));
                    sum = along(sum, t, share * (y0.cos() - y1.cos()));
                }
            }
        }
        dot(sum, n).abs()
    }
}
