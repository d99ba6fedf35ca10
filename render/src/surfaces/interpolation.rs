//! Numbers and directions between the corners of a triangle.

use crate::geometry::Affine;
use crate::packet::V8;
use crate::scene::NormalMap;
use etendue::{Real, Vec3};
use std::f32::consts::FRAC_PI_2;

pub(super) fn lane_of(v: V8, lane: usize) -> [f32; 3] {
    [v.x.lane(lane), v.y.lane(lane), v.z.lane(lane)]
}
pub(super) fn set_lane(v: &mut V8, lane: usize, [x, y, z]: [f32; 3]) {
    v.x.as_mut_array()[lane] = x;
    v.y.as_mut_array()[lane] = y;
    v.z.as_mut_array()[lane] = z;
}
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A triangle whose points have barycentric coordinates: what does not depend on the point is computed once.
pub(super) struct Barycentric {
    first: [f64; 3],
    edges: [[f64; 3]; 2],
    /// Products of the edges: u · u, u · v, v · v, and the inverse of their determinant.
    products: [f64; 4],
}

impl Barycentric {
    pub(super) fn new(corners: [f32; 9]) -> Self {
        let corner = |i: usize| std::array::from_fn::<f64, 3, _>(|k| corners[3 * i + k].into());
        let first = corner(0);
        let edges = [1, 2].map(|i| std::array::from_fn(|k| corner(i)[k] - first[k]));
        let [u, v] = edges;
        let (uu, uv, vv) = (dot(u, u), dot(u, v), dot(v, v));
        Self { first, edges, products: [uu, uv, vv, 1.0 / (uu * vv - uv * uv)] }
    }
    /// The weights of the corners at the point of the plane that is nearest to `p`, none of them negative.
    pub(super) fn weights(&self, p: [f32; 3]) -> [f32; 3] {
        let w = std::array::from_fn(|k| f64::from(p[k]) - self.first[k]);
        let [wu, wv] = self.edges.map(|edge| dot(w, edge));
        let [uu, uv, vv, inverse] = self.products;
        let [s, t] = [(vv * wu - uv * wv) * inverse, (uu * wv - uv * wu) * inverse];
        // the determinant of a sliver may round to 0
        let [s, t] = [s, t].map(|x| if x > 0.0 { x.min(1.0) } else { 0.0 });
        [(1.0 - s - t).max(0.0) as f32, s as f32, t as f32]
    }
}
pub(super) fn interpolated<const N: usize>(of: &[[f32; N]; 3], weights: [f32; 3]) -> [f32; N] {
    std::array::from_fn(|k| of[0][k] * weights[0] + of[1][k] * weights[1] + of[2][k] * weights[2])
}

/// The direction along which u varies and v does not on a triangle, turned by this angle in radians towards falling v; 0 where both do not
/// vary.
pub(super) fn along_u(corners: [f32; 9], uvs: &[[f32; 2]; 3], turn: f32) -> [f32; 3] {
    let edge = |i: usize| {
        let p: [f64; 3] = std::array::from_fn(|k| f64::from(corners[3 * i + k]) - f64::from(corners[k]));
        let uv: [f64; 2] = std::array::from_fn(|k| f64::from(uvs[i][k]) - f64::from(uvs[0][k]));
        (p, uv)
    };
    let ((p, [a, b]), (q, [c, d])) = (edge(1), edge(2));
    // ∂p/∂u and ∂p/∂v, but for a common factor, whose sign counts where they are combined
    let sign = (a * d - b * c).signum();
    let by_u: [f64; 3] = std::array::from_fn(|k| sign * (d * p[k] - b * q[k]));
    let by_v: [f64; 3] = std::array::from_fn(|k| sign * (a * q[k] - c * p[k]));
    let unit = |v: [f64; 3]| {
        let length = dot(v, v).sqrt();
        v.map(|x| if length > 0.0 { x / length } else { 0.0 })
    };
    let along = unit(by_u);
    let slant = dot(by_v, along);
    let across = unit(std::array::from_fn(|k| slant * along[k] - by_v[k]));
    let (sin, cos) = libm::sincos(turn.into());
    std::array::from_fn(|k| (cos * along[k] + sin * across[k]) as f32)
}

/// Normals of an instance in world space; those that the map makes 0 stay so.
pub(super) fn moved(normals: [[f32; 3]; 3], to_world: &Affine) -> [[f32; 3]; 3] {
    let rows = to_world.cofactors();
    normals.map(|n| {
        let n = Vec3::from(n.map(f64::from));
        let [x, y, z] = rows.map(|row| row.dot(n));
        let unit = Vec3::new(x, y, z).normalize();
        let unit = [unit.x as f32, unit.y as f32, unit.z as f32];
        if unit.iter().all(|x| x.is_finite()) { unit } else { [0.0; 3] }
    })
}

