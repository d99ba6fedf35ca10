//! Ray intersection in groups of up to 8 packets of 8 rays, over trees that obvhs builds.
//!
//! Guarantees: traversal never loses a hit that the triangle test would report, since slabs are widened by more than the error of
//! that test. There are no gaps between adjacent triangles. Directions may have components 0 and −0. Nothing depends on the unit of
//! length. A hit is strictly nearer than its limit, and of two hits at equal distance the triangle of lower index wins. Of a shape and others that
//! are level with it but for rounding, the light wins whose lit side is turned to the ray, then the shape that is first. What a ray
//! hits therefore depends neither on the other rays of its group nor on the traversal, bit for bit.
//!
//! Files import one way, from the last of this list to the first: `double_precision`, `traversal`,
//! `primitive`, `rays`, `node`, `build`, `parallel_build`, `tree`, then the traversals `frustum`, `single_ray`, `stream`,
//! `region`, then the primitives `cutouts`, `projected_triangle`, `shapes`, `triangles`, and `instances` of them.
//! Each traversal is one body for closest and any hit (`ANY`). For any hit, the distances in [`Hits`] are those of the ends of segments, and
//! the primitives are the shapes there, which do not occlude.
//!
//! A traversal stays for what it brings end to end. Speed with it relative to without (medians of user time, alternating runs of
//! `etendue render SCENE --spp 16 --size 256x256 --threads 1 --repeat 5 --sampler independent` on a shared machine): the frustum brings
//! 1.18 on terrain, 1.07 on quads and 1.09 on mirror-room; the stream, instead of single rays, 1.17, 1.40 and 1.31.
//! Rays do not take turns while they wait for memory: on the scenes with the largest trees, that brought less than a tenth.

mod build;
mod cutouts;
mod double_precision;
mod frustum;
mod instances;
mod node;
mod parallel_build;
mod primitive;
mod projected_triangle;
mod rays;
mod region;
mod shapes;
mod single_ray;
mod stream;
mod tracer;
mod traversal;
mod tree;
mod triangles;

use crate::geometry::{Affine, Instance, NEAR_LIMIT, Segment};
use crate::packet::{M8, V8, X8, each_bit};
use crate::scene::texture::Mask as Holes;
use double_precision::{hides, wide};
use etendue::{Mask, Real, Vec3};
use frustum::Frustum;
use instances::{InstanceTriangle, Instances, Object};
pub use node::BuildError;
pub use primitive::{PrimitiveId, PrimitiveIds};
use rays::any;
pub use rays::{GROUP, Hits, Rays};
pub use region::Region;
pub use shapes::{LitSides, ShapeSet};
use std::ops::Range;
use std::sync::Arc;
pub(crate) use tracer::Tracer;
pub use tracer::{RayCount, Scratch};
pub use traversal::Traversal;
use tree::Tree;
use triangles::{InPlace, Situated};

/// See [`Bvh::reach_of_points`].
const MOST_REACH: f32 = (1 << 20) as f32;

/// Where shapes are farther apart than this part of the [reach](Bvh::reach) of a scene, segments that end on one are looked for up to this part
/// of their length: the rest is nearer to that shape, and they spare the leaf that it is in.
const GAP: f32 = 1.0 / 16_384.0;
const BEFORE_SHAPES: f64 = 1.0 - 1.0 / 131_072.0;

/// Everything rays can hit: mesh triangles in a tree, and shapes that are intersected as such.
#[derive(Debug)]
pub struct Bvh {
    triangles: Tree<triangles::TriangleLeaves>,
    /// Instances of objects, if the scene has some. Their places follow those of `triangles`.
    instances: Option<Box<Instances>>,
    /// The original index of each triangle, in the order of the leaves of all trees, if there are instances.
    order: Vec<u32>,
    traversal: Traversal,
    /// Spheres and emitters.
    pub shapes: ShapeSet,
    reach: f32,
}

