//! Triangles against eight rays.

use super::tree::{BuildError, Primitives, Tree};
use super::{Hits, M8, Rays, X8, max, min, pick, select};
use etendue::{Mask, Real, Vec3, u32x8};

/// Mesh triangles in the order of the leaves, corner by corner.
#[derive(Debug)]
pub(super) struct Soup {
    corners: Vec<[f32; 9]>,
    /// From leaf order to the caller's index.
    ids: Vec<u32>,
}

impl Soup {
    pub(super) fn tree(triangles: &[[[f32; 3]; 3]]) -> Result<Tree<Self>, BuildError> {
        let bounds = |[a, b, c]: &[[f32; 3]; 3]| {
            [std::array::from_fn(|k| a[k].min(b[k]).min(c[k])), std::array::from_fn(|k| a[k].max(b[k]).max(c[k]))]
        };
        let corners = |&id: &u32| triangles[id as usize].as_flattened().try_into().expect("9 numbers");
        Tree::build(
            triangles.len(),
            |i| bounds(&triangles[i]),
            |order| Self { corners: order.iter().map(corners).collect(), ids: order.to_vec() },
        )
    }
    #[inline]
    pub(super) fn corners(&self, place: u32) -> &[f32; 9] {
        &self.corners[place as usize]
    }
    #[inline]
    pub(super) fn ids(&self) -> &[u32] {
        &self.ids
    }
    /// Lanes in which `place` holds a triangle of lower index than the one in `hits`.
    #[cold]
    fn goes_first(&self, tie: M8, place: u32, hits: &Hits) -> M8 {
        let id = |place: u32| self.ids.get(place as usize).copied().unwrap_or(place);
        let first = (0..8).filter(|&i| tie.lane(i) && id(place) < id(hits.place.as_array()[i]));
        M8::from_bits(first.fold(0, |bits, i| bits | 1 << i))
    }
}

/// Edge functions of a triangle seen along the rays, and what they divide by.
struct Projected {
    inside: M8,
    weights: [X8; 3],
    sum: X8,
    relative: [Vec3<X8>; 3],
}

/// Projects the corners along each ray and takes the signs of the three edge functions.
///
/// A corner's projection depends on the corner and the ray alone, and each edge function is a difference of two rounded products, whose
/// sign is right or 0: two triangles that share an edge never both miss a ray between them, nor do those around a vertex.
/// (The idea is that of Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection", with a rotation in place of the shear, so that lanes need not agree
/// on an axis.)
#[inline]
fn project(corners: &[f32; 9], rays: &Rays) -> Projected {
    let [s, t] = rays.frame;
    let relative = [0, 3, 6]
        .map(|k| Vec3::new(X8::splat(corners[k]), X8::splat(corners[k + 1]), X8::splat(corners[k + 2])) - rays.origin);
    let [(ax, ay), (bx, by), (cx, cy)] = relative.map(|v| (v.dot(s), v.dot(t)));
    let weights = [bx * cy - by * cx, cx * ay - cy * ax, ax * by - ay * bx];
    let [u, v, w] = weights;
    let zero = X8::lit(0.0);
    let least = min(min(u, v), w);
    let most = max(max(u, v), w);
    let sum = u + v + w;
    Projected { inside: (least.ge(zero) | most.le(zero)) & sum.abs().gt(zero), weights, sum, relative }
}

impl Projected {
    /// Distances along the rays, and the reciprocal of the sum of weights.
    #[inline]
    fn distance(&self, rays: &Rays) -> (X8, X8) {
        let [z0, z1, z2] = self.relative.map(|v| v.dot(rays.direction));
        let inverse = X8::lit(1.0) / select(self.inside, self.sum, X8::lit(1.0));
        let [u, v, w] = self.weights;
        (u.mul_add(z0, v.mul_add(z1, w * z2)) * inverse, inverse)
    }
}

impl Primitives for Soup {
    #[inline]
    fn closest(&self, range: core::ops::Range<usize>, rays: &Rays, active: M8, hits: &mut Hits) {
        for (corners, place) in self.corners[range.clone()].iter().zip(range.start as u32..) {
            let projected = project(corners, rays);
            let inside = projected.inside & active;
            if inside.any() {
                let (distance, inverse) = projected.distance(rays);
                let candidate = inside & distance.gt(X8::lit(0.0)) & distance.le(hits.distance);
                let mut nearer = candidate & distance.lt(hits.distance);
                let tie = candidate & !nearer;
                if tie.any() {
                    nearer = nearer | self.goes_first(tie, place, hits);
                }
                hits.distance = select(nearer, distance, hits.distance);
                hits.place = pick(nearer, u32x8::splat(place), hits.place);
                hits.b1 = select(nearer, projected.weights[1] * inverse, hits.b1);
                hits.b2 = select(nearer, projected.weights[2] * inverse, hits.b2);
            }
        }
    }
    #[inline]
    fn occluded(&self, range: core::ops::Range<usize>, rays: &Rays, active: M8, limit: X8, _skip: u32x8) -> M8 {
        let mut hidden = M8::splat(false);
        for corners in &self.corners[range] {
            let projected = project(corners, rays);
            let inside = projected.inside & active;
            if inside.any() {
                let (distance, _) = projected.distance(rays);
                hidden = hidden | inside & distance.gt(X8::lit(0.0)) & distance.lt(limit);
            }
        }
        hidden
    }
    fn bytes(&self) -> usize {
        size_of_val(&self.corners[..]) + size_of_val(&self.ids[..])
    }
}
