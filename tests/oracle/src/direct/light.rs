//! The light that reaches a point: what blockers leave of a light's projected solid angle. It is exact up to the rounding of f64 where
//! blockers are flat, or spheres that do not overlap, and otherwise a sum over points of the light.

use super::scene::{Form, Prepared};
use crate::closed_forms::projected_cap;
use crate::outline::{area_vector, clipped, lambert, solid_angle};
use crate::random::{LATTICE, Random};
use crate::vectors::{V3, along, basis, cross, dot, length, sub, unit};
use crate::visible::{Shape, visible};
use core::f64::consts::{PI, TAU};

/// A point that receives light.
#[derive(Clone, Copy, Debug)]
pub(super) struct Receiver {
    pub(super) point: V3,
    /// Unit normal on the side of the viewer, of a smooth surface its own.
    pub(super) normal: V3,
    /// Unit normal of the flat form on that side.
    pub(super) flat: V3,
    /// The body that it is on.
    pub(super) own: usize,
}

/// A light seen from a point.
pub(super) struct SeenLight<'a> {
    bodies: &'a [Prepared],
    at: Receiver,
    light: usize,
    /// The end of a way to the light, as a fraction of it, that is never occluded.
    spared: f64,
    /// The fraction by which positions in pictures are moved.
    lift: f64,
    outline: Outline,
    /// Whether closed forms know of the horizons: a sphere light is not cut by that of the flat form.
    is_whole: bool,
    /// Projected solid angle without blockers.
    pub(super) all: f64,
    /// The greatest value of one sample of the whole light, also below the horizon, uniform by solid angle or by area: the cosine over the pdf.
    pub(super) most: f64,
}

enum Outline {
    /// The part of a flat light above the horizon, relative to the point; the normal of its plane on the side of the point; the least
    /// distance from that plane, towards the point, of what occludes, as a dot product with that normal.
    Flat(Vec<V3>, V3, f64),
    /// Centre and radius relative to the point, the unit vector to the centre, and the distance of the circle of tangents.
    Sphere(V3, f64, V3, f64),
}

/// What is between a point and a light.
enum Between {
    Nothing,
    /// Something that hides all of the light.
    All,
    /// Blockers relative to the point.
    Shapes(Vec<Shape>),
    /// Something that only segments can tell.
    Segments,
}

/// A point of a light, relative to the receiver, and the projected solid angle for which it stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub(super) to: V3,
    pub(super) weight: f64,
}

