//! Whether a segment meets a shape, in double precision.

use etendue::Vec3;
use etendue::occlusion::{Convex, Polyhedron};
use etendue_oracle::{V3, along, cross, dot, length, sub, unit, wide};
use etendue_render::certify::{Blocker, Bodies};
use etendue_render::scene::Geometry;

/// Whether a segment meets something, unless that is within rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Meets {
    Yes,
    No,
    Unclear,
}

/// Length. Coordinates are far from overflow here, and the oracle's length, which never overflows, takes several times as long.
fn size(a: V3) -> f64 {
    dot(a, a).sqrt()
}

/// The sign of (b−a) × (c−a) · (d−a), or 0 within rounding.
fn side([a, b, c]: [V3; 3], d: V3, tolerance: f64) -> i32 {
    let (u, v, w) = (sub(b, a), sub(c, a), sub(d, a));
    let volume = dot(cross(u, v), w);
    let scale = [a, b, c, d].iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
    let (lu, lv, lw) = (size(u), size(v), size(w));
    let rounding = tolerance * (lu * lv * lw + scale * (lu * lv + lv * lw + lw * lu));
    if volume > rounding { 1 } else { -i32::from(volume < -rounding) }
}

pub(crate) fn meets_triangle([p, q]: [V3; 2], [a, b, c]: [V3; 3], tolerance: f64) -> Meets {
    // a ball around the triangle decides where all its volumes are rounding
    let ball = [b, c].iter().map(|&v| size(sub(v, a))).fold(0.0, f64::max);
    if meets_sphere([p, q], a, ball, 1e-6) == Meets::No && [p, q].iter().all(|&end| size(sub(end, a)) > ball) {
        return Meets::No;
    }
    let ends = [p, q].map(|end| side([a, b, c], end, tolerance));
    if ends[0] * ends[1] > 0 {
        return Meets::No;
    }
    let edges = [[a, b], [b, c], [c, a]].map(|[a, b]| side([p, a, b], q, tolerance));
    if edges.contains(&1) && edges.contains(&-1) {
        return Meets::No;
    }
    let clear = ends[0] * ends[1] < 0 && !edges.contains(&0);
    if clear { Meets::Yes } else { Meets::Unclear }
}

fn meets_sphere([p, q]: [V3; 2], center: V3, radius: f64, tolerance: f64) -> Meets {
    let d = sub(q, p);
    let t = (dot(sub(center, p), d) / dot(d, d)).clamp(0.0, 1.0);
    let distance = size(sub(along(p, d, t), center)) - radius;
    let ends = [p, q].map(|end| size(sub(end, center)) - radius);
    let scale = [p, q, center].iter().flatten().fold(radius, |m: f64, x| m.max(x.abs()));
    let rounding = tolerance * scale;
    match () {
        () if distance > rounding => Meets::No,
        () if distance < -rounding && ends.iter().any(|&end| end > rounding) => Meets::Yes,
        () if ends.iter().all(|&end| end < -rounding) => Meets::No,
        () => Meets::Unclear,
    }
}

/// Rounding of the tests in double precision.
pub(crate) const EXACT: f64 = 1e-15;

pub(crate) fn meets(segment: [V3; 2], geometry: &Geometry) -> Meets {
    match *geometry {
        Geometry::Sphere { center, radius } => meets_sphere(segment, wide(center), f64::from(radius), EXACT),
        Geometry::Triangle(corners) => meets_triangle(segment, corners.map(wide), EXACT),
        Geometry::Parallelogram { p, u, v } => {
            let [p, u, v] = [p, u, v].map(wide);
            let corners = [p, along(p, u, 1.0), along(along(p, u, 1.0), v, 1.0), along(p, v, 1.0)];
            meets_polygon(segment, &corners, EXACT)
        }
    }
}

fn meets_polygon(segment: [V3; 2], corners: &[V3], tolerance: f64) -> Meets {
    let parts = (2..corners.len()).map(|k| [corners[0], corners[k - 1], corners[k]]);
    let all: Vec<_> = parts.map(|part| meets_triangle(segment, part, tolerance)).collect();
    [Meets::Yes, Meets::Unclear].into_iter().find(|kind| all.contains(kind)).unwrap_or(Meets::No)
}

/// May a blocker of a certificate occlude a segment? Its corners are rounded.
pub(crate) fn may_occlude(segment: [V3; 2], blocker: &Blocker, bodies: &Bodies) -> bool {
    Meets::No
        != match *blocker {
            Blocker::Convex { form: Convex::Sphere { center, radius }, .. } => {
                meets_sphere(segment, exact(center), f64::from(radius), 1e-7)
            }
            Blocker::Convex { form, .. } => meets_polygon(segment, &corners(&form), 1e-7),
            Blocker::Body(body) => meets_solid(segment, &bodies.polyhedron(body)),
        }
}

/// The exact value of a point in single precision.
pub(crate) fn exact(v: Vec3<f32>) -> V3 {
    wide([v.x, v.y, v.z])
}

/// The corners of a flat shape.
pub(crate) fn corners(form: &Convex<f32>) -> Vec<V3> {
    match *form {
        Convex::Polygon { corners, count } => corners[..count].iter().map(|&v| exact(v)).collect(),
        Convex::Parallelogram { corner, edges: [u, v] } => {
            let (a, u, v) = (exact(corner), exact(u), exact(v));
            vec![a, along(a, u, 1.0), along(along(a, u, 1.0), v, 1.0), along(a, v, 1.0)]
        }
        Convex::Sphere { .. } => Vec::new(),
    }
}

/// Depths of p below the faces of a body, and their rounding.
pub(crate) fn depths(p: V3, solid: &Polyhedron<'_, f32>) -> (f64, Vec<f64>) {
    let corners = solid.edges.iter().flat_map(|edge| edge.ends).map(exact);
    let rounding = 3e-7 * corners.chain([p]).flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
    let depth = |[normal, on]: &[Vec3<f32>; 2]| dot(unit(exact(*normal)), sub(exact(*on), p));
    (rounding, solid.faces.iter().map(depth).collect())
}

/// Does a body hide q from p, if it lies before q? It hides everything from inside, otherwise a cone whose sides pass its outline.
pub(crate) fn meets_solid([p, q]: [V3; 2], solid: &Polyhedron<'_, f32>) -> Meets {
    let (rounding, depths) = depths(p, solid);
    let least = depths.iter().fold(f64::INFINITY, |m, x| m.min(*x));
    if least > -rounding {
        return if least > rounding { Meets::Yes } else { Meets::Unclear };
    }
    let (inwards, ahead) = (sub(exact(solid.center), p), unit(sub(q, p)));
    let mut all = Meets::Yes;
    for edge in solid.edges.iter().filter(|edge| (depths[edge.faces[0]] >= 0.0) != (depths[edge.faces[1]] >= 0.0)) {
        let [a, b] = edge.ends.map(|end| sub(exact(end), p));
        let plane = cross(a, b);
        let side = dot(unit(plane), ahead) * dot(plane, inwards).signum();
        let distance = length(plane) / length(sub(a, b));
        match () {
            () if side.abs() * distance > rounding => {
                if side < 0.0 {
                    return Meets::No;
                }
            }
            () => all = Meets::Unclear,
        }
    }
    all
}
