//! Tables as words in memory.

use super::cell::{Cell, Cell2d};
use crate::memory::Memory;
use crate::real::{Real, Uint, unit_interval};
use crate::vector::Vec2;

/// A [`PiecewiseConstant1d`](crate::discrete::PiecewiseConstant1d) as words in [memory](crate::memory): what is read where number types write
/// sources. Of single precision, cells have the bits of the table.
#[derive(Clone, Copy, Debug)]
pub struct Words1d<M, U> {
    /// The memory.
    pub memory: M,
    /// Index of the first word of the distribution function.
    pub first: U,
    /// Number of cells, between 1 and 2²⁴.
    pub count: U,
}

impl<M, U: Uint> Words1d<M, U> {
    /// Start and width of a cell.
    #[inline(always)]
    fn bounds<R: Real<Uint = U>>(&self, index: U) -> (R, R)
    where
        M: Memory<R>,
    {
        let (start, end) = self.memory.pair(self.first, index);
        (start, end - start)
    }
    /// Draws the cell for `u`: the first that ends above it, or the last one, which has a width, since the one before it ends at or below `u`.
    #[inline(always)]
    pub fn cell<R: Real<Uint = U>>(&self, u: R) -> Cell<R>
    where
        M: Memory<R>,
    {
        let u = unit_interval(u);
        let index = self.memory.count_up_to(self.first, self.count, u);
        let (start, pmf) = self.bounds(index);
        let some = pmf.gt(R::lit(0.0));
        let offset = unit_interval((u - start) / R::blend(some, pmf, R::lit(1.0)));
        Cell { index, offset, pmf }
    }
    /// Probability of a cell; 0 past the last one.
    #[inline(always)]
    pub fn pmf<R: Real<Uint = U>>(&self, index: U) -> R
    where
        M: Memory<R>,
    {
        self.bounds::<R>(index).1.keep(R::has_bits(index.lt(self.count)))
    }
    /// Returns the `u` that `cell` maps to a position in a cell.
    #[inline(always)]
    pub fn invert_cell<R: Real<Uint = U>>(&self, index: U, offset: R) -> R
    where
        M: Memory<R>,
    {
        let (start, width) = self.bounds::<R>(index);
        unit_interval(offset.mul_add(width, start)).keep(R::has_bits(index.lt(self.count)))
    }
}

/// A [`PiecewiseConstant2d`](crate::discrete::PiecewiseConstant2d) as words in [memory](crate::memory): what is read where number types write
/// sources. Of single precision, cells have the bits of the table.
#[derive(Clone, Copy, Debug)]
pub struct Words2d<M, U> {
    /// The memory.
    pub memory: M,
    /// Index of the first word of the buffer that the table was built in.
    pub first: U,
    /// Width and height in cells, between 1 and 2²⁴.
    pub size: [U; 2],
}

impl<M: Copy, U: Uint> Words2d<M, U> {
    #[inline(always)]
    fn row(&self, y: U) -> Words1d<M, U> {
        let Self { memory, first, size: [width, _] } = *self;
        Words1d { memory, first: first.wrapping_add(y.wrapping_mul(width)), count: width }
    }
    #[inline(always)]
    fn marginal(&self) -> Words1d<M, U> {
        let [_, height] = self.size;
        Words1d { count: height, ..self.row(height) }
    }
    /// Draws the cell for `u`.
    #[inline(always)]
    pub fn cell<R: Real<Uint = U>>(&self, u: Vec2<R>) -> Cell2d<R>
    where
        M: Memory<R>,
    {
        let row = self.marginal().cell(u.y);
        let column = self.row(row.index).cell(u.x);
        Cell2d {
            x: column.index,
            y: row.index,
            offset: Vec2::new(column.offset, row.offset),
            pmf: row.pmf * column.pmf,
        }
    }
    /// Probability of a cell; 0 outside the image.
    #[inline(always)]
    pub fn pmf<R: Real<Uint = U>>(&self, x: U, y: U) -> R
    where
        M: Memory<R>,
    {
        self.marginal().pmf::<R>(y) * self.row(y).pmf::<R>(x)
    }
    /// Returns the `u` that `cell` maps to a position in a cell.
    #[inline(always)]
    pub fn invert_cell<R: Real<Uint = U>>(&self, x: U, y: U, offset: Vec2<R>) -> Vec2<R>
    where
        M: Memory<R>,
    {
        Vec2::new(self.row(y).invert_cell(x, offset.x), self.marginal().invert_cell(y, offset.y))
    }
}
