//! Distances in double precision, where single precision cannot tell on which side of a primitive a ray begins or ends.
//!
//! In single precision the distance to a primitive has an error in proportion to the size of that primitive, not to the distance. Near
//! a ray's origin, and near its limit, that would decide about occlusion: on a floor of the size of a country, all within a metre.

use crate::geometry::{End, Segment};
use etendue::Vec3;

type V64 = Vec3<f64>;

/// The exact values of a point or direction in single precision.
pub(super) fn wide(v: Vec3<f32>) -> V64 {
    v.map(f64::from)
}

/// The distance along a ray to a triangle; `None` if the ray misses it or is parallel to its plane.
///
/// Edge functions are triple products, whose sign is the same for both triangles of an edge. Triangles are wider than they are by 2⁻¹⁵ of
/// the distance, which is more than the error of edges of that length in single precision: there are no gaps between triangles that are
/// tested in different precisions.
///
/// Greatest error: 2⁻⁴⁸ of the greatest distance of a corner, over the cosine of the angle to the normal.
pub(super) fn to_triangle([a, b, c]: [V64; 3], origin: V64, direction: V64) -> Option<f64> {
    let [p, q, r] = [a - origin, b - origin, c - origin];
    let normal = (b - a).cross(c - a);
    let slope = normal.dot(direction);
    let far = p.max_abs().max(q.max_abs()).max(r.max_abs());
    // where the triangle is so large that not even double precision tells on which side of it the origin is
    let is_vast = far > VAST * origin.max_abs();
    let distance = if is_vast { volume([a, b, c], origin) } else { normal.dot(p) } / slope;
    let margin = distance.abs() / 32_768.0;
    let inside = |from: V64, to: V64| from.cross(to).dot(direction) * slope.signum() >= -margin * (to - from).length();
    // on a floor as large as a country, rounding alone decides on which side of the next triangle a point is
    let height = distance * slope.abs() / normal.length();
    let bound = START * if is_vast { VAST * origin.max_abs() } else { far };
    let met = if height.abs() > bound { distance } else { 0.0 };
    (distance.is_finite() && inside(p, q) && inside(q, r) && inside(r, p)).then_some(met)
}

/// The least distance from the plane of a triangle at which a ray that leaves a point before it meets it, relative to the greatest coordinate
/// of the triangle relative to the point: what is nearer may be behind the point as well.
const START: f64 = 1.0 / (1_u64 << 48) as f64;
/// A triangle whose corners are farther than this many times the coordinates of a point is as near to it as these tell.
const VAST: f64 = (1_u64 << 24) as f64;

/// (b−a) × (c−a) · (a−o), to 2⁻¹⁰⁰ of the greatest product: the corners are of single precision, so that their differences are exact as sums of
/// two numbers.
#[cold]
fn volume([a, b, c]: [V64; 3], o: V64) -> f64 {
    // Knuth's sum and Dekker's product without error (Shewchuk 1997, "Adaptive Precision Floating-Point Arithmetic", theorems 7 and 18)
    let sum = |a: f64, b: f64| {
        let high = a + b;
        let from_b = high - a;
        [high, (a - (high - from_b)) + (b - from_b)]
    };
    let times = |[a, b]: [f64; 2], [c, d]: [f64; 2]| {
        let high = a * c;
        sum(high, a.mul_add(c, -high) + (a * d + b * c))
    };
    let plus = |[a, b]: [f64; 2], [c, d]: [f64; 2]| {
        let [high, low] = sum(a, c);
        sum(high, low + (b + d))
    };
    let between = |to: V64, from: V64| [sum(to.x, -from.x), sum(to.y, -from.y), sum(to.z, -from.z)];
    let ([u, v], w) = ([between(b, a), between(c, a)], between(a, o));
    let part = |i: usize, j: usize, k: usize| {
        let [p, q] = [times(u[i], v[j]), times(u[j], v[i])];
        times(plus(p, q.map(|x| -x)), w[k])
    };
    plus(plus(part(0, 1, 2), part(1, 2, 0)), part(2, 0, 1))[0]
}

/// Whether a segment that meets a triangle ends beyond it.
pub(super) fn hides([a, b, c]: [V64; 3], segment: &Segment) -> bool {
    segment.end_at_plane(a, (b - a).cross(c - a).normalize()) == End::Hidden
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planes_of_huge_triangles_are_met_where_they_are() {
        let far = 1e7;
        // y = x/4 + z/8 + 1, exact in binary
        let corner = |x: f64, z: f64| V64::new(x, 0.25 * x + 0.125 * z + 1.0, z);
        let corners = [corner(-far, -far), corner(far, -far), corner(0.0, far)];
        for (origin, direction, expected) in [
            (V64::new(0.0, 1.0 + 1e-6, 0.0), V64::new(0.0, -1.0, 0.0), 1e-6),
            (V64::new(0.0, 1.0 - 1e-6, 0.0), V64::new(0.0, -1.0, 0.0), -1e-6),
            (V64::new(4.0, 3.0, 8.0), V64::new(0.0, 0.0, 1.0), 0.0),
            (V64::new(4.0, 3.0, 0.0), V64::new(-0.6, -0.8, 0.0), 1.0 / 0.65),
        ] {
            let found = to_triangle(corners, origin, direction).unwrap();
            assert!((found - expected).abs() < 1e-8, "{found} instead of {expected}");
        }
        // without area, parallel, and beside an edge by less and by more than the margin
        assert_eq!(to_triangle([corners[0]; 3], V64::default(), corners[0]), None);
        assert_eq!(to_triangle(corners, V64::default(), V64::new(4.0, 1.0, 0.0)), None);
        let beside = |off: f64| {
            to_triangle(corners, corner(0.0, -far - off) + V64::new(0.0, 1.0, 0.0), V64::new(0.0, -1.0, 0.0))
        };
        assert!(beside(1e-5).is_some() && beside(1e-3).is_none());
    }
}
