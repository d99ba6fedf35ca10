//! A hierarchy of boxes of a picture's cells, in the caller's memory.

use super::cells::{Drawn, Grid, Level, Measure, STEPS, Walk};
use crate::real::{Real, Uint};
use wide::f32x4;

/// Numbers of a box in the buffer, which are next to each other: a cache line.
const ENTRIES: usize = 16;

/// A level of the hierarchy: boxes of 4 × 4 parts, or 2 × 2.
struct Boxes {
    /// Where its boxes begin.
    first: u32,
    /// Boxes have 2ᵏ columns and rows, and so many are beside each other.
    log: u32,
    across: u32,
    /// Parts have 2ᵏ columns and rows.
    part: u32,
}

impl Boxes {
    /// Whether a box may have fewer parts than four, in a number of columns or of rows.
    const fn is_cut(&self, count: u32) -> bool {
        self.log == self.part + 1 || !count.is_multiple_of(1 << self.log)
    }
}

/// The levels of a picture of this size, from the whole picture on.
struct Levels {
    size: [u32; 2],
    boxes: u32,
    log: u32,
}

impl Levels {
    #[inline]
    const fn new(size: [u32; 2]) -> Self {
        let longest = if size[0] > size[1] { size[0] } else { size[1] };
        let log = if longest > 1 { 32 - (longest - 1).leading_zeros() } else { 0 };
        Self { size, boxes: 0, log }
    }
    /// The next level, while a box has more than one cell.
    #[inline]
    const fn advance(&mut self) -> Option<Boxes> {
        let (first, log) = (self.boxes, self.log);
        if log == 0 {
            return None;
        }
        // boxes of 2 × 2 come second: the picture as a whole is the nearest of all boxes, the last ones are many
        let is_half = log == 1 || log % 2 == 1 && first > 0;
        self.log -= if is_half { 1 } else { 2 };
        let across = self.size[0].div_ceil(1 << log);
        self.boxes += across * self.size[1].div_ceil(1 << log);
        Some(Boxes { first, log, across, part: self.log })
    }
}

impl Iterator for Levels {
    type Item = Boxes;
    #[inline(always)]
    fn next(&mut self) -> Option<Boxes> {
        self.advance()
    }
}

/// For each box, how much of its weight is before the edges between its parts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hierarchy<'a> {
    /// By level, and row by row: the shares before the second to the fourth row of parts, then for each of these rows those before its
    /// second to its fourth part, and a 0.
    entries: &'a [f32],
    /// Number of cells.
    size: [u32; 2],
}