impl Bvh {
    /// Builds the tree over mesh triangles.
    ///
    /// # Errors
    /// Fails if there are more than 2³¹ − 1 triangles.
    pub fn new(triangles: &[[[f32; 3]; 3]], shapes: ShapeSet) -> Result<Self, BuildError> {
        Self::taking(Self::with_room(triangles), shapes)
    }
    /// A copy of triangles with room for eight-lane loads beyond the last leaf.
    pub(crate) fn with_room(triangles: &[[[f32; 3]; 3]]) -> Vec<[[f32; 3]; 3]> {
        let mut own = Vec::with_capacity(triangles.len() + 1);
        own.extend_from_slice(triangles);
        own
    }
    /// Like [`Bvh::new`], but builds in the memory of the triangles. Beyond the finished tree, this takes the memory of a few
    /// thousand triangles.
    ///
    /// # Errors
    /// Fails if there are more than 2³¹ − 1 triangles.
    pub fn taking(triangles: Vec<[[f32; 3]; 3]>, shapes: ShapeSet) -> Result<Self, BuildError> {
        let mut triangles = triangles::TriangleLeaves::tree(triangles)?;
        triangles.primitives_mut().reached = shapes.reached().clone();
        let reach = triangles.reach().max(shapes.reach());
        Ok(Self { triangles, instances: None, order: Vec::new(), traversal: Traversal::default(), shapes, reach })
    }
    /// Like [`Bvh::taking`], with instances of objects: each object has a range of the triangles, which follow those that are no part of
    /// any, and each other.
    ///
    /// # Errors
    /// Fails if there are more than 2³¹ − 1 triangles, those of all instances counted.
    pub fn with_instances(
        mut triangles: Vec<[[f32; 3]; 3]>,
        objects: &[Range<usize>],
        instances: &[Instance],
        shapes: ShapeSet,
    ) -> Result<Self, BuildError> {
        if instances.is_empty() {
            triangles.truncate(objects.first().map_or(triangles.len(), |range| range.start));
            return Self::taking(triangles, shapes);
        }
        // the last objects first, so that the memory of each is freed
        let mut own = Vec::with_capacity(objects.len());
        for range in objects.iter().rev() {
            let mut tree = triangles::TriangleLeaves::tree(triangles.split_off(range.start))?;
            tree.primitives_mut().reached = shapes.reached().clone();
            triangles.shrink_to_fit();
            own.push(Object { triangles: tree, before: range.start });
        }
        own.reverse();
        let mut bvh = Self::taking(triangles, shapes)?;
        let count = bvh.triangles.count();
        let instances = Instances::new(own, instances, count, bvh.reach)?;
        bvh.order.extend_from_slice(bvh.triangles.primitives().ids());
        for object in &instances.objects {
            bvh.order.extend(object.triangles.primitives().ids().iter().map(|id| id + object.before as u32));
        }
        bvh.reach = instances.reach();
        bvh.instances = Some(Box::new(instances));
        Ok(bvh)
    }
    /// Gives triangles holes. `of` tells the mask of a triangle and the texture coordinates of its corners, by its original index.
    pub fn cut_out(&mut self, masks: &Arc<[Holes]>, of: impl Fn(u32) -> Option<(u32, [[f32; 2]; 3])>) {
        let cut = |leaves: &mut triangles::TriangleLeaves, before: usize| {
            let cuts = leaves.ids().iter().map(|id| of(id + before as u32));
            leaves.cutouts = cutouts::Cutouts::new(masks, cuts).map(Box::new);
        };
        cut(self.triangles.primitives_mut(), 0);
        for object in self.instances.iter_mut().flat_map(|instances| &mut instances.objects) {
            cut(object.triangles.primitives_mut(), object.before);
        }
    }
    /// The same scene with another traversal, for comparisons.
    #[must_use]
    pub fn with_traversal(self, traversal: Traversal) -> Self {
        Self { traversal, ..self }
    }
    /// Prepares rays for this scene.
    #[inline(always)]
    pub fn rays(&self, origin: V8, direction: V8) -> Rays {
        Rays::new(origin, direction, self.reach)
    }
    /// Finds the nearest hits of the active lanes of a group of packets, if nearer than those in `hits`. Coherent groups are fastest.
    ///
    /// All slices must have the same length, at most [`GROUP`].
    #[inline]
    pub fn closest(&self, rays: &[Rays], active: &[M8], hits: &mut [Hits], scratch: &mut Scratch) {
        let mut lanes = [M8::splat(false); GROUP];
        lanes[..active.len()].copy_from_slice(active);
        self.trace::<false>(rays, &mut lanes[..active.len()], hits, scratch);
    }
    /// Like [`Bvh::closest`], for shapes only.
    #[inline]
    pub fn closest_shape(&self, rays: &[Rays], active: &[M8], hits: &mut [Hits], scratch: &mut Scratch) {
        let mut lanes = [M8::splat(false); GROUP];
        lanes[..active.len()].copy_from_slice(active);
        let frustum = self.frustum(rays, active);
        self.trace_shapes::<false>(rays, &mut lanes[..active.len()], frustum.as_ref(), hits, scratch);
    }
    /// Clears the lanes of `active` in which something hides the end of a segment, which is at the distance `limit` and on the shape `target`
    /// (or on none). What is level with the end within [`ENDS`](etendue_visible::ENDS)
    /// does not hide it, but for lights that shine towards the origin, too, and come before the target in the scene's list.
    #[inline]
    pub fn occluded(
        &self,
        rays: &[Rays],
        active: &mut [M8],
        limit: &[X8],
        target: &[PrimitiveIds],
        scratch: &mut Scratch,
    ) {
        let mut hits = [Hits::none(X8::lit(0.0)); GROUP];
        for ((hits, &limit), &target) in hits.iter_mut().zip(limit).zip(target) {
            (hits.distance, hits.primitives) = (limit, target);
        }
        self.trace::<true>(rays, active, &mut hits[..limit.len()], scratch);
    }
    /// Finds the nearest hits of a group. With `ANY`, clears the lanes of `active` that hit something before the distances in `hits`,
    /// other than the shape in `hits`.
    #[inline]
    fn trace<const ANY: bool>(&self, rays: &[Rays], active: &mut [M8], hits: &mut [Hits], scratch: &mut Scratch) {
        let frustum = self.frustum(rays, active);
        // a single shape does not occlude itself
        let only = match self.shapes.tree().primitives().ids() {
            [only] => PrimitiveId::of_shape(*only),
            _ => PrimitiveId::NONE,
        };
        let own = |(&a, hits): (&M8, &Hits)| !(a & !hits.primitives.are(only)).any();
        let none = ANY && only != PrimitiveId::NONE && active.iter().zip(&*hits).all(own);
        if !none {
            if ANY && self.shapes.gap() > GAP * self.reach {
                let mut near = [Hits::none(X8::lit(0.0)); GROUP];
                for (near, &hits) in near.iter_mut().zip(&*hits) {
                    let distance = Real::blend(hits.any(), hits.distance * X8::lit(BEFORE_SHAPES), hits.distance);
                    *near = Hits { distance, ..hits };
                }
                self.trace_shapes::<ANY>(rays, active, frustum.as_ref(), &mut near[..rays.len()], scratch);
            } else {
                self.trace_shapes::<ANY>(rays, active, frustum.as_ref(), hits, scratch);
            }
            if ANY && !any(active) {
                return;
            }
        }
        // triangles that are level with the nearest shape are met, too, until more is known
        let mut shapes = [None; GROUP];
        if !ANY {
            for (hits, shapes) in hits.iter_mut().zip(&mut shapes).filter(|(hits, _)| hits.shapes().any()) {
                *shapes = Some(*hits);
                let farther = hits.distance * X8::lit(1.0 + NEAR_LIMIT);
                hits.distance = Real::blend(hits.shapes(), farther, hits.distance);
            }
        }
        let Scratch { frustum: stack, stream, instances: visits } = scratch;
        let triangles = Situated { triangles: self.triangles.primitives(), situation: InPlace };
        let tree = self.triangles.over(&triangles);
        match (&frustum, self.traversal) {
            (Some(_), _) => frustum::packets::<ANY>(&tree, rays, active, frustum.as_ref(), hits, stack),
            (None, Traversal::Single) => {
                single_ray::one_by_one::<ANY>(&tree, rays, active, hits, &mut stream.single_ray)
            }
            (None, Traversal::Exhaustive) => tree.every_leaf::<ANY>(rays, active, hits),
            (None, Traversal::Choose | Traversal::Stream) => stream::stream::<ANY>(&tree, rays, active, hits, stream),
        }
        if let Some(instances) = &self.instances {
            instances.trace::<ANY>(rays, active, hits, self.traversal, visits, stream);
        }
        for ((rays, hits), shapes) in rays.iter().zip(hits).zip(shapes) {
            if let Some(shapes) = shapes {
                self.prefer_shapes(rays, &shapes, hits);
            }
        }
    }
    /// Returns to the nearest shapes where triangles do not hide their hits.
    fn prefer_shapes(&self, rays: &Rays, shapes: &Hits, hits: &mut Hits) {
        let lanes = shapes.shapes();
        let mut first = lanes & hits.shapes();
        let near = lanes & !first & hits.distance.gt(shapes.distance * X8::lit(1.0 - NEAR_LIMIT));
        each_bit(near.bits(), |lane| {
            let [origin, direction] = [rays.origin, rays.direction].map(|v| wide(v.lane(lane)));
            let segment = Segment { origin, direction, length: shapes.distance.as_array()[lane].into() };
            let segment = self.shapes.reached().by(shapes.primitives.lane(lane), segment);
            let c = self.corners(hits.primitives.lane(lane));
            if !hides([0, 3, 6].map(|k| wide(Vec3::new(c[k], c[k + 1], c[k + 2]))), &segment) {
                first = first | M8::from_bits(1 << lane);
            }
        });
        hits.distance = Real::blend(first, shapes.distance, hits.distance);
        hits.primitives = PrimitiveIds::pick(first, shapes.primitives, hits.primitives);
    }
    /// Like [`Self::trace`], for shapes only: packet by packet if there is no frustum, as shapes are few.
    #[inline]
    fn trace_shapes<const ANY: bool>(
        &self,
        rays: &[Rays],
        active: &mut [M8],
        frustum: Option<&Frustum>,
        hits: &mut [Hits],
        scratch: &mut Scratch,
    ) {
        let (shapes, stack) = (&self.shapes.tree().view(), &mut scratch.frustum);
        if frustum.is_some() {
            return frustum::packets::<ANY>(shapes, rays, active, frustum, hits, stack);
        }
        for p in 0..rays.len() {
            if active[p].any() {
                frustum::packets::<ANY>(shapes, &rays[p..=p], &mut active[p..=p], None, &mut hits[p..=p], stack);
            }
        }
    }
    /// The narrow frustum of the group, if there is one and the traversal may use it.
    #[inline]
    fn frustum(&self, rays: &[Rays], active: &[M8]) -> Option<Frustum> {
        if self.traversal == Traversal::Choose { Frustum::new(rays, active) } else { None }
    }
    /// A triangle of an instance; `None` if it is no part of any.
    #[inline]
    fn of_instance(&self, PrimitiveId(place): PrimitiveId) -> Option<InstanceTriangle<'_>> {
        let instances = self.instances.as_ref().filter(|_| place as usize >= self.triangles.count())?;
        Some(instances.find(place))
    }
    /// The corners of a mesh triangle.
    #[inline]
    pub fn corners(&self, triangle: PrimitiveId) -> [f32; 9] {
        let Some(InstanceTriangle { object, index, to_world }) = self.of_instance(triangle) else {
            return self.triangles.primitives().corners(triangle.0);
        };
        let c = object.triangles.primitives().corners(index as u32);
        let [a, b, c] = [0, 3, 6].map(|k| to_world.point(Vec3::new(c[k], c[k + 1], c[k + 2])));
        [a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z]
    }
    /// The index in [`order`](Self::order) of a mesh triangle.
    #[inline]
    pub fn slot(&self, triangle: PrimitiveId) -> usize {
        self.of_instance(triangle).map_or(triangle.0 as usize, |found| found.object.before + found.index)
    }
    /// The map to world space of a mesh triangle; `None` for one that is no part of an instance.
    pub fn to_world(&self, triangle: PrimitiveId) -> Option<&Affine> {
        self.of_instance(triangle).map(|found| found.to_world)
    }
    /// Whether a mesh triangle has holes.
    pub fn is_cut_out(&self, triangle: PrimitiveId) -> bool {
        let (triangles, index) = match self.of_instance(triangle) {
            Some(found) => (found.object.triangles.primitives(), found.index),
            None => (self.triangles.primitives(), triangle.0 as usize),
        };
        triangles.cutouts.as_ref().is_some_and(|cutouts| cutouts.has(index))
    }
    /// The number of triangles that are no part of an instance; their places come first.
    pub fn count(&self) -> usize {
        self.triangles.count()
    }
    /// Calls `visit` with each primitive that may meet the region, until it returns false or `budget` nodes
    /// have been visited, of which it leaves the rest. Returns whether the search was completed.
    pub fn search(
        &self,
        region: &Region,
        stack: &mut Vec<u32>,
        budget: &mut usize,
        mut visit: impl FnMut(PrimitiveId) -> bool,
    ) -> bool {
        let shapes = self.shapes.tree();
        let ids = shapes.primitives().ids();
        region::search(&shapes.view(), region, stack, budget, |at| visit(PrimitiveId::of_shape(ids[at])))
            && region::search(&self.triangles.view(), region, stack, budget, |at| {
                visit(PrimitiveId::of_triangle(at as u32))
            })
            && self.instances.as_ref().is_none_or(|all| all.search(region, stack, budget, visit))
    }
    /// Greatest magnitude of a coordinate of the scene.
    pub fn reach(&self) -> f32 {
        self.reach
    }
    /// By the part 2⁻⁴⁴ of this, points are lifted off their surfaces at the least: the greatest coordinate of the scene, but not beyond 2²⁰
    /// times those of the nearest light, so that a floor without end lifts no point off its shadow.
    pub fn reach_of_points(&self) -> f32 {
        self.reach.min(self.shapes.least() * MOST_REACH)
    }
    /// The original index of each triangle, in leaf order; those of objects follow the others.
    pub fn order(&self) -> &[u32] {
        if self.instances.is_some() { &self.order } else { self.triangles.primitives().ids() }
    }
    /// Size of trees and triangles in bytes.
    pub fn bytes(&self) -> usize {
        let instances = self.instances.as_ref().map_or(0, |instances| instances.bytes());
        self.triangles.bytes() + self.triangles.primitives().bytes() + instances + size_of_val(&self.order[..])
    }
}