impl<'a> SeenLight<'a> {
    /// A light, if it emits towards the point, and is above its horizon.
    pub(super) fn new(bodies: &'a [Prepared], at: Receiver, light: usize, [spared, lift]: [f64; 2]) -> Option<Self> {
        let Prepared { body, normal, .. } = &bodies[light];
        let (normal, is_smooth) = (*normal, at.normal != at.flat);
        let two_sided = body.emission?.two_sided;
        let outline = match body.form {
            Form::Sphere { center, radius } => {
                let c = sub(center, at.point);
                let distance = length(c);
                if light == at.own || distance <= radius || dot(c, at.normal) <= -radius || dot(c, at.flat) <= -radius {
                    return None;
                }
                Outline::Sphere(c, radius, unit(c), (distance - radius) * (distance + radius) / distance)
            }
            Form::Flat { .. } => {
                if light == at.own || bodies[light].is_level(at.point) {
                    return None;
                }
                let (corners, count) = body.form.corners(at.point);
                let height = -dot(normal, corners[0]);
                if height < 0.0 && !two_sided {
                    return None;
                }
                let mut above = clipped(&corners[..count], at.normal, 0.0);
                if is_smooth {
                    above = clipped(&above, at.flat, 0.0);
                }
                if above.is_empty() {
                    return None;
                }
                // from the light's plane, the point is along this
                let towards = normal.map(|x| x * height.signum());
                Outline::Flat(above, towards, -height.abs() * (1.0 - spared))
            }
        };
        let all = match &outline {
            Outline::Flat(above, ..) => lambert(above, at.normal),
            Outline::Sphere(c, radius, ..) => projected_cap(*c, *radius, at.normal),
        };
        let most = match (&outline, body.form) {
            (Outline::Sphere(c, radius, axis, _), _) => {
                let sin = radius / length(*c);
                let height = dot(*axis, at.normal).clamp(-1.0, 1.0);
                let nearest = (height.acos() - sin.asin()).max(0.0).cos();
                // 1 − cosα = sin²α / (1 + cosα); by area, the near side is drawn from the whole surface
                let solid_angle = TAU * sin * sin / (1.0 + (1.0 - sin * sin).sqrt());
                let area = 4.0 * PI * (radius / (length(*c) - radius)).powi(2);
                nearest * area.max(solid_angle)
            }
            (Outline::Flat(above, ..), form) => {
                let (corners, count) = form.corners(at.point);
                let whole = area_vector(&corners[..count]);
                let angle = solid_angle(&corners[..count]).abs();
                let value = |c: &V3| {
                    let by_area = 0.5 * dot(whole, *c).abs() / length(*c).powi(3);
                    dot(*c, at.normal) / length(*c) * angle.max(by_area)
                };
                above.iter().map(value).fold(0.0, f64::max)
            }
        };
        let is_whole = match &outline {
            Outline::Flat(..) => true,
            Outline::Sphere(c, radius, ..) => !is_smooth || dot(*c, at.flat) >= *radius,
        };
        (all > 0.0).then_some(Self { bodies, at, light, spared, lift, outline, is_whole, all, most })
    }
    /// [`all`](Self::all) and the part of it that is visible, less what the horizon of the flat form hides of a sphere light.
    pub(super) fn both(&self, count: usize, random: &mut Random) -> [f64; 2] {
        if self.is_whole {
            return [self.visible(count, random), self.all];
        }
        let points = self.points(count, random);
        let left = points.iter().map(|point| point.weight * self.transmittance(point.to)).sum();
        [left, points.iter().map(|point| point.weight).sum()]
    }
    /// The part of [`all`](Self::all) that is visible; `count` points decide where closed forms do not.
    pub(super) fn visible(&self, count: usize, random: &mut Random) -> f64 {
        match self.between() {
            Between::Nothing => self.all,
            Between::All => 0.0,
            Between::Shapes(blockers) => {
                let shape = match &self.outline {
                    Outline::Flat(above, ..) => Shape::Polygon(above.clone()),
                    Outline::Sphere(c, radius, ..) => Shape::Sphere(*c, *radius),
                };
                match visible(&shape, &blockers, self.at.normal, self.spared) {
                    Some(seen) => seen.left.clamp(0.0, self.all),
                    None => self.sampled(count, random),
                }
            }
            Between::Segments => self.sampled(count, random),
        }
    }
    pub(super) fn sampled(&self, count: usize, random: &mut Random) -> f64 {
        let points = self.points(count, random);
        points.iter().map(|point| point.weight * self.transmittance(point.to)).sum()
    }
    /// Points of the light, each with the part of it for which it stands.
    pub(super) fn points(&self, count: usize, random: &mut Random) -> Vec<Point> {
        // a lattice at a random place, of which any run of points is even, too: each part of a light gets such a run
        let shift = [random.unit(), random.unit()];
        let at = |i: usize, k: usize| (shift[k] + LATTICE[k] * i as f64).fract();
        let grid: Vec<[f64; 2]> = (0..count).map(|i| [at(i, 0), at(i, 1)]).collect();
        match &self.outline {
            Outline::Flat(above, ..) => {
                let mut parts = Vec::new();
                for i in 1..above.len() - 1 {
                    split([above[0], above[i], above[i + 1]], 0, &mut parts);
                }
                let sizes: Vec<f64> = parts.iter().map(|part| lambert(part, self.at.normal)).collect();
                let total: f64 = sizes.iter().sum();
                let (mut points, offset) = (Vec::with_capacity(grid.len()), random.unit());
                for (i, [u, v]) in grid.iter().enumerate() {
                    // along the parts by the index, within a part by the lattice
                    let target = (i as f64 + offset) / grid.len() as f64 * total;
                    let mut sum = 0.0;
                    let found = sizes.iter().position(|size| {
                        sum += size;
                        sum > target
                    });
                    let index = found.unwrap_or(sizes.len() - 1);
                    let [a, b, c] = parts[index];
                    let root = u.sqrt();
                    let to = along(along(a, sub(b, a), root * (1.0 - v)), sub(c, a), root * v);
                    let area = cross(sub(b, a), sub(c, a)).map(|x| 0.5 * x);
                    let squared = dot(to, to);
                    let there = dot(area, to).abs() * dot(self.at.normal, to).max(0.0) / (squared * squared);
                    let share = if sizes[index] > 0.0 { there / sizes[index] } else { 0.0 };
                    points.push(Point { to, weight: share * total / grid.len() as f64 });
                }
                points
            }
            Outline::Sphere(c, radius, axis, tangents) => {
                let distance = length(*c);
                let sin = radius / distance;
                let versine = sin * sin / (1.0 + (tangents / distance).max(0.0).sqrt());
                let (s, t) = basis(*axis);
                let each = TAU * versine / grid.len() as f64;
                let mut points = Vec::with_capacity(grid.len());
                for [u, v] in grid {
                    let (less, turn) = (u * versine, TAU * v);
                    let across = (less * (2.0 - less)).sqrt();
                    let direction =
                        along(along(axis.map(|x| x * (1.0 - less)), s, across * turn.cos()), t, across * turn.sin());
                    // the near root, from the power of the point
                    let b = distance * (1.0 - less);
                    let half = (radius * radius - (distance * across).powi(2)).max(0.0).sqrt();
                    let near = (distance - radius) * (distance + radius) / (b + half);
                    let is_above = dot(direction, self.at.flat) > 0.0;
                    let cos = if is_above { dot(direction, self.at.normal).max(0.0) } else { 0.0 };
                    points.push(Point { to: direction.map(|x| x * near), weight: cos * each });
                }
                points
            }
        }
    }
    /// The part of a ray to a point of the light that nothing on the way stops.
    pub(super) fn transmittance(&self, to: V3) -> f64 {
        let others = (0..self.bodies.len()).filter(|index| *index != self.light);
        transmittance(self.bodies, others, &self.at, to, 1.0 - self.spared, self.lift)
    }
    fn between(&self) -> Between {
        let mut shapes = Vec::new();
        for (index, body) in self.bodies.iter().enumerate().filter(|(index, _)| *index != self.light) {
            match body.body.form {
                Form::Sphere { center, radius } => {
                    let c = sub(center, self.at.point);
                    let is_own = index == self.at.own;
                    if is_own && dot(c, self.at.normal) <= 0.0 {
                        continue;
                    }
                    if is_own || length(c) < radius {
                        // from inside, only what is inside is visible
                        match self.is_within(c, radius) {
                            Some(true) => continue,
                            Some(false) => return Between::All,
                            None => return Between::Segments,
                        }
                    }
                    if self.may_hide(&[c], radius, None) {
                        shapes.push(Shape::Sphere(c, radius));
                    }
                }
                Form::Flat { .. } => {
                    if index == self.at.own || body.is_level(self.at.point) {
                        continue;
                    }
                    let (corners, count) = body.body.form.corners(self.at.point);
                    if self.may_hide(&corners[..count], 0.0, Some(body.normal)) {
                        if body.has_holes() || self.is_crossed(&corners[..count], body.normal) {
                            return Between::Segments;
                        }
                        shapes.push(Shape::Polygon(corners[..count].to_vec()));
                    }
                }
            }
        }
        if shapes.is_empty() { Between::Nothing } else { Between::Shapes(shapes) }
    }
    /// Whether a flat blocker may cut into a sphere light: what is inside of it hides nothing.
    fn is_crossed(&self, corners: &[V3], normal: V3) -> bool {
        let Outline::Sphere(c, radius, ..) = &self.outline else { return false };
        let around = corners.iter().map(|v| length(sub(*v, corners[0]))).fold(0.0, f64::max);
        dot(normal, sub(*c, corners[0])).abs() < *radius && length(sub(*c, corners[0])) < radius + around
    }
    /// Whether the light is within a sphere; `None` if it crosses it.
    fn is_within(&self, center: V3, radius: f64) -> Option<bool> {
        match &self.outline {
            Outline::Flat(above, towards, _) => {
                let distances = above.iter().map(|v| length(sub(*v, center)));
                if distances.clone().all(|d| d <= radius) {
                    return Some(true);
                }
                let height = dot(*towards, sub(above[0], center)).abs();
                let least = distances.fold(f64::INFINITY, f64::min);
                let around = above.iter().map(|v| length(sub(*v, above[0]))).fold(0.0, f64::max);
                (height >= radius || least - around >= radius).then_some(false)
            }
            Outline::Sphere(c, r, ..) => {
                let distance = length(sub(*c, center));
                match () {
                    () if distance + r <= radius => Some(true),
                    () if distance >= radius + r => Some(false),
                    () => None,
                }
            }
        }
    }
    /// Whether a blocker, with all within `radius` of the hull of `corners`, may hide something: no plane that is tried separates it.
    fn may_hide(&self, corners: &[V3], radius: f64, normal: Option<V3>) -> bool {
        let below = |plane: V3, least: f64| corners.iter().all(|c| dot(plane, *c) <= least);
        if below(self.at.normal, -radius) {
            return false;
        }
        match &self.outline {
            Outline::Flat(above, towards, front) => {
                // what is not between the point and the light's plane, on either side
                if below(*towards, front - radius) || corners.iter().all(|c| -dot(*towards, *c) <= -radius) {
                    return false;
                }
                let turn = -dot(*towards, area_vector(above)).signum();
                for (i, &a) in above.iter().enumerate() {
                    let edge = sub(above[(i + 1) % above.len()], a);
                    let plane = cross(a, edge).map(|x| x * turn);
                    if below(plane, if radius > 0.0 { -radius * length(plane) } else { 0.0 }) {
                        return false;
                    }
                }
                let Some(normal) = normal else { return true };
                let turn = dot(normal, corners[0]).signum();
                (0..corners.len()).all(|i| {
                    let plane = cross(corners[i], sub(corners[(i + 1) % corners.len()], corners[i]));
                    above.iter().any(|v| dot(plane, *v) * turn > 0.0)
                })
            }
            Outline::Sphere(c, r, axis, tangents) => {
                // a long wall may begin behind the point and end beyond the light
                let heights = corners.iter().map(|v| dot(*axis, *v));
                if heights.clone().all(|x| x <= -radius) || heights.clone().all(|x| x >= tangents + radius) {
                    return false;
                }
                let Some(normal) = normal else {
                    let angle = |v: V3, size: f64| (size / length(v)).min(1.0).asin();
                    let between = length(cross(*axis, corners[0])).atan2(dot(*axis, corners[0]));
                    return between < angle(*c, *r) + angle(corners[0], radius);
                };
                let turn = dot(normal, corners[0]).signum();
                (0..corners.len()).all(|i| {
                    let plane = cross(corners[i], sub(corners[(i + 1) % corners.len()], corners[i]));
                    dot(plane, *c) * turn > -r * length(plane)
                })
            }
        }
    }
}

