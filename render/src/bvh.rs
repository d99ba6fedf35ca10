//! Ray intersection in groups of up to 8 packets of 8 rays, over trees that obvhs builds.
//!
//! Guarantees: traversal never loses a hit that the triangle test would report, since slabs are widened by more than the error of
//! that test. There are no gaps between adjacent triangles. Directions may have components 0 and −0. Nothing depends on the unit of
//! length. A hit is strictly nearer than its limit, and of two hits at equal distance the triangle of lower index wins. What a ray
//! hits therefore depends neither on the other rays of its group nor on the traversal, bit for bit.

/// Calls a function that is specialised to the octant of the rays, or to `other` if there is none.
macro_rules! by_octant {
    ($octant:expr, else $other:literal, $this:ident.$function:ident $arguments:tt) => {
        match $octant {
            0 => $this.$function::<0> $arguments,
            1 => $this.$function::<1> $arguments,
            2 => $this.$function::<2> $arguments,
            3 => $this.$function::<3> $arguments,
            4 => $this.$function::<4> $arguments,
            5 => $this.$function::<5> $arguments,
            6 => $this.$function::<6> $arguments,
            7 => $this.$function::<7> $arguments,
            _ => $this.$function::<$other> $arguments,
        }
    };
}

mod build;
mod frustum;
mod interleaved;
mod packets;
mod parallel_build;
mod shapes;
mod single_ray;
mod stream;
mod tree;
mod triangles;

use frustum::Frustum;
pub use packets::Scratch;
use packets::slabs;
pub use shapes::ShapeSet;
use single_ray::Nearest;
pub use tree::BuildError;
use tree::{Primitives, Tree};

use crate::packet::{M8, V8, X8, below, equal, max};
use etendue::{Frame, Mask, Real, Vec3, u32x8};

/// Bit of an id that marks a shape (sphere, emitter) instead of a mesh triangle.
pub const SHAPE: u32 = 1 << 31;
/// Greatest number of children of a node.
pub(crate) const WIDTH: usize = 8;
/// Greatest number of packets in a group.
pub const GROUP: usize = 8;
/// The id of a miss.
pub const NOTHING: u32 = u32::MAX;

/// Eight rays, prepared for traversal.
#[derive(Clone, Copy, Debug)]
pub struct Rays {
    /// Origins.
    pub origin: V8,
    /// Unit directions.
    pub direction: V8,
    /// Two unit vectors that complete the direction to a frame; vertices are projected onto them along the ray.
    frame: [V8; 2],
    inverse: V8,
    /// −(origin ± pad)/direction, for the lower and the upper planes of boxes.
    offset: [V8; 2],
    /// Whether the rays run towards − along each axis; `None` if they disagree along one.
    common_sign: Option<[bool; 3]>,
    /// Greatest distance by which boxes are widened.
    pad: f32,
}

impl Default for Rays {
    fn default() -> Self {
        let zero = V8::default();
        Self {
            origin: zero,
            direction: zero,
            frame: [zero; 2],
            inverse: zero,
            offset: [zero; 2],
            common_sign: None,
            pad: 0.0,
        }
    }
}

impl Rays {
    /// Prepares eight rays. `reach` is the greatest magnitude of a coordinate in the scene; slabs are widened in proportion to it.
    #[inline(always)]
    pub fn new(origin: V8, direction: V8, reach: f32) -> Self {
        let frame = Frame::new(direction);
        // components below 1e−18 count as 1e−18, with which a ray never reaches the planes across that axis
        let invert = |d: X8| X8::lit(1.0) / max(d.abs(), X8::lit(1e-18)).copysign(d);
        let inverse = Vec3::new(invert(direction.x), invert(direction.y), invert(direction.z));
        // 2⁻²⁰ of the largest coordinate involved: 16 times the rounding of a vertex relative to the origin
        let pad = (origin.max_abs() + X8::splat(reach)) * X8::lit(1.0 / 1_048_576.0);
        let plane = |o: V8, pad: X8| {
            Vec3::new(-((o.x + pad) * inverse.x), -((o.y + pad) * inverse.y), -((o.z + pad) * inverse.z))
        };
        let negative =
            [direction.x, direction.y, direction.z].map(|d| X8::lit(1.0).copysign(d).lt(X8::lit(0.0)).bits());
        let common = negative.iter().all(|&bits| bits == 0 || bits == 0xff);
        Self {
            origin,
            direction,
            frame: [frame.s, frame.t],
            inverse,
            offset: [plane(origin, pad), plane(origin, -pad)],
            common_sign: common.then(|| negative.map(|bits| bits != 0)),
            pad: pad.to_array().into_iter().fold(0.0, f32::max),
        }
    }
}

