//! Primitives that may occlude a light.

use super::hull::{Hull, V64, edges, magnitude, unit, wide};
use super::shaft::Shaft;
use crate::bvh::SHAPE;
use crate::geometry::{Geometry, Outline};
use crate::occlusion::Convex;
use crate::surfaces::Surfaces;
use etendue::Vec3;

/// A patch that is nowhere higher over the plane of a blocker, as a fraction of the distance of its farthest point, is flush with it. The
/// rounding of heights is some 1e−6 of that distance.
const FLUSH: f64 = 1e-2;

/// Something that may occlude a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Blocker {
    /// A convex shape: a triangle, two triangles that form a quadrilateral, a parallelogram or a sphere.
    Convex {
        /// The shape.
        form: Convex<f32>,
        /// Whether part of it may lie behind the light as seen from some point of the patch: beyond the plane of a flat light, or the
        /// polar plane of a sphere.
        crosses_light: bool,
    },
    /// A closed convex part of a mesh, by its index among the bodies. All of it lies before the light.
    Body(u32),
}

/// A primitive, or two triangles that share an edge.
#[derive(Clone, Copy, Debug)]
pub(super) enum Candidate {
    /// The shape, its corners in order and their number, and how far it is from flat, in scene units. Of four corners, 0–2 is the edge that
    /// two triangles share, or a diagonal.
    Flat(Convex<f32>, [V64; 4], usize, f64),
    Ball([f32; 3], f32),
}

