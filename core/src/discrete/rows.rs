//! Distribution functions among others, with another place in each lane.

use super::cell::Cell;
use crate::real::{Real, Uint, unit_interval};

/// A distribution function in a slice of several.
#[derive(Clone, Copy)]
pub(super) struct Row<'a, U> {
    pub(super) cdfs: &'a [f32],
    /// Index of its first number.
    pub(super) first: U,
    /// Number of cells, between 1 and 2²⁴.
    pub(super) count: u32,
}

impl<U: Uint> Row<'_, U> {
    /// Start and width of a cell; both are 0 past the end of the slice.
    #[inline(always)]
    fn bounds<R: Real<Uint = U>>(&self, index: U) -> (R, R) {
        let ends = |lane: usize| {
            let index = index.lane(lane) as usize;
            let at = (self.first.lane(lane) as usize).wrapping_add(index);
            // one test of the length serves both
            match self.cdfs.get(at) {
                Some(&end) => [if index > 0 { self.cdfs[at - 1] } else { 0.0 }, end],
                None => [0.0; 2],
            }
        };
        let [start, end] = [0, 1].map(|k| R::from_fn(|lane| R::Scalar::lit(f64::from(ends(lane)[k]))));
        (start, end - start)
    }
    /// Draws the cell for `u`: the first that ends above it, or the last one, which has a width, since the one before it ends at or below `u`.
    #[inline(always)]
    pub(super) fn cell<R: Real<Uint = U>>(&self, u: R) -> Cell<R> {
        let u = unit_interval(u);
        let index = U::from_fn(|lane| {
            let (first, others, u) = (self.first.lane(lane) as usize, self.count.wrapping_sub(1), u.lane_f64(lane));
            let ends = self.cdfs.get(first..first.wrapping_add(others as usize)).unwrap_or_default();
            ends.partition_point(|&end| f64::from(end) <= u) as u32
        });
        let (start, pmf): (R, R) = self.bounds(index);
        let some = pmf.gt(R::lit(0.0));
        let offset = unit_interval((u - start) / R::blend(some, pmf, R::lit(1.0)));
        Cell { index, offset, pmf }
    }
    /// Probability of a cell; 0 past the last one.
    #[inline(always)]
    pub(super) fn pmf<R: Real<Uint = U>>(&self, index: U) -> R {
        self.bounds::<R>(index).1.keep(R::has_bits(index.lt(U::splat(self.count))))
    }
    /// Returns the `u` that `cell` maps to a position in a cell.
    #[inline(always)]
    pub(super) fn invert_cell<R: Real<Uint = U>>(&self, index: U, offset: R) -> R {
        let (start, width) = self.bounds::<R>(index);
        unit_interval(offset.mul_add(width, start)).keep(R::has_bits(index.lt(U::splat(self.count))))
    }
}