impl<'a> Hierarchy<'a> {
    /// Number of entries.
    #[inline]
    pub(super) const fn length(size: [u32; 2]) -> usize {
        let mut levels = Levels::new(size);
        while levels.advance().is_some() {}
        levels.boxes as usize * ENTRIES
    }
    /// The hierarchy in a buffer of this [`length`](Self::length).
    #[inline]
    pub(super) const fn new(buffer: &'a [f32], size: [u32; 2]) -> Self {
        Self { entries: buffer, size }
    }
    /// Fills a buffer, given the weight of each cell times its area; none if all are 0.
    pub(super) fn fill(buffer: &mut [f32], size: [u32; 2], weight: impl Fn(usize, usize) -> f64) -> Option<()> {
        let [width, height] = size.map(|n| n as usize);
        let mut boxes = buffer.chunks_exact_mut(ENTRIES);
        for Boxes { log, across, part: side, .. } in Levels::new(size) {
            let rows = size[1].div_ceil(1 << log);
            for (row, column) in
                (0..rows as usize).flat_map(|row| (0..across as usize).map(move |column| (row, column)))
            {
                let part = |y: usize, x: usize| -> f64 {
                    let cells = |begin: usize, i: usize, n: usize| {
                        let end = ((begin + 1) << log).min(n);
                        ((begin << log) + (i << side)).min(end)..((begin << log) + ((i + 1) << side)).min(end)
                    };
                    let columns = cells(column, x, width);
                    cells(row, y, height).map(|y| columns.clone().map(|x| weight(x, y)).sum::<f64>()).sum()
                };
                let parts: [[f64; 4]; 4] = core::array::from_fn(|y| core::array::from_fn(|x| part(y, x)));
                let entries = boxes.next()?;
                entries[0..3].copy_from_slice(&shares(parts.map(|row| row.iter().sum())));
                for (entries, row) in entries[3..].chunks_exact_mut(3).zip(parts) {
                    entries.copy_from_slice(&shares(row));
                }
                entries[15] = 0.0;
            }
        }
        (0..height).any(|y| (0..width).any(|x| weight(x, y) > 0.0)).then_some(())
    }
    /// Columns and rows of cells.
    #[inline(always)]
    pub(super) const fn size(&self) -> [u32; 2] {
        self.size
    }
    /// Goes down to a cell. At each edge between slabs, `before` is asked whether it is before the edge, given the axis, and the first step
    /// and the first column or row after the edge.
    // by far the longest part: one copy for each measure
    #[inline]
    pub(super) fn walk<R: Real>(
        &self,
        grid: Grid,
        measure: &impl Measure<R>,
        before: impl Fn(usize, R, R) -> R::Mask,
    ) -> Drawn<R> {
        let mut walk = Walk::<R>::new();
        for boxes in Levels::new(self.size) {
            let Boxes { first, log, across, part } = boxes;
            let [side, length] = [part, log].map(|log| R::lit(f64::from(1_u32 << log)));
            let [x, y] = [walk.columns, walk.rows].map(|span| span.cell.to_uint().shr(log));
            let here = y.wrapping_mul(R::Uint::splat(across)).wrapping_add(x).wrapping_add(R::Uint::splat(first));
            let here = here.shl(ENTRIES.trailing_zeros());
            // where all boxes of the level have four parts, that need not be found out for each
            let cut = self.size.map(|count| boxes.is_cut(count));
            let shares = |row: Option<R::Uint>| match (self.entries, row) {
                // the first box is the same for all lanes
                ([a, b, c, ..], None) if first == 0 => [*a, *b, *c].map(|share| R::lit(f64::from(share))),
                (entries, row) => shares_at::<R>(entries, row.map_or(here, |row| here.wrapping_add(row))),
            };
            walk.descend(grid, &Level { length, side, cut }, shares, measure, &before);
        }
        walk.drawn()
    }
}

/// The three shares that begin at these entries.
#[inline(always)]
fn shares_at<R: Real>(entries: &[f32], first: R::Uint) -> [R; 3] {
    // of four, for which there are instructions, the last one is not used
    let four = |lane: usize| {
        let first = first.lane(lane) as usize;
        entries.get(first..first + 4).and_then(|four| four.try_into().ok()).unwrap_or([1.0; 4])
    };
    let scalar = |x: f32| R::Scalar::lit(f64::from(x));
    let mut shares = [[[0.0; 4]; 4]; 4];
    if R::LANES % 4 != 0 || R::LANES > 4 * shares.len() {
        return [0, 1, 2].map(|k| R::from_fn(|lane| scalar(four(lane)[k])));
    }
    for (k, shares) in shares.iter_mut().enumerate().take(R::LANES / 4) {
        *shares = f32x4::transpose(core::array::from_fn(|lane| four(k * 4 + lane).into())).map(f32x4::to_array);
    }
    core::array::from_fn(|k| R::from_fn(|lane| scalar(shares[lane / 4][k][lane % 4])))
}

/// The shares of the first, the first two and the first three weights, as multiples of 2⁻²⁴: each weight above 0 has at least one of them.
fn shares(weights: [f64; 4]) -> [f32; 3] {
    let sums = |of: [f64; 4]| {
        let mut sum = 0.0;
        of.map(|part| {
            sum += part;
            sum
        })
    };
    let (below, kept) = (sums(weights), sums(weights.map(|weight| f64::from(weight > 0.0))));
    let (all, rest) = (below[3], STEPS - kept[3]);
    [0, 1, 2].map(|k| {
        // what ends at the whole must reach it
        let part = if below[k] < all { (below[k] / all * rest + 0.5).min(rest) as u32 } else { rest as u32 };
        ((kept[k] + f64::from(part)) / STEPS) as f32
    })
}
