//! Instances of objects: a tree over them, and a tree over the triangles of each object.
//!
//! A ray enters the boxes of an object in the object's space, where it has the same distances. Its triangles are moved to world space,
//! rounded there, and tested like all others. What a ray hits is thus what it would hit if each instance were a copy whose corners
//! [`Affine::point`] has moved, bit for bit.

use super::build::Costs;
use super::node::{BuildError, WIDTH, push_in_order, slabs};
use super::primitive::PrimitiveId;
use super::rays::{Hits, Rays};
use super::region::{Placed, Region, search};
use super::stream::{Scratch, stream};
use super::traversal::Traversal;
use super::tree::Tree;
use super::triangles::{Moved, Situated, TriangleLeaves};
use crate::geometry::{Affine, Instance, bounds_of};
use crate::packet::{M8, X8};
use etendue::{Mask, Real};
use std::ops::{Range, RangeInclusive};

const SQRT_3: f64 = 1.733;

/// The extents of instances whose triangles may be tested in single precision, if those of the object may.
const EXTENTS: RangeInclusive<f64> = 1.0 / (1_u64 << 16) as f64..=(1_u64 << 40) as f64;

/// A node is visited in about the time of a box.
const COSTS: Costs = Costs { most: 1, leaf: 4.0, primitive: 0.0 };

/// Triangles that instances share.
#[derive(Debug)]
pub(super) struct Object {
    pub(super) triangles: Tree<TriangleLeaves>,
    /// Number of triangles before those of the object, in the order of the leaves of all trees.
    pub(super) before: usize,
}

/// Where an instance is.
#[derive(Clone, Copy, Debug)]
struct Placement {
    object: u32,
    /// The place of its first triangle.
    first: u32,
    to_world: Affine,
    to_object: Affine,
    /// A bound of the factor by which the distances grow up to which single precision does not suffice.
    size: f32,
}

/// The instances of a scene.
#[derive(Debug)]
pub(super) struct Instances {
    pub(super) objects: Vec<Object>,
    /// In leaf order.
    placements: Vec<Placement>,
    over: Tree<()>,
    /// Greatest magnitude of a coordinate of the scene.
    reach: f32,
}

/// A node or a placement to visit, and the least distance at which a ray enters it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Visit {
    first: u32,
    is_leaf: bool,
    near: f32,
}

/// A triangle of an instance.
pub(super) struct InstanceTriangle<'a> {
    pub(super) object: &'a Object,
    /// The index of the triangle in the order of the object's leaves.
    pub(super) index: usize,
    pub(super) to_world: &'a Affine,
}

