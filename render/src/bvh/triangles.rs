//! Intersection of one triangle with eight rays, and of one ray with all triangles of a leaf.

use super::build::Costs;
use super::cutouts::Cutouts;
use super::double_precision::{hides, to_triangle, wide};
use super::node::{Bounded, Bounds, BuildError, greater, lesser, prefetch};
use super::primitive::{PrimitiveId, PrimitiveIds};
use super::projected_triangle::{project, undecided};
use super::rays::{Hits, Nearest, Rays};
use super::region::{Placed, Region};
use super::shapes::Reached;
use super::single_ray::{Leaves, SingleRay};
use super::tree::{Primitives, Tree};
use crate::geometry::{Affine, NEAR, Segment};
use crate::packet::{M8, V8, X8, each_bit};
use etendue::{Mask, Real, Vec3, u32x8};
use std::ops::{Range, RangeInclusive};
use wide::u16x8;

/// Greatest number of triangles in a leaf.
const MOST: usize = 8;
/// From this many triangles on, leaves are larger, so that there are fewer nodes to fetch from memory. In small scenes, whose rays go in
/// packets, larger leaves make an image take up to a tenth longer (`sphere-light`, `mirror-room`).
const LARGE: usize = 1 << 16;

/// The costs of leaves in a tree of this many triangles. A packet tests one triangle after another, a single ray all triangles of a leaf at once.
fn costs(triangles: usize) -> Costs {
    let [leaf, primitive] = if triangles < LARGE { [0.7, 0.2] } else { [0.5, 0.05] };
    Costs { most: MOST, leaf, primitive }
}

/// The corners of a triangle.
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

/// Mesh triangles in leaf order. A leaf of n triangles stores each of the nine coordinates n times in a row, so that one load of eight
/// lanes fetches a coordinate of all its triangles (and whatever follows).
#[derive(Debug)]
pub(super) struct TriangleLeaves {
    coordinates: Vec<f32>,
    /// For each triangle, 16 times its index in its leaf plus the leaf's number of triangles.
    leaves: Vec<u8>,
    /// For each triangle, the caller's index.
    ids: Vec<u32>,
    /// For each triangle, the biased exponent of a distance: hits that are nearer to the origin of a ray are computed in double precision.
    near: Vec<u8>,
    /// Whether some triangles are so large or so small that this is infinite.
    extreme: bool,
    /// What segments may end on.
    pub(super) reached: Reached,
    /// The triangles that have holes, if some do.
    pub(super) cutouts: Option<Box<Cutouts>>,
}

/// Where triangles are.
pub(super) trait Situation {
    /// What is added to the index of a triangle to give its number as a primitive.
    fn first(&self) -> u32;
    /// Where a corner of a triangle is.
    fn corner<R: Real<Scalar = f32>>(&self, corner: Vec3<R>) -> Vec3<R>;
    /// A bound of the factor by which the distances grow up to which single precision does not suffice.
    fn size(&self) -> f32;
    /// The distances up to which single precision does not suffice for these triangles, in some lanes, from their bounds.
    fn near(&self, stored: &TriangleLeaves, bounds: X8, lanes: M8, triangles: [usize; 8]) -> X8;
}

/// Triangles where they are.
#[derive(Debug)]
pub(super) struct Situated<'a, S> {
    pub(super) triangles: &'a TriangleLeaves,
    pub(super) situation: S,
}

/// Triangles as they are stored.
pub(super) struct InPlace;

impl Situation for InPlace {
    #[inline(always)]
    fn first(&self) -> u32 {
        0
    }
    #[inline(always)]
    fn corner<R: Real<Scalar = f32>>(&self, corner: Vec3<R>) -> Vec3<R> {
        corner
    }
    #[inline(always)]
    fn size(&self) -> f32 {
        1.0
    }
    #[inline(always)]
    fn near(&self, _: &TriangleLeaves, bounds: X8, _: M8, _: [usize; 8]) -> X8 {
        bounds
    }
}

