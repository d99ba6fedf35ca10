//! Cells of distributions, and how they are drawn from distribution functions in memory.

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
    R::lit(if R::DOUBLE { f64::EPSILON } else { f64::from(f32::EPSILON) })
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
        let at = |back: usize| {
            R::from_fn(|lane| {
                let (cdf, i) = (self.0(lane), index.lane(lane) as usize);
                let value = if i < cdf.len() && i >= back { cdf[i - back] } else { 0.0 };
                R::Scalar::lit(f64::from(value))
            })
        };
        let start = at(1);
        (start, at(0) - start)
    }
}

/// What is left of the position in a bucket, given its threshold, within its own item or the other one: a fresh number.
#[inline(always)]
pub(super) fn rest<R: Real>(own: R::Mask, fraction: R, threshold: R) -> R {
    let one = R::lit(1.0);
    let range = R::blend(own, threshold, one - threshold);
    unit_interval(R::blend(own, fraction, fraction - threshold) / range.greater(R::lit(1e-30)))
}