impl Candidate {
    /// What the primitive at a place is, or is within.
    pub(super) fn outline(surfaces: &Surfaces, place: u32) -> Outline {
        if place & SHAPE == 0 {
            let c = surfaces.bvh.corners(place);
            return Geometry::Triangle([[c[0], c[1], c[2]], [c[3], c[4], c[5]], [c[6], c[7], c[8]]]).outline();
        }
        surfaces.shapes()[(place & !SHAPE) as usize].geometry.outline()
    }
    pub(super) fn of(form: Convex<f32>) -> Self {
        match form {
            Convex::Sphere { center, radius } => Self::Ball([center.x, center.y, center.z], radius),
            Convex::Polygon { corners, count } => {
                Self::Flat(form, corners.map(|corner| corner.map(f64::from)), count, 0.0)
            }
            Convex::Parallelogram { corner, edges } => {
                let (a, [u, v]) = (corner.map(f64::from), edges.map(|edge| edge.map(f64::from)));
                Self::Flat(form, [a, a + u, a + u + v, a + v], 4, 0.0)
            }
        }
    }
    /// Whether all points of the patch are outside of the primitive, if that is a ball. What touches it counts as outside: a floor on which a
    /// ball rests, or another ball.
    pub(super) fn is_outside(&self, shaft: &Shaft) -> bool {
        let Self::Ball(center, radius) = *self else { return true };
        let (center, radius) = (wide(center), f64::from(radius));
        let slack = 1e-6 * radius;
        let above = |&(normal, offset): &(V64, f64)| (normal.dot(center) - offset).abs() >= radius - slack;
        let apart = |&(other, size): &(V64, f64)| (other - center).length() >= radius + size - slack;
        (shaft.patch.center - center).length() > radius + shaft.patch.extent
            || shaft.on_plane.as_ref().is_some_and(above)
            || shaft.on_ball.as_ref().is_some_and(apart)
    }
    /// Whether all points of a hull are inside of the ball, by more than rounding.
    fn contains(center: V64, radius: f64, hull: &Hull, epsilon: f64) -> bool {
        let farthest = hull.corners().iter().map(|&p| (p - center).length()).fold(0.0, f64::max);
        farthest + hull.radius < radius * (1.0 - 1e-9) - epsilon
    }
    /// Is the primitive known not to meet any segment of the shaft? It is either the candidate itself, or within it.
    pub(super) fn misses(&self, shaft: &Shaft, is_exact: bool) -> bool {
        match self {
            Self::Ball(center, radius) => {
                let (center, radius) = (wide(*center), f64::from(*radius));
                // no segment that begins and ends inside meets the surface
                let inside = |hull: &Hull| Self::contains(center, radius, hull, shaft.epsilon);
                shaft.misses(&[center], radius) || is_exact && inside(&shaft.patch) && inside(&shaft.light)
            }
            Self::Flat(_, corners, count, _) => {
                let corners = &corners[..*count];
                shaft.misses(corners, 0.0) || is_on_one_side(corners, shaft)
            }
        }
    }
    /// The convex quadrilateral of two triangles that share an edge and a plane.
    pub(super) fn merged(&self, other: &Self) -> Option<Self> {
        let corners = |of: &Self| match of {
            Self::Flat(Convex::Polygon { corners, .. }, _, 3, _) => Some(corners.map(|v| [v.x, v.y, v.z])),
            _ => None,
        };
        let (one, two) = (&corners(self)?, &corners(other)?);
        let bits = |p: [f32; 3]| p.map(f32::to_bits);
        let is_shared = |p: [f32; 3], of: &[[f32; 3]; 4]| of[..3].iter().any(|&q| bits(q) == bits(p));
        let i = (0..3).find(|&i| !is_shared(one[i], two))?;
        let (s, t) = (one[(i + 1) % 3], one[(i + 2) % 3]);
        if bits(s) == bits(t) || !is_shared(s, two) || !is_shared(t, two) {
            return None;
        }
        let apex = *two[..3].iter().find(|&&q| bits(q) != bits(s) && bits(q) != bits(t))?;
        let corners = [s, apex, t, one[i]];
        let exact = corners.map(wide);
        let [a, b, c, d] = exact;
        let normal = unit((c - d).cross(a - d));
        // A triangle as narrow as the rounding of its corners is next to any plane: the normals must agree, too, as far as the corners extend.
        let fold = normal.cross(unit((b - a).cross(c - a))).length();
        let extent = (c - a).length() + (b - d).length();
        let deviation = normal.dot(b - a).abs() + fold * extent;
        let flat = deviation <= 8.0 * magnitude(&exact) * f64::from(f32::EPSILON);
        let turns = |p: V64, q: V64, r: V64| normal.dot((q - p).cross(r - q));
        let turns = [turns(a, b, c), turns(b, c, d), turns(c, d, a), turns(d, a, b)];
        let convex = turns.iter().all(|&x| x > 0.0) || turns.iter().all(|&x| x < 0.0);
        let form = Convex::Polygon { corners: corners.map(Vec3::from), count: 4 };
        (flat && convex).then_some(Self::Flat(form, exact, 4, deviation))
    }
    /// The angle in radians by which the outline may be displaced as seen from a patch: next to the primitive, from most of the patch.
    pub(super) fn displacement(&self, patch: &Hull) -> f64 {
        match self {
            Self::Flat(_, corners, count, deviation) if *deviation > 0.0 => {
                let hull = Hull::new(&corners[..*count], 0.0);
                deviation / ((hull.center - patch.center).length() - hull.extent - patch.extent).max(patch.extent)
            }
            _ => 0.0,
        }
    }
    /// See [`Hull::stretch`].
    pub(super) fn stretch(&self, patch: &Hull) -> f64 {
        match self {
            Self::Flat(_, corners, count, _) => patch.stretch(edges(&corners[..*count])),
            Self::Ball(..) => 1.0,
        }
    }
    /// May a point of the patch be over or on a flat primitive, so near to its plane that single precision does not tell on which side? Where
    /// that concerns only one point in 10⁴, by the rounding of a height, it does not count.
    pub(super) fn is_flush(&self, patch: &Hull) -> bool {
        let Self::Flat(_, corners, count, _) = self else { return false };
        let corners = &corners[..*count];
        let normal = unit((corners[1] - corners[0]).cross(corners[2] - corners[0]));
        let [least, most] = patch.range(normal).map(|x| x - normal.dot(corners[0]));
        let far = corners.iter().map(|&p| (p - patch.center).length()).fold(0.0, f64::max) + patch.extent;
        most.max(-least) <= FLUSH * far && self.touches(patch, FLUSH * far)
    }
    /// Is the primitive between the centres of patch and light?
    pub(super) fn is_central(&self, shaft: &Shaft) -> bool {
        match self {
            Self::Flat(_, corners, count, _) => {
                let (p, y) = (shaft.patch.center, shaft.light.center);
                let volume = |i: usize| (corners[i] - p).cross(corners[(i + 1) % count] - p).dot(y - p);
                let is_right = (0..*count).all(|i| volume(i) >= 0.0);
                (is_right || (0..*count).all(|i| volume(i) <= 0.0)) && is_between(&corners[..*count], shaft)
            }
            Self::Ball(..) => true,
        }
    }
    /// Is every segment of the shaft known to meet the primitive?
    pub(super) fn covers(&self, shaft: &Shaft) -> bool {
        match self {
            // A line that passes inside of the outer edges of two triangles meets one of them, and a segment from one side of the slab to
            // the other meets whatever its line meets inside the slab. The triangles need not have the same plane.
            Self::Flat(_, corners, count, _) => {
                is_between(&corners[..*count], shaft) && is_inside(&corners[..*count], shaft)
            }
            Self::Ball(center, radius) => {
                let (center, radius) = (wide(*center), f64::from(*radius));
                // A segment that ends in the ball might not meet its surface.
                let apart = |hull: &Hull| (hull.center - center).length() > hull.extent + radius + shaft.epsilon;
                if Self::contains(center, radius, &shaft.patch, shaft.epsilon) {
                    // A segment from inside leaves the ball, and ends outside of it by more than rounding.
                    return (shaft.light.center - center).length()
                        > shaft.light.extent + radius + 2.0 * shaft.ends + shaft.epsilon;
                }
                let axis = unit(shaft.light.center - shaft.patch.center);
                let helper = if axis.x.abs() < 0.6 { V64::new(1.0, 0.0, 0.0) } else { V64::new(0.0, 1.0, 0.0) };
                let s = unit(axis.cross(helper)) * (radius * (1.0 - 1e-9));
                let t = axis.cross(s);
                let half = (s + t) * std::f64::consts::FRAC_1_SQRT_2;
                let other = (t + -s) * std::f64::consts::FRAC_1_SQRT_2;
                let octagon = [s, half, t, other, -s, -half, -t, -other].map(|v| center + v);
                apart(&shaft.patch) && apart(&shaft.light) && is_between(&octagon, shaft) && is_inside(&octagon, shaft)
            }
        }
    }
    /// May the primitive meet a ball?
    pub(super) fn touches(&self, ball: &Hull, epsilon: f64) -> bool {
        match self {
            Self::Ball(center, radius) => {
                let apart = (wide(*center) - ball.center).length() > f64::from(*radius) + ball.extent + epsilon;
                !apart
            }
            Self::Flat(_, corners, count, _) => {
                let [a, b, c, d] = *corners;
                let is_far = |a, b, c| (nearest([a, b, c], ball.center) - ball.center).length() > ball.extent + epsilon;
                !(is_far(a, b, c) && (*count == 3 || is_far(a, c, d)))
            }
        }
    }
    pub(super) fn blocker(&self, shaft: &Shaft) -> Blocker {
        match *self {
            Self::Flat(form, corners, count, _) => {
                Blocker::Convex { form, crosses_light: crosses(&corners[..count], 0.0, shaft) }
            }
            Self::Ball(center, radius) => {
                let form = Convex::Sphere { center: center.into(), radius };
                Blocker::Convex { form, crosses_light: crosses(&[wide(center)], f64::from(radius), shaft) }
            }
        }
    }
}

