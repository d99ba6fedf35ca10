//! What rays hit, by number.

use crate::packet::{M8, X8, below, each_group, equal, pick};
use etendue::u32x8;

/// Marks a shape instead of a mesh triangle.
const SHAPE: u32 = 1 << 31;

/// A primitive: a mesh triangle, by its place in the order of leaves, or a shape, by its index in the scene's list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PrimitiveId(pub(super) u32);

impl Default for PrimitiveId {
    fn default() -> Self {
        Self::NONE
    }
}

impl PrimitiveId {
    /// No primitive: that of a miss, and of rays that begin or end on none.
    pub const NONE: Self = Self(u32::MAX);
    /// The mesh triangle at this place in the order of leaves, less than 2³¹; those of instances follow the others.
    #[must_use]
    pub const fn of_triangle(place: u32) -> Self {
        Self(place)
    }
    /// The shape of this index, less than 2³¹ − 1.
    #[must_use]
    pub const fn of_shape(index: u32) -> Self {
        Self(index | SHAPE)
    }
    /// A number that has its bits.
    pub(crate) const fn to_float(self) -> f32 {
        f32::from_bits(self.0)
    }
    /// The place of a mesh triangle in the order of leaves.
    #[must_use]
    pub const fn triangle(self) -> Option<u32> {
        if self.0 & SHAPE == 0 { Some(self.0) } else { None }
    }
    /// The index of a shape. That of [`NONE`](Self::NONE) is beyond all shapes.
    #[must_use]
    pub const fn shape(self) -> Option<usize> {
        if self.0 & SHAPE == 0 { None } else { Some((self.0 & !SHAPE) as usize) }
    }
}

/// A primitive in each of eight lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrimitiveIds(pub(super) u32x8);

impl PrimitiveIds {
    /// The same in all lanes.
    #[inline(always)]
    #[must_use]
    pub fn splat(id: PrimitiveId) -> Self {
        Self(u32x8::splat(id.0))
    }
    /// No primitive in any lane.
    #[inline(always)]
    #[must_use]
    pub fn none() -> Self {
        Self::splat(PrimitiveId::NONE)
    }
    /// From the bits of numbers, which keep those of [`PrimitiveId::to_float`].
    #[inline(always)]
    pub(crate) fn from_floats(floats: X8) -> Self {
        Self(floats.to_bits())
    }
    /// The primitive in a lane from 0 to 7.
    #[inline(always)]
    #[must_use]
    pub fn lane(&self, lane: usize) -> PrimitiveId {
        PrimitiveId(self.0.as_array()[lane])
    }
    #[inline(always)]
    pub(super) fn set(&mut self, lane: usize, id: PrimitiveId) {
        self.0.as_mut_array()[lane] = id.0;
    }
    /// Lanes in which both are the same, or none.
    #[inline(always)]
    #[must_use]
    pub fn equal(self, other: Self) -> M8 {
        equal(self.0, other.0)
    }
    /// Lanes that have this one.
    #[inline(always)]
    #[must_use]
    pub fn are(self, id: PrimitiveId) -> M8 {
        self.equal(Self::splat(id))
    }
    /// Lanes that have one.
    #[inline(always)]
    #[must_use]
    pub fn some(self) -> M8 {
        !self.are(PrimitiveId::NONE)
    }
    /// Lanes of shapes.
    #[inline(always)]
    #[must_use]
    pub fn shapes(self) -> M8 {
        self.some() & !below(self.0, u32x8::splat(SHAPE))
    }
    /// Lanes in which these come before others: triangles in the order of leaves, then shapes in that of the scene.
    #[inline(always)]
    pub(super) fn before(self, others: Self) -> M8 {
        below(self.0, others.0)
    }
    /// `yes` where the mask is true, `no` elsewhere.
    #[inline(always)]
    #[must_use]
    pub fn pick(mask: M8, yes: Self, no: Self) -> Self {
        Self(pick(mask, yes.0, no.0))
    }
    /// Calls `f` with each primitive that some of these lanes have, and the lanes that share it.
    #[inline(always)]
    pub fn each(self, lanes: M8, mut f: impl FnMut(PrimitiveId, M8)) {
        each_group(self.0, lanes, |id, here| f(PrimitiveId(id), here));
    }
}
