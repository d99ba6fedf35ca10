//! Bilinear patches and quads as parallelograms and triangles.

use crate::builder::{Builder, round};
use crate::shape_attributes::ShapeAttributes;
use crate::transform::{add, cross, dot, length, scaled, sub, unit};
use crate::vertices::Vertex;
use etendue_render::geometry::{Geometry, Parallelogram};
use etendue_render::scene::light_picture::affine;

/// How far a bilinear patch may deviate from a parallelogram, and a quad of a mesh file from its plane, relative to its size:
/// coordinates of six digits pass, a visible bend does not.
const FLATNESS: f64 = 1e-5;
/// How far the triangles that stand for a bent patch are from it at most, relative to its size, unless it takes more than `MOST_PARTS`²
/// pairs of them.
const BEND: f64 = 1e-3;
const MOST_PARTS: usize = 16;

/// How far texture coordinates at the corners p00, p10, p01, p11 are from those of an affine map, relative to their range.
fn bend_of_uvs(corners: &[Vertex; 4]) -> f64 {
    let [a, b, c, d] = corners.map(|vertex| vertex.uv);
    let range = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).abs().max((p[1] - q[1]).abs());
    let off = range([a[0] + d[0], a[1] + d[1]], [b[0] + c[0], b[1] + c[1]]);
    let size = [b, c, d].into_iter().map(|uv| range(uv, a)).fold(f64::MIN_POSITIVE, f64::max);
    off / size
}

impl Builder {
    /// Adds a bilinear patch with corners p00, p10, p01, p11: a parallelogram, or triangles that are near to it.
    pub(super) fn patch(&mut self, surface: &ShapeAttributes, corners: [Vertex; 4]) {
        let [p00, p10, p01, p11] = corners.map(|vertex| vertex.point);
        let (u, v) = (sub(p10, p00), sub(p01, p00));
        let size = length(u).max(length(v)).max(length(sub(p11, p01))).max(length(sub(p11, p10)));
        let off = length(sub(p11, add(p10, v))) / size;
        let [a, b, c, d] = corners;
        let bend = if surface.emission.is_some() && surface.picture.is_some() { bend_of_uvs(&corners) } else { 0.0 };
        // a patch without extent is flat
        if (off.is_nan() || off <= FLATNESS) && bend <= FLATNESS {
            if surface.emission.is_none() {
                self.triangle(surface, [a, b, d]);
                return self.triangle(surface, [a, d, c]);
            }
            let given = corners.iter().fold([0.0; 3], |sum, vertex| add(sum, vertex.normal));
            let side = dot(cross(u, v), given);
            let flip = if side == 0.0 { surface.flip } else { side < 0.0 };
            let (u, v, [b, c]) = if flip { (v, u, [c, b]) } else { (u, v, [b, c]) };
            let (p, u, v) = (round(p00), round(u), round(v));
            if cross(u.map(f64::from), v.map(f64::from)) == [0.0; 3] {
                self.left_out += 1;
                return;
            }
            let geometry = Geometry::Parallelogram(Parallelogram { p, u, v });
            let emission = self.lamps.emission(surface, &geometry, || affine([a.uv, b.uv, c.uv]));
            if emission.is_some() {
                return self.push(surface.material, emission, geometry);
            }
            if surface.is_unseen() {
                return;
            }
            let dark = ShapeAttributes { emission: None, ..surface.clone() };
            return self.patch(&dark, corners);
        }
        // a patch is off its n² pairs of triangles by a quarter of its bend over n²
        let off = off.max(bend);
        let parts = ((off / (4.0 * BEND)).sqrt().ceil() as usize).clamp(2, MOST_PARTS);
        let at = |i: usize, j: usize| {
            let [s, t] = [i, j].map(|k| k as f64 / parts as f64);
            let weights = [(1.0 - s) * (1.0 - t), s * (1.0 - t), (1.0 - s) * t, s * t];
            let mix = |of: &dyn Fn(&Vertex) -> [f64; 3]| {
                let terms = corners.iter().zip(weights).map(|(vertex, weight)| scaled(of(vertex), weight));
                terms.fold([0.0; 3], add)
            };
            let given = mix(&|vertex| vertex.normal);
            let along = |p: [f64; 3], q: [f64; 3], r: [f64; 3], s: [f64; 3], t: f64| {
                add(scaled(sub(q, p), 1.0 - t), scaled(sub(s, r), t))
            };
            // the patch's own normal, on the side of the order of the vertices
            let own = cross(along(p00, p10, p01, p11, t), along(p00, p01, p10, p11, s));
            let own = if surface.flip { scaled(own, -1.0) } else { own };
            let uv = mix(&|vertex| [vertex.uv[0], vertex.uv[1], 0.0]);
            Vertex {
                point: mix(&|vertex| vertex.point),
                normal: unit(if given == [0.0; 3] { own } else { given }).unwrap_or([0.0; 3]),
                uv: [uv[0], uv[1]],
            }
        };
        for (i, j) in (0..parts).flat_map(|i| (0..parts).map(move |j| (i, j))) {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
            self.triangle(surface, [a, b, d]);
            self.triangle(surface, [a, d, c]);
        }
    }

    /// Adds a quad with corners in cyclic order: a parallelogram, two triangles if it is planar and convex, or else a patch.
    pub(super) fn quad(&mut self, surface: &ShapeAttributes, vertices: [Vertex; 4]) {
        let [a, b, c, d] = vertices.map(|vertex| vertex.point);
        let off = length(sub(add(a, c), add(b, d)));
        let size = length(sub(c, a)).max(length(sub(d, b)));
        let [va, vb, vc, vd] = vertices;
        if off > FLATNESS * length(sub(b, a)).max(length(sub(d, a))) {
            let normal = cross(sub(c, a), sub(d, b));
            let convex = [[d, a, b], [a, b, c], [b, c, d], [c, d, a]]
                .iter()
                .all(|[before, at, after]| dot(cross(sub(*after, *at), sub(*before, *at)), normal) > 0.0);
            let bend = dot(sub(b, a), normal).abs() / length(normal);
            if convex && bend <= FLATNESS * size {
                self.triangle(surface, [va, vb, vc]);
                return self.triangle(surface, [va, vc, vd]);
            }
        }
        self.patch(surface, [va, vb, vd, vc]);
    }
}