/// Are patch and light on the same side of the plane of a polygon?
fn is_on_one_side(corners: &[V64], shaft: &Shaft) -> bool {
    let normal = unit((corners[1] - corners[0]).cross(corners[2] - corners[0]));
    let [mut least, mut most] = [f64::INFINITY, f64::NEG_INFINITY];
    for &p in corners {
        (least, most) = (least.min(normal.dot(p)), most.max(normal.dot(p)));
    }
    let margin = 2.0 * shaft.epsilon;
    let above = |hull: &Hull| hull.range(normal)[0] - hull.radius > most + margin;
    let below = |hull: &Hull| hull.range(normal)[1] + hull.radius < least - margin;
    above(&shaft.patch) && above(&shaft.light) || below(&shaft.patch) && below(&shaft.light)
}

/// Is a slab that contains the polygon between patch and light, and no part of it level with the end of a segment?
fn is_between(corners: &[V64], shaft: &Shaft) -> bool {
    let normal = unit((corners[1] - corners[0]).cross(corners[2] - corners[0]));
    let [mut least, mut most] = [f64::INFINITY, f64::NEG_INFINITY];
    for &p in corners {
        (least, most) = (least.min(normal.dot(p)), most.max(normal.dot(p)));
    }
    let grown = |hull: &Hull| {
        let margin = hull.radius + 2.0 * shaft.epsilon;
        let [least, most] = hull.range(normal);
        [least - margin, most + margin]
    };
    let (p, y) = (grown(&shaft.patch), grown(&shaft.light));
    let above = |p: [f64; 2], y: [f64; 2], [least, most]: [f64; 2]| p[0] > most && least - y[1] > 2.0 * shaft.ends;
    let turned = |[least, most]: [f64; 2]| [-most, -least];
    above(p, y, [least, most]) || above(turned(p), turned(y), turned([least, most]))
}

