//! Ray intersection in groups of up to 8 packets of 8: trees built by obvhs, traversed here.
//!
//! Guarantees: the tree never loses a hit that the test of a triangle would report (slabs are widened by more than the error of the
//! triangle test); neighbouring triangles leave no gap between them; zero components and −0 in directions are as good as others;
//! nothing depends on the unit of length. A hit is nearer than its limit, never at it; ties of equal distance go to the triangle of
//! lower index. So what a ray hits depends on neither its companions nor the way it takes through the tree, bit for bit.

/// Calls a function whose planes are in an order that depends on the octant of the rays alone.
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
mod packets;
mod parts;
mod shaft;
mod shape;
mod single;
mod stream;
mod together;
mod tree;
mod triangle;

pub use packets::Stack;
use packets::slabs;
use shaft::Shaft;
pub use shape::ShapeSet;
use single::Nearest;
pub use tree::BuildError;
use tree::{Primitives, Tree};

use etendue::{Frame, Mask, Real, Vec3, f32x8, u32x8};

/// Eight lanes.
pub type X8 = f32x8;
/// Eight points or directions.
pub type V8 = Vec3<f32x8>;
/// Truth in eight lanes.
pub type M8 = <f32x8 as Real>::Mask;

/// Marks an id as one of a shape (sphere, emitter) and not of a mesh triangle.
pub const SHAPE: u32 = 1 << 31;
/// Children of a node of a tree.
pub(crate) const WIDTH: usize = 8;
/// Packets that are traced together, at the most.
pub const GROUP: usize = 8;
/// The id where nothing was hit.
pub const NOTHING: u32 = u32::MAX;

