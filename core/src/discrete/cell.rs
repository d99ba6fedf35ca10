//! Cells of distributions, and how they are drawn from distribution functions in memory.

use crate::real::{Real, unit_interval};
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