/// An instance of triangles. Its corners are moved and rounded, and tested as if they were stored so.
#[derive(Debug)]
pub(super) struct Moved<'a> {
    /// What is added to the index of a triangle to give its number as a primitive.
    pub(super) first: u32,
    pub(super) to_world: &'a Affine,
    /// A bound of the factor by which the distances grow up to which single precision does not suffice.
    pub(super) size: f32,
}

impl Situation for Moved<'_> {
    #[inline(always)]
    fn first(&self) -> u32 {
        self.first
    }
    #[inline(always)]
    fn corner<R: Real<Scalar = f32>>(&self, corner: Vec3<R>) -> Vec3<R> {
        self.to_world.point(corner)
    }
    #[inline(always)]
    fn size(&self) -> f32 {
        self.size
    }
    #[cold]
    fn near(&self, stored: &TriangleLeaves, mut bounds: X8, lanes: M8, triangles: [usize; 8]) -> X8 {
        each_bit(lanes.bits(), |lane| {
            let c = stored.corners(triangles[lane] as u32);
            let corners = [0, 3, 6].map(|k| self.corner(Vec3::new(c[k], c[k + 1], c[k + 2])).into());
            bounds.as_mut_array()[lane] = from_exponent(near_exponent(&corners));
        });
        bounds
    }
}

/// The longest edges for which products of three lengths are normal numbers in single precision. The distances of all hits of larger and of
/// smaller triangles are computed in double precision.
const SINGLE: RangeInclusive<f64> = 1.0 / (1_u64 << 36) as f64..=(1_u64 << 40) as f64;
/// The exponent of infinity, for triangles of other sizes.
const ALWAYS: u8 = 255;

/// The biased exponent of the distance up to which single precision does not suffice. Rounding moves hits by a fraction of the longest edge,
/// and further in slivers.
fn near_exponent([a, b, c]: &Corners) -> u8 {
    let [a, b, c] = [a, b, c].map(|v| wide((*v).into()));
    let (e1, e2, e3) = (b - a, c - a, c - b);
    let square = e1.length_squared().max(e2.length_squared()).max(e3.length_squared());
    if !SINGLE.contains(&square.sqrt()) {
        return ALWAYS;
    }
    let area = e1.cross(e2).length();
    let sliver = (square / (area * 256.0)).clamp(1.0, 1e30);
    let distance = square.sqrt() * NEAR * sliver;
    // one more, since the fraction is cut off
    (((distance as f32).to_bits() >> 23) + 1).min(254) as u8
}

/// The distance of an exponent.
#[inline(always)]
fn from_exponent(exponent: u8) -> f32 {
    f32::from_bits(u32::from(exponent) << 23)
}