/// The nearest hits of eight rays.
#[derive(Clone, Copy, Debug)]
pub struct Hits {
    /// Distances; the rays' limits for misses.
    pub distance: X8,
    /// Index of a triangle in leaf order, index of a shape with the bit [`SHAPE`] set, or [`NOTHING`].
    pub place: u32x8,
    /// Barycentric coordinates of the triangles' second vertices.
    pub b1: X8,
    /// Barycentric coordinates of the triangles' third vertices.
    pub b2: X8,
}

impl Hits {
    /// Misses, with hits to be searched nearer than `limit`.
    #[inline]
    pub fn none(limit: X8) -> Self {
        Self { distance: limit, place: u32x8::splat(NOTHING), b1: X8::lit(0.0), b2: X8::lit(0.0) }
    }
    /// Lanes that hit something.
    #[inline]
    pub fn any(&self) -> M8 {
        !equal(self.place, u32x8::splat(NOTHING))
    }
    #[inline]
    fn nearest(&self, lane: usize) -> Nearest {
        Nearest {
            distance: self.distance.as_array()[lane],
            place: self.place.as_array()[lane],
            b1: self.b1.as_array()[lane],
            b2: self.b2.as_array()[lane],
        }
    }
    #[inline]
    fn put(&mut self, lane: usize, nearest: &Nearest) {
        self.distance.as_mut_array()[lane] = nearest.distance;
        self.place.as_mut_array()[lane] = nearest.place;
        self.b1.as_mut_array()[lane] = nearest.b1;
        self.b2.as_mut_array()[lane] = nearest.b2;
    }
    /// Lanes that hit a shape.
    #[inline]
    pub fn shapes(&self) -> M8 {
        self.any() & !below(self.place, u32x8::splat(SHAPE))
    }
}

