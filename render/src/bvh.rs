//! Ray intersection in groups of up to 8 packets of 8 rays, over trees that obvhs builds.
//!
//! Guarantees: traversal never loses a hit that the triangle test would report, since slabs are widened by more than the error of
//! that test. There are no gaps between adjacent triangles. Directions may have components 0 and −0. Nothing depends on the unit of
//! length. A hit is strictly nearer than its limit, and of two hits at equal distance the triangle of lower index wins. What a ray
//! hits therefore depends neither on the other rays of its group nor on the traversal, bit for bit.
//!
//! Files import one way, from the last of this list to the first: `double_precision`, `rays`, `node`, `build`, `parallel_build`, `tree`, then the
//! traversals `frustum`, `single_ray`, `stream`, `region`, then the primitives `triangles`, `shapes`. Each traversal is one body for closest and
//! any hit (`ANY`). For any hit, the distances in [`Hits`] are the limits, and their places are the shapes that do not occlude.
//!
//! A traversal stays for what it brings end to end. Speed with it relative to without (medians of user time, alternating runs of
//! `etendue render SCENE --spp 16 --size 256x256 --threads 1 --repeat 5 --sampler independent` on a shared machine): the frustum brings
//! 1.18 on terrain, 1.07 on quads and 1.09 on mirror-room; the stream, instead of single rays, 1.17, 1.40 and 1.31.

mod build;
mod double_precision;
mod frustum;
mod node;
mod parallel_build;
mod rays;
mod region;
mod shapes;
mod single_ray;
mod stream;
mod tree;
mod triangles;

use crate::packet::{M8, V8, X8, equal};
use etendue::{Mask, Real, u32x8};
use frustum::Frustum;
pub use node::BuildError;
use node::Stack;
use rays::any;
pub use rays::{GROUP, Hits, NOTHING, Rays, SHAPE};
pub use region::Region;
pub use shapes::ShapeSet;
use tree::Tree;

/// Scratch memory for traversals, to be reused.
#[derive(Debug, Default)]
pub struct Scratch {
    frustum: Stack<frustum::Pending>,
    stream: stream::Scratch,
}

/// How groups of packets traverse the tree of triangles. The hits do not depend on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Traversal {
    /// As one frustum if the group fits into a narrow one, otherwise as a stream.
    #[default]
    Choose,
    /// As a stream: the group visits each node once, with the rays that enter it. Below 5 active rays, each finishes
    /// alone.
    Stream,
    /// Ray by ray.
    Single,
    /// Every leaf, regardless of other hits and without the tree above it: the oracle for the other traversals.
    Exhaustive,
}

/// Everything rays can hit: mesh triangles in a tree, and shapes that are intersected as such.
#[derive(Debug)]
pub struct Bvh {
    triangles: Tree<triangles::TriangleLeaves>,
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
        // room for eight-lane loads beyond the last leaf
        let mut own = Vec::with_capacity(triangles.len() + 1);
        own.extend_from_slice(triangles);
        Self::taking(own, shapes)
    }
    /// Like [`Bvh::new`], but builds in the memory of the triangles. Beyond the finished tree, this takes the memory of a few
    /// thousand triangles.
    ///
    /// # Errors
    /// Fails if there are more than 2³¹ − 1 triangles.
    pub fn taking(triangles: Vec<[[f32; 3]; 3]>, shapes: ShapeSet) -> Result<Self, BuildError> {
        let triangles = triangles::TriangleLeaves::tree(triangles)?;
        let reach = triangles.reach().max(shapes.reach());
        Ok(Self { triangles, traversal: Traversal::default(), shapes, reach })
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
    /// Clears the lanes of `active` that are occluded by something nearer than `limit`, other than the shape `target` (an index
    /// without [`SHAPE`], or [`NOTHING`]).
    #[inline]
    pub fn occluded(&self, rays: &[Rays], active: &mut [M8], limit: &[X8], target: &[u32x8], scratch: &mut Scratch) {
        let mut hits = [Hits::none(X8::lit(0.0)); GROUP];
        for ((hits, &limit), &target) in hits.iter_mut().zip(limit).zip(target) {
            (hits.distance, hits.place) = (limit, target | u32x8::splat(SHAPE));
        }
        self.trace::<true>(rays, active, &mut hits[..limit.len()], scratch);
    }
    /// Finds the nearest hits of a group. With `ANY`, clears the lanes of `active` that hit something before the distances in `hits`,
    /// other than the shape in `hits`.
    #[inline]
    fn trace<const ANY: bool>(&self, rays: &[Rays], active: &mut [M8], hits: &mut [Hits], scratch: &mut Scratch) {
        let frustum = self.frustum(rays, active);
        // a single shape does not occlude itself
        let own = |(&a, hits): (&M8, &Hits)| !(a & !equal(hits.place, u32x8::splat(SHAPE))).any();
        let none = ANY && self.shapes.tree().count() == 1 && active.iter().zip(&*hits).all(own);
        if !none {
            self.trace_shapes::<ANY>(rays, active, frustum.as_ref(), hits, scratch);
            if ANY && !any(active) {
                return;
            }
        }
        let Scratch { frustum: stack, stream } = scratch;
        match (&frustum, self.traversal) {
            (Some(_), _) => frustum::packets::<ANY>(&self.triangles, rays, active, frustum.as_ref(), hits, stack),
            (None, Traversal::Single) => {
                single_ray::one_by_one::<ANY>(&self.triangles, rays, active, hits, &mut stream.single_ray)
            }
            (None, Traversal::Exhaustive) => self.triangles.every_leaf::<ANY>(rays, active, hits),
            (None, _) => stream::stream::<ANY>(&self.triangles, rays, active, hits, stream),
        }
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
        let (shapes, stack) = (self.shapes.tree(), &mut scratch.frustum);
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
    /// The corners of the mesh triangle at a place.
    #[inline]
    pub fn corners(&self, place: u32) -> [f32; 9] {
        self.triangles.primitives().corners(place)
    }
    /// Calls `visit` with the place of each primitive that may meet the region, as in [`Hits`], until it returns false or `budget` nodes
    /// have been visited. Returns whether the search was completed.
    pub fn search(
        &self,
        region: &Region,
        stack: &mut Vec<u32>,
        mut budget: usize,
        mut visit: impl FnMut(u32) -> bool,
    ) -> bool {
        let shapes = self.shapes.tree();
        let ids = shapes.primitives().ids();
        region::search(shapes, region, stack, &mut budget, |at| visit(ids[at] | SHAPE))
            && region::search(&self.triangles, region, stack, &mut budget, |at| visit(at as u32))
    }
    /// Greatest magnitude of a coordinate of the scene.
    pub fn reach(&self) -> f32 {
        self.reach
    }
    /// The original index of each triangle, in leaf order.
    pub fn order(&self) -> &[u32] {
        self.triangles.primitives().ids()
    }
    /// Size of tree and triangles in bytes.
    pub fn bytes(&self) -> usize {
        self.triangles.bytes()
    }
}
