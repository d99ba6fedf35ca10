//! Intersection with spheres and emitters.

use super::build::Costs;
use super::double_precision::{NEAR, to_sphere, wide as exact};
use super::node::BuildError;
use super::rays::{Hits, Rays, SHAPE};
use super::region::{Placed, Region};
use super::tree::{Primitives, Tree};
use crate::geometry::Geometry;
use crate::packet::{M8, V8, X8, each_bit, equal, max, pick, select};
use etendue::{Mask, Real, Vec3, u32x8};
use std::ops::Range;

/// A packet tests one shape after another, each in about the time of a node.
const COSTS: Costs = Costs { most: 4, leaf: 0.0, primitive: 1.0 };

/// A shape, prepared for intersection.
#[derive(Clone, Copy, Debug)]
enum Solid {
    Sphere {
        center: [f32; 3],
        radius: f32,
    },
    /// A triangle or parallelogram p + s·u + t·v, where s and t are dot products with the dual vectors.
    Flat {
        p: [f32; 3],
        normal: [f32; 3],
        /// The unit normal in double precision.
        exact: V64,
        dual: [[f32; 3]; 2],
        triangle: bool,
        /// Hits that are nearer to the origin of a ray are computed in double precision.
        near: f32,
    },
}

#[derive(Debug)]
pub(super) struct Solids {
    solids: Vec<Solid>,
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

type V64 = Vec3<f64>;

fn wide(v: [f32; 3]) -> V64 {
    v.map(f64::from).into()
}

fn narrow(v: V64) -> [f32; 3] {
    [v.x as f32, v.y as f32, v.z as f32]
}

fn flat(p: [f32; 3], u: V64, v: V64, triangle: bool) -> Solid {
    let normal = u.cross(v);
    let inverse = 1.0 / normal.length_squared();
    let dual = [v.cross(normal) * inverse, normal.cross(u) * inverse].map(narrow);
    let exact = normal.normalize();
    let near = (u.length().max(v.length()).max((u - v).length()) * NEAR) as f32;
    Solid::Flat { p, normal: narrow(exact), exact, dual, triangle, near }
}

fn solid(geometry: &Geometry) -> Solid {
    match *geometry {
        Geometry::Sphere { center, radius } => Solid::Sphere { center, radius },
        Geometry::Triangle([a, b, c]) => flat(a, wide(b) - wide(a), wide(c) - wide(a), true),
        Geometry::Parallelogram { p, u, v } => flat(p, wide(u), wide(v), false),
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
            |_, ids, _| Solids { solids: ids.iter().map(|&i| solid(shapes[i as usize])).collect(), ids },
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

/// Distances at which the rays hit the solid, and the lanes where these are positive and less than the limit. The solid is at `place`. With
/// `ANY`, hits near the limit are decided in double precision, too.
#[inline]
fn intersect<const ANY: bool>(solid: &Solid, rays: &Rays, limit: X8, place: u32x8) -> (X8, M8) {
    let (zero, one) = (X8::lit(0.0), X8::lit(1.0));
    let own = equal(rays.from, place);
    let near_limit = |distance: X8, near: f32| {
        let unclear = (distance - limit).abs().lt(X8::splat(near / 4096.0));
        if ANY { unclear } else { M8::splat(false) }
    };
    match solid {
        Solid::Sphere { center, radius } => {
            // uses the foot of the perpendicular instead of |c − o|², which keeps the edges of distant spheres accurate
            let to_center = V8::from(*center) - rays.origin;
            let along = to_center.dot(rays.direction);
            let foot = rays.direction.mul_add(-along, to_center);
            let r = X8::splat(*radius);
            let square = r.mul_add(r, -foot.length_squared());
            let half = max(square, zero).sqrt();
            let near = along - half;
            let mut distance = select(near.gt(zero), near, along + half);
            let mut met = square.ge(zero) & distance.gt(zero);
            let size = *radius * NEAR as f32;
            let close = |distance: X8| distance.abs().lt(X8::splat(size));
            let unclear = square.ge(zero) & (own | close(near) | close(along + half) | near_limit(distance, size));
            if unclear.any() {
                each_bit(unclear.bits(), |lane| {
                    let (o, d) = (exact(rays.origin.lane(lane)), exact(rays.direction.lane(lane)));
                    let found = to_sphere(wide(*center), f64::from(*radius), o, d, own.lane(lane));
                    distance.as_mut_array()[lane] = found.map_or(-1.0, |distance| distance as f32);
                });
                met = met & !unclear | unclear & distance.gt(zero);
            }
            (distance, met & distance.lt(limit))
        }
        Solid::Flat { p, normal, exact: plane, dual, triangle, near } => {
            let to_corner = V8::from(*p) - rays.origin;
            let normal = V8::from(*normal);
            let slope = rays.direction.dot(normal);
            let some = slope.abs().gt(zero);
            let mut distance = to_corner.dot(normal) / select(some, slope, one);
            let point = rays.direction.mul_add(distance, -to_corner);
            let (s, t) = (point.dot(dual[0].into()), point.dot(dual[1].into()));
            let far_side = if *triangle { (s + t).le(one) } else { s.le(one) & t.le(one) };
            let inside = some & s.ge(zero) & t.ge(zero) & far_side & !own;
            let unclear = inside & (distance.abs().lt(X8::splat(*near)) | near_limit(distance, *near));
            if unclear.any() {
                each_bit(unclear.bits(), |lane| {
                    let (o, d) = (exact(rays.origin.lane(lane)), exact(rays.direction.lane(lane)));
                    let found = plane.dot(wide(*p) - o) / plane.dot(d);
                    distance.as_mut_array()[lane] = if found.is_finite() { found as f32 } else { -1.0 };
                });
            }
            (distance, inside & distance.gt(zero) & distance.lt(limit))
        }
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
            if ANY {
                let others = active & !equal(hits.place, place);
                if others.any() {
                    hidden = hidden | intersect::<true>(solid, rays, hits.distance, place).1 & others;
                }
                continue;
            }
            let (distance, hit) = intersect::<false>(solid, rays, hits.distance, place);
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
