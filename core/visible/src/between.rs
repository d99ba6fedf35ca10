//! The tests by which a shape is proved to miss all segments of a shaft, to meet all of them, or to lie between their ends: each claims
//! nothing within the bounds of rounding.

use crate::hull::{Hull, V64, unit};
use crate::polyhedron::Polyhedron;
use crate::shaft::Shaft;
use crate::solid::Solid;

impl Solid {
    /// Whether all points of the patch are outside of the shape, if that is a sphere. What touches it counts as outside: a floor on which a
    /// ball rests, or another ball.
    pub(crate) fn is_outside(&self, shaft: &Shaft) -> bool {
        let Self::Sphere { center, radius } = *self else { return true };
        let slack = 1e-6 * radius;
        let above = |&(normal, offset): &(V64, f64)| (normal.dot(center) - offset).abs() >= radius - slack;
        let apart = |&(other, size): &(V64, f64)| (other - center).length() >= radius + size - slack;
        (shaft.patch.center - center).length() > radius + shaft.patch.extent
            || shaft.on_plane.as_ref().is_some_and(above)
            || shaft.on_ball.as_ref().is_some_and(apart)
    }
    /// Is the shape known not to meet any segment of the shaft?
    pub(crate) fn misses(&self, shaft: &Shaft) -> bool {
        match self {
            Self::Sphere { center, radius } => shaft.misses(&[*center], *radius),
            Self::Polyhedron(body) => shaft.misses(&body.corners, 0.0),
            _ => self.outline().is_some_and(|(corners, count)| shaft.misses(&corners[..count], 0.0)),
        }
    }
    /// Is every segment of the shaft known to meet it?
    pub(crate) fn covers(&self, shaft: &Shaft) -> bool {
        match self {
            Self::Polyhedron(body) => body.covers(shaft),
            Self::Sphere { .. } => false,
            // A line that passes inside of the outer edges of two triangles meets one of them, and a segment from one side of the slab to
            // the other meets whatever its line meets inside the slab. The triangles need not have the same plane.
            _ => self.outline().is_some_and(|(corners, count)| {
                is_between(&corners[..count], shaft) && is_inside(&corners[..count], shaft)
            }),
        }
    }
}

impl Polyhedron {
    /// Can it stand for its triangles in a shaft from something else?
    ///
    /// From inside it hides every light that is outside, so a segment from inside must end outside by more than rounding. All of it must lie
    /// before the light. Shading points on the polyhedron itself are inside or outside by rounding alone.
    pub(crate) fn serves(&self, shaft: &Shaft) -> bool {
        let margin = shaft.light.radius + 2.0 * shaft.epsilon;
        let is_outside = |&(n, offset): &(V64, f64)| shaft.light.range(n)[0] - margin - offset > 2.0 * shaft.ends;
        self.planes.iter().any(is_outside) && !crosses(&self.corners, 0.0, shaft)
    }
    /// Is every segment of the shaft known to meet it?
    ///
    /// The points from which a convex body hides a point form a convex set, and so do the points that it hides. If it hides all corners of
    /// one hull from all corners of the other, it therefore hides all of one from all of the other. Here it is smaller by the inflation of
    /// the hulls.
    fn covers(&self, shaft: &Shaft) -> bool {
        let margin = shaft.patch.radius.max(shaft.light.radius) + 4.0 * shaft.epsilon;
        let meets = |p: V64, y: V64| {
            let (mut enters, mut leaves, mut beyond) = (0.0_f64, 1.0_f64, f64::INFINITY);
            for &(n, offset) in &self.planes {
                let (a, b) = (n.dot(p) - offset + margin, n.dot(y) - offset + margin);
                if !(a <= 0.0 || b <= 0.0) {
                    return false;
                }
                if a > 0.0 {
                    enters = enters.max(a / (a - b));
                } else if b > 0.0 && a / (a - b) < leaves {
                    (leaves, beyond) = (a / (a - b), b);
                }
            }
            // where it leaves, it ends beyond the face by more than rounding
            enters + 1e-9 < leaves && leaves < 1.0 && beyond > margin + 2.0 * shaft.ends
        };
        shaft.patch.corners().iter().all(|&p| shaft.light.corners().iter().all(|&y| meets(p, y)))
    }
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
pub(crate) fn crosses(points: &[V64], radius: f64, shaft: &Shaft) -> bool {
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
