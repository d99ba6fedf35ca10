//! Cells of distributions, and how they are drawn from distribution functions in memory.

use crate::memory::{Memory, last_up_to};
use crate::real::{Real, Uint, unit_interval};
use crate::vector::Vec2;

/// A cell (or item) drawn from a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell<R: Real> {
    /// Index of the cell, in [0, n).
    pub index: R::Uint,
    /// Position in the cell, in [0, 1): what is left of `u`, uniform.
    pub offset: R,
    /// Probability of the cell, in [0, 1]; times the number of cells, it is the pdf on [0, 1).
    pub pmf: R,
}

/// A cell of an image drawn from a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell2d<R: Real> {
    /// Column, in [0, w).
    pub x: R::Uint,
    /// Row, in [0, h).
    pub y: R::Uint,
    /// Position in the cell, in [0, 1)².
    pub offset: Vec2<R>,
    /// Probability of the cell, in [0, 1]; times the number of cells, it is the pdf per unit area of the unit square.
    pub pmf: R,
}

/// Twice the relative rounding error of one operation.
#[inline(always)]
fn epsilon<R: Real>() -> R {
    R::lit(if size_of::<R::Scalar>() == 4 { f64::from(f32::EPSILON) } else { f64::EPSILON })
}

/// The number in [0, 1) for a position in cell `index` of n: (index + offset)/n, moved by an ulp where rounding left the cell.
#[inline(always)]
pub(crate) fn place<R: Real>(index: R::Uint, offset: R, n: R) -> R {
    let i = R::from_uint(index);
    let x = (i + offset) / n;
    // xn − i, exact up to its last rounding, which keeps the sign and whether it reaches 1
    let scaled = x * n;
    let position = (scaled - i) + R::two_prod_error(x, n, scaled);
    let x = R::blend(position.lt(R::lit(0.0)), x + x * epsilon(), x);
    R::blend(position.ge(R::lit(1.0)), x - x * (epsilon::<R>() * R::lit(0.5)), x)
}

/// The inverse: cell and position of x in [0, 1). The product is not rounded before its integer part is taken.
#[inline(always)]
pub(crate) fn locate<R: Real>(x: R, n: R) -> (R::Uint, R) {
    let (zero, one) = (R::lit(0.0), R::lit(1.0));
    let scaled = x * n;
    let i = R::from_uint(scaled.to_uint());
    let position = (scaled - i) + R::two_prod_error(x, n, scaled);
    let (below, above) = (position.lt(zero), position.ge(one));
    let i = R::blend(below, i - one, R::blend(above, i + one, i));
    let position = R::blend(below, position + one, R::blend(above, position - one, position));
    (i.clamped(zero, n - one).to_uint(), unit_interval(position))
}

/// A distribution function in memory, which may differ by lane.
pub(super) trait Row<R: Real> {
    /// The first cell that ends above `u`, or the last one: it has a width, since the one before it ends at or below `u`.
    fn find(&self, u: R) -> R::Uint;
    /// Start and width of a cell; 0 and 0 past the last one.
    fn bounds(&self, index: R::Uint) -> (R, R);
}

/// Cell, position and pmf of `u`.
#[inline(always)]
pub(super) fn draw<R: Real>(u: R, row: &impl Row<R>) -> Cell<R> {
    let u = unit_interval(u);
    let index = row.find(u);
    let (start, pmf) = row.bounds(index);
    let some = pmf.gt(R::lit(0.0));
    let offset = unit_interval((u - start) / R::blend(some, pmf, R::lit(1.0)));
    Cell { index, offset, pmf }
}

/// The row of each lane.
pub(super) struct Rows<F>(pub(super) F);

