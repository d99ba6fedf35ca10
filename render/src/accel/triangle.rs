//! Triangles against eight rays, and one ray against the triangles of a leaf.

use super::build::Costs;
use super::packets::each_bit;
use super::single::{Leaves, Nearest, Single};
use super::tree::{Bounded, Bounds, BuildError, Primitives, Tree, greater, lesser};
use super::{Hits, M8, NOTHING, Rays, V8, X8, max, min, pick, select};
use etendue::{Mask, Real, Vec3, u32x8};
use std::ops::Range;

/// A packet meets one triangle after the other, a single ray all of a leaf at once.
const COSTS: Costs = Costs { most: 8, leaf: 0.7, primitive: 0.2 };

/// A triangle.
pub(super) type Corners = [[f32; 3]; 3];

impl Bounded for Corners {
    #[inline]
    fn bounds(&self) -> Bounds {
        let [a, b, c] = self;
        let all = |pick: fn(f32, f32) -> f32| std::array::from_fn(|k| pick(pick(a[k], b[k]), c[k]));
        [all(lesser), all(greater)]
    }
    #[inline]
    fn middle(&self, axis: usize) -> f32 {
        let [a, b, c] = self.map(|corner| corner[axis]);
        0.5 * lesser(lesser(a, b), c) + 0.5 * greater(greater(a, b), c)
    }
}

/// Mesh triangles in the order of the leaves. A leaf of n holds its nine coordinates one after the other, each of them n times, so that
/// a load of eight lanes is the coordinate of all its triangles (and of what lies behind it).
#[derive(Debug)]
pub(super) struct Soup {
    coordinates: Vec<f32>,
    /// Triangles of each one's leaf before it, and in all of that leaf: 16·before + all.
    leaves: Vec<u8>,
    /// From leaf order to the caller's index.
    ids: Vec<u32>,
}

impl Soup {
    pub(super) fn tree(triangles: Vec<Corners>) -> Result<Tree<Self>, BuildError> {
        let by_coordinate = |leaf: &mut [Corners]| {
            let mut turned = [0.0; 9 * COSTS.most];
            let all = leaf.len();
            let coordinates = leaf.as_flattened_mut().as_flattened_mut();
            for (i, triangle) in coordinates.chunks_exact(9).enumerate() {
                triangle.iter().enumerate().for_each(|(k, &x)| turned[k * all + i] = x);
            }
            coordinates.copy_from_slice(&turned[..9 * all]);
        };
        Tree::build(triangles, COSTS, by_coordinate, |triangles, ids, nodes| {
            let mut leaves = vec![0; ids.len()];
            for node in nodes {
                for leaf in (0..node.children as usize).map(|slot| node.leaf(slot)) {
                    let all = leaf.len() as u8;
                    leaves[leaf].iter_mut().zip(0..).for_each(|(l, before)| *l = before << 4 | all);
                }
            }
            let mut coordinates = triangles.into_flattened().into_flattened();
            // for loads from the last leaf
            coordinates.extend([0.0; 8]);
            Self { coordinates, leaves, ids }
        })
    }
    #[inline]
    pub(super) fn corners(&self, place: u32) -> [f32; 9] {
        let leaf = self.leaves[place as usize];
        let (before, all) = (usize::from(leaf >> 4), usize::from(leaf & 15));
        let start = 9 * (place as usize - before) + before;
        std::array::from_fn(|k| self.coordinates[start + k * all])
    }
    #[inline]
    pub(super) fn ids(&self) -> &[u32] {
        &self.ids
    }
    /// What decides ties: the caller's index of a triangle, more than any for a shape, and less than any where nothing is hit, so that
    /// a hit at the very limit is none.
    fn rank(&self, place: u32) -> u64 {
        match self.ids.get(place as usize) {
            Some(&id) => u64::from(id) + 1,
            None if place == NOTHING => 0,
            None => u64::MAX,
        }
    }
    /// Lanes in which `place` holds a triangle of lower index than the one in `hits`.
    #[cold]
    fn goes_first(&self, tie: M8, place: u32, hits: &Hits) -> M8 {
        let first = (0..8).filter(|&i| tie.lane(i) && self.rank(place) < self.rank(hits.place.as_array()[i]));
        M8::from_bits(first.fold(0, |bits, i| bits | 1 << i))
    }
    /// Corners of one triangle of a leaf, in every lane.
    #[inline(always)]
    fn one(&self, leaf: &Range<usize>, index: usize) -> [V8; 3] {
        let data = &self.coordinates[9 * leaf.start..9 * leaf.end];
        let at = |k: usize| X8::splat(data[k * leaf.len() + index]);
        let corner = |k: usize| Vec3::new(at(k), at(k + 1), at(k + 2));
        [corner(0), corner(3), corner(6)]
    }
    /// Corners of the triangles of a leaf, lane by lane; other lanes hold any numbers.
    #[inline(always)]
    fn all(&self, leaf: &Range<usize>) -> [V8; 3] {
        let all = leaf.len();
        let data = &self.coordinates[9 * leaf.start..9 * leaf.start + 8 * all + 8];
        let at = |k: usize| {
            let lanes: [f32; 8] = data[k * all..k * all + 8].try_into().expect("8 numbers");
            X8::from(lanes)
        };
        let corner = |k: usize| Vec3::new(at(k), at(k + 1), at(k + 2));
        [corner(0), corner(3), corner(6)]
    }
}