/// Eight rays in the form in which they are traversed.
#[derive(Clone, Copy, Debug)]
pub struct Rays {
    /// Origins.
    pub origin: V8,
    /// Unit directions.
    pub direction: V8,
    /// Two unit vectors that complete the direction to a frame: a vertex is projected along the ray onto them.
    frame: [V8; 2],
    inverse: V8,
    /// −(origin ± pad)/direction, for the lower and the upper planes of boxes.
    offset: [V8; 2],
    /// Per axis: do all rays run towards +, all towards −, or neither?
    common_sign: Option<[bool; 3]>,
    /// By how much boxes are widened, at the most.
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
    /// Eight rays. `reach` is the greatest magnitude of a coordinate in the scene: slabs are widened in proportion to it.
    #[inline(always)]
    pub fn new(origin: V8, direction: V8, reach: f32) -> Self {
        let frame = Frame::new(direction);
        // a ray that is parallel to a plane to within 1e−18 of its length never reaches it
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

/// What eight rays hit first.
#[derive(Clone, Copy, Debug)]
pub struct Hits {
    /// Distance; the rays' limit where nothing was hit.
    pub distance: X8,
    /// Place of a triangle in the order of the leaves, or index of a shape with [`SHAPE`] set, or [`NOTHING`].
    pub place: u32x8,
    /// Barycentric coordinates of the second vertex of a triangle.
    pub b1: X8,
    /// Barycentric coordinates of the third vertex of a triangle.
    pub b2: X8,
}

impl Hits {
    /// Nothing hit up to `limit`.
    #[inline]
    pub fn none(limit: X8) -> Self {
        Self { distance: limit, place: u32x8::splat(NOTHING), b1: X8::lit(0.0), b2: X8::lit(0.0) }
    }
    /// True where something was hit.
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
    /// True where a shape was hit.
    #[inline]
    pub fn shapes(&self) -> M8 {
        self.any() & !below(self.place, u32x8::splat(SHAPE))
    }
}

/// `yes` where the mask is true, `no` elsewhere. (A free function, as are [`min`] and [`max`]: the packet type has methods of
/// these names that would be found first, with other arguments or with checks for NaN.)
#[inline]
pub fn select(mask: M8, yes: X8, no: X8) -> X8 {
    Real::blend(mask, yes, no)
}

/// The lesser; `b` where either is NaN.
#[inline]
pub fn min(a: X8, b: X8) -> X8 {
    Real::lesser(a, b)
}

/// The greater; `b` where either is NaN.
#[inline]
pub fn max(a: X8, b: X8) -> X8 {
    Real::greater(a, b)
}

/// `a == b` per lane.
#[inline]
pub fn equal(a: u32x8, b: u32x8) -> M8 {
    M8::from_bits(a.simd_eq(b).to_bitmask())
}

/// `a < b` per lane.
#[inline]
pub fn below(a: u32x8, b: u32x8) -> M8 {
    M8::from_bits(a.simd_lt(b).to_bitmask())
}

/// `yes` where the mask is true, `no` elsewhere.
#[inline]
pub fn pick(mask: M8, yes: u32x8, no: u32x8) -> u32x8 {
    select(mask, X8::from_bits(yes), X8::from_bits(no)).to_bits()
}

/// How groups of packets go through the tree of triangles. It makes no difference to what they hit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Way {
    /// As one where they have a narrow shaft in common, else as a stream.
    #[default]
    Choose,
    /// As a stream: each node is visited once, by the rays that enter it. Rays that are left alone go on one by one, or, where the rays of the
    /// group have no octant in common, a step of each in turn.
    Stream,
    /// Ray by ray.
    Single,
    /// Each leaf in turn, whatever else has been hit, without the tree above it: the oracle of the others.
    Exhaustive,
}

/// All that rays can meet: mesh triangles in a tree, and the shapes that are intersected as they are.
#[derive(Debug)]
pub struct Accel {
    triangles: Tree<triangle::Soup>,
    way: Way,
    /// Spheres and emitters.
    pub shapes: ShapeSet,
    reach: f32,
}

impl Accel {
    /// Builds over mesh triangles and shapes.
    ///
    /// # Errors
    /// More than 2³¹ − 1 triangles.
    pub fn new(triangles: &[[[f32; 3]; 3]], shapes: ShapeSet) -> Result<Self, BuildError> {
        // with room for what loads from the last leaf
        let mut own = Vec::with_capacity(triangles.len() + 1);
        own.extend_from_slice(triangles);
        Self::taking(own, shapes)
    }
    /// The same, in the memory of the triangles: it needs that of a few thousand of them besides what it holds in the end.
    ///
    /// # Errors
    /// More than 2³¹ − 1 triangles.
    pub fn taking(triangles: Vec<[[f32; 3]; 3]>, shapes: ShapeSet) -> Result<Self, BuildError> {
        let triangles = triangle::Soup::tree(triangles)?;
        let reach = triangles.reach().max(shapes.reach());
        Ok(Self { triangles, way: Way::default(), shapes, reach })
    }
    /// The same, but rays go through it in another way: to compare them.
    #[must_use]
    pub fn with_way(self, way: Way) -> Self {
        Self { way, ..self }
    }
    /// Rays for this scene.
    #[inline(always)]
    pub fn rays(&self, origin: V8, direction: V8) -> Rays {
        Rays::new(origin, direction, self.reach)
    }
    /// The nearest hits in the lanes of `active`, nearer than what `hits` holds, for a group of packets at once: best for
    /// packets that have much in common.
    ///
    /// All slices are of one length, up to [`GROUP`].
    #[inline]
    pub fn closest(&self, rays: &[Rays], active: &[M8], hits: &mut [Hits], stack: &mut Stack) {
        let shaft = self.shaft(rays, active);
        self.closest_of_shapes(rays, active, shaft.as_ref(), hits, stack);
        match (&shaft, self.way) {
            (Some(shaft), _) => self.triangles.closest(rays, active, Some(shaft), hits, stack),
            (None, Way::Single) => self.triangles.closest_one_by_one(rays, active, hits, stack),
            (None, Way::Exhaustive) => self.triangles.each_leaf(|leaf, node, slot| {
                for ((rays, &active), hits) in rays.iter().zip(active).zip(&mut *hits) {
                    let (near, entered) = slabs::<false>(node, slot, rays, [false; 3], X8::lit(f64::INFINITY));
                    self.triangles.primitives().closest(leaf.clone(), rays, near, active & entered, hits);
                }
            }),
            (None, _) => self.triangles.closest_stream(rays, active, hits, stack),
        }
    }
    /// The nearest hits of shapes alone.
    #[inline]
    pub fn closest_shape(&self, rays: &[Rays], active: &[M8], hits: &mut [Hits], stack: &mut Stack) {
        let shaft = self.shaft(rays, active);
        self.closest_of_shapes(rays, active, shaft.as_ref(), hits, stack);
    }
    /// Shapes are few: without a shaft packet by packet.
    #[inline]
    fn closest_of_shapes(
        &self,
        rays: &[Rays],
        active: &[M8],
        shaft: Option<&Shaft>,
        hits: &mut [Hits],
        stack: &mut Stack,
    ) {
        if shaft.is_some() {
            return self.shapes.tree().closest(rays, active, shaft, hits, stack);
        }
        for p in (0..rays.len()).filter(|&p| active[p].any()) {
            self.shapes.tree().closest(&rays[p..=p], &active[p..=p], None, &mut hits[p..=p], stack);
        }
    }
    /// Takes out of `active` the lanes in which something lies nearer than `limit`, other than shape `target`
    /// (an index without [`SHAPE`], or [`NOTHING`]).
    #[inline]
    pub fn occluded(&self, rays: &[Rays], active: &mut [M8], limit: &[X8], target: &[u32x8], stack: &mut Stack) {
        let shaft = self.shaft(rays, active);
        // the only shape does not hide itself
        let own = |(&a, &t): (&M8, &u32x8)| !(a & !equal(t, u32x8::splat(0))).any();
        let none = match self.shapes.tree().count() {
            0 => true,
            1 => active.iter().zip(target).all(own),
            _ => false,
        };
        if !none {
            self.occluded_by_shapes(rays, active, limit, target, shaft.as_ref(), stack);
            if !active.iter().any(|a| a.any()) {
                return;
            }
        }
        match (&shaft, self.way) {
            (Some(shaft), _) => self.triangles.occluded(rays, active, limit, target, Some(shaft), stack),
            (None, Way::Single) => self.triangles.occluded_one_by_one(rays, active, limit, stack),
            (None, Way::Exhaustive) => self.triangles.each_leaf(|leaf, node, slot| {
                for (p, active) in active.iter_mut().enumerate() {
                    let (near, entered) = slabs::<false>(node, slot, &rays[p], [false; 3], X8::lit(f64::INFINITY));
                    let (soup, lanes) = (self.triangles.primitives(), *active & entered);
                    *active = *active & !soup.occluded(leaf.clone(), &rays[p], near, lanes, limit[p], target[p]);
                }
            }),
            (None, _) => self.triangles.occluded_stream(rays, active, limit, stack),
        }
    }
    /// As [`Self::closest_of_shapes`].
    #[inline]
    fn occluded_by_shapes(
        &self,
        rays: &[Rays],
        active: &mut [M8],
        limit: &[X8],
        target: &[u32x8],
        shaft: Option<&Shaft>,
        stack: &mut Stack,
    ) {
        let shapes = self.shapes.tree();
        if shaft.is_some() {
            return shapes.occluded(rays, active, limit, target, shaft, stack);
        }
        for p in 0..rays.len() {
            if active[p].any() {
                shapes.occluded(&rays[p..=p], &mut active[p..=p], &limit[p..=p], &target[p..=p], None, stack);
            }
        }
    }
    /// A narrow shaft that the rays have in common.
    #[inline]
    fn shaft(&self, rays: &[Rays], active: &[M8]) -> Option<Shaft> {
        if self.way == Way::Choose { Shaft::new(rays, active) } else { None }
    }
    /// The corners of the mesh triangle at a place.
    #[inline]
    pub fn corners(&self, place: u32) -> [f32; 9] {
        self.triangles.primitives().corners(place)
    }
    /// For each place, the index of its triangle in the slice that the tree was built over.
    pub fn order(&self) -> &[u32] {
        self.triangles.primitives().ids()
    }
    /// Bytes held by tree and triangles.
    pub fn bytes(&self) -> usize {
        self.triangles.bytes()
    }
}