impl<'a, R: Real, F: Fn(usize) -> &'a [f32]> Row<R> for Rows<F> {
    #[inline(always)]
    fn find(&self, u: R) -> R::Uint {
        R::Uint::from_fn(|lane| {
            let (cdf, u) = (self.0(lane), u.lane_f64(lane));
            cdf.partition_point(|&end| f64::from(end) <= u).min(cdf.len() - 1) as u32
        })
    }
    #[inline(always)]
    fn bounds(&self, index: R::Uint) -> (R, R) {
        let row = &self.0;
        let at = |lane: usize, back: usize| {
            let i = index.lane(lane) as usize;
            let cdf = row(lane);
            let value = if i < cdf.len() && i >= back { cdf[i - back] } else { 0.0 };
            R::Scalar::lit(f64::from(value))
        };
        let start =
            R::from_fn(|lane| if (index.lane(lane) as usize) < row(lane).len() { at(lane, 1) } else { at(lane, 0) });
        let end = R::from_fn(|lane| at(lane, 0));
        (start, end - start)
    }
}

/// `count` words of memory.
struct WordsRow<M, U> {
    memory: M,
    first: U,
    count: U,
}

impl<R: Real, M: Memory<R>> Row<R> for WordsRow<M, R::Uint> {
    #[inline(always)]
    fn find(&self, u: R) -> R::Uint {
        // the last cell before which one ends up to u; there is none before the first
        last_up_to(&self.memory, self.first.wrapping_sub(R::Uint::splat(1)), self.count, u)
    }
    #[inline(always)]
    fn bounds(&self, index: R::Uint) -> (R, R) {
        let inside = R::has_bits(index.lt(self.count));
        let at = self.first.wrapping_add(index);
        let end = self.memory.number(at).keep(inside);
        let before = self.memory.number(at.wrapping_sub(R::Uint::splat(1)));
        let start = before.keep(inside & R::has_bits(index));
        (start, end - start)
    }
}

/// A [`PiecewiseConstant2d`](crate::discrete::PiecewiseConstant2d) as words in [memory](crate::memory): the buffer that it was built in, from the index `first` on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Words2d<M, U> {
    pub(crate) memory: M,
    pub(crate) first: U,
    pub(crate) size: [U; 2],
}

impl<M: Copy, U: Uint> Words2d<M, U> {
    #[inline(always)]
    fn row(&self, y: U) -> WordsRow<M, U> {
        let Self { memory, first, size: [width, _] } = *self;
        WordsRow { memory, first: first.wrapping_add(y.wrapping_mul(width)), count: width }
    }
    #[inline(always)]
    fn marginal(&self) -> WordsRow<M, U> {
        let [_, height] = self.size;
        WordsRow { count: height, ..self.row(height) }
    }
    /// See [`PiecewiseConstant2d::cell`](crate::discrete::PiecewiseConstant2d::cell).
    #[inline(always)]
    pub(crate) fn cell<R: Real<Uint = U>>(&self, u: Vec2<R>) -> Cell2d<R>
    where
        M: Memory<R>,
    {
        let row = draw(u.y, &self.marginal());
        let column = draw(u.x, &self.row(row.index));
        Cell2d {
            x: column.index,
            y: row.index,
            offset: Vec2::new(column.offset, row.offset),
            pmf: row.pmf * column.pmf,
        }
    }
    /// See [`PiecewiseConstant2d::pmf`](crate::discrete::PiecewiseConstant2d::pmf).
    #[inline(always)]
    pub(crate) fn pmf<R: Real<Uint = U>>(&self, x: U, y: U) -> R
    where
        M: Memory<R>,
    {
        let ((_, row), (_, column)) = (Row::<R>::bounds(&self.marginal(), y), Row::<R>::bounds(&self.row(y), x));
        row * column
    }
    /// See [`PiecewiseConstant2d::invert_cell`](crate::discrete::PiecewiseConstant2d::invert_cell).
    #[inline(always)]
    pub(crate) fn invert_cell<R: Real<Uint = U>>(&self, x: U, y: U, offset: Vec2<R>) -> Vec2<R>
    where
        M: Memory<R>,
    {
        let invert = |row: &WordsRow<M, U>, index: U, offset: R| {
            let (start, width) = Row::<R>::bounds(row, index);
            unit_interval(offset.mul_add(width, start))
        };
        Vec2::new(invert(&self.row(y), x, offset.x), invert(&self.marginal(), y, offset.y))
    }
}
