//! Discrete and piecewise constant distributions over slices that the caller owns: no allocation.
//!
//! | table | draws | cost | inverse |
//! |---|---|---|---|
//! | [`PiecewiseConstant1d`] | one of n cells, and a position in it | log₂ n steps | yes |
//! | [`PiecewiseConstant2d`] | a cell of an image, and a position in it | log₂ w + log₂ h steps | yes |
//!
//! ```
//! use etendue::discrete::PiecewiseConstant1d;
//! let mut cdf = [0.0; 4];
//! let table = PiecewiseConstant1d::build(&[1.0, 0.0, 2.0, 1.0], &mut cdf).unwrap();
//! let cell = table.cell(0.5_f32);
//! assert_eq!((cell.index, cell.offset, cell.pmf), (2, 0.5, 0.5));
//! assert_eq!(table.invert_cell(2, 0.5_f32), 0.5);
//! ```
//!
//! The distribution functions of the piecewise constant tables hold multiples of 2⁻²⁴, the grid of `u`, so the pmf that they
//! report is exactly the probability with which a cell is drawn, even with a million cells. It may differ from weight/total by
//! up to 2⁻²⁴; an estimator that divides by it stays unbiased, since a cell with a weight keeps at least 2⁻²⁴, and one without
//! is never drawn.
//!
//! Every routine takes a scalar or a packet; look-ups go lane by lane, with the same bits.

mod cell;
mod rows;

use crate::real::{Real, Uint, unit_interval};
use crate::vector::Vec2;
use crate::warp::Warp;
pub use cell::{Cell, Cell2d};
pub(crate) use cell::{locate, place};
use core::fmt::{self, Display, Formatter};
use rows::Row;

/// Steps of `u` in the unit interval, and the greatest number of cells in a table.
const STEPS: f64 = 16_777_216.0;

/// Why a table cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TableError {
    /// The lengths of the slices do not match, or there are no cells, or more than 2²⁴.
    Length,
    /// A weight is negative, infinite or NaN.
    Weight,
    /// All weights are 0, so there is nothing to draw.
    Empty,
}
impl Display for TableError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Length => "slice lengths do not match, or the table has no cells or more than 2^24",
            Self::Weight => "a weight is negative, infinite or NaN",
            Self::Empty => "all weights are 0",
        })
    }
}
impl core::error::Error for TableError {}

/// Sum of the weights, if all are valid, and number of those above 0.
fn total(n: usize, weight: impl Fn(usize) -> f64) -> Result<(f64, usize), TableError> {
    let (mut sum, mut some) = (0.0, 0);
    for i in 0..n {
        let w = weight(i);
        if !(0.0..=f64::MAX).contains(&w) {
            return Err(TableError::Weight);
        }
        sum += w;
        some += usize::from(w > 0.0);
    }
    Ok((sum, some))
}

/// Fills `cdf[i]` with the sum of the weights up to and including i, over the total, on the grid of 2⁻²⁴; each weight above 0
/// gets at least one step. Sums are in double precision: with 1e6 cells they are off by less than 1e−10.
fn accumulate(cdf: &mut [f32], weight: impl Fn(usize) -> f64) -> Result<(), TableError> {
    if cdf.is_empty() || cdf.len() > STEPS as usize {
        return Err(TableError::Length);
    }
    let (sum, mut some) = total(cdf.len(), &weight)?;
    if some == 0 {
        return Err(TableError::Empty);
    }
    let (mut running, mut steps) = (0.0, 0.0);
    for (i, entry) in cdf.iter_mut().enumerate() {
        let w = weight(i);
        if w > 0.0 {
            running += w;
            some -= 1;
            // the nearest step, but at least one for this cell and for each that follows
            let nearest = (running / sum * STEPS + 0.5) as u32;
            steps = f64::from(nearest).greater(steps + 1.0).lesser(STEPS - some as f64);
            if some == 0 {
                steps = STEPS;
            }
        }
        *entry = (steps / STEPS) as f32;
    }
    Ok(())
}

/// A distribution on [0, 1) whose pdf is constant in each of n equal cells: for tables and one-dimensional images.
///
/// Call `PiecewiseConstant1d::build(&weights, &mut cdf)`, then `cell` for a cell or `sample` for a point. Weights that are
/// invalid or all 0 are an error when the table is built.
///
/// - Formula: bisection finds the first cell whose cumulative weight exceeds u; the rest of u over the cell's width is the
///   position in it.
/// - Domain: u in [0, 1); 1 to 2²⁴ cells with finite weights ≥ 0, in any unit.
/// - Density: the pdf is n × the cell's pmf per unit length of [0, 1), 0 elsewhere. Cells without weight are never drawn.
/// - Degenerate input: if all weights are 0, `build` returns [`TableError::Empty`].
/// - Greatest error: each pmf is within n·2⁻²⁴ of weight/total (within 2⁻²⁴ where no weight is below 2⁻²⁴ of the total), and
///   exactly the probability of the draw; position × pmf is off by up to 2⁻²⁴.
/// - Source: the inverse of the distribution function.
#[derive(Clone, Copy, Debug)]
pub struct PiecewiseConstant1d<'a> {
    cdf: &'a [f32],
}

