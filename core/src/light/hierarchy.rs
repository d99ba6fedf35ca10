//! A hierarchy of boxes of a picture's cells: which cell, in proportion to its weight and to a measure of the boxes.

use crate::real::{Mask, Real, Uint, unit_interval};
use crate::vector::Vec2;
use wide::f32x4;

/// Steps of `u` in the unit interval, and the greatest number of columns and of rows.
pub(super) const STEPS: f64 = 16_777_216.0;

/// Numbers of a box in the buffer, which are next to each other: a cache line.
const ENTRIES: usize = 16;

/// Columns and rows of cells, and where they are on the picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    /// Number of cells.
    pub(super) size: [u32; 2],
    /// Whether the cells at the rim are half as wide as the others.
    pub(super) halved: bool,
}

impl Grid {
    #[inline(always)]
    pub(super) fn counts<R: Real>(&self) -> Vec2<R> {
        let [w, h] = self.size.map(|n| R::lit(f64::from(n)));
        Vec2::new(w, h)
    }
    /// One over the numbers of columns and rows that are whole, which [`edge`](Self::edge) needs.
    #[inline(always)]
    pub(super) fn pitch<R: Real>(&self) -> Vec2<R> {
        let (counts, one) = (self.counts::<R>(), R::lit(1.0));
        let pitch = |count: R| one / if self.halved { count - one } else { count };
        Vec2::new(pitch(counts.x), pitch(counts.y))
    }
    /// Where columns, or rows, begin in the picture, in [0, 1].
    #[inline(always)]
    pub(super) fn edge<R: Real>(&self, at: R, pitch: R) -> R {
        if self.halved { ((at - R::lit(0.5)) * pitch).clamped(R::lit(0.0), R::lit(1.0)) } else { at * pitch }
    }
}

/// A box of cells, from `low` to `high`, as parts of the picture's sides.
#[derive(Clone, Copy)]
pub(super) struct Box2<R> {
    pub(super) low: Vec2<R>,
    pub(super) high: Vec2<R>,
}

/// A box that is cut into four, along one side: those past the last column or row are empty.
#[derive(Clone, Copy)]
pub(super) struct Slabs<R> {
    /// 0 where they are beside each other along u, 1 along v.
    pub(super) axis: usize,
    /// The edges between them, as parts of the picture's side.
    pub(super) along: [R; 5],
    /// From where to where they extend along the other axis.
    pub(super) across: [R; 2],
}

impl<R: Real> Slabs<R> {
    #[inline(always)]
    pub(super) fn slab(&self, k: usize) -> Box2<R> {
        let (along, across) = ([self.along[k], self.along[k + 1]], self.across);
        let [x, y] = if self.axis == 0 { [along, across] } else { [across, along] };
        Box2 { low: Vec2::new(x[0], y[0]), high: Vec2::new(x[1], y[1]) }
    }
    #[inline(always)]
    pub(super) fn each(&self) -> [Box2<R>; 4] {
        core::array::from_fn(|k| self.slab(k))
    }
}

/// How much of the measure, per unit of the picture's area, the slabs of a box have.
pub(super) trait Measure<R: Real> {
    /// Numbers ≥ 0 in proportion to it, for slabs that are not empty neither infinite nor NaN. A slab in which a sample can have a pdf has
    /// more than 0.
    ///
    /// Also, whether the parts of these slabs can differ by more than 1 %: where not, nothing more is asked.
    fn densities(&self, of: &Slabs<R>) -> ([R; 4], R::Mask);
}

/// A cell that was drawn.
#[derive(Clone, Copy)]
pub(super) struct Drawn<R: Real> {
    /// Column and row.
    pub(super) cell: Vec2<R>,
    /// The first step of the cell in u₀ and u₁.
    start: Vec2<R>,
    /// Number of its steps.
    steps: Vec2<R>,
}