impl Instances {
    /// `first` is the place of the first triangle of the instances. Instances of objects without triangles, and those whose map is singular,
    /// are left out.
    pub(super) fn new(
        objects: Vec<Object>,
        instances: &[Instance],
        first: usize,
        reach: f32,
    ) -> Result<Self, BuildError> {
        let of = |instance: &Instance| &objects[instance.object as usize].triangles;
        let some = |instance: &Instance| {
            let to_object = instance.to_world.inverse().filter(|_| of(instance).count() > 0);
            to_object.map(|to_object| (*instance, to_object))
        };
        let instances: Vec<_> = instances.iter().filter_map(some).collect();
        let bounds = instances.iter().map(|(instance, _)| bounds_of(&instance.corners(of(instance).bounds())));
        let mut order = Vec::new();
        let over = Tree::build(bounds.collect(), COSTS, |_| (), |_, ids, _| order = ids)?;
        let mut end = first;
        let placements = order.into_iter().map(|index| {
            let (Instance { object, to_world }, to_object) = instances[index as usize];
            let first = end as u32;
            end += objects[object as usize].triangles.count();
            // as the longest edge, and more where the map makes slivers; distances are rounded up to powers of two
            let (greatest, det) = (to_world.greatest() * 2.0 * SQRT_3, to_world.determinant().abs());
            let size = (greatest * (greatest.powi(3) / det).clamp(1.0, 1e30)) as f32;
            let [low, high] = objects[object as usize].triangles.bounds().map(|corner| corner.map(f64::from));
            let extent = (0..3).fold(0.0, |most: f64, k| most.max(high[k] - low[k])) * greatest;
            let size = if EXTENTS.contains(&extent) { size } else { f32::INFINITY };
            Placement { object, first, to_world, to_object, size }
        });
        let placements = placements.collect();
        if end >= 1 << 31 {
            return Err(BuildError { count: end, most: (1 << 31) - 1 });
        }
        let reach = reach.max(over.reach());
        Ok(Self { objects, placements, over, reach })
    }
    /// Greatest magnitude of a coordinate of the scene.
    pub(super) fn reach(&self) -> f32 {
        self.reach
    }
    pub(super) fn bytes(&self) -> usize {
        let objects =
            self.objects.iter().map(|object| object.triangles.bytes() + object.triangles.primitives().bytes());
        self.over.bytes() + size_of_val(&self.placements[..]) + objects.sum::<usize>()
    }
    /// The triangle at a place of an instance.
    pub(super) fn find(&self, place: u32) -> InstanceTriangle<'_> {
        let placement = &self.placements[self.placements.partition_point(|other| other.first <= place) - 1];
        let index = (place - placement.first) as usize;
        InstanceTriangle { object: &self.objects[placement.object as usize], index, to_world: &placement.to_world }
    }
    /// Finds the nearest hits of packets, if nearer than those in `hits`. With `ANY`, clears the lanes of `active` that hit something
    /// instead. If the traversal is exhaustive, every leaf of every instance is tested.
    pub(super) fn trace<const ANY: bool>(
        &self,
        rays: &[Rays],
        active: &mut [M8],
        hits: &mut [Hits],
        traversal: Traversal,
        stack: &mut Vec<Visit>,
        scratch: &mut Scratch,
    ) {
        for ((rays, active), hits) in rays.iter().zip(active).zip(hits) {
            if traversal == Traversal::Exhaustive {
                self.placements.iter().for_each(|placement| {
                    let (own, moved) = self.enter(placement, rays);
                    let tree = self.objects[placement.object as usize].triangles.over(&moved);
                    tree.every_leaf::<ANY>(&[own], std::slice::from_mut(active), std::slice::from_mut(hits));
                });
            } else if active.any() {
                self.trace_packet::<ANY>(rays, active, hits, stack, scratch);
            }
        }
    }
    fn trace_packet<const ANY: bool>(
        &self,
        rays: &Rays,
        active: &mut M8,
        hits: &mut Hits,
        stack: &mut Vec<Visit>,
        scratch: &mut Scratch,
    ) {
        stack.clear();
        let (nodes, order) = (self.over.view().nodes, X8::lit(f64::INFINITY));
        stack.push(Visit { first: 0, is_leaf: false, near: 0.0 });
        while let Some(Visit { first, is_leaf, near }) = stack.pop() {
            if !(*active & hits.distance.ge(X8::splat(near))).any() {
                continue;
            }
            if is_leaf {
                let placement = &self.placements[first as usize];
                let (own, moved) = self.enter(placement, rays);
                let tree = self.objects[placement.object as usize].triangles.over(&moved);
                let (active, hits) = (std::slice::from_mut(active), std::slice::from_mut(hits));
                stream::<ANY>(&tree, &[own], active, hits, scratch);
                continue;
            }
            let node = &nodes[first as usize];
            let floor = stack.len();
            for slot in 0..(node.children as usize).min(WIDTH) {
                let (near, entered) = slabs::<false>(node, slot, rays, [false; 3], hits.distance);
                let entered = entered & *active;
                if entered.any() {
                    let near = Real::blend(entered, near, order).to_array().into_iter().fold(f32::INFINITY, f32::min);
                    let child = Visit { first: node.first[slot], is_leaf: node.count[slot] != 0, near };
                    stack.push(child);
                    let mut height = stack.len() - 1;
                    push_in_order(stack, &mut height, floor, child, |visit| visit.near);
                }
            }
        }
    }
    /// The rays of a packet as they enter the boxes of an instance, and its triangles.
    fn enter<'a>(&'a self, placement: &'a Placement, rays: &Rays) -> (Rays, Situated<'a, Moved<'a>>) {
        let Placement { first, ref to_world, ref to_object, size, .. } = *placement;
        let triangles = &self.objects[placement.object as usize].triangles;
        let (origin, direction) = (to_object.point(rays.origin), to_object.vector(rays.direction));
        // the rounding of corners and rays in world space, as far as it goes in the object's space, and that in this space
        let outside = (rays.origin.max_abs() + X8::splat(self.reach)) * X8::splat(2.0 * to_object.greatest() as f32);
        let inside = origin.max_abs() + X8::splat(triangles.reach());
        let pad = (outside + inside) * X8::lit(1.0 / 1_048_576.0);
        let moved = Situated { triangles: triangles.primitives(), situation: Moved { first, to_world, size } };
        (rays.entering(origin, direction, pad), moved)
    }
    /// As of [`search`](super::region::search), with the triangles of instances.
    pub(super) fn search(
        &self,
        region: &Region,
        stack: &mut Vec<u32>,
        budget: &mut usize,
        mut visit: impl FnMut(PrimitiveId) -> bool,
    ) -> bool {
        let mut met = Vec::new();
        let complete = search(&self.over.over(&All), region, stack, budget, |at| {
            met.push(at);
            true
        });
        complete
            && met.into_iter().all(|at| {
                let Placement { object, first, ref to_world, .. } = self.placements[at];
                let triangles = &self.objects[object as usize].triangles;
                let region = region.in_space(to_world, triangles.reach());
                search(&triangles.view(), &region, stack, budget, |index| visit(PrimitiveId(first + index as u32)))
            })
    }
}

/// The boxes of instances.
struct All;

impl Placed for All {
    #[inline]
    fn meeting(&self, leaf: &Range<usize>, _region: &Region) -> u32 {
        // the node's boxes are those of the instances
        (1 << leaf.len()) - 1
    }
}