impl<'a> PiecewiseConstant1d<'a> {
    /// Builds the distribution function in the caller's buffer, which must be as long as the weights.
    ///
    /// # Errors
    /// Fails if the lengths differ, a weight is invalid, or all are 0.
    pub fn build(weights: &[f32], cdf: &'a mut [f32]) -> Result<Self, TableError> {
        if weights.len() != cdf.len() {
            return Err(TableError::Length);
        }
        accumulate(cdf, |i| f64::from(weights[i]))?;
        Ok(Self { cdf })
    }
    /// Number of cells.
    #[inline(always)]
    #[must_use]
    pub fn cells(&self) -> usize {
        self.cdf.len()
    }
    /// Draws the cell for `u`.
    #[inline(always)]
    pub fn cell<R: Real>(&self, u: R) -> Cell<R> {
        self.row().cell(u)
    }
    /// Probability of a cell; 0 past the last one.
    #[inline(always)]
    pub fn pmf<R: Real>(&self, index: R::Uint) -> R {
        self.row().pmf(index)
    }
    /// Returns the `u` that `cell` maps to a position in a cell.
    #[inline(always)]
    pub fn invert_cell<R: Real>(&self, index: R::Uint, offset: R) -> R {
        self.row().invert_cell(index, offset)
    }
    #[inline(always)]
    fn row<U: Uint>(&self) -> Row<'a, U> {
        Row { cdfs: self.cdf, first: U::splat(0), count: self.cdf.len() as u32 }
    }
    #[inline(always)]
    fn count<R: Real>(&self) -> R {
        R::lit(self.cdf.len() as f64)
    }
    /// Maps `u` in [0, 1) to a point of [0, 1).
    #[inline(always)]
    pub fn sample<R: Real>(&self, u: R) -> R {
        let cell = self.cell(u);
        place(cell.index, cell.offset, self.count())
    }
    /// The pdf per unit length of [0, 1).
    #[inline(always)]
    pub fn pdf<R: Real>(&self, x: R) -> R {
        let inside = x.ge(R::lit(0.0)) & x.lt(R::lit(1.0));
        let (index, _) = locate(unit_interval(x), self.count::<R>());
        (self.pmf::<R>(index) * self.count()).keep(inside)
    }
    /// Returns the `u` in [0, 1) that `sample` maps to a point.
    #[inline(always)]
    pub fn invert<R: Real>(&self, x: R) -> R {
        let (index, offset) = locate(unit_interval(x), self.count::<R>());
        self.invert_cell(index, offset)
    }
}

/// A distribution on the unit square whose pdf is constant in each cell of an image: draws the row by its sum, then the column
/// within the row.
///
/// Call `PiecewiseConstant2d::build(&weights, width, &mut buffer)`, then `cell` for a cell or `sample` for a point. Weights
/// that are invalid or all 0 are an error when the table is built.
///
/// ```
/// use etendue::{Vec2, Warp, discrete::PiecewiseConstant2d};
/// let mut buffer = [0.0; PiecewiseConstant2d::buffer(2, 2)];
/// let image = PiecewiseConstant2d::build(&[0.0, 1.0, 3.0, 0.0], 2, &mut buffer).unwrap();
/// let p = image.sample(Vec2::new(0.5_f32, 0.125));
/// assert_eq!((p.x, p.y), (0.75, 0.25));
/// assert_eq!(image.pdf(p), 1.0);
/// assert_eq!(image.pdf(Vec2::new(0.25_f32, 0.75)), 3.0);
/// ```
///
/// - Formula: u₁ draws the row, u₀ the column, each as in [`PiecewiseConstant1d`].
/// - Domain: u in [0, 1)²; w, h from 1 to 2²⁴, and a buffer of less than 2³² entries; finite weights ≥ 0, in any unit, row by row.
/// - Density: the pdf is wh × the cell's pmf per unit area of the unit square, 0 elsewhere. Cells without weight are never
///   drawn.
/// - Degenerate input: if all weights are 0, `build` returns [`TableError::Empty`].
/// - Greatest error: that of [`PiecewiseConstant1d`], for the row and for the column.
/// - Source: Pharr, Jakob and Humphreys, PBR 4th ed., A.4.
#[derive(Clone, Copy, Debug)]
pub struct PiecewiseConstant2d<'a> {
    /// The distribution functions of the rows, then that of their sums.
    cdfs: &'a [f32],
    width: u32,
    height: u32,
}

