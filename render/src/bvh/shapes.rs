//! Intersection with spheres and emitters.

use super::build::Costs;
use super::node::{Bounds, BuildError};
use super::primitive::{PrimitiveId, PrimitiveIds};
use super::rays::{Hits, Rays};
use super::region::{Placed, Region};
use super::tree::{Primitives, Tree};
use crate::geometry::{AnyHittable, Approach, Geometry, Hittable, Meeting, NEAR_LIMIT, Segment};
use crate::packet::{M8, X8};
use etendue::{Mask, Real};
use std::ops::Range;
use std::sync::Arc;

/// A packet tests one shape after another, each in about the time of a node.
const COSTS: Costs = Costs { most: 4, leaf: 0.0, primitive: 1.0 };

/// Of more shapes, it is not asked how far apart they are.
const MOST_APART: usize = 1024;

/// From which sides of a shape light comes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LitSides {
    /// It is no light.
    Neither,
    /// From that of its normal.
    Front,
    /// From both.
    Both,
    /// It shines, but no ray meets it.
    Unseen,
}

#[derive(Debug)]
pub(super) struct Hittables {
    hittables: Vec<AnyHittable>,
    ids: Vec<u32>,
    /// For each shape of the list, its index in leaf order; `None` for one that no ray meets.
    indices: Vec<Option<u32>>,
    /// In leaf order.
    lit: Vec<LitSides>,
    reached: Reached,
}

/// What segments may end on, by the index in the scene's list: it tells their ends in double precision.
#[derive(Clone, Debug, Default)]
pub(super) struct Reached(Arc<[AnyHittable]>);

impl Reached {
    /// The segment with its end on a primitive.
    pub(super) fn by(&self, primitive: PrimitiveId, segment: Segment) -> Segment {
        let solid = primitive.shape().and_then(|shape| self.0.get(shape));
        solid.map_or(segment, |solid| solid.reached_by(segment))
    }
}

/// All shapes of a scene. Ids are indices into the scene's list.
#[derive(Debug)]
pub struct ShapeSet {
    tree: Tree<Hittables>,
    reach: f32,
    /// The least greatest coordinate of a shape.
    least: f32,
    gap: f32,
}

impl Hittables {
    /// The index of each shape in the scene's list, in leaf order.
    pub(super) fn ids(&self) -> &[u32] {
        &self.ids
    }
    /// Lanes in which rays that meet the shape of this index in leaf order, at these distances, meet a side from which light comes.
    fn is_lit(&self, index: usize, rays: Approach<'_>, distance: X8) -> M8 {
        match self.lit[index] {
            LitSides::Neither | LitSides::Unseen => M8::splat(false),
            LitSides::Front => self.hittables[index].fronts([rays.origin, rays.direction], distance),
            LitSides::Both => M8::splat(true),
        }
    }
    /// Lanes in which the shape of this index in leaf order comes before these, with which it is level: what shines towards the
    /// ray comes first, then what is first in the scene's list.
    #[cold]
    #[inline(never)]
    fn comes_first(&self, index: usize, rays: Approach<'_>, lanes: M8, level: PrimitiveIds) -> M8 {
        let (own, id) =
            (self.is_lit(index, rays, rays.limit), PrimitiveIds::splat(PrimitiveId::of_shape(self.ids[index])));
        let (mut others, mut seen) = (M8::splat(false), M8::splat(false));
        level.each(lanes, |primitive, here| {
            if let Some(other) = primitive.shape().and_then(|shape| self.indices[shape]) {
                seen = seen | here;
                others = others | here & self.is_lit(other as usize, rays, rays.limit);
            }
        });
        // nothing is before a light that is no surface
        seen & (own & !others | !(own ^ others) & id.before(level))
    }
}