impl TriangleLeaves {
    pub(super) fn tree(triangles: Vec<Corners>) -> Result<Tree<Self>, BuildError> {
        let by_coordinate = |leaf: &mut [Corners]| {
            let mut turned = [0.0; 9 * MOST];
            let all = leaf.len();
            let coordinates = leaf.as_flattened_mut().as_flattened_mut();
            for (i, triangle) in coordinates.chunks_exact(9).enumerate() {
                triangle.iter().enumerate().for_each(|(k, &x)| turned[k * all + i] = x);
            }
            coordinates.copy_from_slice(&turned[..9 * all]);
        };
        let costs = costs(triangles.len());
        Tree::build(triangles, costs, by_coordinate, |triangles, ids, nodes| {
            let mut leaves = vec![0; ids.len()];
            for node in nodes {
                for leaf in (0..node.children as usize).map(|slot| node.leaf(slot)) {
                    let all = leaf.len() as u8;
                    leaves[leaf].iter_mut().zip(0..).for_each(|(l, before)| *l = before << 4 | all);
                }
            }
            let mut near = vec![0; ids.len() + MOST];
            for node in nodes {
                for leaf in (0..node.children as usize).map(|slot| node.leaf(slot)) {
                    // leaves are stored by coordinate
                    let (all, columns) = (leaf.len(), triangles[leaf.clone()].as_flattened().as_flattened());
                    for (index, near) in near[leaf].iter_mut().enumerate() {
                        let corner = |k: usize| std::array::from_fn(|axis| columns[(k + axis) * all + index]);
                        *near = near_exponent(&[corner(0), corner(3), corner(6)]);
                    }
                }
            }
            let extreme = near.contains(&ALWAYS);
            let mut coordinates = triangles.into_flattened().into_flattened();
            // room for eight-lane loads beyond the last leaf
            coordinates.extend([0.0; 8]);
            Self { coordinates, leaves, ids, near, extreme, reached: Reached::default(), cutouts: None }
        })
    }
    #[inline]
    pub(super) fn corners(&self, index: u32) -> [f32; 9] {
        let leaf = self.leaves[index as usize];
        let (before, all) = (usize::from(leaf >> 4), usize::from(leaf & 15));
        let start = 9 * (index as usize - before) + before;
        std::array::from_fn(|k| self.coordinates[start + k * all])
    }
    #[inline]
    pub(super) fn ids(&self) -> &[u32] {
        &self.ids
    }
    /// The lower rank wins a tie: the caller's index for triangles, a greater rank for shapes, and the least for misses, so that a
    /// hit exactly at the limit does not count. The numbers of an instance begin at `first`, and follow each other; an instance of lower
    /// numbers wins.
    fn rank(&self, first: u32, primitive: PrimitiveId) -> u64 {
        match self.ids.get(primitive.0.wrapping_sub(first) as usize) {
            Some(&id) => u64::from(first) + u64::from(id) + 1,
            None if primitive == PrimitiveId::NONE => 0,
            None if primitive.shape().is_some() => u64::MAX,
            None => u64::from(primitive.0) + 1,
        }
    }
    /// Lanes of `tie` where a triangle has a lower rank than the hit in `hits`.
    #[cold]
    fn goes_first(&self, tie: M8, first: u32, triangle: PrimitiveId, hits: &Hits) -> M8 {
        let rank = |primitive| self.rank(first, primitive);
        let first = (0..8).filter(|&i| tie.lane(i) && rank(triangle) < rank(hits.primitives.lane(i)));
        M8::from_bits(first.fold(0, |bits, i| bits | 1 << i))
    }
    /// Corners of one triangle of a leaf, broadcast to all lanes.
    #[inline(always)]
    fn one(columns: &[&[f32]; 9], index: usize) -> [V8; 3] {
        let at = |k: usize| X8::splat(columns[k][index]);
        let corner = |k: usize| Vec3::new(at(k), at(k + 1), at(k + 2));
        [corner(0), corner(3), corner(6)]
    }
    /// Corners of the triangles of a leaf, one per lane; the values of the other lanes are arbitrary.
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

impl TriangleLeaves {
    /// Computes the distances in these lanes in double precision, to `triangles` there. Returns the lanes that hit something
    /// ahead; with `ANY`, those where it hides the end of a segment that ends at the limit, on the shape that is `reached`.
    #[cold]
    #[inline(never)]
    fn decide<const ANY: bool>(
        &self,
        situation: &impl Situation,
        lanes: u32,
        triangles: [usize; 8],
        [origin, direction]: [V8; 2],
        (limit, reached): (X8, PrimitiveIds),
        distance: &mut X8,
    ) -> u32 {
        let mut ahead = 0;
        each_bit(lanes, |lane| {
            let c = self.corners(triangles[lane] as u32);
            let corners = [0, 3, 6].map(|k| wide(situation.corner(Vec3::new(c[k], c[k + 1], c[k + 2]))));
            let [origin, direction] = [origin, direction].map(|v| wide(v.lane(lane)));
            let limit = limit.as_array()[lane];
            let segment = Segment { origin, direction, length: limit.into() };
            if let Some(exact) = to_triangle(corners, origin, direction).filter(|&exact| exact > 0.0)
                && (!ANY || hides(corners, &self.reached.by(reached.lane(lane), segment)))
            {
                let exact = exact as f32;
                // before the limit, whatever the rounding
                distance.as_mut_array()[lane] = if ANY { exact.min(limit * (1.0 - f32::EPSILON)) } else { exact };
                ahead |= 1 << lane;
            }
        });
        ahead
    }
}

impl TriangleLeaves {
    /// Whether some triangles are so large or so small where they are that single precision never suffices.
    #[inline(always)]
    fn is_extreme(&self, situation: &impl Situation) -> bool {
        self.extreme || situation.size() == f32::INFINITY
    }
}

/// Lanes in which single precision never suffices.
#[inline(always)]
fn is_infinite(near: X8) -> M8 {
    near.ge(X8::lit(f64::INFINITY))
}

// Distances are at least `near`, where the ray enters the box of the leaf. No traversal cuts a ray shorter than that, so the hit does not
// depend on the traversal, not even that of a sliver.
impl TriangleLeaves {
    #[inline(always)]
    fn packet<const ANY: bool>(
        &self,
        situation: &impl Situation,
        leaf: Range<usize>,
        rays: &Rays,
        near: X8,
        active: M8,
        hits: &mut Hits,
    ) -> M8 {
        let mut hidden = M8::splat(false);
        let count = leaf.len();
        let data = &self.coordinates[9 * leaf.start..9 * leaf.end];
        let columns: [&[f32]; 9] = std::array::from_fn(|k| &data[k * count..(k + 1) * count]);
        for index in 0..count {
            let triangle = PrimitiveId((leaf.start + index) as u32 + situation.first());
            let corners = Self::one(&columns, index).map(|corner| situation.corner(corner));
            let projected = project(corners, rays.origin, rays.frame);
            // without a branch on whether any ray hits: it would often be mispredicted, which costs more than the division
            let mut distance = projected.distance(rays.direction);
            let others = active & !rays.from.are(triangle);
            let mut met = projected.inside & others;
            let size = X8::splat(from_exponent(self.near[leaf.start + index]) * situation.size());
            let mut unclear = others & undecided::<ANY>(distance, size, hits.distance);
            if unclear.any() {
                let triangles = [leaf.start + index; 8];
                let size = situation.near(self, size, unclear, triangles);
                unclear = unclear
                    & undecided::<ANY>(distance, size, hits.distance)
                    & (projected.nearly() | is_infinite(size));
                let lanes = unclear.bits();
                let way = [rays.origin, rays.direction];
                let end = (hits.distance, hits.primitives);
                let ahead = self.decide::<ANY>(situation, lanes, triangles, way, end, &mut distance);
                met = met & !unclear | M8::from_bits(ahead);
            }
            let distance = distance.greater(near);
            let mut ahead = met & distance.gt(X8::lit(0.0));
            if let Some(cutouts) = &self.cutouts {
                let weights = projected.weights;
                let lane = |k: usize| (leaf.start + index, triangle, weights.map(|w| w.lane(k)));
                let hit = (ahead & distance.le(hits.distance)).bits();
                ahead = M8::from_bits(cutouts.opaque(hit, rays.origin, rays.direction, lane));
            }
            let mut nearer = ahead & distance.lt(hits.distance);
            if ANY {
                hidden = hidden | nearer;
                continue;
            }
            let tie = ahead & distance.le(hits.distance) & !nearer;
            if tie.any() {
                nearer = nearer | self.goes_first(tie, situation.first(), triangle, hits);
            }
            hits.distance = Real::blend(nearer, distance, hits.distance);
            hits.primitives = PrimitiveIds::pick(nearer, PrimitiveIds::splat(triangle), hits.primitives);
        }
        hidden
    }
    #[inline(always)]
    fn ray<const ANY: bool>(
        &self,
        situation: &impl Situation,
        leaf: Range<usize>,
        ray: &SingleRay,
        near: X8,
        nearest: &mut Nearest,
    ) -> bool {
        prefetch(&self.near[leaf.start..=leaf.start]);
        let corners = self.all(&leaf).map(|corner| situation.corner(corner));
        let projected = project(corners, ray.origin(), ray.frame());
        let first = leaf.start as u32 + situation.first();
        let own = 1_u32.checked_shl(ray.from.0.wrapping_sub(first)).unwrap_or(0);
        let others = ((1 << leaf.len()) - 1) & !own;
        let (mut inside, mut nearly) = (projected.inside.bits() & others, projected.nearly().bits() & others);
        if nearly == 0 && !self.is_extreme(situation) {
            return false;
        }
        let mut distance = projected.distance(ray.direction());
        let limit = X8::splat(nearest.distance);
        let mut exponents = [0; 16];
        exponents[..8].copy_from_slice(&self.near[leaf.start..leaf.start + 8]);
        let exponents = u32x8::from(u16x8::from_u8x16_low(exponents.into()));
        let size = X8::from_bits(exponents << 23) * X8::splat(situation.size());
        if self.is_extreme(situation) {
            nearly |= is_infinite(size).bits() & others;
        }
        let unclear = undecided::<ANY>(distance, size, limit);
        let behind = unclear & projected.surely_behind(distance, size);
        let (behind, mut unclear) = (behind.bits(), nearly & (unclear & !behind).bits());
        inside &= !behind;
        if unclear != 0 {
            let triangles = std::array::from_fn(|lane| leaf.start + lane);
            let size = situation.near(self, size, M8::from_bits(unclear), triangles);
            unclear &= undecided::<ANY>(distance, size, limit).bits();
            let way = [ray.origin(), ray.direction()];
            let end = (limit, PrimitiveIds::splat(nearest.primitive));
            let ahead = self.decide::<ANY>(situation, unclear, triangles, way, end, &mut distance);
            inside = inside & !unclear | ahead;
        }
        let distance = distance.greater(near);
        let ahead = distance.gt(X8::lit(0.0));
        if let Some(cutouts) = &self.cutouts {
            let weights = projected.weights;
            let lane = |k: usize| (leaf.start + k, PrimitiveId(first + k as u32), weights.map(|w| w.lane(k)));
            let hit = inside & (ahead & distance.le(limit)).bits();
            inside = cutouts.opaque(hit, ray.origin(), ray.direction(), lane);
        }
        if ANY {
            return inside & (ahead & distance.lt(limit)).bits() != 0;
        }
        each_bit(inside & (ahead & distance.le(limit)).bits(), |lane| {
            let lane = lane & 7;
            let distance = distance.as_array()[lane];
            let primitive = PrimitiveId(first + lane as u32);
            let rank = |primitive| self.rank(situation.first(), primitive);
            if distance < nearest.distance || distance == nearest.distance && rank(primitive) < rank(nearest.primitive)
            {
                *nearest = Nearest { distance, primitive };
            }
        });
        false
    }
}

impl<S: Situation> Primitives for Situated<'_, S> {
    #[inline]
    fn test_packet<const ANY: bool>(
        &self,
        leaf: Range<usize>,
        rays: &Rays,
        near: X8,
        active: M8,
        hits: &mut Hits,
    ) -> M8 {
        self.triangles.packet::<ANY>(&self.situation, leaf, rays, near, active, hits)
    }
}

impl<S: Situation> Leaves for Situated<'_, S> {
    #[inline(always)]
    fn test_ray<const ANY: bool>(&self, leaf: Range<usize>, ray: &SingleRay, near: X8, nearest: &mut Nearest) -> bool {
        self.triangles.ray::<ANY>(&self.situation, leaf, ray, near, nearest)
    }
    #[inline(always)]
    fn prefetch(&self, leaf: Range<usize>) {
        prefetch(&self.triangles.coordinates[9 * leaf.start..9 * leaf.end + 8]);
        prefetch(&self.triangles.near[leaf.start..=leaf.start]);
    }
}

impl TriangleLeaves {
    /// Size in bytes.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.coordinates[..])
            + size_of_val(&self.leaves[..])
            + size_of_val(&self.ids[..])
            + size_of_val(&self.near[..])
            + self.cutouts.as_ref().map_or(0, |cutouts| cutouts.bytes())
    }
}

impl Placed for TriangleLeaves {
    #[inline]
    fn meeting(&self, leaf: &Range<usize>, region: &Region) -> u32 {
        region.triangles(&self.all(leaf))
    }
}

#[cfg(test)]
mod tests;