/// The part of a ray from a point that these bodies do not stop before `end`, in units of `to`.
pub(super) fn transmittance(
    bodies: &[Prepared],
    which: impl Iterator<Item = usize>,
    at: &Receiver,
    to: V3,
    end: f64,
    lift: f64,
) -> f64 {
    let mut left = 1.0;
    for index in which {
        if let Some(t) = bodies[index].meets(at.point, to, index == at.own).filter(|&t| t < end) {
            left *= 1.0 - bodies[index].opacity(along(at.point, to, t), lift);
        }
        if left == 0.0 {
            break;
        }
    }
    left
}

/// Splits a triangle into parts that are small relative to their distance.
fn split([a, b, c]: [V3; 3], depth: u32, parts: &mut Vec<[V3; 3]>) {
    let longest = [sub(b, a), sub(c, b), sub(a, c)].map(|e| dot(e, e)).into_iter().fold(0.0, f64::max);
    // the distance of the plane, or of the nearest corner where that is level
    let n = cross(sub(b, a), sub(c, a));
    let height = dot(n, a).abs() / length(n);
    let near = [a, b, c].map(|v| dot(v, v)).into_iter().fold(f64::INFINITY, f64::min).sqrt();
    let distance = height.max(near - longest.sqrt());
    if depth == 5 || longest.sqrt() <= distance {
        parts.push([a, b, c]);
        return;
    }
    let middle = |p: V3, q: V3| along(p, sub(q, p), 0.5);
    let (d, e, f) = (middle(a, b), middle(b, c), middle(c, a));
    for part in [[a, d, f], [d, b, e], [f, e, c], [d, e, f]] {
        split(part, depth + 1, parts);
    }
}