/// The least cosine between a smooth normal and the direction to the viewer.
const LEAST_COS: f64 = 0.01;

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
fn unit(n: [f64; 3]) -> Option<[f64; 3]> {
    let length = dot(n, n).sqrt();
    (length > 1e-6).then(|| n.map(|x| x / length))
}

/// The normal `n` of a triangle at a point, turned as a normal map tells there; `None` where texture coordinates give no direction.
pub(super) fn turned(
    n: [f64; 3],
    map: &NormalMap,
    corners: [f32; 9],
    uvs: &[[f32; 2]; 3],
    uv: [f32; 2],
) -> Option<[f64; 3]> {
    let [along_u, falling_v] = [0.0, FRAC_PI_2].map(|turn| along_u(corners, uvs, turn).map(f64::from));
    let slant = dot(along_u, n);
    let along = unit(std::array::from_fn(|k| along_u[k] - slant * n[k]))?;
    let mut across = cross(n, along);
    if map.follows_v && dot(across, falling_v) < 0.0 {
        across = across.map(|x| -x);
    }
    let [x, y, z] = map.at(uv);
    unit(std::array::from_fn(|k| x * along[k] + y * across[k] + z * n[k]))
}

/// The unit normal between these at the corners of a triangle, if they do not cancel.
pub(super) fn between(normals: &[[f32; 3]; 3], weights: [f32; 3]) -> Option<[f64; 3]> {
    unit(interpolated(normals, weights).map(f64::from))
}

/// The outward unit normal of a flat triangle, which is on the other side of a mirrored one.
pub(super) fn outward(corners: [f32; 9], is_mirrored: bool) -> Option<[f64; 3]> {
    let edge = |i: usize| std::array::from_fn(|k| f64::from(corners[3 * i + k]) - f64::from(corners[k]));
    let (a, b) = if is_mirrored { (edge(2), edge(1)) } else { (edge(1), edge(2)) };
    let n = cross(a, b);
    let greatest = n.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    unit(n.map(|x| x / greatest))
}

/// Whether a normal is on the other side of the surface than the flat one.
pub(super) fn is_behind(n: [f64; 3], flat: [f32; 3]) -> bool {
    dot(n, flat.map(f64::from)) < 0.0
}

/// A unit normal, turned until its cosine to the viewer is at least [`LEAST_COS`].
pub(super) fn facing(mut n: [f64; 3], direction: [f32; 3]) -> Option<[f32; 3]> {
    let direction = direction.map(f64::from);
    let cos = -dot(n, direction);
    if cos < LEAST_COS {
        n = unit(std::array::from_fn(|k| n[k] - (LEAST_COS - cos) * direction[k]))?;
    }
    Some(n.map(|x| x as f32))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// u grows to the right and v downwards, seen from the front; or to the left, as in a mirror; or along other edges.
    #[test]
    fn directions_follow_the_texture_coordinates() {
        let corners = [0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, -3.0, 0.0];
        let near = |found: [f32; 3], [x, y]: [f32; 2]| {
            assert!((found[0] - x).abs() < 1e-6 && (found[1] - y).abs() < 1e-6 && found[2] == 0.0, "{found:?}");
        };
        let (right, turned) = (std::f32::consts::FRAC_PI_2, std::f32::consts::FRAC_PI_6);
        for (uvs, turn, along) in [
            ([[0.0, 0.0], [4.0, 0.0], [0.0, 1.0]], 0.0, [1.0, 0.0]),
            // towards falling v, whatever the length of either edge
            ([[0.0, 0.0], [4.0, 0.0], [0.0, 1.0]], right, [0.0, 1.0]),
            ([[0.0, 0.0], [4.0, 0.0], [0.0, 1.0]], turned, [0.75_f32.sqrt(), 0.5]),
            ([[0.5, 0.0], [0.0, 0.0], [0.5, 1.0]], 0.0, [-1.0, 0.0]),
            ([[0.5, 0.0], [0.0, 0.0], [0.5, 1.0]], right, [0.0, 1.0]),
            ([[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]], 0.0, [0.0, -1.0]),
            // v alone varies
            ([[0.0, 0.0], [0.0, 1.0], [0.0, 2.0]], 0.0, [0.8, 0.6]),
            ([[0.3, 0.7]; 3], 0.0, [0.0, 0.0]),
        ] {
            near(along_u(corners, &uvs, turn), along);
        }
    }
}