/// Edge functions of a triangle seen along a ray, and what they divide by.
struct Projected {
    inside: M8,
    weights: [X8; 3],
    sum: X8,
    relative: [V8; 3],
}

/// Projects the corners along each ray and takes the signs of the three edge functions.
///
/// A corner's projection depends on the corner and the ray alone, and each edge function is a difference of two rounded products, whose
/// sign is right or 0: two triangles that share an edge never both miss a ray between them, nor do those around a vertex.
/// (The idea is that of Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection", with a rotation in place of the shear, so that lanes need not agree
/// on an axis.)
#[inline(always)]
fn project(corners: [V8; 3], origin: V8, [s, t]: [V8; 2]) -> Projected {
    let [a, b, c] = corners;
    let relative = [a - origin, b - origin, c - origin];
    let [a, b, c] = relative;
    let (ax, ay, bx, by, cx, cy) = (a.dot(s), a.dot(t), b.dot(s), b.dot(t), c.dot(s), c.dot(t));
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
    ///
    /// Weights of slivers may be all rounding, and a distance with them. It is no less than `near`, where the ray enters the box of the
    /// leaf: as no tree cuts a ray shorter than that, what the ray hits does not depend on its way there.
    #[inline(always)]
    fn distance(&self, direction: V8, near: X8) -> (X8, X8) {
        let [a, b, c] = self.relative;
        let (z0, z1, z2) = (a.dot(direction), b.dot(direction), c.dot(direction));
        let inverse = X8::lit(1.0) / select(self.inside, self.sum, X8::lit(1.0));
        let [u, v, w] = self.weights;
        (max(u.mul_add(z0, v.mul_add(z1, w * z2)) * inverse, near), inverse)
    }
}

impl Primitives for Soup {
    #[inline]
    fn closest(&self, leaf: Range<usize>, rays: &Rays, near: X8, active: M8, hits: &mut Hits) {
        for index in 0..leaf.len() {
            let projected = project(self.one(&leaf, index), rays.origin, rays.frame);
            let inside = projected.inside & active;
            if inside.any() {
                let place = (leaf.start + index) as u32;
                let (distance, inverse) = projected.distance(rays.direction, near);
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
    fn occluded(&self, leaf: Range<usize>, rays: &Rays, near: X8, active: M8, limit: X8, _skip: u32x8) -> M8 {
        let mut hidden = M8::splat(false);
        for index in 0..leaf.len() {
            let projected = project(self.one(&leaf, index), rays.origin, rays.frame);
            let inside = projected.inside & active;
            if inside.any() {
                let (distance, _) = projected.distance(rays.direction, near);
                hidden = hidden | inside & distance.gt(X8::lit(0.0)) & distance.lt(limit);
            }
        }
        hidden
    }
    fn bytes(&self) -> usize {
        size_of_val(&self.coordinates[..]) + size_of_val(&self.leaves[..]) + size_of_val(&self.ids[..])
    }
}

impl Leaves for Soup {
    #[inline(always)]
    fn prefetch(&self, leaf: Range<usize>) {
        super::tree::prefetch(&self.coordinates[9 * leaf.start..9 * leaf.end]);
    }
    #[inline(always)]
    fn closest_of_leaf(&self, leaf: Range<usize>, ray: &Single, near: X8, nearest: &mut Nearest) {
        let projected = project(self.all(&leaf), ray.origin, ray.frame);
        let inside = projected.inside.bits() & ((1 << leaf.len()) - 1);
        if inside == 0 {
            return;
        }
        let (distance, inverse) = projected.distance(ray.direction, near);
        let candidate = distance.gt(X8::lit(0.0)) & distance.le(X8::splat(nearest.distance));
        let (b1, b2) = (projected.weights[1] * inverse, projected.weights[2] * inverse);
        each_bit(inside & candidate.bits(), |lane| {
            let distance = distance.as_array()[lane];
            let place = (leaf.start + lane) as u32;
            if distance < nearest.distance
                || distance == nearest.distance && self.rank(place) < self.rank(nearest.place)
            {
                *nearest = Nearest { distance, place, b1: b1.as_array()[lane], b2: b2.as_array()[lane] };
            }
        });
    }
    #[inline(always)]
    fn leaf_hides(&self, leaf: Range<usize>, ray: &Single, near: X8, limit: f32) -> bool {
        let projected = project(self.all(&leaf), ray.origin, ray.frame);
        let inside = projected.inside.bits() & ((1 << leaf.len()) - 1);
        if inside == 0 {
            return false;
        }
        let (distance, _) = projected.distance(ray.direction, near);
        inside & (distance.gt(X8::lit(0.0)) & distance.lt(X8::splat(limit))).bits() != 0
    }
}