impl ShapeSet {
    /// No shapes.
    #[must_use]
    pub fn none() -> Self {
        Self::new(std::iter::empty()).unwrap_or_else(|_| unreachable!("none are few"))
    }
    /// Prepares all shapes of a scene, in their order.
    ///
    /// # Errors
    /// Fails if there are more than 2³¹ − 1 shapes.
    pub fn new<'a>(shapes: impl Iterator<Item = (&'a Geometry, LitSides)>) -> Result<Self, BuildError> {
        let all: Vec<_> = shapes.collect();
        let (own, shapes): (Vec<u32>, Vec<_>) =
            (0..).zip(&all).filter(|(_, (_, lit))| *lit != LitSides::Unseen).unzip();
        let boxes: Vec<_> = shapes.iter().map(|(shape, _)| shape.bounds()).collect();
        let farthest = |bounds: &Bounds| bounds.iter().flatten().fold(0.0_f32, |m, x| m.max(x.abs()));
        let reach = boxes.iter().map(farthest).fold(0.0, f32::max);
        let least = boxes.iter().map(farthest).fold(f32::INFINITY, f32::min);
        let gap = gap_between(&boxes);
        let tree = Tree::build(
            boxes,
            COSTS,
            |_| (),
            |_, order, _| {
                let ids: Vec<u32> = order.iter().map(|&i| own[i as usize]).collect();
                let mut indices = vec![None; all.len()];
                (0..).zip(&ids).for_each(|(index, &id)| indices[id as usize] = Some(index));
                let hittables = ids.iter().map(|&id| all[id as usize].0.hittable()).collect();
                let reached = Reached(all.iter().map(|(shape, _)| shape.hittable()).collect());
                Hittables { hittables, indices, lit: ids.iter().map(|&id| all[id as usize].1).collect(), ids, reached }
            },
        )?;
        Ok(Self { tree, reach, least, gap })
    }
    /// Greatest magnitude of a coordinate.
    pub fn reach(&self) -> f32 {
        self.reach
    }
    /// The least of the greatest magnitudes of the coordinates of each shape; infinite if there are none.
    pub(super) fn least(&self) -> f32 {
        self.least
    }
    /// No two shapes are nearer to each other along all axes; infinite if there is one.
    pub(super) fn gap(&self) -> f32 {
        self.gap
    }
    pub(super) fn tree(&self) -> &Tree<Hittables> {
        &self.tree
    }
    /// What segments may end on.
    pub(super) fn reached(&self) -> &Reached {
        &self.tree.primitives().reached
    }
}

/// The least distance between two boxes, along the axis on which they are farthest apart; 0 if there are too many to tell.
fn gap_between(boxes: &[Bounds]) -> f32 {
    if boxes.len() > MOST_APART {
        return 0.0;
    }
    let between = |[a, b]: &Bounds, [c, d]: &Bounds| {
        (0..3).map(|k| (c[k] - b[k]).max(a[k] - d[k])).fold(f32::NEG_INFINITY, f32::max)
    };
    let pairs = boxes.iter().enumerate().flat_map(|(i, a)| boxes[..i].iter().map(move |b| between(a, b)));
    pairs.fold(f32::INFINITY, f32::min)
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
        for index in leaf {
            let (hittable, id) = (&self.hittables[index], PrimitiveIds::splat(PrimitiveId::of_shape(self.ids[index])));
            let Rays { origin, direction, from, .. } = *rays;
            let own = from.equal(id);
            let lanes = if ANY { active & !hits.primitives.equal(id) } else { active };
            let ends = &hits.primitives;
            let reaching = |lane: usize, segment| self.reached.by(ends.lane(lane), segment);
            let mut rays = Approach { origin, direction, lanes, own, limit: hits.distance, reaching: &reaching };
            if ANY {
                if lanes.any() {
                    let Meeting { hit, level, .. } = hittable.meet::<true>(&rays);
                    hidden = hidden | hit & lanes;
                    if level.any() {
                        let level = level & lanes & hits.any();
                        hidden = hidden | self.comes_first(index, rays, level, hits.primitives);
                    }
                }
                continue;
            }
            // with what is about as near, until more is known
            rays.limit = hits.distance * X8::lit(1.0 + NEAR_LIMIT);
            let Meeting { distance, hit, .. } = hittable.meet::<false>(&rays);
            let mut hit = hit & active;
            if !hit.any() {
                continue;
            }
            let level = hit & hits.any() & distance.gt(hits.distance * X8::lit(1.0 - NEAR_LIMIT));
            hit = hit & (distance.lt(hits.distance) | level);
            if level.any() {
                rays.limit = hits.distance;
                let near = hittable.meet::<true>(&rays);
                let first = self.comes_first(index, rays, near.level & level, hits.primitives);
                hit = hit & !level | level & (near.hit | first);
            }
            hits.distance = Real::blend(hit, distance, hits.distance);
            hits.primitives = PrimitiveIds::pick(hit, id, hits.primitives);
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