impl<'a> PiecewiseConstant2d<'a> {
    /// Length of the buffer for w × h cells: wh + h.
    #[inline(always)]
    #[must_use]
    pub const fn buffer(width: usize, height: usize) -> usize {
        width * height + height
    }
    /// Builds the distribution functions of the rows and of their sums in the caller's buffer of [`buffer`](Self::buffer)
    /// entries.
    ///
    /// # Errors
    /// Fails if the lengths do not match, a weight is invalid, or all are 0.
    pub fn build(weights: &[f32], width: usize, buffer: &'a mut [f32]) -> Result<Self, TableError> {
        Self::build_by_rows(weights, width, |_| 1.0, buffer)
    }
    /// As [`build`](Self::build), with the weights of row y times `factor(y)`, which must be finite and greater than 0.
    ///
    /// # Errors
    /// As for [`build`](Self::build).
    pub fn build_by_rows(
        weights: &[f32],
        width: usize,
        factor: impl Fn(usize) -> f64,
        buffer: &'a mut [f32],
    ) -> Result<Self, TableError> {
        let height = weights.len().checked_div(width).unwrap_or(0);
        if weights.len() != width * height || height == 0 || buffer.len() != Self::buffer(width, height) {
            return Err(TableError::Length);
        }
        let (rows, marginal) = buffer.split_at_mut(width * height);
        let weight = |x: usize, y: usize| f64::from(weights[y * width + x]);
        for (y, cdf) in rows.chunks_exact_mut(width).enumerate() {
            match accumulate(cdf, |x| weight(x, y)) {
                // this row is never drawn
                Err(TableError::Empty) => cdf.fill(0.0),
                other => other?,
            }
        }
        accumulate(marginal, |y| (0..width).map(|x| weight(x, y)).sum::<f64>() * factor(y))?;
        Self::from_buffer(buffer, width)
    }
    /// Reads the table that [`build`](Self::build) left in a buffer. The contents are not validated, but no contents cause a
    /// panic.
    ///
    /// # Errors
    /// Fails if no table with this width has a buffer of this length.
    #[inline]
    pub fn from_buffer(buffer: &'a [f32], width: usize) -> Result<Self, TableError> {
        let height = buffer.len() / width.saturating_add(1);
        if width == 0 || height == 0 || buffer.len() != Self::buffer(width, height) || buffer.len() > u32::MAX as usize
        {
            return Err(TableError::Length);
        }
        Ok(Self { cdfs: buffer, width: width as u32, height: height as u32 })
    }
    /// Width and height in cells.
    #[inline(always)]
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        [self.width as usize, self.height as usize]
    }
    #[inline(always)]
    fn row<U: Uint>(&self, y: U) -> Row<'a, U> {
        Row { cdfs: self.cdfs, first: y.wrapping_mul(U::splat(self.width)), count: self.width }
    }
    /// The distribution of the rows, after all of them.
    #[inline(always)]
    fn marginal<U: Uint>(&self) -> Row<'a, U> {
        Row { count: self.height, ..self.row(U::splat(self.height)) }
    }
    /// Draws the cell for `u`.
    #[inline(always)]
    pub fn cell<R: Real>(&self, u: Vec2<R>) -> Cell2d<R> {
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
    pub fn pmf<R: Real>(&self, x: R::Uint, y: R::Uint) -> R {
        self.marginal().pmf::<R>(y) * self.row(y).pmf::<R>(x)
    }
    /// Returns the `u` that `cell` maps to a position in a cell.
    #[inline(always)]
    pub fn invert_cell<R: Real>(&self, x: R::Uint, y: R::Uint, offset: Vec2<R>) -> Vec2<R> {
        Vec2::new(self.row(y).invert_cell(x, offset.x), self.marginal().invert_cell(y, offset.y))
    }
}

impl<R: Real> Warp<R> for PiecewiseConstant2d<'_> {
    type Point = Vec2<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec2<R> {
        let cell = self.cell(u);
        let [w, h] = self.size().map(|n| R::lit(n as f64));
        Vec2::new(place(cell.x, cell.offset.x, w), place(cell.y, cell.offset.y, h))
    }
    /// The pdf per unit area of the unit square.
    #[inline(always)]
    fn pdf(&self, p: Vec2<R>) -> R {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let inside = p.x.ge(zero) & p.x.lt(one) & p.y.ge(zero) & p.y.lt(one);
        let [w, h] = self.size().map(|n| R::lit(n as f64));
        let (x, y) = (locate(unit_interval(p.x), w).0, locate(unit_interval(p.y), h).0);
        (self.pmf::<R>(x, y) * (w * h)).keep(inside)
    }
    #[inline(always)]
    fn invert(&self, p: Vec2<R>) -> Vec2<R> {
        let [w, h] = self.size().map(|n| R::lit(n as f64));
        let ((x, column), (y, row)) = (locate(unit_interval(p.x), w), locate(unit_interval(p.y), h));
        self.invert_cell(x, y, Vec2::new(column, row))
    }
}