/// How groups of packets traverse the tree of triangles. The hits do not depend on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Traversal {
    /// As one frustum if the group fits into a narrow one, otherwise as a stream.
    #[default]
    Choose,
    /// As a stream: the group visits each node once, with the rays that enter it. Below 5 active rays, each finishes alone; in
    /// groups of mixed octants, these rays are interleaved.
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
    way: Traversal,
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
        Ok(Self { triangles, way: Traversal::default(), shapes, reach })
    }
    /// The same scene with another traversal, for comparisons.
    #[must_use]
    pub fn with_traversal(self, way: Traversal) -> Self {
        Self { way, ..self }
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
        let frustum = self.frustum(rays, active);
        self.closest_of_shapes(rays, active, frustum.as_ref(), hits, scratch);
        match (&frustum, self.way) {
            (Some(frustum), _) => self.triangles.closest(rays, active, Some(frustum), hits, scratch),
            (None, Traversal::Single) => self.triangles.closest_one_by_one(rays, active, hits, scratch),
            (None, Traversal::Exhaustive) => self.triangles.each_leaf(|leaf, node, slot| {
                for ((rays, &active), hits) in rays.iter().zip(active).zip(&mut *hits) {
                    let (near, entered) = slabs::<false>(node, slot, rays, [false; 3], X8::lit(f64::INFINITY));
                    self.triangles.primitives().closest(leaf.clone(), rays, near, active & entered, hits);
                }
            }),
            (None, _) => self.triangles.closest_stream(rays, active, hits, scratch),
        }
    }
    /// Like [`Bvh::closest`], for shapes only.
    #[inline]
    pub fn closest_shape(&self, rays: &[Rays], active: &[M8], hits: &mut [Hits], scratch: &mut Scratch) {
        let frustum = self.frustum(rays, active);
        self.closest_of_shapes(rays, active, frustum.as_ref(), hits, scratch);
    }
    /// Nearest hits of shapes, packet by packet if there is no frustum, as shapes are few.
    #[inline]
    fn closest_of_shapes(
        &self,
        rays: &[Rays],
        active: &[M8],
        frustum: Option<&Frustum>,
        hits: &mut [Hits],
        scratch: &mut Scratch,
    ) {
        if frustum.is_some() {
            return self.shapes.tree().closest(rays, active, frustum, hits, scratch);
        }
        for p in (0..rays.len()).filter(|&p| active[p].any()) {
            self.shapes.tree().closest(&rays[p..=p], &active[p..=p], None, &mut hits[p..=p], scratch);
        }
    }
    /// Clears the lanes of `active` that are occluded by something nearer than `limit`, other than the shape `target` (an index
    /// without [`SHAPE`], or [`NOTHING`]).
    #[inline]
    pub fn occluded(&self, rays: &[Rays], active: &mut [M8], limit: &[X8], target: &[u32x8], scratch: &mut Scratch) {
        let frustum = self.frustum(rays, active);
        // a single shape does not occlude itself
        let own = |(&a, &t): (&M8, &u32x8)| !(a & !equal(t, u32x8::splat(0))).any();
        let none = match self.shapes.tree().count() {
            0 => true,
            1 => active.iter().zip(target).all(own),
            _ => false,
        };
        if !none {
            self.occluded_by_shapes(rays, active, limit, target, frustum.as_ref(), scratch);
            if !active.iter().any(|a| a.any()) {
                return;
            }
        }
        match (&frustum, self.way) {
            (Some(frustum), _) => self.triangles.occluded(rays, active, limit, target, Some(frustum), scratch),
            (None, Traversal::Single) => self.triangles.occluded_one_by_one(rays, active, limit, scratch),
            (None, Traversal::Exhaustive) => self.triangles.each_leaf(|leaf, node, slot| {
                for (p, active) in active.iter_mut().enumerate() {
                    let (near, entered) = slabs::<false>(node, slot, &rays[p], [false; 3], X8::lit(f64::INFINITY));
                    let (soup, lanes) = (self.triangles.primitives(), *active & entered);
                    *active = *active & !soup.occluded(leaf.clone(), &rays[p], near, lanes, limit[p], target[p]);
                }
            }),
            (None, _) => self.triangles.occluded_stream(rays, active, limit, scratch),
        }
    }
    /// Occlusion by shapes, like [`Self::closest_of_shapes`].
    #[inline]
    fn occluded_by_shapes(
        &self,
        rays: &[Rays],
        active: &mut [M8],
        limit: &[X8],
        target: &[u32x8],
        frustum: Option<&Frustum>,
        scratch: &mut Scratch,
    ) {
        let shapes = self.shapes.tree();
        if frustum.is_some() {
            return shapes.occluded(rays, active, limit, target, frustum, scratch);
        }
        for p in 0..rays.len() {
            if active[p].any() {
                shapes.occluded(&rays[p..=p], &mut active[p..=p], &limit[p..=p], &target[p..=p], None, scratch);
            }
        }
    }
    /// The narrow frustum of the group, if there is one and the traversal may use it.
    #[inline]
    fn frustum(&self, rays: &[Rays], active: &[M8]) -> Option<Frustum> {
        if self.way == Traversal::Choose { Frustum::new(rays, active) } else { None }
    }
    /// The corners of the mesh triangle at a place.
    #[inline]
    pub fn corners(&self, place: u32) -> [f32; 9] {
        self.triangles.primitives().corners(place)
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