/// Do all segments pass the edges of a convex polygon on its inner side?
///
/// The volume f(p, y) = (a−p) × (b−p) · (y−p) tells on which side of the edge from a to b the line from p to y passes. It is affine in p
/// for each y, and in y for each p. Where it is positive for all pairs of corners, it is thus positive for all pairs of points of the two
/// hulls. Displacements of p by m and of y by r change it by at most |b−a| (m |y−a| + r |p−a| + m r).
fn is_inside(corners: &[V64], shaft: &Shaft) -> bool {
    let (m, r) = (shaft.patch.radius, shaft.light.radius);
    let side = |sign: f64| {
        (0..corners.len()).all(|i| {
            let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
            let edge = b - a;
            let length = edge.length();
            shaft.patch.corners().iter().all(|&p| {
                let normal = (p - a).cross(edge) * sign;
                let (far, across) = ((p - a).length(), normal.length());
                shaft.light.corners().iter().all(|&y| {
                    let to = y - a;
                    let lever = edge.cross(to).length();
                    let rounding = shaft.epsilon * length * (far + to.length());
                    normal.dot(to) > m * lever + r * across + length * m * r + rounding
                })
            })
        })
    };
    side(1.0) || side(-1.0)
}

/// May part of a hull of points, inflated by `radius`, lie behind the light as seen from some point of the patch?
pub(super) fn crosses(points: &[V64], radius: f64, shaft: &Shaft) -> bool {
    if let Some((normal, offset, height)) = shaft.end {
        return !points.iter().all(|&x| normal.dot(x) - radius - offset > height.max(0.0) + shaft.epsilon);
    }
    // x is in front of the polar plane of p if (x−c)·(p−c) > r²; this is affine in x and in p.
    let (center, r) = (shaft.light.center, shaft.light.radius);
    !shaft.patch.corners().iter().all(|&p| {
        let to = p - center;
        points.iter().all(|&x| {
            let arm = x - center;
            let margin = radius * (to.length() + shaft.patch.radius) + arm.length() * shaft.patch.radius;
            arm.dot(to) - margin > r * r * (1.0 + 1e-9) + shaft.epsilon * (arm.length() + to.length())
        })
    })
}

