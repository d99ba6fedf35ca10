//! Intersection with spheres and emitters.

use super::build::Costs;
use super::node::BuildError;
use super::rays::{Hits, Rays, SHAPE};
use super::region::{Placed, Region};
use super::tree::{Primitives, Tree};
use crate::geometry::{AnyHittable, Approach, Geometry, Hittable};
use crate::packet::{M8, X8, equal, pick, select};
use etendue::{Mask, u32x8};
use std::ops::Range;

/// A packet tests one shape after another, each in about the time of a node.
const COSTS: Costs = Costs { most: 4, leaf: 0.0, primitive: 1.0 };

#[derive(Debug)]
pub(super) struct Hittables {
    hittables: Vec<AnyHittable>,
    ids: Vec<u32>,
}

/// All shapes of a scene. Ids are indices into the scene's list; in hits, they have the bit [`SHAPE`] set.
#[derive(Debug)]
pub struct ShapeSet {
    tree: Tree<Hittables>,
    reach: f32,
}

impl Hittables {
    /// The index of each shape in the scene's list, in leaf order.
    pub(super) fn ids(&self) -> &[u32] {
        &self.ids
    }
}

impl ShapeSet {
    /// Prepares the shapes.
    ///
    /// # Errors
    /// Fails if there are more than 2³¹ − 1 shapes.
    pub fn new<'a>(shapes: impl Iterator<Item = &'a Geometry>) -> Result<Self, BuildError> {
        let shapes: Vec<_> = shapes.collect();
        let boxes: Vec<_> = shapes.iter().map(|shape| shape.bounds()).collect();
        let reach = boxes.iter().flatten().flatten().fold(0.0_f32, |m, x| m.max(x.abs()));
        let tree = Tree::build(
            boxes,
            COSTS,
            |_| (),
            |_, ids, _| Hittables { hittables: ids.iter().map(|&i| shapes[i as usize].hittable()).collect(), ids },
        )?;
        Ok(Self { tree, reach })
    }
    /// Greatest magnitude of a coordinate.
    pub fn reach(&self) -> f32 {
        self.reach
    }
    pub(super) fn tree(&self) -> &Tree<Hittables> {
        &self.tree
    }
}

impl Primitives for Hittables {
    #[inline]
    fn test_packet<const ANY: bool>(
        &self,
        leaf: Range<usize>,
        rays: &Rays,
        _near: X8,
        active: M8,
        hits: &mut Hits,
    ) -> M8 {
        let mut hidden = M8::splat(false);
        for (hittable, &id) in self.hittables[leaf.clone()].iter().zip(&self.ids[leaf]) {
            let place = u32x8::splat(id | SHAPE);
            let Rays { origin, direction, from, .. } = *rays;
            let rays = Approach { origin, direction, own: equal(from, place), limit: hits.distance };
            if ANY {
                let others = active & !equal(hits.place, place);
                if others.any() {
                    hidden = hidden | hittable.meet::<true>(&rays).1 & others;
                }
                continue;
            }
            let (distance, hit) = hittable.meet::<false>(&rays);
            let hit = hit & active;
            hits.distance = select(hit, distance, hits.distance);
            hits.place = pick(hit, place, hits.place);
        }
        hidden
    }
}

impl Placed for Hittables {
    #[inline]
    fn meeting(&self, leaf: &Range<usize>, _region: &Region) -> u32 {
        // shapes are few: the caller tests each
        (1 << leaf.len()) - 1
    }
}
