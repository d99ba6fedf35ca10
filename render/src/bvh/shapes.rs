//! Intersection with spheres and emitters.

use super::build::Costs;
use super::node::BuildError;
use super::rays::{Hits, Rays, SHAPE};
use super::region::{Placed, Region};
use super::tree::{Primitives, Tree};
use crate::geometry::{AnySolid, Approach, Geometry, Solid};
use crate::packet::{M8, X8, equal, pick, select};
use etendue::{Mask, u32x8};
use std::ops::Range;

/// A packet tests one shape after another, each in about the time of a node.
const COSTS: Costs = Costs { most: 4, leaf: 0.0, primitive: 1.0 };

#[derive(Debug)]
pub(super) struct Solids {
    solids: Vec<AnySolid>,
    ids: Vec<u32>,
}

/// All shapes of a scene. Ids are indices into the scene's list; in hits, they have the bit [`SHAPE`] set.
#[derive(Debug)]
pub struct ShapeSet {
    tree: Tree<Solids>,
    reach: f32,
}

impl Solids {
    /// The index of each shape in the scene's list, in leaf order.
    pub(super) fn ids(&self) -> &[u32] {
        &self.ids
    }
}

impl ShapeSet {
    /// Prepares shapes, each with its index in the scene's list.
    ///
    /// # Errors
    /// Fails if there are more than 2³¹ − 1 shapes.
    pub fn new<'a>(shapes: impl Iterator<Item = (u32, &'a Geometry)>) -> Result<Self, BuildError> {
        let (indices, shapes): (Vec<u32>, Vec<&Geometry>) = shapes.unzip();
        let boxes: Vec<_> = shapes.iter().map(|shape| shape.bounds()).collect();
        let reach = boxes.iter().flatten().flatten().fold(0.0_f32, |m, x| m.max(x.abs()));
        let tree = Tree::build(
            boxes,
            COSTS,
            |_| (),
            |_, ids, _| Solids {
                solids: ids.iter().map(|&i| shapes[i as usize].solid()).collect(),
                ids: ids.iter().map(|&i| indices[i as usize]).collect(),
            },
        )?;
        Ok(Self { tree, reach })
    }
    /// Greatest magnitude of a coordinate.
    pub fn reach(&self) -> f32 {
        self.reach
    }
    pub(super) fn tree(&self) -> &Tree<Solids> {
        &self.tree
    }
}

impl Primitives for Solids {
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
        for (solid, &id) in self.solids[leaf.clone()].iter().zip(&self.ids[leaf]) {
            let place = u32x8::splat(id | SHAPE);
            let Rays { origin, direction, from, .. } = *rays;
            let rays = Approach { origin, direction, own: equal(from, place), limit: hits.distance };
            if ANY {
                let others = active & !equal(hits.place, place);
                if others.any() {
                    hidden = hidden | solid.meet::<true>(&rays).1 & others;
                }
                continue;
            }
            let (distance, hit) = solid.meet::<false>(&rays);
            let hit = hit & active;
            hits.distance = select(hit, distance, hits.distance);
            hits.place = pick(hit, place, hits.place);
        }
        hidden
    }
}

impl Placed for Solids {
    #[inline]
    fn meeting(&self, leaf: &Range<usize>, _region: &Region) -> u32 {
        // shapes are few: the caller tests each
        (1 << leaf.len()) - 1
    }
}