/// The point of a triangle nearest to another point (Ericson 2005, "Real-Time Collision Detection", section 5.1.5).
fn nearest([a, b, c]: [V64; 3], p: V64) -> V64 {
    let on_edge = |a: V64, b: V64| {
        let edge = b - a;
        let t = (edge.dot(p - a) / edge.length_squared()).clamp(0.0, 1.0);
        // an edge without length
        if t.is_nan() { a } else { a + edge * t }
    };
    let normal = (b - a).cross(c - a);
    let inside = |a: V64, b: V64| normal.dot((b - a).cross(p - a)) >= 0.0;
    if normal.length_squared() > 0.0 && inside(a, b) && inside(b, c) && inside(c, a) {
        let n = unit(normal);
        return p + n * -n.dot(p - a);
    }
    let all = [on_edge(a, b), on_edge(b, c), on_edge(c, a)];
    let distance = |q: &V64| (*q - p).length();
    all.into_iter().min_by(|x, y| distance(x).total_cmp(&distance(y))).expect("three points")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(corners: [[f32; 3]; 3]) -> Candidate {
        Candidate::of(Geometry::Triangle(corners).outline().convex())
    }

    /// Two triangles of a convex quadrilateral are merged in any order of their corners; nothing else is.
    #[test]
    fn coplanar_triangles_that_share_an_edge_are_merged() {
        let place = |x: f32, y: f32| [x, 0.25 * x + 0.5 * y + 3.0, y];
        let (a, b, c, d) = (place(0.0, 0.0), place(1.0, 0.0), place(1.5, 1.0), place(0.0, 2.0));
        for turn in 0..3 {
            for flip in [false, true] {
                let mut other = [a, c, d];
                other.rotate_left(turn);
                if flip {
                    other.swap(0, 1);
                }
                let merged = triangle([a, b, c]).merged(&triangle(other));
                let Some(Candidate::Flat(Convex::Polygon { corners, count: 4 }, ..)) = merged else {
                    panic!("{turn}, {flip}: not merged");
                };
                let corners = corners.map(|v| [v.x, v.y, v.z]);
                let start = corners.iter().position(|&v| v == a).unwrap();
                let around = [1, 2, 3].map(|k| corners[(start + k) % 4]);
                assert!(around == [b, c, d] || around == [d, c, b], "{corners:?}");
            }
        }
        let one = triangle([a, b, c]);
        let not = [
            ("the same triangle", [a, b, c]),
            ("another plane", [a, c, [0.0, 3.0, 2.0]]),
            ("one common corner", [a, d, place(-1.0, 1.0)]),
            ("on the same side of the edge", [a, c, place(1.0, 0.1)]),
            ("a reflex corner", [a, c, place(-4.0, -0.2)]),
            ("a degenerate triangle", [a, a, c]),
            // within the rounding of the plane, as any triangle that is as narrow
            ("a sliver with another normal", [a, c, [0.75 - 1e-6, 3.437_5 + 1e-6, 0.5 + 1e-6]]),
        ];
        for (what, corners) in not {
            assert!(one.merged(&triangle(corners)).is_none(), "{what}");
            assert!(triangle(corners).merged(&one).is_none(), "{what}");
        }
    }

    /// The nearest point of a triangle, against points of a fine grid.
    #[test]
    fn nearest_points_are_nearest() {
        let corners = [[0.0, 0.0, 0.0], [2.0, 0.1, 0.0], [0.3, 1.0, 0.5]].map(|v: [f32; 3]| wide(v));
        let [a, b, c] = corners;
        for k in 0..200 {
            let p = V64::new(f64::from(k % 7) - 3.0, f64::from(k % 11) * 0.5 - 2.0, f64::from(k % 5) - 2.0);
            let found = (nearest(corners, p) - p).length();
            let grid = (0..=100).flat_map(|i| (0..=100 - i).map(move |j| (f64::from(i) / 100.0, f64::from(j) / 100.0)));
            let least = grid.map(|(s, t)| (a + (b - a) * s + (c - a) * t - p).length()).fold(f64::INFINITY, f64::min);
            assert!(found <= least + 1e-12 && found > least - 0.02, "{found}, {least}");
        }
    }
}