impl<R: Real> Drawn<R> {
    /// Probability of the cell.
    #[inline(always)]
    pub(super) fn pmf(&self) -> R {
        let step = R::lit(1.0 / STEPS);
        (self.steps.x * step) * (self.steps.y * step)
    }
    /// The `u` for a position in the cell.
    #[inline(always)]
    pub(super) fn invert(&self, within: Vec2<R>) -> Vec2<R> {
        let step = R::lit(1.0 / STEPS);
        let at = |start: R, steps: R, within: R| {
            // the number below the next cell's first step
            let end = start + steps;
            within.mul_add(steps, start).lesser(end - end * step) * step
        };
        let Self { start, steps, .. } = self;
        Vec2::new(at(start.x, steps.x, within.x), at(start.y, steps.y, within.y))
    }
}

/// A level of the hierarchy: boxes of 4 × 4 parts, or 2 × 2.
struct Level {
    /// Where its boxes begin.
    first: u32,
    /// Boxes have 2ᵏ columns and rows, and so many are beside each other.
    log: u32,
    across: u32,
    /// Parts have 2ᵏ columns and rows.
    part: u32,
}

impl Level {
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
    const fn new(size: [u32; 2]) -> Self {
        let longest = if size[0] > size[1] { size[0] } else { size[1] };
        let log = if longest > 1 { 32 - (longest - 1).leading_zeros() } else { 0 };
        Self { size, boxes: 0, log }
    }
    /// The next level, while a box has more than one cell.
    const fn advance(&mut self) -> Option<Level> {
        let (first, log) = (self.boxes, self.log);
        if log == 0 {
            return None;
        }
        // boxes of 2 × 2 come second: the picture as a whole is the nearest of all boxes, the last ones are many
        let is_half = log == 1 || log % 2 == 1 && first > 0;
        self.log -= if is_half { 1 } else { 2 };
        let across = self.size[0].div_ceil(1 << log);
        self.boxes += across * self.size[1].div_ceil(1 << log);
        Some(Level { first, log, across, part: self.log })
    }
}

impl Iterator for Levels {
    type Item = Level;
    #[inline(always)]
    fn next(&mut self) -> Option<Level> {
        self.advance()
    }
}

/// For each box, how much of its weight is before the edges between its parts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hierarchy<'a> {
    /// By level, and row by row: the shares before the second to the fourth row of parts, then for each of these rows those before its
    /// second to its fourth part, and a 0.
    entries: &'a [f32],
    pub(super) grid: Grid,
}

impl<'a> Hierarchy<'a> {
    /// Number of entries.
    pub(super) const fn length(size: [u32; 2]) -> usize {
        let mut levels = Levels::new(size);
        while levels.advance().is_some() {}
        levels.boxes as usize * ENTRIES
    }
    /// Of a buffer of this length.
    pub(super) const fn new(buffer: &'a [f32], grid: Grid) -> Self {
        Self { entries: buffer, grid }
    }
    /// Fills a buffer, given the weight of each cell times its area; none if all are 0.
    pub(super) fn fill(buffer: &mut [f32], size: [u32; 2], weight: impl Fn(usize, usize) -> f64) -> Option<()> {
        let [width, height] = size.map(|n| n as usize);
        let mut boxes = buffer.chunks_exact_mut(ENTRIES);
        for Level { log, across, part: side, .. } in Levels::new(size) {
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
    /// The cell that `u` draws, and the position in it.
    #[inline(always)]
    pub(super) fn draw<R: Real>(&self, u: Vec2<R>, measure: &impl Measure<R>) -> (Drawn<R>, Vec2<R>) {
        let (zero, steps) = (R::lit(0.0), R::lit(STEPS));
        let least = |x: R| x.clamped(zero, R::ONE_MINUS_EPSILON) * steps;
        let at = Vec2::new(least(u.x), least(u.y));
        let drawn = self.walk(measure, |axis, step, _| if axis == 0 { at.x.lt(step) } else { at.y.lt(step) });
        // the differences are exact
        let within = |at: R, start: R, steps: R| unit_interval((at - start) / steps);
        let Drawn { start, steps, .. } = drawn;
        (drawn, Vec2::new(within(at.x, start.x, steps.x), within(at.y, start.y, steps.y)))
    }
    /// A cell, given its column and row, and how it is drawn.
    #[inline(always)]
    pub(super) fn find<R: Real>(&self, cell: Vec2<R>, measure: &impl Measure<R>) -> Drawn<R> {
        self.walk(measure, |axis, _, edge| if axis == 0 { cell.x.lt(edge) } else { cell.y.lt(edge) })
    }
    /// Goes down to a cell. At each edge between slabs, `before` is asked whether it is before the edge, given the axis, and the first step
    /// and the first column or row after the edge.
    // by far the longest part: one copy for each measure
    #[inline]
    fn walk<R: Real>(&self, measure: &impl Measure<R>, before: impl Fn(usize, R, R) -> R::Mask) -> Drawn<R> {
        let zero = R::lit(0.0);
        let pair = |v: Vec2<R>| [v.x, v.y];
        let (counts, pitch) = (pair(self.grid.counts::<R>()), pair(self.grid.pitch::<R>()));
        let whole = Span { start: zero, steps: R::lit(STEPS), cell: zero };
        let [mut columns, mut rows] = [whole; 2];
        let mut differ = R::Mask::splat(true);
        for level in Levels::new(self.grid.size) {
            let Level { first, log, across, part } = level;
            let [side, length] = [part, log].map(|log| R::lit(f64::from(1_u32 << log)));
            let [x, y] = [columns, rows].map(|span| span.cell.to_uint().shr(log));
            let here = y.wrapping_mul(R::Uint::splat(across)).wrapping_add(x).wrapping_add(R::Uint::splat(first));
            let here = here.shl(ENTRIES.trailing_zeros());
            // where all boxes of the level have four parts, that need not be found out for each
            let [cut_x, cut_y] = self.grid.size.map(|count| level.is_cut(count));
            let end_x = (columns.cell + length).lesser(counts[0]);
            let end_y = (rows.cell + length).lesser(counts[1]);
            let edge = |at: R, axis: usize| self.grid.edge(at, pitch[axis]);
            let slabs = |axis: usize, along: &[R; 5], across: [R; 2]| Slabs {
                axis,
                along: along.map(|at| edge(at, axis)),
                across: across.map(|at| edge(at, 1 - axis)),
            };

            let at = rows.edges(side, cut_y.then_some(end_y));
            let shares = match self.entries {
                // the first box is the same for all lanes
                [a, b, c, ..] if first == 0 => [*a, *b, *c].map(|share| R::lit(f64::from(share))),
                entries => shares_at::<R>(entries, here),
            };
            let cuts = if differ.any() {
                let (densities, _) = measure.densities(&slabs(1, &at, [columns.cell, end_x]));
                rows.cuts(shares, side, cut_y.then_some(&at), Some((densities, differ)))
            } else {
                rows.cuts(shares, side, cut_y.then_some(&at), None)
            };
            let [i, j, k] = [0, 1, 2].map(|k| before(1, rows.start + cuts[k], at[k + 1]));
            rows.go([i, j, k], cuts, &at);
            let row = [3, 6, 9, 12].map(R::Uint::splat);
            let row = R::blend_uint(i, row[0], R::blend_uint(j, row[1], R::blend_uint(k, row[2], row[3])));

            let at = columns.edges(side, cut_x.then_some(end_x));
            let shares = shares_at::<R>(self.entries, here.wrapping_add(row));
            let cuts = if differ.any() {
                let end = (rows.cell + side).lesser(end_y);
                let (densities, still) = measure.densities(&slabs(0, &at, [rows.cell, end]));
                let cuts = columns.cuts(shares, side, cut_x.then_some(&at), Some((densities, differ)));
                differ = differ & still;
                cuts
            } else {
                columns.cuts(shares, side, cut_x.then_some(&at), None)
            };
            let [i, j, k] = [0, 1, 2].map(|k| before(0, columns.start + cuts[k], at[k + 1]));
            columns.go([i, j, k], cuts, &at);
        }
        let pair = |of: fn(&Span<R>) -> R| Vec2::new(of(&columns), of(&rows));
        Drawn { cell: pair(|span| span.cell), start: pair(|span| span.start), steps: pair(|span| span.steps) }
    }
}

/// Columns or rows, and their steps.
#[derive(Clone, Copy)]
struct Span<R> {
    start: R,
    steps: R,
    /// The first column or row.
    cell: R,
}

impl<R: Real> Span<R> {
    /// Edges between four parts of so many columns or rows each, and their ends, none of which is after `end`.
    #[inline(always)]
    fn edges(&self, side: R, end: Option<R>) -> [R; 5] {
        let edge = |k: f64| {
            let edge = self.cell + side * R::lit(k);
            end.map_or(edge, |end| edge.lesser(end))
        };
        [self.cell, edge(1.0), edge(2.0), edge(3.0), edge(4.0)]
    }
    /// The steps before the second, the third and the fourth part, given the shares of what is before them, and, in some lanes, how much of
    /// the measure the parts have per area. The parts have so many columns or rows each, or lie between edges.
    ///
    /// A part with weight has one step for each of its columns or rows, and the rest is divided in proportion to the weights.
    #[inline(always)]
    fn cuts(&self, shares: [R; 3], side: R, edges: Option<&[R; 5]>, measured: Option<([R; 4], R::Mask)>) -> [R; 3] {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let all = self.steps;
        // no contents of a buffer lead past the last column or row, and they are in order
        let [mut a, mut b, mut c] = shares;
        let mut widths = [side; 4];
        if let Some(at) = edges {
            [a, b, c] = core::array::from_fn(|k| R::blend(at[k + 1].lt(at[4]), shares[k], one));
            widths = core::array::from_fn(|k| at[k + 1] - at[k]);
        }
        a = a.greater(zero);
        b = b.greater(a);
        c = c.greater(b);
        // a box that is never drawn has no steps
        let drawn = all.gt(zero);
        let mut lit = [a.gt(zero), b.gt(a), c.gt(b), one.gt(c)].map(|lit| lit & drawn);
        let (mut before, mut whole) = ([a, b, c], one);
        if let Some((densities, differ)) = measured {
            let weights = [a, b - a, c - b, one - c];
            let seen: [R; 4] = core::array::from_fn(|k| (weights[k] * densities[k]).keep(lit[k]));
            let first = seen[0] + seen[1];
            let second = first + seen[2];
            let sum = second + seen[3];
            // where the measure leaves nothing, the weight decides
            let some = differ & sum.gt(zero);
            lit = core::array::from_fn(|k| lit[k] & (seen[k].gt(zero) | !some));
            before = [R::blend(some, seen[0], a), R::blend(some, first, b), R::blend(some, second, c)];
            whole = R::blend(some, sum, one);
        }
        let widths: [R; 4] = core::array::from_fn(|k| widths[k].keep(lit[k]));
        let kept = [widths[0], widths[0] + widths[1], (widths[0] + widths[1]) + widths[2]];
        let rest = all - (kept[2] + widths[3]);
        let scale = if measured.is_some() { rest / whole } else { rest };
        core::array::from_fn(|k| {
            let part = (before[k] * scale).round_ties_even().lesser(rest);
            // what reaches the whole leaves nothing
            kept[k] + R::blend(before[k].lt(whole), part, rest)
        })
    }
    /// Goes to the part that is before the first of the edges for which that is known, or to the last part.
    #[inline(always)]
    fn go(&mut self, [i, j, k]: [R::Mask; 3], cuts: [R; 3], at: &[R; 5]) {
        let choose = |a: R, b: R, c: R, d: R| R::blend(i, a, R::blend(j, b, R::blend(k, c, d)));
        let from = choose(R::lit(0.0), cuts[0], cuts[1], cuts[2]);
        self.steps = choose(cuts[0], cuts[1], cuts[2], self.steps) - from;
        self.start += from;
        self.cell = choose(at[0], at[1], at[2], at[3]);
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
